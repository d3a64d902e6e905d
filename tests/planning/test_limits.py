"""Paths that cannot be planned are one error that says why, at once."""

import math

import pytest

import gazelle
from gazelle import Pose
from gazelle.errors import PlanningError
from gazelle.planning import Group


@pytest.fixture(scope="module")
def arm():
    with gazelle.Simulation("fetch", threads=1) as sim:
        yield Group(sim.robots["fetch"], "arm")


@pytest.mark.parametrize(
    ("poses", "text"),
    [
        ([], "a list of one pose or more"),
        (5, "a list of one pose or more"),
        (None, "a list of one pose or more"),
        ([None], "pose 0 of a path is not a gazelle.Pose"),
        ("poses", "pose 0 of a path is not a gazelle.Pose"),
        ([Pose(x=math.nan)], "'poses' must be finite numbers"),
        ([Pose(), Pose(yaw=math.inf)], "'poses' must be finite numbers"),
        ([Pose(x=1e300)], "'poses' must be finite numbers"),
        ([Pose(x=1e5)], "more than the limit of 100,000"),
    ],
)
def test_a_path_of_no_poses_is_refused(arm, poses, text):
    with pytest.raises(PlanningError, match=text):
        arm.follow(poses)


@pytest.mark.parametrize("step", [0.0, -1.0, math.nan, 1e-300])
def test_a_step_that_goes_nowhere_is_refused(arm, step):
    with pytest.raises(PlanningError, match=r"above zero|more than the limit|'max_step' must be"):
        arm.follow([Pose(x=0.5)], max_step=step)
