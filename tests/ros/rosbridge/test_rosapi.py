"""rosapi's services, asked through rosbridge as its clients ask them."""

from __future__ import annotations

import json

import pytest

from gazelle_ros import Node, load_message, load_service
from gazelle_ros.rosbridge.rosapi import RosApi
from gazelle_ros.rosbridge.settings import BridgeSettings

ACTION = ("cancel", "feedback", "goal", "result", "status")


@pytest.fixture(scope="module", autouse=True)
def _things(robot):
    """Advertise things to be found."""
    string = load_message("std_msgs/String")
    robot.advertise("/chatter", string)
    robot.subscribe("/heard", string, lambda _: None)
    robot.serve("/add", load_service("roscpp_tutorials/TwoInts"), lambda _: [0])
    for name in ACTION:
        robot.advertise(f"/arm/move/{name}", string)
    robot.set_param("/robot_name", "r1")


@pytest.fixture
def ask(client):
    def run(name_, **args):
        answer = client.call(f"/rosapi/{name_}", args)
        assert answer["result"], answer
        return answer["values"]

    return run


def test_topics(ask):
    found = ask("topics")
    types = dict(zip(found["topics"], found["types"], strict=True))
    assert types["/chatter"] == types["/heard"] == "std_msgs/String"
    assert "/chatter" in ask("topics_for_type", type="std_msgs/String")["topics"]
    assert ask("topic_type", topic="/chatter") == {"type": "std_msgs/String"}
    assert ask("topic_type", topic="/none") == {"type": ""}
    assert ask("publishers", topic="/chatter") == {"publishers": ["/robot"]}
    assert ask("subscribers", topic="/heard") == {"subscribers": ["/robot"]}
    assert ask("subscribers", topic="/chatter") == {"subscribers": []}
    raw = ask("topics_and_raw_types")
    text = dict(zip(raw["topics"], raw["typedefs_full_text"], strict=True))
    assert text["/chatter"].strip() == "string data"
    assert ask("action_servers") == {"action_servers": ["/arm/move"]}


def test_services_and_nodes(ask):
    assert "/add" in ask("services")["services"]
    assert ask("services_for_type", type="roscpp_tutorials/TwoInts") == {"services": ["/add"]}
    assert ask("service_type", service="/add") == {"type": "roscpp_tutorials/TwoInts"}
    assert ask("service_type", service="/none") == {"type": ""}
    assert ask("service_node", service="/add") == {"node": "/robot"}
    assert ask("service_host", service="/add")["host"]
    assert ask("service_providers", service="roscpp_tutorials/TwoInts") == {"providers": ["/robot"]}
    assert {"/robot", "/rosapi", "/rosbridge_websocket"} <= set(ask("nodes")["nodes"])
    details = ask("node_details", node="/robot")
    assert "/chatter" in details["publishing"]
    assert details["subscribing"] == ["/heard"]
    assert "/add" in details["services"]


def test_parameters(ask, client):
    assert json.loads(ask("get_param", name="/robot_name", default="")["value"]) == "r1"
    assert json.loads(ask("get_param", name="/none", default="[1]")["value"]) == [1]
    assert json.loads(ask("get_param", name="/none", default="word")["value"]) == "word"
    assert json.loads(ask("get_param", name="/none", default="")["value"]) is None
    ask("set_param", name="/tree", value='{"a": [1, 2.5, "x"], "b": true}')
    assert json.loads(ask("get_param", name="/tree", default="")["value"])["a"] == [1, 2.5, "x"]
    assert ask("has_param", name="/tree/b") == {"exists": True}
    assert "/tree/b" in ask("get_param_names")["names"]
    assert ask("search_param", name="robot_name") == {"global_name": "/robot_name"}
    ask("delete_param", name="/tree")
    ask("delete_param", name="/tree")
    assert ask("has_param", name="/tree") == {"exists": False}
    client.say("call_service", service="/rosapi/set_param", args={"name": "/x", "value": "word"})
    assert "not valid JSON" in client.hear()["msg"]
    client.hear()


def test_time(ask):
    assert ask("get_time")["time"]["secs"] > 1_600_000_000


def test_details_of_types(ask):
    found = ask("message_details", type="geometry_msgs/PoseWithCovarianceStamped")["typedefs"]
    by_type = {each["type"]: each for each in found}
    assert found[0]["type"] == "geometry_msgs/PoseWithCovarianceStamped"
    assert set(by_type) == {
        "geometry_msgs/PoseWithCovarianceStamped", "std_msgs/Header", "time",
        "geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose", "geometry_msgs/Point",
        "geometry_msgs/Quaternion",
    }  # fmt: skip
    covariance = by_type["geometry_msgs/PoseWithCovariance"]
    assert covariance["fieldnames"] == ["pose", "covariance"]
    assert covariance["fieldtypes"] == ["geometry_msgs/Pose", "float64"]
    assert covariance["fieldarraylen"] == [-1, 36]
    assert covariance["examples"] == ["{}", "[]"]
    header = by_type["std_msgs/Header"]
    assert header["examples"] == ["0", "{}", ""]
    (status,) = ask("message_details", type="actionlib_msgs/GoalStatus")["typedefs"][:1]
    constants = dict(zip(status["constnames"], status["constvalues"], strict=True))
    assert (constants["ACTIVE"], constants["LOST"]) == ("1", "9")
    request = ask("service_request_details", type="roscpp_tutorials/TwoInts")["typedefs"][0]
    assert request["fieldnames"] == ["a", "b"]
    response = ask("service_response_details", type="roscpp_tutorials/TwoInts")["typedefs"][0]
    assert response["fieldnames"] == ["sum"]


def test_unknown_types_are_said(client):
    client.say("call_service", service="/rosapi/message_details", args={"type": "std_msgs/Strin"})
    assert "String" in client.hear()["msg"]


def test_patterns_hide_the_rest(graph, robot):
    settings = BridgeSettings(topics_glob="[/chat*]", params_glob="[/robot_*]")
    with Node("other_api", master_uri=graph.uri) as node:
        api = RosApi.__new__(RosApi)  # a second one on the same graph would take the names
        api._node, api._settings, api._servers = node, settings, []
        from gazelle_ros.tools.graph import GraphInspector

        api._graph = GraphInspector("x", graph.uri, "/")
        with api:
            assert api._topics()[0] == ["/chatter"]
            assert api._topic_type("/heard") == ""
            assert api._users(0, "/heard") == []
            assert api._param_names() == ["/robot_name"]
            assert not api._has_param("/rosdistro")
