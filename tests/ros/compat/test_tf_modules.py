"""tf2_ros and tf in a node: listening, sending, waiting, transforming."""

import importlib
import math
import threading
import time

import pytest
from ros.graph import until

from gazelle_ros.messages import load_message
from gazelle_ros.time import Time


def transform(parent, child, stamp, x=0.0, yaw=0.0):
    made = load_message("geometry_msgs/TransformStamped")()
    made.header.frame_id, made.child_frame_id, made.header.stamp = parent, child, stamp
    made.transform.translation.x = x
    made.transform.rotation.z, made.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return made


@pytest.fixture
def tf2(node):
    return importlib.import_module("tf2_ros")


def test_what_is_sent_is_found(node, tf2):
    buffer = tf2.Buffer()
    tf2.TransformListener(buffer)
    sender, static = tf2.TransformBroadcaster(), tf2.StaticTransformBroadcaster()
    until(lambda: sender.pub_tf.get_num_connections() and static.pub_tf.get_num_connections())
    sender.sendTransform([transform("map", "base", Time(5), 1.0), transform("map", "x", Time(5))])
    static.sendTransform(transform("base", "laser", Time(0), 0.5))
    found = buffer.lookup_transform("map", "laser", node.Time(5), node.Duration(60))
    assert found.transform.translation.x == 1.5
    assert (found.header.frame_id, found.child_frame_id) == ("map", "laser")
    assert found.header.stamp == Time(5)


def test_all_static_transforms_reach_a_late_listener(node, tf2):
    tf2.StaticTransformBroadcaster().sendTransform(transform("a", "b", Time(0), 1.0))
    tf2.StaticTransformBroadcaster().sendTransform(transform("b", "c", Time(0), 2.0))
    buffer = tf2.Buffer()
    tf2.TransformListener(buffer)
    found = buffer.lookup_transform("a", "c", node.Time(0), node.Duration(60))
    assert found.transform.translation.x == 3.0


def test_a_wait_ends_when_its_time_is_over(node, tf2):
    buffer = tf2.Buffer()
    begin = time.monotonic()
    with pytest.raises(tf2.LookupException, match="does not exist"):
        buffer.lookup_transform("a", "b", node.Time(0), node.Duration(0.2))
    assert time.monotonic() - begin > 0.15
    assert buffer.can_transform("a", "b", node.Time(0), return_debug_tuple=True) == (
        False,
        "canTransform: target_frame a does not exist. source_frame b does not exist.",
    )


def test_stamped_messages_are_transformed(node, tf2):
    importlib.import_module("tf2_geometry_msgs")
    buffer = tf2.Buffer()
    buffer.set_transform(transform("map", "base", Time(5), 1.0, math.pi / 2), "test")
    pose = load_message("geometry_msgs/PoseStamped")()
    pose.header.frame_id, pose.header.stamp = "base", Time(5)
    pose.pose.position.x, pose.pose.orientation.w = 2.0, 1.0
    moved = buffer.transform(pose, "map")
    assert moved.header.frame_id == "map"
    place = moved.pose.position
    assert (place.x, place.y) == pytest.approx((1.0, 2.0))
    assert moved.pose.orientation.z == pytest.approx(math.sin(math.pi / 4))
    vector = load_message("geometry_msgs/Vector3Stamped")(header=pose.header)
    vector.vector.x = 1.0
    turned = buffer.transform(vector, "map").vector
    assert (turned.x, turned.y) == pytest.approx((0.0, 1.0))
    with pytest.raises(tf2.TypeException):
        buffer.transform(load_message("sensor_msgs/Imu")(header=pose.header), "map")


def test_a_covariance_turns_with_its_pose(node, tf2):
    importlib.import_module("tf2_geometry_msgs")
    buffer = tf2.Buffer()
    buffer.set_transform(transform("map", "base", Time(5), 0.0, math.pi / 2), "test")
    pose = load_message("geometry_msgs/PoseWithCovarianceStamped")()
    pose.header.frame_id, pose.header.stamp = "base", Time(5)
    pose.pose.pose.orientation.w = 1.0
    pose.pose.covariance = [4.0] + [0.0] * 35
    moved = buffer.transform(pose, "map").pose.covariance
    assert moved[0] == pytest.approx(0.0)
    assert moved[7] == pytest.approx(4.0)


