"""ROS-Industrial's simulated controller and the action of its trajectories."""

from __future__ import annotations

import math
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import Background, until

from gazelle_ros import Duration
from gazelle_ros.actions import GoalStatus, SimpleActionClient
from gazelle_ros.builtin.industrial.joint_names import controller_joints
from gazelle_ros.builtin.industrial.motion import Waypoint, WaypointMotion, waypoints_of
from gazelle_ros.builtin.industrial.simulator import RobotSimulator
from gazelle_ros.builtin.industrial.trajectory_action import TrajectoryAction
from gazelle_ros.clock import SECOND, SimulatedClock
from gazelle_ros.errors import RosError
from gazelle_ros.msgs import control_msgs, industrial_msgs, sensor_msgs, trajectory_msgs

ACTION = control_msgs.msg.FollowJointTrajectoryAction
FEEDBACK = control_msgs.msg.FollowJointTrajectoryFeedback
RESULT = control_msgs.msg.FollowJointTrajectoryResult
JOINTS = ["a", "b"]
NUMBERS = st.floats(-3.0, 3.0)
ROBOT = """<robot name="r"><link name="base"/><link name="one"/><link name="two"/><link name="tip"/>
<joint name="b" type="prismatic"><parent link="two"/><child link="tip"/></joint>
<joint name="f" type="fixed"><parent link="one"/><child link="two"/></joint>
<joint name="a" type="revolute"><parent link="base"/><child link="{of_a}"/></joint></robot>"""


def trajectory(*points, names=JOINTS):
    """Return a trajectory of points, each a time [s] and positions."""
    made = trajectory_msgs.msg.JointTrajectory(joint_names=list(names))
    for seconds, *positions in points:
        point = trajectory_msgs.msg.JointTrajectoryPoint(positions=positions)
        point.time_from_start = Duration.from_sec(seconds)
        made.points.append(point)
    return made


# Motion -----------------------------------------------------------------------------------


@given(st.floats(0.1, 5.0), NUMBERS, NUMBERS, NUMBERS)
def test_a_motion_with_velocities_has_them_at_its_waypoints(span, start, end, velocity):
    motion = WaypointMotion([start], [Waypoint(span, (end,), (velocity,))])
    step = 1e-4 * span
    speeds = [(motion.at(later)[0] - motion.at(later - step)[0]) / step for later in (step, span)]
    assert (motion.at(0.0), motion.at(span), motion.duration) == ([start], [end], span)
    assert speeds == pytest.approx([0.0, velocity], abs=0.02 / min(span, 1.0))


def test_a_motion_without_velocities_is_straight_or_jumps():
    points = [Waypoint(1.0, (2.0,)), Waypoint(3.0, (0.0,))]
    times = (-1.0, 0.0, 0.5, 1.0, 2.0, 9.0)
    straight, jumps = (
        WaypointMotion([1.0], points),
        WaypointMotion([1.0], points, interpolated=False),
    )
    assert [straight.at(each)[0] for each in times] == [1.0, 1.0, 1.5, 2.0, 1.0, 0.0]
    assert [jumps.at(each)[0] for each in times] == [1.0, 1.0, 1.0, 2.0, 2.0, 0.0]


def test_waypoints_are_in_the_order_of_the_controller():
    found = waypoints_of(trajectory((1.0, 5.0, 6.0, 7.0), names="bca"), JOINTS)
    assert found == [Waypoint(1.0, (7.0, 5.0))]


@pytest.mark.parametrize(
    ("message", "text"),
    [
        (trajectory((1.0, 5.0), names="b"), "no joint 'a'"),
        (trajectory((1.0, 5.0)), "point 0 .* has 1 positions"),
        (trajectory((2.0, 5.0, 5.0), (1.0, 5.0, 5.0)), "point 1 .* is before"),
        (trajectory((1.0, 5.0, math.nan)), "point 0 .* has NaN"),
    ],
)
def test_a_malformed_trajectory_is_an_error(message, text):
    with pytest.raises(RosError, match=text):
        waypoints_of(message, JOINTS)


# Names ------------------------------------------------------------------------------------


def test_joints_are_those_of_the_parameter_or_of_the_chain(make_node):
    node = make_node("action")
    node.set_param("/robot_description", ROBOT.format(of_a="one"))
    assert controller_joints(node) == ["a", "b"]
    node.set_param("/controller_joint_names", ["b", "", "a"])
    assert controller_joints(node) == ["b", "a"]
    node.set_param("/controller_joint_names", "a")
    with pytest.raises(RosError, match="list of names"):
        controller_joints(node)


def test_joints_that_branch_are_no_chain(make_node):
    node = make_node("action")
    branches = ROBOT.format(of_a="one").replace('<parent link="two"/>', '<parent link="base"/>')
    node.set_param("/robot_description", branches)
    with pytest.raises(RosError, match="branch"):
        controller_joints(node)


# Nodes ------------------------------------------------------------------------------------


@pytest.fixture
def robot(make_node, listen):
    """Yield a simulated controller with its action, and a client."""
    node = make_node("controller")
    parameters = {"pub_rate": 50.0, "controller_joint_names": JOINTS, "initial_joint_state": [1, 2]}
    for name, value in parameters.items():
        node.set_param(f"/{name}", value)
    simulator, action = RobotSimulator(node), TrajectoryAction(make_node("action"))
    states = listen("/joint_states", sensor_msgs.msg.JointState)
    status = listen("/robot_status", industrial_msgs.msg.RobotStatus)
    threads = [Background(simulator.run), Background(action.run)]
    until(lambda: states and status and action._seen is not None)
    client = SimpleActionClient(make_node("client"), "joint_trajectory_action", ACTION)
    assert client.wait_for_server(Duration(60))
    yield SimpleNamespace(states=states, status=status, client=client, node=node)
    for each in threads:
        each.end()


