"""message_filters, dynamic_reconfigure, rosparam, rostopic, rosservice, rosnode, actionlib."""

import importlib
import types

import pytest
from ros.graph import until

from gazelle_ros.messages import load_message
from gazelle_ros.time import Time


def stamped(seconds):
    made = load_message("geometry_msgs/PointStamped")()
    made.header.stamp = Time.from_sec(seconds)
    return made


@pytest.fixture
def filters(rospy):
    return importlib.import_module("message_filters")


def test_messages_of_one_time_are_matched(filters):
    left, right, got = filters.SimpleFilter(), filters.SimpleFilter(), []
    filters.TimeSynchronizer([left, right], 10).registerCallback(lambda *m: got.append(m))
    for second in (1, 2, 3):
        left.signalMessage(stamped(second))
    for second in (3, 1, 4):
        right.signalMessage(stamped(second))
    assert [pair[0].header.stamp.secs for pair in got] == [3, 1]


def test_messages_of_close_times_are_matched(filters):
    left, right, got = filters.SimpleFilter(), filters.SimpleFilter(), []
    sync = filters.ApproximateTimeSynchronizer([left, right], 10, 0.1)
    sync.registerCallback(lambda a, b, more: got.append((a, b, more)), "more")
    left.signalMessage(stamped(1.0))
    left.signalMessage(stamped(1.05))
    right.signalMessage(stamped(1.5))
    assert got == []
    right.signalMessage(stamped(1.06))
    assert got[0][0].header.stamp == Time.from_sec(1.05)
    assert got[0][2] == "more"


def test_a_cache_answers_by_time(filters):
    source = filters.SimpleFilter()
    cache = filters.Cache(source, 3)
    for second in (1, 4, 2, 3):
        source.signalMessage(stamped(second))
    assert [m.header.stamp.secs for m in cache.getInterval(Time(0), Time(9))] == [2, 3, 4]
    assert cache.getElemAfterTime(Time(3)).header.stamp.secs == 3
    assert cache.getElemBeforeTime(Time(3, 5)).header.stamp.secs == 3
    assert cache.getLatestTime() == Time(4)
    assert cache.getOldestTime() == Time(2)
    assert cache.getElemBeforeTime(Time(1)) is None


def test_a_filter_listens_to_a_topic(node, filters):
    got = []
    subscriber = filters.Subscriber("p", load_message("geometry_msgs/PointStamped"))
    subscriber.registerCallback(got.append)
    publisher = node.Publisher("p", load_message("geometry_msgs/PointStamped"), queue_size=1)
    until(publisher.get_num_connections)
    publisher.publish(stamped(2))
    until(lambda: got)
    assert subscriber.getTopic() == "p"
    assert subscriber.get_num_connections() == 1


def described():
    """Return the description of a .cfg file."""

    def one(name, kind, level, default):
        return {
            "name": name,
            "type": kind,
            "level": level,
            "default": default,
            "description": "",
            "edit_method": "",
        }

    parameters = [
        one("gain", "double", 1, 0.5),
        one("count", "int", 2, 3),
        one("on", "bool", 4, True),
        one("name", "str", 8, "x"),
    ]
    return types.SimpleNamespace(
        defaults={each["name"]: each["default"] for each in parameters},
        min={"gain": 0.0, "count": 0, "on": False, "name": ""},
        max={"gain": 1.0, "count": 9, "on": True, "name": ""},
        level={each["name"]: each["level"] for each in parameters},
        config_description={
            "name": "Default",
            "type": "",
            "id": 0,
            "parent": 0,
            "state": True,
            "parameters": parameters,
            "groups": [],
        },
    )


