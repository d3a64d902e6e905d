"""The way between the buoys: the rules of openai_ros' task by hand, natively and on a graph."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from hypothesis import strategies as st

from gazelle import assets, formats
from gazelle.envs.wamv.rules import ChannelRules, outside, reached, reward_of
from gazelle.envs.wamv.task import WamvSettings, WamvTask, squares
from gazelle.errors import TaskError

ID = "gazelle/WamvBuoys-v0"
RULES = ChannelRules()
COARSE = {"time_step": 0.04}  # enough where only rules are looked at
tenths = st.integers(-100, 360).map(lambda each: each / 10)


def begun(nworld=1, **options):
    task = WamvTask(nworld, WamvSettings(**{**COARSE, **options}))
    task.seed(0)
    task.begin(np.arange(nworld))
    return task


def test_gymnasiums_checker_finds_nothing():
    env = gym.make(ID, **COARSE)
    check_env(env.unwrapped, skip_render_check=True)
    env.close()


def test_the_vessel_weighs_and_turns_as_published():
    (link,) = formats.load_model(assets.robot("wamv")).links
    inertia = link.inertial.inertia
    assert link.inertial.mass == 180.0
    assert (inertia.ixx, inertia.iyy, inertia.izz) == (120.0, 393.0, 446.0)


@pytest.mark.parametrize(
    ("x", "y", "over", "success"),
    [
        (0.0, 0.0, False, False),
        (29.6, 0.0, True, True),
        (30.5, 0.5, True, True),  # beyond the work space, and at the goal
        (29.5, 0.0, False, False),
        (30.1, 0.6, True, False),
        (30.0, 4.9, False, False),
        (-1.0, 0.0, True, False),
        (5.0, 5.1, True, False),
        (5.0, -5.0, True, False),
    ],
)
def test_ends_are_the_published_ones(x, y, over, success):
    place = np.array([[x, y]])
    assert (reached(RULES, place) | outside(RULES, place))[0] == over
    assert reached(RULES, place)[0] == success
    for closer in (False, True):
        reward = reward_of(
            RULES, over=np.array([over]), success=np.array([success]), closer=np.array([closer])
        )[0]
        wanted = (1000.0 if success else -1000.0) if over else (100.0 if closer else -100.0)
        assert reward == wanted


def test_actions_turn_and_push():
    task = begun(4)
    task.advance(np.arange(4))
    motion = task.robot.motion()
    assert motion.linear[0, 0] > 1.5
    assert motion.linear[1, 0] < -0.5
    assert motion.angular[2, 2] > 0.5
    assert motion.angular[3, 2] < -0.5


def test_it_floats_at_rest_when_an_episode_begins():
    task = begun(2)
    observation, info = task.begin(np.array([1]))
    # 0.08 m below the water, seen from a goal 1 m above it.
    assert observation[0].tolist() == pytest.approx([0.0] * 8 + [30.0], abs=1e-6)
    assert info["distance"][0] == pytest.approx(30.0)
    assert task.memory["distance"][0] == pytest.approx(np.hypot(30.0, 1.0))


def test_starts_of_training_and_evaluation_are_apart():
    trained, held_out = squares(held_out=False), squares(held_out=True)
    assert not {tuple(each) for each in trained} & {tuple(each) for each in held_out}
    task = begun(64, starts="held-out")
    start = task.memory["start"]
    near = np.abs(start[:, None, :2] - held_out).max(axis=2)
    assert (near.min(axis=1) <= 0.4 + 1e-12).all()
    assert len(np.unique(start[:, 2])) == 64
    with pytest.raises(TaskError, match="starts"):
        WamvSettings(starts="anywhere")


def test_equal_seeds_give_equal_ways_whoever_else_goes():
    def gone(nworld):
        task = begun(nworld, starts="training")
        return np.array(
            [task.step(np.full(nworld, each)).transition.observation[:2] for each in (0, 2)]
        )

    first = gone(3)
    np.testing.assert_array_equal(first, gone(3))
    np.testing.assert_array_equal(first, gone(2))
