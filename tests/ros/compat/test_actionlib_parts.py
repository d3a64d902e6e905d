"""The parts of actionlib that programs reach into."""

import importlib

import pytest

from gazelle_ros.messages import load_message


@pytest.fixture
def actionlib(node):
    return importlib.import_module("actionlib")


def test_a_status_has_a_name(actionlib):
    assert actionlib.GoalStatus.to_string(actionlib.GoalStatus.PREEMPTED) == "PREEMPTED"


def test_a_tracker_gives_a_nameless_goal_an_id(node, actionlib):
    goal = load_message("actionlib/TestActionGoal")()
    tracker = actionlib.StatusTracker(goal=goal)
    assert tracker.status.goal_id.id.startswith("/probe-")
    assert tracker.status.goal_id.stamp
    assert tracker.status.status == actionlib.GoalStatus.PENDING


def test_a_tracker_keeps_what_it_is_given(actionlib):
    tracker = actionlib.StatusTracker("some-id", actionlib.GoalStatus.ACTIVE)
    assert (tracker.status.goal_id, tracker.status.status) == ("some-id", 1)


def test_a_handle_of_nothing_refuses_to_move(actionlib):
    handle = actionlib.ServerGoalHandle()
    assert handle.get_goal() is None
    assert not handle.get_goal_id().id
    assert not handle.set_accepted()
    assert not handle.set_cancel_requested()
    handle.publish_feedback(None)


def test_a_deleter_notes_the_time(actionlib):
    server = actionlib.ActionServer("act", load_message("actionlib/TestAction"), auto_start=False)
    tracker = actionlib.StatusTracker("some-id", 1)
    actionlib.HandleTrackerDeleter(server, tracker)(None)
    assert tracker.handle_destruction_time


def test_tf2_ros_gives_its_messages_too(node):
    tf2_ros = importlib.import_module("tf2_ros")
    assert tf2_ros.TransformStamped is load_message("geometry_msgs/TransformStamped")
    assert tf2_ros.TFMessage is load_message("tf2_msgs/TFMessage")


@pytest.mark.parametrize(
    "module", ["action_client", "action_server", "simple_action_client", "simple_action_server"]
)
def test_the_status_of_goals_is_found_in_each_module(actionlib, module):
    """``smach_ros`` imports it from ``actionlib.simple_action_client``."""
    found = importlib.import_module(f"actionlib.{module}").GoalStatus
    assert found is actionlib.GoalStatus
    assert found.to_string(found.ACTIVE) == "ACTIVE"