def test_parameters_are_changed_from_outside(node):
    server_module = importlib.import_module("dynamic_reconfigure.server")
    client_module = importlib.import_module("dynamic_reconfigure.client")
    errors = importlib.import_module("dynamic_reconfigure")
    calls, seen = [], []

    def changed(config, level):
        calls.append((config.copy(), level))
        return config

    node.set_param("~count", 5)
    server = server_module.Server(described(), changed)
    assert calls[0][1] == 15
    assert calls[0][0].count == 5
    client = client_module.Client("probe", timeout=60, config_callback=seen.append)
    assert client.get_configuration(60.0)["gain"] == 0.5
    taken = client.update_configuration({"gain": "7.5", "on": "false"})
    assert (taken["gain"], taken["on"], taken["count"]) == (1.0, False, 5)
    assert calls[-1][1] == 5
    assert node.get_param("~gain") == 1.0
    names = [each["name"] for each in client.get_parameter_descriptions(60.0)]
    assert names == ["gain", "count", "on", "name"]
    for change in ({"nothing": 1}, {"count": "many"}):
        with pytest.raises(errors.DynamicReconfigureParameterException):
            client.update_configuration(change)
    server.update_configuration({"name": "y"})
    until(lambda: seen and seen[-1]["name"] == "y")
    client.close()


def test_parameters_are_read_and_written_as_yaml(rospy, tmp_path):
    rosparam = importlib.import_module("rosparam")
    rosparam.set_param("/a", "[1, deg(180)]")
    assert rosparam.get_param("/a") == pytest.approx([1, 3.14159265])
    file = tmp_path / "x.yaml"
    file.write_text("_ns: deep\nb: {c: 2}\n")
    for values, space in rosparam.load_file(str(file), "/top"):
        rosparam.upload_params(space, values)
    assert rosparam.get_param("/top/deep/b/c") == 2
    rosparam.delete_param("/a")
    with pytest.raises(importlib.import_module("rosgraph").MasterError):
        rosparam.get_param("/a")


def test_topics_services_and_nodes_are_found(node):
    rostopic = importlib.import_module("rostopic")
    rosservice = importlib.import_module("rosservice")
    rosnode = importlib.import_module("rosnode")
    string = load_message("std_msgs/String")
    node.Publisher("chatter", string, queue_size=1)
    assert rostopic.get_topic_class("/chatter")[:2] == (string, "/chatter")
    assert rostopic.get_topic_type("/none") == (None, None, None)
    evaluate = rostopic.get_topic_type("/chatter/data")[2]
    assert evaluate(string("x")) == "x"
    assert "/chatter" in rostopic.find_by_type("std_msgs/String")
    flag = importlib.import_module("std_srvs.srv").SetBool
    node.Service("flag", flag, lambda request: {"success": request.data})
    assert rosservice.get_service_type("/flag") == "std_srvs/SetBool"
    assert rosservice.call_service("/flag", [True])[1].success
    assert rosservice.get_service_args("/flag") == "data"
    assert "/probe" in rosnode.get_node_names()
    assert any(rosnode.rosnode_ping("/probe", max_count=1) for _ in range(10))


def test_actionlib_works_in_the_node_of_the_process(node):
    actionlib = importlib.import_module("actionlib")
    messages = importlib.import_module("actionlib.msg")

    def execute(goal):
        server.set_succeeded(messages.TestResult(goal.goal + 1))

    server = actionlib.SimpleActionServer("act", messages.TestAction, execute, False)
    server.start()
    client = actionlib.SimpleActionClient("act", messages.TestAction)
    assert client.wait_for_server(node.Duration(60))
    state = client.send_goal_and_wait(messages.TestGoal(1), node.Duration(60))
    assert state == actionlib.GoalStatus.SUCCEEDED
    assert client.get_result().result == 2


def test_gazebo_interface_calls_the_services_of_a_gazebo(node):
    interface = importlib.import_module("gazebo_ros.gazebo_interface")
    srv = importlib.import_module("gazebo_msgs.srv")
    asked = []

    def spawn(request):
        asked.append((request.model_name, request.robot_namespace, request.initial_pose.position.x))
        return request.model_name == "new", "told"

    node.Service("/gazebo/spawn_sdf_model", srv.SpawnModel, spawn)
    node.Service("/gazebo/set_model_configuration", srv.SetModelConfiguration, lambda _: 1 / 0)
    pose = load_message("geometry_msgs/Pose")()
    pose.position.x = 2.0
    assert interface.spawn_sdf_model_client("new", "<sdf/>", "/a", pose, "", "/gazebo") is True
    assert interface.spawn_sdf_model_client("old", "<sdf/>", "/a", pose, "", "/gazebo") is False
    assert interface.set_model_configuration_client("m", "", ["j"], [1.0], "/gazebo") is None
    assert asked == [("new", "/a", 2.0), ("old", "/a", 2.0)]
