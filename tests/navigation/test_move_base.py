"""Behaviour of ``move_base`` while there is no way on."""

import math

import numpy as np
import pytest

from gazelle.errors import Error
from gazelle.navigation.costmap import Costmap, footprint_of
from gazelle.navigation.move_base import (
    GoalOutcome,
    MoveBase,
    MoveBaseSettings,
    RobotState,
    navigation_stack,
)
from gazelle.navigation.move_base.recovery import RecoveryBehavior, RotateRecovery, make_recovery
from gazelle.navigation.planners.plugins import STOP

TURN = (0.0, 0.0, 0.8)
PERIOD = 0.1


class Planner:
    def make_plan(self, start, goal, tolerance=None):
        return np.array([start, goal])


class Controller:
    """Has a velocity where `finds` says so, asked with what the robot has."""

    def __init__(self, finds):
        self.finds = finds

    def set_plan(self, plan):
        return True

    def goal_reached(self, pose, velocity, to_local):
        return False

    def command(self, pose, velocity, to_local):
        return self.finds(velocity)


class Cycles(RecoveryBehavior):
    """Turns for some cycles."""

    def __init__(self, name, count):
        self.name, self.count, self.left = name, count, 0

    def begin(self, global_pose, local_pose):
        self.left = self.count

    def update(self, local_pose):
        self.left -= 1
        return TURN if self.left >= 0 else None


def ran(finds, recoveries, seconds=60.0, **settings):
    """Run with a base that stays in its place and has each velocity at once.

    Returns what was begun when, how it ended, and when a velocity was found.
    """
    law = MoveBase(
        MoveBaseSettings(**{"controller_frequency": 10.0, "planner_frequency": 5.0, **settings}),
        Planner(), Controller(finds), recoveries,
    )  # fmt: skip
    law.set_goal((1.0, 0.0, 0.0), 0.0)
    velocity, begun, moved = STOP, [], None
    for cycle in range(round(seconds / PERIOD)):
        time = cycle * PERIOD
        step = law.update(time, RobotState((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), velocity))
        velocity = velocity if step.velocity is None else step.velocity
        if step.recovery is not None:
            begun.append((step.recovery[1], round(time, 1)))
        if velocity not in {STOP, TURN} and moved is None:
            moved = round(time, 1)
        if step.outcome is not None:
            return begun, (step.outcome, step.text, round(time, 1)), moved
    return begun, None, moved


@pytest.mark.parametrize(
    ("goal", "time"), [((1.0, math.nan, 0.0), 0.0), ((1.0, 0.0, 0.0), math.nan)]
)
def test_a_goal_of_nan_is_refused(goal, time):
    law = MoveBase(MoveBaseSettings(), Planner(), Controller(None), [])
    with pytest.raises(Error, match="finite"):
        law.set_goal(goal, time)
    assert law.goal is None


def test_recoveries_follow_each_other_at_once_when_there_is_no_velocity():
    """As in the original only a velocity that was found counts as one."""
    begun, ended, _ = ran(lambda _: None, [Cycles("a", 0), Cycles("b", 3), Cycles("c", 0)])
    names, times = zip(*begun, strict=True)
    assert names == ("a", "b", "c")
    assert 15.0 < times[0] < 15.4
    assert times[-1] - times[0] < 1.2
    text = "Failed to find a valid control. Even after executing recovery behaviors."
    assert ended[:2] == (GoalOutcome.ABORTED, text)


def test_one_that_finds_no_velocity_does_not_oscillate():
    """Oscillation is looked for while it drives; with none the controller's patience counts."""
    begun, ended, _ = ran(lambda _: None, [Cycles("a", 0)], oscillation_timeout=10.0)
    assert begun[0][1] > 15.0
    assert "valid control" in ended[1]


def test_one_that_goes_to_and_fro_recovers_and_gives_up_as_oscillating():
    begun, ended, _ = ran(
        lambda _: (0.1, 0.0, 0.0), [Cycles("a", 0), Cycles("b", 2)], oscillation_timeout=10.0
    )
    assert [round(time / 10.0) for _, time in begun] == [1, 2]
    text = "Robot is oscillating. Even after executing recovery behaviors."
    assert ended[:2] == (GoalOutcome.ABORTED, text)


def test_a_recovery_that_turns_leaves_the_robot_turning():
    """A controller that knows a way on only from motion gets to see the motion."""
    begun, ended, moved = ran(
        lambda velocity: (0.2, 0.0, 0.0) if velocity != STOP else None,
        [Cycles("clear", 0), Cycles("rotate", 5)],
    )
    assert [name for name, _ in begun] == ["clear", "rotate"]
    assert ended is None
    assert moved == pytest.approx(begun[-1][1] + 0.6, abs=0.11)


@pytest.mark.parametrize(
    ("own", "base", "rate"),
    [
        ({}, {}, 1.0),
        ({}, {"max_vel_theta": 0.6}, 0.6),
        ({}, {"max_rotational_vel": 0.5}, 0.5),
        ({"max_rotational_vel": 0.7}, {}, 0.7),
        ({}, {"min_in_place_vel_theta": 1.2, "max_vel_theta": 2.0, "acc_lim_theta": 0.01}, 1.2),
    ],
)
def test_rotating_reads_the_limits_of_trajectory_planner(own, base, rate):
    costmap = Costmap([], footprint_of([[-0.1, -0.1], [-0.1, 0.1], [0.1, 0.1], [0.1, -0.1]]))
    found = make_recovery(
        {"name": "r", "type": "rotate_recovery/RotateRecovery"}, costmap, costmap,
        {"r": own, "TrajectoryPlannerROS": base}, conservative=3.0,
    )  # fmt: skip
    assert isinstance(found, RotateRecovery)
    found.begin((5.0, 5.0, 0.0), (5.0, 5.0, 0.0))
    assert found.update((5.0, 5.0, 0.0)) == (0.0, 0.0, pytest.approx(rate))
    heading = 0.0
    for _ in range(400):
        velocity = found.update((5.0, 5.0, heading))
        if velocity is None:
            break
        heading = math.remainder(heading + 0.05 * velocity[2], 2 * math.pi)
    assert velocity is None
    assert abs(heading) < 0.15


@pytest.mark.parametrize("rate", [0.0, -5.0])
def test_frequencies_of_planners_are_positive(rate):
    with pytest.raises(Error, match="TrajectoryPlannerROS/controller_frequency must be above 0"):
        navigation_stack({"TrajectoryPlannerROS": {"controller_frequency": rate}})
