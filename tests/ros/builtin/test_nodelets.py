"""The program ``nodelet``: built-in nodes that a manager runs in its process."""

from __future__ import annotations

import signal
import threading
from functools import partial

import pytest
from ros.graph import Background, until

from gazelle_ros import load_message, load_service
from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin import registry
from gazelle_ros.builtin.arguments import CallbackWork
from gazelle_ros.builtin.nodelets import bonds
from gazelle_ros.builtin.nodelets.bonds import BondHolder
from gazelle_ros.builtin.nodelets.command import main
from gazelle_ros.builtin.nodelets.manager import NodeletManager
from gazelle_ros.builtin.package import BuiltinPackage
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.nodes import kill

STRING = load_message("std_msgs/String")


class Repeating(CallbackWork):
    """A nodelet that repeats ``in`` on ``out``, with a prefix."""

    def __init__(self, node):
        super().__init__(node)
        prefix = node.get_param("~prefix", "")
        if prefix == "wrong":
            raise RosError("the prefix is wrong")
        self.out = node.advertise("~out", STRING)
        node.subscribe(
            "in", STRING, lambda message: self.out.publish(STRING(data=prefix + message.data))
        )


class Failing(CallbackWork):
    """A nodelet that ends by an error."""

    def run(self, stop):
        raise ValueError("it broke")


@pytest.fixture(autouse=True)
def nodelets(monkeypatch):
    monkeypatch.setattr(registry, "_registered", {})
    classes = {"Repeating": f"{__name__}:Repeating", "Failing": f"{__name__}:Failing"}
    registry.register(BuiltinPackage("testing", nodelets=classes))


@pytest.fixture
def manager(make_node):
    made = NodeletManager(make_node("manager"))
    running = Background(made.run)
    yield made
    running.end()


@pytest.fixture
def call(make_node):
    """Return a function that calls a service of the manager, and returns the answer."""
    node = make_node("caller")

    def run(name, /, **fields):
        kind = load_service(f"nodelet/Nodelet{name.split('_')[0].title()}")
        client = node.client(f"/manager/{name}", kind)
        return client.call(kind._request_class(**fields))

    return run


def test_a_nodelet_has_names_parameters_and_remappings_of_its_own(manager, call, make_node, listen):
    node = make_node("setter")
    node.set_param("/here/one/prefix", "1 ")
    remappings = {"remap_source_args": ["/here/in"], "remap_target_args": ["/text"]}
    assert call("load_nodelet", name="/here/one", type="testing/Repeating", **remappings).success
    assert call("load_nodelet", name="/two", type="testing/Repeating").success
    assert call("list").nodelets == ["/here/one", "/two"]
    got = {name: listen(f"/{name}/out", STRING) for name in ("here/one", "two")}
    senders = [node.advertise(topic, STRING) for topic in ("/text", "/in")]
    until(lambda: all(each.num_connections for each in senders))
    until(lambda: all(each.num_connections for each in _outputs(manager)))
    for each, text in zip(senders, ("a", "b"), strict=True):
        each.publish(STRING(data=text))
    until(lambda: all(got.values()))
    assert [got["here/one"][0].data, got["two"][0].data] == ["1 a", "b"]
    assert call("unload_nodelet", name="/two").success
    assert call("list").nodelets == ["/here/one"]
    assert not call("unload_nodelet", name="/two").success


def _outputs(manager):
    return [each._work.out for each in manager._loaded.values()]


@pytest.mark.parametrize(
    ("name", "kind", "words"),
    [
        ("/one", "testing/Repeating", "there is a nodelet /one already"),
        ("/two", "testing/Repeatign", "did you mean 'testing/Repeating'"),
        ("/two", "nowhere/Thing", "there is no nodelet 'nowhere/Thing'"),
        ("/wrong", "testing/Repeating", "the prefix is wrong"),
    ],
)
def test_what_cannot_be_loaded_is_named_and_leaves_nothing(
    manager, call, make_node, caplog, name, kind, words
):
    make_node("setter").set_param("/wrong/prefix", "wrong")
    assert call("load_nodelet", name="/one", type="testing/Repeating").success
    assert not call("load_nodelet", name=name, type=kind).success
    assert words in caplog.text
    assert call("list").nodelets == ["/one"]


def test_a_failing_nodelet_leaves_the_others_running(manager, call, caplog):
    assert call("load_nodelet", name="/broken", type="testing/Failing").success
    until(lambda: "it broke" in caplog.text)
    assert call("load_nodelet", name="/one", type="testing/Repeating").success
    assert call("list").nodelets == ["/broken", "/one"]


