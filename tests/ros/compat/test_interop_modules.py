"""Our rospy, tf and actionlib with real nodes, on our master."""

import importlib
import threading
import time

import pytest
from ros import real
from ros.graph import until

pytestmark = [pytest.mark.ros, real.needs_ros]

TF_SENDER = """
import tf2_ros
from geometry_msgs.msg import TransformStamped
rospy.init_node("real_sender")
moving, static = tf2_ros.TransformBroadcaster(), tf2_ros.StaticTransformBroadcaster()
def made(parent, child, x):
    m = TransformStamped()
    m.header.frame_id, m.child_frame_id, m.header.stamp = parent, child, rospy.Time.now()
    m.transform.translation.x, m.transform.rotation.w = x, 1.0
    return m
static.sendTransform(made("base", "laser", 0.5))
while not rospy.is_shutdown():
    moving.sendTransform(made("map", "base", 1.0))
    time.sleep(0.02)
"""
TF_LISTENER = """
import tf2_ros
rospy.init_node("real_listener")
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
found = buffer.lookup_transform("map", "laser", rospy.Time(0), rospy.Duration(60))
say(found.transform.translation.x)
"""
ACTION_SERVER = """
import actionlib
from actionlib.msg import *
rospy.init_node("real_server")
def execute(goal):
    server.publish_feedback(TestFeedback(7))
    for _ in range(goal.goal):
        if server.is_preempt_requested():
            server.set_preempted(TestResult(-1)); return
        time.sleep(0.02)
    server.set_succeeded(TestResult(goal.goal), "real")
server = actionlib.SimpleActionServer("/act", TestAction, execute, False)
server.start()
say("ready")
rospy.spin()
"""
ACTION_CLIENT = """
import actionlib
from actionlib.msg import *
# A server that answers before send_goal returns makes this client log an error; it goes on well.
rospy.init_node("real_client", log_level=rospy.FATAL)
client = actionlib.SimpleActionClient("/act", TestAction)
say(client.wait_for_server(rospy.Duration(60)))
heard = []
client.send_goal(TestGoal(3), feedback_cb=lambda f: heard.append(f.feedback))
while not heard: time.sleep(0.01)
say("heard")
client.wait_for_result(rospy.Duration(60))
say(client.get_state(), client.get_result().result, set(heard))
client.send_goal(TestGoal(5000))
while client.get_state() != 1: time.sleep(0.01)
client.cancel_goal()
client.wait_for_result(rospy.Duration(60))
say(client.get_state(), client.get_result().result)
"""
BUFFER_CLIENT = """
import tf2_ros
rospy.init_node("real_asker", log_level=rospy.FATAL)
client = tf2_ros.BufferClient("/frames")
say(client.wait_for_server(rospy.Duration(60)))
say(client.lookup_transform("map", "base", rospy.Time(5), rospy.Duration(1)).transform.translation.x)
try:
    client.lookup_transform("map", "nothing", rospy.Time(0))
except tf2_ros.LookupException as error:
    say(error)
"""
QUICK_CLIENT = """
import actionlib
from actionlib.msg import *
rospy.init_node("real_client", log_level=rospy.FATAL)
client = actionlib.SimpleActionClient("/act", TestAction)
say(client.wait_for_server(rospy.Duration(60)))
whole = 0
for number in range(30):
    # This client itself drops what comes while one of its threads waits for a processor: then once more.
    for _ in range(10):
        heard = []
        client.send_goal(TestGoal(number), feedback_cb=lambda f: heard.append(f.feedback))
        done = client.wait_for_result(rospy.Duration(2)) and client.get_state() == 3
        if done and client.get_result().result == number and heard == [number]:
            whole += 1
            break
say(whole)
"""
RECONFIGURE = """
import dynamic_reconfigure.client
rospy.init_node("real_changer")
client = dynamic_reconfigure.client.Client("probe", timeout=60)
say(sorted(client.get_configuration(60).items(), key=str)[0])
say(client.update_configuration({"gain": 0.75})["gain"])
"""


def test_our_buffer_hears_real_broadcasters(node, master):
    tf2_ros = importlib.import_module("tf2_ros")
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer)
    with real.RealNode(master.uri, TF_SENDER):
        found = buffer.lookup_transform("map", "laser", node.Time(0), node.Duration(60))
    assert found.transform.translation.x == 1.5
    assert "broadcaster: '/real_sender'" in buffer.all_frames_as_yaml()


