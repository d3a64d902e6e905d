"""The node tf2_web_republisher: transforms at a rate, when they change."""

from __future__ import annotations

import math

import pytest
from ros.graph import until

from gazelle_ros import Duration, Time
from gazelle_ros.actions import GoalStatus, SimpleActionClient
from gazelle_ros.builtin.tf_republisher import FramePair, TransformRepublisher
from gazelle_ros.errors import RosError
from gazelle_ros.msgs import geometry_msgs, tf2_msgs, tf2_web_republisher
from gazelle_ros.tf import StampedTransform

ACTION = tf2_web_republisher.msg.TFSubscriptionAction
GOAL = tf2_web_republisher.msg.TFSubscriptionGoal
SERVICE = tf2_web_republisher.srv.RepublishTFs
REQUEST = tf2_web_republisher.srv.RepublishTFsRequest


def turned(angle, x=0.0):
    rotation = (0.0, 0.0, math.sin(angle / 2.0), math.cos(angle / 2.0))
    return StampedTransform(0, (x, 0.0, 0.0), rotation)


@pytest.mark.parametrize(
    ("limits", "transform", "sent"),
    [
        ((0.0, 0.1), turned(0.0), True),
        ((0.1, 0.0), turned(0.0), True),
        ((0.1, 0.1), turned(0.0), False),
        ((0.1, 0.1), turned(0.19), False),
        ((0.1, 0.1), turned(0.21), True),
        ((0.1, 0.1), turned(0.0, x=0.09), False),
        ((0.1, 0.1), turned(0.0, x=0.11), True),
    ],
)
def test_a_change_beyond_a_threshold_is_sent(limits, transform, sent):
    pair = FramePair("a", "b", *limits)
    assert pair.take(turned(0.0))
    assert pair.take(transform) == sent


def test_small_changes_add_up():
    pair = FramePair("a", "b", 0.1, 0.1)
    sent = [pair.take(turned(0.0, x=0.06 * number)) for number in range(5)]
    assert sent == [True, False, True, False, True]


@pytest.fixture
def frames(make_node):
    """Return the node, and a function that moves the frame ``base``."""
    made = TransformRepublisher(make_node("tf2_web_republisher"))
    publisher = make_node("driver").advertise("/tf", tf2_msgs.msg.TFMessage)
    until(lambda: publisher.has_subscribers)
    seconds = iter(range(1, 1000))

    def move(x):
        link = geometry_msgs.msg.TransformStamped(child_frame_id="base")
        link.header.frame_id, link.header.stamp = "odom", Time(next(seconds))
        link.transform.translation.x, link.transform.rotation.w = x, 1.0
        publisher.publish(tf2_msgs.msg.TFMessage(transforms=[link]))

    return made.node, move


def test_feedback_of_a_goal_has_the_transforms_until_it_is_cancelled(frames, make_node):
    _, move = frames
    client = SimpleActionClient(make_node("page"), "/tf2_web_republisher", ACTION)
    assert client.wait_for_server(Duration(60))
    move(1.0)
    found = []
    goal = GOAL(["/base", "nothing"], "/odom", 0.01, 0.01, 50.0)
    client.send_goal(goal, feedback_cb=lambda each: found.extend(each.transforms))
    until(lambda: found)
    move(2.0)
    until(lambda: len(found) == 2)
    assert [each.transform.translation.x for each in found] == [1.0, 2.0]
    assert {(each.header.frame_id, each.child_frame_id) for each in found} == {("odom", "base")}
    client.cancel_goal()
    assert client.wait_for_result(Duration(60))
    assert client.get_state() == GoalStatus.PREEMPTED


def test_a_goal_without_a_rate_is_rejected(frames, make_node):
    client = SimpleActionClient(make_node("page"), "/tf2_web_republisher", ACTION)
    assert client.wait_for_server(Duration(60))
    client.send_goal(GOAL(["base"], "odom", 0.0, 0.0, 0.0))
    assert client.wait_for_result(Duration(60))
    assert client.get_state() == GoalStatus.REJECTED
    assert "rate must be above 0" in client.get_goal_status_text()


def test_a_topic_has_the_transforms_and_ends_without_subscribers(frames, make_node):
    node, move = frames
    page = make_node("page")
    move(1.0)
    request = REQUEST(["base"], "odom", 0.0, 0.0, 50.0, Duration.from_sec(2.0))
    topic = page.client("/republish_tfs", SERVICE).call(request).topic_name
    assert topic == "/tf2_web_republisher/tf_repub_0"
    found = []
    subscriber = page.subscribe(topic, tf2_web_republisher.msg.TFArray, found.append)
    until(lambda: len(found) > 2)
    assert found[-1].transforms[0].transform.translation.x == 1.0
    subscriber.close()
    until(lambda: node.publication(topic) is None)
    with pytest.raises(RosError, match="rate"):
        page.client("/republish_tfs", SERVICE).call(REQUEST())
