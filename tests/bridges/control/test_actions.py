"""Goals of controllers as ROS actions, with a controller that does as the test says."""

import contextlib

import numpy as np
import pytest
from bridges.control.control_graph import control_graph
from ros.graph import until

from gazelle.bridges.control.hardware_loop import LiveGraph
from gazelle.control import ActionPort, Controller, GoalState, register
from gazelle.control.values import (
    GripperGoal,
    GripperResult,
    JointSample,
    TrajectoryGoal,
    TrajectoryResult,
    TrajectoryState,
)
from gazelle.errors import ControlError
from gazelle_ros import load_message
from gazelle_ros.actions import ActionClient, SimpleActionClient
from gazelle_ros.time import Duration, Time

CONTROL = "control_msgs/"


class Following(Controller):
    """Keeps the goals it gets, and lets the test bring them to their ends."""

    goals = ("follow_joint_trajectory", TrajectoryGoal, TrajectoryState, TrajectoryResult)

    def init(self, parameters):
        name, *kinds = self.goals
        self.taken, self.stopped, self.refusing = [], [], None
        self.add_action(
            name,
            lambda topic, call: ActionPort(
                topic, *kinds, begin=self.begin, stop=self.stop, nworld=self.nworld, call=call
            ),
        )

    def begin(self, goal):
        if self.refusing is not None:
            raise self.refusing
        if len(goal.value.trajectory.names) != 1:
            result = TrajectoryResult(-2, "other joints")
            goal.end(GoalState.REJECTED, None, result, result.error_string)
            return
        for each in self.taken:
            each.end(GoalState.PREEMPTED)
        goal.accept()
        self.taken.append(goal)
        if not goal.value.trajectory.points:
            goal.end(GoalState.SUCCEEDED, None, TrajectoryResult(), "nothing to do")

    def stop(self, goal):
        self.stopped.append(goal)
        goal.end(GoalState.PREEMPTED, text="stopped")


class Gripping(Following):
    goals = ("gripper_cmd", GripperGoal, GripperResult, GripperResult)

    def begin(self, goal):
        goal.accept()
        self.taken.append(goal)


COUNTING = [
    load_message(f"actionlib_tutorials/Fibonacci{part}") for part in ("Goal", "Feedback", "Result")
]


class Counting(Gripping):
    """Goals that are messages."""

    goals = ("count", *COUNTING)


register("test/Following", Following)
register("test/Gripping", Gripping)
register("test/Counting", Counting)


@contextlib.contextmanager
def acting(kind, action, spec):
    with control_graph(namespace="/robot") as graph:
        graph.spawn("arm", f"test/{kind}")
        client = ActionClient(graph.node, f"/robot/arm/{action}", load_message(spec))
        assert client.wait_for_server(30.0)
        yield graph, client, graph.manager["arm"]


@pytest.fixture
def following():
    spec = f"{CONTROL}FollowJointTrajectoryAction"
    with acting("Following", "follow_joint_trajectory", spec) as made:
        yield made


def trajectory(*times, names=("hip",)):
    goal = load_message(f"{CONTROL}FollowJointTrajectoryGoal")()
    point = load_message("trajectory_msgs/JointTrajectoryPoint")
    goal.trajectory.joint_names = list(names)
    for time in times:
        stamp = Duration.from_sec(time)
        goal.trajectory.points.append(
            point(positions=[time], velocities=[0.5], accelerations=[0.1], time_from_start=stamp)
        )
    return goal


def state_of(handle):
    return handle.get_goal_status()


def test_a_goal_arrives_whole(following, monkeypatch):
    _graph, client, arm = following
    # A loop that is late shifts stamps (test_late_loop.py), and a busy machine makes loops late.
    monkeypatch.setattr(LiveGraph, "own_ns", lambda _graph, time: time.to_nsec())
    goal = trajectory(1.0, 2.5)
    goal.trajectory.header.stamp = Time(7, 5)
    tolerance = load_message(f"{CONTROL}JointTolerance")
    goal.path_tolerance = [tolerance("hip", 0.1, -1.0, 0.3)]
    goal.goal_tolerance = [tolerance(name="hip", position=0.01)]
    goal.goal_time_tolerance = Duration.from_sec(0.5)
    handle = client.send_goal(goal)
    until(lambda: state_of(handle) == GoalState.ACTIVE, 30)
    value = arm.taken[0].value
    assert value.trajectory.names == ("hip",)
    assert value.trajectory.stamp == 7_000_000_005
    first, second = value.trajectory.points
    assert (first.time, second.time) == (1.0, 2.5)
    assert second.positions == (2.5,)
    assert (first.velocities, first.accelerations, first.effort) == ((0.5,), (0.1,), ())
    (path,) = value.path_tolerance
    assert (path.name, path.position, path.velocity, path.acceleration) == ("hip", 0.1, -1.0, 0.3)
    assert value.goal_tolerance[0].position == 0.01
    assert value.goal_time_tolerance == 0.5
    assert arm.taken[0].worlds.tolist() == [0]


@pytest.mark.parametrize(
    ("end", "code"),
    [(GoalState.SUCCEEDED, 0), (GoalState.ABORTED, -4), (GoalState.PREEMPTED, None)],
)
def test_the_end_of_a_goal_is_told(following, end, code):
    graph, client, arm = following
    handle = client.send_goal(trajectory(1.0))
    until(lambda: arm.taken, 30)
    result = None if code is None else TrajectoryResult(code, "so it is")
    graph.manager.call(lambda: arm.taken[0].end(end, None, result, "done"))
    until(lambda: state_of(handle) == end and handle.get_result() is not None, 30)
    assert handle.get_goal_status_text() == "done"
    assert handle.get_result().error_code == (code or 0)
    assert handle.get_result().error_string == ("" if code is None else "so it is")