def test_a_real_buffer_hears_our_broadcasters(node, master):
    tf2_ros = importlib.import_module("tf2_ros")
    transform = importlib.import_module("geometry_msgs.msg").TransformStamped
    moving, static = tf2_ros.TransformBroadcaster(), tf2_ros.StaticTransformBroadcaster()
    for parent, child, x in (("base", "laser", 0.5), ("laser", "glass", 9.0)):
        made = transform()
        made.header.frame_id, made.child_frame_id = parent, child
        made.transform.translation.x, made.transform.rotation.w = x, 1.0
        static.sendTransform(made)
    with real.RealNode(master.uri, TF_LISTENER) as listener:
        until(moving.pub_tf.get_num_connections)
        for _ in range(50):
            made = transform()
            made.header.frame_id, made.child_frame_id = "map", "base"
            made.header.stamp = node.Time.now()
            made.transform.translation.x, made.transform.rotation.w = 1.0, 1.0
            moving.sendTransform(made)
            time.sleep(0.02)
        listener.expect("1.5")


def test_our_client_sends_goals_to_a_real_server(node, master):
    actionlib = importlib.import_module("actionlib")
    messages = importlib.import_module("actionlib.msg")
    with real.RealNode(master.uri, ACTION_SERVER) as server:
        server.expect("ready")
        client = actionlib.SimpleActionClient("/act", messages.TestAction)
        assert client.wait_for_server(node.Duration(60))
        client.send_goal(messages.TestGoal(3))
        assert client.wait_for_result(node.Duration(60))
        assert client.get_state() == actionlib.GoalStatus.SUCCEEDED
        assert client.get_result().result == 3
        assert client.get_goal_status_text() == "real"
        heard = []
        client.send_goal(messages.TestGoal(5000), feedback_cb=heard.append)
        until(lambda: client.get_state() == actionlib.GoalStatus.ACTIVE)
        until(lambda: [each.feedback for each in heard] == [7])
        client.cancel_goal()
        assert client.wait_for_result(node.Duration(60))
        assert client.get_state() == actionlib.GoalStatus.PREEMPTED


@pytest.mark.long
def test_a_real_client_sends_goals_to_our_server(node, master):
    actionlib = importlib.import_module("actionlib")
    messages = importlib.import_module("actionlib.msg")

    heard = threading.Event()

    def execute(goal):
        for _ in range(3000):
            if server.is_preempt_requested():
                server.set_preempted(messages.TestResult(-1))
                return
            server.publish_feedback(messages.TestFeedback(7))
            time.sleep(0.02)
            if goal.goal == 3 and heard.is_set():
                break
        server.set_succeeded(messages.TestResult(goal.goal))

    server = actionlib.SimpleActionServer("/act", messages.TestAction, execute, False)
    server.start()
    with real.RealNode(master.uri, ACTION_CLIENT) as client:
        client.expect("True", "heard")
        heard.set()
        client.expect("3 3 {7}", "2 -1")


def test_a_real_client_asks_our_buffer(node, master):
    tf2_ros = importlib.import_module("tf2_ros")
    made = importlib.import_module("geometry_msgs.msg").TransformStamped()
    made.header.frame_id, made.child_frame_id, made.header.stamp = "map", "base", node.Time(5)
    made.transform.translation.x, made.transform.rotation.w = 1.5, 1.0
    buffer = tf2_ros.Buffer()
    buffer.set_transform(made, "test")
    tf2_ros.BufferServer(buffer, "/frames")
    with real.RealNode(master.uri, BUFFER_CLIENT) as client:
        client.expect("True", "1.5")
        assert "does not exist" in client.line()


def test_a_real_client_misses_nothing_of_goals_that_are_done_at_once(node, master):
    actionlib = importlib.import_module("actionlib")
    messages = importlib.import_module("actionlib.msg")

    def execute(goal):
        server.publish_feedback(messages.TestFeedback(goal.goal))
        server.set_succeeded(messages.TestResult(goal.goal))

    server = actionlib.SimpleActionServer("/act", messages.TestAction, execute, False)
    server.start()
    with real.RealNode(master.uri, QUICK_CLIENT) as client:
        client.expect("True", "30")


@pytest.mark.long
def test_a_real_client_changes_our_parameters(node, master):
    server_module = importlib.import_module("dynamic_reconfigure.server")
    from ros.compat.test_other_modules import described

    server_module.Server(described(), lambda config, level: config)
    with real.RealNode(master.uri, RECONFIGURE) as changer:
        changer.line()
        changer.expect("0.75")
    assert node.get_param("~gain") == 0.75
