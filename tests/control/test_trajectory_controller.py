"""The joint trajectory controllers, on joints that do at once what they are told."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.control import ControllerManager, GoalState
from gazelle.control.values import (
    GOAL_TOLERANCE_VIOLATED,
    INVALID_GOAL,
    INVALID_JOINTS,
    PATH_TOLERANCE_VIOLATED,
    JointTolerance,
    JointTrajectory,
    TrajectoryGoal,
    TrajectoryPoint,
    TrajectoryQuery,
)
from gazelle.errors import ControlError, ControlWarning
from tests.control.robots import ARM
from tests.control.stand_in import Frictionless, spin

NAMES = ("one", "two")
FOLLOW = "follow_joint_trajectory"


def loaded(kind="position", nworld=1, interface=None, joints=NAMES, **parameters):
    commands = {interface or kind.capitalize(): list(joints)}
    manager = ControllerManager(Frictionless(commands, nworld), model=ARM)
    of = f"{kind}_controllers/JointTrajectoryController"
    controller = manager.load("arm", {"type": of, "joints": list(joints), **parameters})
    manager.start("arm")
    spin(manager)
    return manager, controller


def path(*points, names=NAMES, stamp=0):
    """Return a trajectory: (time, positions, velocities)."""
    made = [TrajectoryPoint(p[0], tuple(p[1]), tuple(p[2]) if len(p) > 2 else ()) for p in points]
    return JointTrajectory(names, tuple(made), stamp)


STEP = path((1.0, (1.0, 0.5)), (2.0, (0.0, 1.0)))


def give(controller, trajectory, worlds=None, **tolerances):
    return controller.actions[FOLLOW].send(TrajectoryGoal(trajectory, **tolerances), worlds)


def position(manager, world=0):
    return manager.hardware.joints.position[world].tolist()


def test_a_goal_is_followed_and_succeeds():
    manager, controller = loaded()
    seen, told = [], []
    goal = give(controller, STEP)
    goal.subscribe(lambda g: seen.append(g.state), told.append)
    spin(manager, 50)
    assert position(manager) == pytest.approx([0.49, 0.245], abs=0.02)
    assert seen == [GoalState.ACTIVE]
    spin(manager, 50)
    assert position(manager) == pytest.approx([1.0, 0.5], abs=0.02)
    assert not goal.done
    spin(manager, 110)
    assert position(manager) == pytest.approx([0.0, 1.0])
    assert (goal.state, goal.result.error_code) == (GoalState.SUCCEEDED, 0)
    assert goal.wait(0)
    assert 35 < len(told) < 45  # 20 Hz
    assert told[3].names == NAMES


def test_names_may_come_in_any_order_and_the_rest_is_refused():
    manager, controller = loaded()
    controller.inputs["command"].send(path((0.1, (0.5, 1.0)), names=("two", "one")))
    spin(manager, 20)
    assert position(manager) == pytest.approx([1.0, 0.5])
    for names, code in (
        (("one",), INVALID_JOINTS),
        (("one", "three"), INVALID_JOINTS),
        (("one", "one"), INVALID_JOINTS),
    ):
        goal = give(controller, path((1.0, (0.0,) * len(names)), names=names))
        assert (goal.state, goal.result.error_code) == (GoalState.REJECTED, code)
    assert "did you mean" in give(controller, path((1.0, (0, 0)), names=("one", "tow"))).text


@pytest.mark.parametrize(
    ("trajectory", "said"),
    [
        (path((1.0, (0, 0)), (1.0, (1, 1))), "strictly increasing"),
        (path((1.0, (0, 0)), (0.5, (1, 1))), "strictly increasing"),
        (path((1.0, (0,))), "1 positions for 2 joints"),
        (path((1.0, (0, 0), (1,))), "1 velocities for 2 joints"),
        (path((1.0, (), (1, 1))), "0 positions for 2 joints"),
        (path((1.0, (0, math.nan))), "not finite"),
        (path((0.0, (0, 0))), r"dropping all 1 trajectory point\(s\)"),
        (path((0.1, (0, 0)), stamp=1), "dropping all"),
    ],
)
def test_what_cannot_be_followed_is_refused_and_the_old_goes_on(trajectory, said):
    manager, controller = loaded()
    spin(manager, 30)
    first = give(controller, STEP)
    spin(manager, 50)
    goal = give(controller, trajectory)
    assert (goal.state, goal.result.error_code) == (GoalState.REJECTED, INVALID_GOAL)
    with pytest.raises(ControlError, match=said):
        controller.inputs["command"].send(trajectory)
    spin(manager, 160)
    assert first.state == GoalState.SUCCEEDED
    assert position(manager) == pytest.approx([0.0, 1.0])


def test_points_that_are_over_are_dropped():
    manager, controller = loaded()
    spin(manager, 199)
    now = manager.now_ns
    with pytest.warns(ControlWarning, match=r"dropping first 1 trajectory point\(s\) out of 2"):
        controller.inputs["command"].send(
            path((0.5, (9.0, 9.0)), (1.5, (1.0, 1.0)), stamp=now - 1_000_000_000)
        )
    spin(manager, 60)
    assert position(manager) == pytest.approx([1.0, 1.0])
    controller.inputs["command"].send(path((0.0, (5.0, 5.0)), (0.1, (0.0, 0.0))))  # said by nobody
    spin(manager, 20)
    assert position(manager) == pytest.approx([0.0, 0.0])


def test_a_trajectory_of_the_future_waits():
    manager, controller = loaded()
    stamp = manager.now_ns + 1_000_000_000
    goal = give(controller, path((0.5, (1.0, 1.0)), stamp=stamp))
    spin(manager, 95)
    assert position(manager) == pytest.approx([0.0, 0.0], abs=0.02)
    spin(manager, 60)
    assert goal.state == GoalState.SUCCEEDED
    assert position(manager) == pytest.approx([1.0, 1.0])


def test_replaced_cancelled_and_stopped_goals_are_preempted():
    manager, controller = loaded()
    first = give(controller, STEP)
    second = give(controller, STEP)
    assert (first.state, second.state) == (GoalState.PREEMPTED, GoalState.ACTIVE)
    first.cancel()
    assert second.state == GoalState.ACTIVE
    spin(manager, 50)
    second.cancel()
    assert second.state == GoalState.PREEMPTED
    there = position(manager)
    spin(manager, 50)
    assert position(manager) == pytest.approx(there)
    third = give(controller, STEP)
    controller.inputs["command"].send(JointTrajectory())  # hold
    assert third.state == GoalState.PREEMPTED
    fourth = give(controller, STEP)
    manager.stop("arm")
    assert fourth.state == GoalState.PREEMPTED
    last = give(controller, STEP)
    assert (last.state, last.result.error_code) == (GoalState.REJECTED, INVALID_GOAL)
    assert "not running" in last.text


def test_a_goal_without_points_succeeds_and_holds():
    manager, controller = loaded()
    give(controller, STEP)
    spin(manager, 50)
    there = position(manager)
    assert give(controller, JointTrajectory()).state == GoalState.SUCCEEDED
    nameless = give(controller, JointTrajectory(names=()))
    assert (nameless.state, nameless.result.error_code) == (GoalState.REJECTED, INVALID_JOINTS)
    spin(manager, 20)
    assert position(manager) == pytest.approx(there)


def test_a_stop_takes_its_time():
    manager, controller = loaded(stop_trajectory_duration=0.5)
    give(controller, path((1.0, (1.0, 1.0), (1.0, 1.0)), (3.0, (3.0, 3.0), (1.0, 1.0))))
    spin(manager, 150)
    controller.inputs["command"].send(JointTrajectory())
    before = position(manager)[0]
    speeds = []
    for _ in range(60):
        spin(manager)
        speeds.append((position(manager)[0] - before) / 0.01)
        before = position(manager)[0]
    assert speeds[0] == pytest.approx(1.0, abs=0.05)
    assert speeds[-1] == pytest.approx(0.0, abs=1e-6)
    assert max(np.abs(np.diff(speeds))) < 0.06  # no jerk


def test_some_joints_may_move_alone_if_that_is_allowed():
    manager, controller = loaded(allow_partial_joints_goal=True)
    give(controller, STEP)
    spin(manager, 50)
    goal = give(controller, path((0.5, (3.0,)), names=("two",)))
    spin(manager, 60)
    assert goal.state == GoalState.SUCCEEDED
    assert position(manager)[1] == pytest.approx(3.0)
    assert position(manager)[0] == pytest.approx(0.9, abs=0.03)
    spin(manager, 100)
    assert position(manager) == pytest.approx([0.0, 3.0])
    # Some is not none.
    for goal in (give(controller, path(names=())), give(controller, path((1.0, ()), names=()))):
        assert (goal.state, goal.result.error_code) == (GoalState.REJECTED, INVALID_JOINTS)


def test_endless_joints_take_the_shorter_way():
    manager, controller = loaded()
    manager.hardware.joints.position[:] = 3.0
    manager.stop("arm")
    manager.start("arm")
    controller.inputs["command"].send(path((0.5, (2.0, -3.0))))
    spin(manager, 60)
    assert position(manager) == pytest.approx([2.0, 2 * math.pi - 3.0])


def test_errors_on_the_way_and_at_the_end_abort():
    strict = {"constraints": {"one": {"trajectory": 0.05, "goal": 0.01}, "goal_time": 0.2}}
    manager, controller = loaded("velocity", gains={n: {"p": 0.0} for n in NAMES}, **strict)
    goal = give(controller, STEP)
    spin(manager, 100)
    assert (goal.state, goal.result.error_code) == (GoalState.ABORTED, PATH_TOLERANCE_VIOLATED)
    assert goal.result.error_string.startswith("one path error 0.0")
    free = (JointTolerance("one", position=-1.0),)
    goal = give(controller, path((0.5, (1.0, 0.0))), path_tolerance=free)
    spin(manager, 60)
    assert goal.state == GoalState.ACTIVE  # it has some time left
    spin(manager, 20)
    assert (goal.state, goal.result.error_code) == (GoalState.ABORTED, GOAL_TOLERANCE_VIOLATED)
    assert goal.result.error_string.startswith("one goal error 1.0")
    goal = give(controller, path((0.5, (1.0, 0.0))), path_tolerance=free, goal_tolerance=free)
    spin(manager, 60)
    assert goal.state == GoalState.SUCCEEDED
    near = (JointTolerance("two", position=0.001),)
    goal = give(controller, path((0.5, (0.0, 1.0))), path_tolerance=near + free)
    spin(manager, 10)
    assert goal.result.error_string.startswith("two path error")


@pytest.mark.parametrize("kind", ["velocity", "effort"])
def test_pid_and_feedforward_make_commands(kind):
    gains = {n: {"p": 100.0, "d": 20.0} for n in NAMES}
    manager, controller = loaded(kind, gains=gains, velocity_ff=dict.fromkeys(NAMES, 1.0))
    if kind == "velocity":
        gains = {n: {"p": 5.0} for n in NAMES}
        manager, controller = loaded(kind, gains=gains, velocity_ff=dict.fromkeys(NAMES, 1.0))
    give(controller, path((1.0, (1.0, 0.5), (0.0, 0.0)), (2.0, (1.0, 0.5), (0.0, 0.0))))
    spin(manager, 250)
    assert position(manager) == pytest.approx([1.0, 0.5], abs=1e-3)
    tuned = controller.tunings["gains/one"].send(p=3.0)
    assert tuned["p"] == 3.0
    with pytest.raises(ControlError, match="no gains 'x/gains/one/p'"):
        manager.load(
            "x", {"type": f"{kind}_controllers/JointTrajectoryController", "joints": list(NAMES)}
        )


@pytest.mark.parametrize("kind", ["pos_vel", "pos_vel_acc"])
def test_all_fields_are_commanded(kind):
    interface = {"pos_vel": "PosVel", "pos_vel_acc": "PosVelAcc"}[kind]
    manager, controller = loaded(kind, interface=interface)
    give(controller, path((1.0, (1.0, 0.5), (0.0, 0.0)), (2.0, (1.0, 0.5), (0.0, 0.0))))
    spin(manager, 50)
    commands = manager.hardware.interfaces[f"hardware_interface/{interface}JointInterface"].commands
    t = 0.5 - 0.01
    assert commands["position"][0, 0] == pytest.approx(3 * t**2 - 2 * t**3, abs=0.02)
    assert commands["velocity"][0, 0] == pytest.approx(6 * t - 6 * t**2, abs=0.01)
    if kind == "pos_vel_acc":
        assert commands["acceleration"][0, 0] == pytest.approx(6 - 12 * t, abs=0.3)


def test_the_state_and_any_moment_of_a_trajectory_can_be_asked_for():
    manager, controller = loaded(state_publish_rate=10.0)
    told = []
    controller.outputs["state"].subscribe(told.append)
    start = manager.now_ns
    give(controller, STEP)
    spin(manager, 100)
    assert len(told) in (9, 10)
    assert told[4].desired.positions.shape == (1, 2)
    assert told[4].error.positions == pytest.approx(
        told[4].desired.positions - told[4].actual.positions
    )
    answer = controller.queries["query_state"].call(TrajectoryQuery(start + 1_510_000_000))
    assert answer.sample.positions[0] == pytest.approx([0.5, 0.75])
    assert answer.sample.velocities[0] == pytest.approx([-1.0, 0.5])
    with pytest.raises(ControlError, match="precedes"):
        controller.queries["query_state"].call(TrajectoryQuery(start - 10_000_000_000))
    manager.stop("arm")
    with pytest.raises(ControlError, match="not running"):
        controller.queries["query_state"].call(TrajectoryQuery(start))


def test_jumps_of_the_clock_do_not_move_a_trajectory():
    manager, controller = loaded()
    give(controller, STEP)
    spin(manager, 50)
    there = position(manager)[0]
    manager.now_ns += 5_000_000_000
    spin(manager)
    assert position(manager)[0] == pytest.approx(there, abs=0.03)


def test_worlds_follow_trajectories_of_their_own():
    manager, controller = loaded(nworld=3)
    some = give(controller, STEP, np.array([0, 2]))
    alone = give(controller, path((0.5, (2.0, 2.0))), np.array([1]))
    spin(manager, 60)
    assert alone.state == GoalState.SUCCEEDED
    other = give(controller, path((0.5, (3.0, 3.0))), np.array([2]))
    assert some.states.tolist() == [GoalState.ACTIVE, GoalState.PREEMPTED]
    assert not some.done
    spin(manager, 160)
    assert some.states.tolist() == [GoalState.SUCCEEDED, GoalState.PREEMPTED]
    assert (some.done, other.state) == (True, GoalState.SUCCEEDED)
    assert manager.hardware.joints.position == pytest.approx(
        np.array([[0.0, 1.0], [2.0, 2.0], [3.0, 3.0]])
    )
    reset = give(controller, STEP)
    manager.hardware.joints.position[1] = 7.0
    controller.reset(np.array([1]))
    assert reset.states.tolist() == [GoalState.ACTIVE, GoalState.PREEMPTED, GoalState.ACTIVE]
    spin(manager, 10)
    assert position(manager, 1) == [7.0, 7.0]


def test_a_snapshot_goes_on():
    manager, controller = loaded()
    give(controller, STEP)
    spin(manager, 50)
    kept, joints = controller.state(), manager.hardware.state()
    spin(manager, 30)
    wanted = position(manager)
    give(controller, path((0.1, (9.0, 9.0))))
    spin(manager, 30)
    controller.restore(kept)
    manager.hardware.restore(joints)
    spin(manager, 30)
    assert position(manager) == pytest.approx(wanted)


@pytest.mark.parametrize(
    ("parameters", "said"),
    [
        ({"joints": ["one", "elbow"]}, "'elbow' in the URDF"),
        ({"joints": []}, "is empty"),
        ({"joints": "one", "constraints": {"goal_time": "soon"}}, "'arm/constraints/goal_time'"),
    ],
)
def test_what_cannot_be_is_said_when_it_is_loaded(parameters, said):
    manager = ControllerManager(Frictionless({"Position": list(NAMES)}), model=ARM)
    of = "position_controllers/JointTrajectoryController"
    with pytest.raises(ControlError, match=said):
        manager.load("arm", {"type": of, **parameters})
    with pytest.raises(ControlError, match="needs the robot's URDF"):
        ControllerManager(manager.hardware).load("arm", {"type": of, "joints": list(NAMES)})