def test_the_frames_of_a_buffer_can_be_asked_for(node, tf2):
    buffer = tf2.Buffer()
    buffer.set_transform(transform("map", "base", Time(5)), "test")
    kind = load_message("tf2_msgs/FrameGraphRequest")
    assert kind._type
    srv = importlib.import_module("tf2_msgs.srv").FrameGraph
    answer = node.ServiceProxy("~tf2_frames", srv)()
    assert "parent: 'map'" in answer.frame_yaml


def test_the_older_tf_gives_lists(node):
    tf = importlib.import_module("tf")
    listener, sender = tf.TransformListener(), tf.TransformBroadcaster()
    until(sender.pub_tf.get_num_connections)
    sender.sendTransform((1, 2, 3), (0, 0, 0, 1), node.Time(5), "base", "map")
    listener.waitForTransform("/map", "/base", node.Time(5), node.Duration(60))
    assert listener.lookupTransform("map", "base", node.Time(0)) == ([1, 2, 3], [0, 0, 0, 1])
    assert listener.frameExists("base")
    assert listener.getLatestCommonTime("map", "base") == Time(5)
    with pytest.raises(tf.LookupException):
        listener.lookupTransform("map", "nowhere", node.Time(0))
    point = load_message("geometry_msgs/PointStamped")()
    point.header.frame_id = "base"
    assert listener.transformPoint("map", point).point.z == 3.0


def test_a_twist_is_measured(node):
    tf = importlib.import_module("tf")
    frames = tf.Transformer()
    for tick in range(11):
        moving = transform("map", "base", Time(1, tick * 10**8 % 10**9), tick * 0.1, tick * 0.05)
        moving.header.stamp = Time(nsecs=10**9 + tick * 10**8)
        frames.setTransform(moving)
    linear, angular = frames.lookupTwist("base", "map", node.Time(1, 5 * 10**8), node.Duration(0.4))
    assert linear == pytest.approx((1.0, 0.0, 0.0))
    assert angular == pytest.approx((0.0, 0.0, 0.5))


def test_a_buffer_answers_other_nodes(node, tf2):
    buffer = tf2.Buffer()
    buffer.set_transform(transform("map", "base", Time(5), 1.0), "test")
    buffer.set_transform(transform("map", "base", Time(6), 2.0), "test")
    server = tf2.BufferServer(buffer, "/frames")
    client = tf2.BufferClient("/frames", timeout_padding=node.Duration(60))
    assert client.wait_for_server(node.Duration(60))
    found = client.lookup_transform("map", "base", node.Time(5.5), node.Duration(60))
    assert found.transform.translation.x == 1.5
    moved = client.lookup_transform_full(
        "base", node.Time(6), "base", node.Time(5), "map", node.Duration(60)
    )
    assert moved.transform.translation.x == -1.0
    with pytest.raises(tf2.LookupException, match="does not exist"):
        client.lookup_transform("map", "nothing", node.Time(0))
    with pytest.raises(tf2.ExtrapolationException):
        client.lookup_transform("map", "base", node.Time(9), node.Duration(0.1))
    assert not client.can_transform("map", "nothing", node.Time(0))
    server.start()


def test_a_buffer_answers_when_the_transform_comes(node, tf2):
    buffer = tf2.Buffer()
    tf2.BufferServer(buffer, "/frames", check_period=node.Duration(0.01))
    client = tf2.BufferClient("/frames", timeout_padding=node.Duration(60))
    assert client.wait_for_server(node.Duration(60))
    later = threading.Timer(
        0.3, lambda: buffer.set_transform(transform("map", "base", Time(5), 1.0), "test")
    )
    later.start()
    found = client.lookup_transform("map", "base", node.Time(5), node.Duration(60))
    assert found.transform.translation.x == 1.0
    later.join()
