"""A control loop that is late: what is over by the clock is over for its controllers."""

from __future__ import annotations

import contextlib

import pytest
from control.robots import ARM
from control.stand_in import Frictionless
from ros.graph import until

from gazelle.bridges.control import HardwareLoop
from gazelle.control import ControllerManager
from gazelle_ros import Master, Node, Time, load_message
from gazelle_ros.actions import ActionClient, CommState, TerminalState
from gazelle_ros.clock import SECOND, SimulatedClock
from gazelle_ros.time import Duration

JOINTS = ["one", "two"]
PERIOD_S = 0.01


@pytest.fixture
def late():
    """Send a trajectory that ends at a time, when the clock shows another, after 5 s."""
    with contextlib.ExitStack() as stack:
        master = stack.enter_context(Master(port=0, rosout=False))
        clock = SimulatedClock()
        clock.set(5 * SECOND)
        robot = stack.enter_context(Node("robot", master_uri=master.uri, clock=clock))
        client = stack.enter_context(Node("client", master_uri=master.uri))
        manager = ControllerManager(Frictionless({"Position": JOINTS}), model=ARM)
        loop = stack.enter_context(HardwareLoop(robot, manager, 1.0 / PERIOD_S))
        of = "position_controllers/JointTrajectoryController"
        manager.load("arm", {"type": of, "joints": JOINTS})
        loop.step(PERIOD_S)
        manager.start("arm")
        loop.step(PERIOD_S)
        kind = load_message("control_msgs/FollowJointTrajectoryAction")
        action = ActionClient(client, "/arm/follow_joint_trajectory", kind)
        until(lambda: action.connected)

        def send(clock_s, ends_s):
            clock.set(round(clock_s * SECOND))
            goal = action.types.goal()
            goal.trajectory.joint_names = JOINTS
            goal.trajectory.header.stamp = Time.from_sec(ends_s - 1.0)
            point = load_message("trajectory_msgs/JointTrajectoryPoint")
            end = point(positions=[0.5, 0.5], time_from_start=Duration.from_sec(1.0))
            goal.trajectory.points = [end]
            handle = action.send_goal(goal)
            ends = {CommState.DONE, CommState.ACTIVE}
            until(lambda: handle.get_comm_state() in ends)
            if handle.get_comm_state() == CommState.ACTIVE:
                handle.cancel()
                return "ACTIVE"
            return TerminalState.to_string(handle.get_terminal_state())

        yield send


@pytest.mark.parametrize(
    ("clock_s", "ends_s", "state"),
    [
        (5.0, 4.9, "REJECTED"),
        (5.0, 5.005, "REJECTED"),  # before the next period begins
        (5.0, 5.1, "ACTIVE"),
        (5.2, 5.1, "REJECTED"),
        (5.2, 5.199, "REJECTED"),
        (5.2, 5.3, "ACTIVE"),
        (60.0, 59.999, "REJECTED"),
        (60.0, 60.5, "ACTIVE"),
    ],
)
def test_a_trajectory_that_is_over_is_refused_however_late_the_loop_is(
    clock_s, ends_s, state, late
):
    assert late(clock_s, ends_s) == state