def test_the_loader_waits_unloads_at_its_end_and_ends_with_the_manager(
    make_node, master, monkeypatch
):
    monkeypatch.setenv("ROS_MASTER_URI", master.uri)
    loader = Background(
        lambda _stop: main(["load", "testing/Repeating", "manager", "__name:=one", "in:=text"])
    )
    node = make_node("manager")
    made = NodeletManager(node)
    until(lambda: made.loaded == ["/one"])
    assert made._loaded["/one"]._node.resolve("in") == "/text"
    with GraphInspector("rosnode", master_uri=master.uri) as graph:
        assert kill(graph, ["/one"]) == []
    loader.end(stop=False)
    assert made.loaded == []
    loader = Background(lambda _stop: main(["load", "testing/Repeating", "manager"]))
    until(lambda: made.loaded == ["/testing_Repeating"])
    until(lambda: made._bonds._publisher.num_connections > 1)
    assert made.unload("/testing_Repeating")
    loader.end(stop=False)


@pytest.fixture
def short_bonds(monkeypatch):
    """Set short periods and timeouts of heartbeats."""
    for name, seconds in {"PERIOD": 0.05, "TIMEOUT": 1.0, "CONNECT": 1.0}.items():
        monkeypatch.setattr(bonds, f"_{name}_S", seconds)


def test_a_bond_breaks_when_the_other_side_ends_it(make_node, short_bonds):
    broken = []
    first, second = (BondHolder(make_node(name), "/bond") for name in ("first", "second"))
    for name in ("one", "two"):
        first.add(name, partial(broken.append, f"first {name}"))
        second.add(name, partial(broken.append, f"second {name}"))
    until(lambda: first._publisher.num_connections > 1 < second._publisher.num_connections)
    second.end("one")
    until(lambda: broken)
    assert broken == ["first one"]
    assert (list(first._bonds), list(second._bonds)) == (["two"], ["two"])


def test_a_bond_breaks_when_the_other_side_is_silent(make_node, short_bonds, listen):
    broken, beats = [], listen("/bond", load_message("bond/Status"))
    holder, other = make_node("holder"), make_node("other")
    BondHolder(holder, "/bond").add("one", partial(broken.append, "one"))
    BondHolder(other, "/bond").add("one", lambda: None)
    until(lambda: len(beats) > 20)  # half a second
    assert broken == []
    other.close()
    until(lambda: broken == ["one"])


def test_a_bond_without_another_side_breaks_after_a_while(make_node, short_bonds):
    broken = []
    BondHolder(make_node("holder"), "/bond").add("one", partial(broken.append, "one"))
    until(lambda: broken == ["one"])


def test_a_loader_without_a_bond_stays_beside_an_ended_manager(make_node, master, monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", master.uri)
    words = ["load", "testing/Repeating", "manager", "--no-bond", "__name:=one"]
    loader = Background(lambda _stop: main(words))
    node = make_node("manager")
    made = NodeletManager(node)
    until(lambda: made.loaded == ["/one"])
    assert made._bonds._bonds == {}
    node.close()
    with GraphInspector("rosnode", master_uri=master.uri) as graph:
        assert kill(graph, ["/one"]) == []
    loader.end(stop=False)


def test_a_manager_at_its_end_unloads_all_and_expects_late_requests(manager, call, caplog):
    assert call("load_nodelet", name="/one", type="testing/Repeating").success
    assert not call("unload_nodelet", name="/two").success
    assert "there is no nodelet /two to unload" in caplog.text
    caplog.clear()
    ended = threading.Event()
    ended.set()
    manager.run(ended)
    assert manager.loaded == []
    assert call("unload_nodelet", name="/one").success
    assert caplog.records == []


def test_a_loader_ends_quietly_beside_its_manager(make_node, master, monkeypatch, caplog):
    monkeypatch.setenv("ROS_MASTER_URI", master.uri)
    loader = Background(lambda _stop: main(["load", "testing/Repeating", "manager", "__name:=one"]))
    node = make_node("manager")
    made = NodeletManager(node)
    until(lambda: made.loaded == ["/one"])
    caplog.clear()
    monkeypatch.setattr(made, "unload", lambda _name: node.close())
    with GraphInspector("rosnode", master_uri=master.uri) as graph:
        assert kill(graph, ["/one"]) == []
    loader.end(stop=False)
    assert "is not unloaded" not in caplog.text


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ([], "no command ''"),
        (["manger"], "did you mean 'manager'"),
        (["load", "testing/Repeating"], "too few arguments"),
        (["load", "testing/Repeatin", "manager"], "did you mean 'testing/Repeating'"),
        (["standalone", "testing/Nothing"], "no nodelet 'testing/Nothing'"),
    ],
)
def test_a_wrong_command_line_is_an_error(words, text):
    with pytest.raises(RosError, match=text):
        main(words)


def test_a_started_manager_is_killed_like_any_node(start, make_node):
    process = start("nodelet", "nodelet", "manager", "__name:=mine")
    make_node("waiter").wait_for_service("/mine/load_nodelet", 60)
    process.send_signal(signal.SIGINT)
    assert process.wait(60) == 0