def goal(*points, **options):
    return control_msgs.msg.FollowJointTrajectoryGoal(trajectory=trajectory(*points, **options))


def test_a_goal_is_followed_until_the_joints_are_there(robot):
    assert list(robot.states[0].position) == [1.0, 2.0]
    robot.client.send_goal(goal((0.1, 1.5, 1.5), (0.3, 4.0, 3.0), names="ba"))
    assert robot.client.wait_for_result(Duration(60))
    assert robot.client.get_state() == GoalStatus.SUCCEEDED
    until(lambda: list(robot.states[-1].position) == [3.0, 4.0])
    moved = [each.in_motion.val for each in robot.status]
    assert {0, 1} <= set(moved)
    last = robot.status[-1]
    assert (last.mode.val, last.motion_possible.val, last.in_error.val) == (2, 1, 0)


def test_a_cancelled_goal_stops_the_joints(robot):
    robot.client.send_goal(goal((60.0, 61.0, 62.0)))
    until(lambda: robot.status[-1].in_motion.val == 1)
    robot.client.cancel_goal()
    assert robot.client.wait_for_result(Duration(60))
    assert robot.client.get_state() == GoalStatus.PREEMPTED
    until(lambda: robot.status[-1].in_motion.val == 0)
    assert 1.0 <= robot.states[-1].position[0] < 61.0


def test_a_new_goal_ends_the_one_before_it(robot, make_node):
    first = SimpleActionClient(make_node("first"), "joint_trajectory_action", ACTION)
    assert first.wait_for_server(Duration(60))
    first.send_goal(goal((60.0, 61.0, 62.0)))
    until(lambda: robot.status[-1].in_motion.val == 1)
    robot.client.send_goal(goal((0.1, -1.0, -2.0)))
    assert first.wait_for_result(Duration(60))
    assert robot.client.wait_for_result(Duration(60))
    assert first.get_state() == GoalStatus.ABORTED
    assert robot.client.get_state() == GoalStatus.SUCCEEDED
    until(lambda: list(robot.states[-1].position) == [-1.0, -2.0])


@pytest.mark.parametrize(
    ("wrong", "code"),
    [
        (goal(), RESULT.INVALID_GOAL),
        (goal((1.0, 2.0), names="a"), RESULT.INVALID_JOINTS),
        (goal((1.0, 2.0)), RESULT.INVALID_GOAL),
    ],
)
def test_a_wrong_goal_is_rejected(robot, wrong, code):
    robot.client.send_goal(wrong)
    assert robot.client.wait_for_result(Duration(60))
    assert robot.client.get_state() == GoalStatus.REJECTED
    assert robot.client.get_result().error_code == code


def test_a_trajectory_during_another_one_stops_it(robot, make_node, caplog):
    commands = make_node("driver").advertise(
        "/joint_path_command", trajectory_msgs.msg.JointTrajectory
    )
    until(lambda: commands.has_subscribers)
    commands.publish(trajectory((60.0, 61.0, 62.0)))
    until(lambda: robot.status[-1].in_motion.val == 1)
    commands.publish(trajectory((60.0, -61.0, -62.0)))
    until(lambda: robot.status[-1].in_motion.val == 0)
    assert "during another one" in caplog.text


def test_the_robot_has_the_names_that_are_given(make_node):
    node = make_node("named")
    node.set_param("~robot_info", {"controller": {"model": "C"}, "robots": [{"model": "R"}]})
    RobotSimulator(node)
    found = node.client("/get_robot_info", industrial_msgs.srv.GetRobotInfo).call(
        industrial_msgs.srv.GetRobotInfoRequest()
    )
    assert (found.controller.model, [each.model for each in found.robots]) == ("C", ["R"])
    assert found.code.val == 1
    node.set_param("~robot_info", {"controller": {"colour": "red"}, "robots": []})
    with pytest.raises(RosError, match="robot_info"):
        RobotSimulator(node)


def test_the_goal_of_a_silent_controller_is_aborted(make_node):
    clock = SimulatedClock()
    clock.set(SECOND)
    node = make_node("action", clock=clock)
    node.set_param("/controller_joint_names", JOINTS)
    made = TrajectoryAction(node)
    client = SimpleActionClient(make_node("client"), "joint_trajectory_action", ACTION)
    assert client.wait_for_server(Duration(60))
    client.send_goal(goal((5.0, 1.0, 2.0)))
    assert client.wait_for_result(Duration(60))
    assert client.get_state() == GoalStatus.REJECTED
    assert "Waiting for" in client.get_goal_status_text()
    made._check(FEEDBACK(joint_names=JOINTS))
    client.send_goal(goal((5.0, 1.0, 2.0)))
    until(lambda: made._goal is not None)
    clock.set(clock.now() + SECOND)
    made._watch()
    assert made._goal is not None
    clock.set(clock.now() + 1)
    made._watch()
    assert client.wait_for_result(Duration(60))
    assert client.get_state() == GoalStatus.ABORTED