def test_a_goal_that_has_ended_at_once_was_accepted(following):
    _, client, _arm = following
    handle = client.send_goal(trajectory())
    until(lambda: state_of(handle) == GoalState.SUCCEEDED, 30)


def test_a_refusal_has_its_code(following):
    _graph, client, arm = following
    handle = client.send_goal(trajectory(1.0, names=("hip", "nose")))
    until(lambda: state_of(handle) == GoalState.REJECTED and handle.get_result(), 30)
    assert handle.get_result().error_code == -2
    arm.refusing = ControlError("it does not run")
    handle = client.send_goal(trajectory(1.0))
    until(lambda: state_of(handle) == GoalState.REJECTED and handle.get_result(), 30)
    assert handle.get_result().error_code == -1
    assert "does not run" in handle.get_goal_status_text()


def test_a_goal_takes_the_place_of_the_one_before(following):
    _, client, arm = following
    first = client.send_goal(trajectory(1.0))
    until(lambda: state_of(first) == GoalState.ACTIVE, 30)
    second = client.send_goal(trajectory(2.0))
    until(lambda: state_of(first) == GoalState.PREEMPTED, 30)
    until(lambda: state_of(second) == GoalState.ACTIVE, 30)
    assert arm.stopped == []


def test_cancelling_stops_the_goal_and_only_it(following):
    _, client, arm = following
    first = client.send_goal(trajectory(1.0))
    until(lambda: state_of(first) == GoalState.ACTIVE, 30)
    first.cancel()
    until(lambda: state_of(first) == GoalState.PREEMPTED, 30)
    assert [each is arm.taken[0] for each in arm.stopped] == [True]
    second = client.send_goal(trajectory(1.0))
    until(lambda: state_of(second) == GoalState.ACTIVE, 30)
    client.cancel_goals_at_and_before_time(Time(1, 0))
    client.cancel_all_goals()
    until(lambda: state_of(second) == GoalState.PREEMPTED, 30)


def test_feedback_has_all_of_a_trajectorys_state(following):
    graph, client, arm = following
    heard = []
    handle = client.send_goal(trajectory(1.0), feedback_cb=lambda _, found: heard.append(found))
    until(lambda: arm.taken and state_of(handle) == GoalState.ACTIVE, 30)

    def sample(value, accelerations=True):
        row = np.array([[value]])
        return JointSample(row, row + 1.0, row + 2.0 if accelerations else None)

    value = TrajectoryState(
        3_000_000_000,
        ("hip",),
        sample(1.0),
        sample(2.0, accelerations=False),
        sample(3.0, accelerations=False),
        np.array([0.25]),
    )
    until(lambda: arm.taken[0].has_feedback_callbacks, 30)
    graph.manager.call(lambda: arm.taken[0].publish_feedback(value))
    until(lambda: heard, 30)
    found = heard[0]
    assert found.header.stamp == Time(3, 0)
    assert found.joint_names == ["hip"]
    assert list(found.desired.positions) == [1.0]
    assert list(found.desired.accelerations) == [3.0]
    assert list(found.actual.velocities) == [3.0]
    assert list(found.actual.accelerations) == []
    assert list(found.error.positions) == [3.0]
    assert found.desired.time_from_start == Duration.from_sec(0.25)


def test_a_gripper_is_told_where_and_how_hard():
    with acting("Gripping", "gripper_cmd", f"{CONTROL}GripperCommandAction") as made:
        graph, _, arm = made
        client = SimpleActionClient(
            graph.node, "/robot/arm/gripper_cmd", load_message(f"{CONTROL}GripperCommandAction")
        )
        assert client.wait_for_server(Duration.from_sec(30))
        goal = load_message(f"{CONTROL}GripperCommandGoal")()
        goal.command.position, goal.command.max_effort = 0.04, 20.0
        client.send_goal(goal)
        until(lambda: arm.taken, 30)
        assert arm.taken[0].value == GripperGoal(0.04, 20.0)
        result = GripperResult(0.03, 20.0, stalled=True, reached_goal=False)
        graph.manager.call(lambda: arm.taken[0].end(GoalState.ABORTED, None, result))
        assert client.wait_for_result(Duration.from_sec(30))
        found = client.get_result()
        assert (found.position, found.effort, found.stalled) == (0.03, 20.0, True)
        assert not found.reached_goal


def test_goals_may_be_messages():
    spec = "actionlib_tutorials/FibonacciAction"
    with acting("Counting", "count", spec) as (graph, client, arm):
        goal_kind, _, result_kind = COUNTING
        handle = client.send_goal(goal_kind(5))
        until(lambda: arm.taken, 30)
        assert arm.taken[0].value.order == 5
        result = result_kind([1, 1, 2])
        graph.manager.call(lambda: arm.taken[0].end(GoalState.SUCCEEDED, None, result))
        until(lambda: handle.get_result() is not None, 30)
        assert list(handle.get_result().sequence) == [1, 1, 2]


def test_an_action_goes_with_its_controller(following):
    graph, _, _arm = following
    assert graph.switch(stop=["arm"])
    assert graph.call("unload_controller", name="arm")
    status = "/robot/arm/follow_joint_trajectory/status"
    until(lambda: status not in graph.node.master.system_state()[0], 30)
