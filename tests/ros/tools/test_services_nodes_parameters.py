"""The other tools as functions, on a graph of this process."""

from __future__ import annotations

import threading

import pytest
from ros.graph import until

from gazelle_ros import load_message, load_service
from gazelle_ros.tools import nodes, params, services
from gazelle_ros.tools.errors import ToolError

STRING = load_message("std_msgs/String")
SETBOOL = load_service("std_srvs/SetBool")


@pytest.fixture
def server(make_node):
    node = make_node("server")
    node.serve("/set", SETBOOL, lambda request: (request.data, f"got {request.data}"))
    return node


def test_services_are_described(graph, server):
    assert services.list_services(graph) == [("/set", ["/server"])]
    assert services.list_services(graph, "/nope") == []
    assert services.service_type(graph, "set") == "std_srvs/SetBool"
    assert services.services_of_type(graph, "std_srvs/SetBool") == ["/set"]
    lines = services.service_info(graph, "/set").splitlines()
    assert lines[0] == "Node: /server"
    assert lines[2:] == ["Type: std_srvs/SetBool", "Args: data"]
    with pytest.raises(ToolError, match="did you mean '/set'"):
        services.service_node(graph, "/sett")


def test_services_are_called(graph, server, make_node):
    caller = services.ServiceCaller(graph, make_node("caller"), "/set")
    assert caller.takes_values
    response = caller.call(caller.request([True]))
    assert (response.success, response.message) == (True, "got True")
    assert caller.request([{"data": False}]).data is False
    with pytest.raises(ToolError, match="Service arguments are"):
        caller.request([1, 2])


def test_nodes_are_described(graph, make_node):
    node = make_node("talker")
    node.advertise("/a", STRING)
    other = make_node("n/listener")
    other.subscribe("/a", STRING, print)
    assert nodes.list_nodes(graph) == "/n/listener\n/talker\n"
    assert nodes.list_nodes(graph, "/n") == "/n/listener\n"
    assert nodes.list_nodes(graph, uris=True, names=False) == f"{other.uri}\n{node.uri}\n"
    assert nodes.machines(graph) == ["127.0.0.1"]
    assert nodes.nodes_on(graph, "localhost") == ["/n/listener", "/talker"]
    until(lambda: node.publication("/a").num_connections)
    text = nodes.node_info(graph, "/talker")
    assert "Publications: \n * /a [std_msgs/String]\n" in text
    assert "Subscriptions: None\n" in text
    assert "Pid: " in text
    assert " * topic: /a\n    * to: /n/listener\n    * direction: outbound" in text
    with pytest.raises(ToolError, match="did you mean '/talker'"):
        nodes.node_info(graph, "/talkr")
    for name in ("\udcff", "a" * 300, ".."):
        with pytest.raises(ToolError, match="cannot resolve"):
            nodes.nodes_on(graph, name)


@pytest.mark.long
def test_nodes_answer_pings(graph, make_node, out):
    make_node("talker").advertise("/a", STRING)
    complaints = []

    def ping():
        out.seek(0)
        out.truncate()
        return nodes.ping(graph, "/talker", out, threading.Event(), count=2, complain=print)

    assert any(ping() for _ in range(10)), "even if it is held up for three seconds once"
    lines = out.getvalue().splitlines()
    assert lines[0] == "pinging /talker with a timeout of 3.0s"
    assert len(lines) == 4
    assert lines[3].startswith("ping average: ")
    assert not nodes.ping(graph, "/no", out, threading.Event(), complain=complaints.append)
    assert complaints == ["cannot ping [/no]: unknown node"]


def test_nodes_are_ended(graph, make_node):
    node = make_node("talker")
    node.advertise("/a", STRING)
    assert nodes.kill(graph, ["/talker", "/no"]) == ["/no"]
    until(lambda: node.closed)


def test_dead_nodes_are_found_and_forgotten(graph, master, make_node):
    make_node("alive").advertise("/a", STRING)
    graph.master.caller = "/dead"
    graph.master.register_publisher("/a", "std_msgs/String", "http://127.0.0.1:1/")
    graph.master.register_subscriber("/b", "std_msgs/String", "http://127.0.0.1:1/")
    graph.master.register_service("/s", "rosrpc://127.0.0.1:1", "http://127.0.0.1:1/")
    graph.master.caller = "/rostool"
    until(lambda: nodes.dead_nodes(graph) == ["/dead"])
    nodes.unregister(graph, ["/dead"])
    assert graph.nodes() == ["/alive"]
    assert graph.services() == []


def test_parameters_are_set_and_merged(graph):
    params.set_from_text(graph, "/a", "{b: 1, c: [1, x]}")
    done = params.set_from_text(graph, "/a", "{d: {e: true}}")
    assert done == [("/a/d/e", True)]
    assert params.get_parameter(graph, "/a") == {"b": 1, "c": [1, "x"], "d": {"e": True}}
    assert params.list_parameters(graph, "/a/d") == ["/a/d/e"]
    params.set_from_text(graph, "/s", "")
    assert params.get_parameter(graph, "/s") == ""


def test_parameters_have_forms(graph):
    value = {"b": 1, "d": {"t": "x\ny", "u": "z"}, "l": [1.5]}
    assert params.as_yaml(1) == "1\n"
    assert params.as_yaml("x") == "x\n"
    assert params.pretty(value) == "b: 1\nd:\n  t: |\n    x\n    y\n  u: z\nl: - 1.5\n"
    assert params.pretty("text") == "text\n"


def test_parameters_are_loaded_and_dumped(graph, tmp_path):
    path = tmp_path / "p.yaml"
    path.write_text("a: !degrees 180\n_ns: inner\n---\nb: 2\n")
    params.load_parameters(graph, str(path), "/n")
    found = params.get_parameter(graph, "/n")
    assert found == {"inner": {"a": pytest.approx(3.14159265)}, "b": 2}
    path.write_text(params.dump_parameters(graph, "/n"))
    params.load_parameters(graph, str(path), "/m")
    assert params.get_parameter(graph, "/m") == found
    path.write_text("a: [")
    with pytest.raises(ToolError, match="not valid YAML"):
        params.load_parameters(graph, str(path))
    with pytest.raises(ToolError, match="cannot be read"):
        params.load_parameters(graph, "/no/such")


def test_parameters_are_deleted(graph):
    params.set_from_text(graph, "/alpha", "1")
    with pytest.raises(ToolError, match="did you mean '/alpha'"):
        params.delete_parameter(graph, "/alpa")
    params.delete_parameter(graph, "/alpha")
    assert params.list_parameters(graph) == []
    params.set_from_text(graph, "/", "{x: 1}")
    params.delete_parameter(graph, "/")
    assert params.list_parameters(graph) == []


@pytest.mark.parametrize("text", ["[", "99999999999", "null"])
def test_values_that_cannot_be_are_refused(graph, text):
    with pytest.raises(ToolError):
        params.set_from_text(graph, "/x", text)


def test_the_root_is_a_mapping(graph):
    with pytest.raises(ToolError, match="dictionary"):
        params.set_from_text(graph, "/", "1")
