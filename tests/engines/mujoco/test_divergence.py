"""A world that breaks down says where to look first."""

import numpy as np
import pytest
import scenes

from gazelle.description import Pose
from gazelle.engines import DivergenceError, make_engine


def engine(nworld=3):
    world = scenes.world(
        scenes.ground(), scenes.ball(pose=Pose(z=1.0)), scenes.burger(pose=Pose(2.0))
    )
    made = make_engine("mujoco", world, nworld)
    made.step(10)
    return made


def nan(*shape):
    return np.full(shape, np.nan)


ONE = np.array([1])
UP = (0.0, 0.0, 0.0, 1.0)


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (
            lambda e: e.links["ball::link"].set_motion((1e12, 0, 0), (0, 0, 0), ONE),
            "link 'ball::link' moved at 1e",
        ),
        (
            lambda e: e.joints["burger::wheel_left_joint"].set_velocity(1e13, ONE),
            "joint 'burger::wheel_left_joint' moved at 1e",
        ),
        (
            lambda e: e.links["ball::link"].set_wrench(nan(1, 3), np.zeros(3), ONE),
            "the force on link 'ball::link' was not finite",
        ),
        (
            lambda e: e.joints["burger::wheel_right_joint"].set_effort(nan(1, 1), ONE),
            "the effort on joint 'burger::wheel_right_joint' was not finite",
        ),
        (
            lambda e: e.links["ball::link"].set_motion(nan(1, 3), (0, 0, 0), ONE),
            "the velocity of link 'ball::link' was not finite",
        ),
    ],
)
def test_the_culprit_is_named(spoil, said):
    worlds = engine()
    spoil(worlds)
    with pytest.raises(DivergenceError, match=rf"1 of 3 worlds.*world 1, where {said}"):
        worlds.step(20)
    assert np.isfinite(worlds.snapshot()).all()
