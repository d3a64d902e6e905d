"""Rewards of the learner in place of the task's own."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
from corridor import MODES, Corridor

import gazelle.envs  # noqa: F401  # registers tasks
from gazelle.errors import TaskError
from gazelle.training.goal_reward import GoalReward, GoalRewards
from gazelle.training.stepper import Stepper
from gazelle.training.vecenv import VectorEnvAdapter

PAY = GoalReward(goal=3.0, collision=5.0, progress=2.0)


class Measured(Corridor):
    """A corridor that tells how far the goal is, in each of Gymnasium's modes."""

    def reset(self, *, seed=None, options=None):
        obs, info = super().reset(seed=seed, options=options)
        return obs, {**info, **_told(obs)}

    def step(self, actions):
        obs, reward, terminated, truncated, info = super().step(actions)
        if "final_info" in info:
            info["final_info"] |= _told(info["final_obs"])
            info |= {name: np.zeros(self.num_envs, bool) for name in ("is_success", "is_collision")}
        return obs, reward, terminated, truncated, {**info, **_told(obs)}


def _told(obs):
    return {"distance": np.abs(obs[:, 1].astype(float) - obs[:, 0])}


def moves(count, rounds):
    rng = np.random.default_rng(7)
    return [rng.integers(0, 3, count) for _ in range(rounds)]


@pytest.mark.parametrize("mode", MODES)
def test_goals_collisions_and_progress_are_paid_in_every_mode(mode):
    """The corridor's own reward is progress + goal - collision, so it is the oracle."""
    stepper = Stepper(Measured(8, mode=mode.value, limit=12), goal_reward=PAY)
    stepper.reset(seed=2)
    ended = {"is_success": 0, "is_collision": 0}
    for actions in moves(8, 400):
        step = stepper.step(actions)
        success, collision = np.zeros(8), np.zeros(8)
        if step.ended is not None:
            for name, array in (("is_success", success), ("is_collision", collision)):
                array[step.ended.slots] = step.ended.outcomes[name]
                ended[name] += int(array.sum())
        progress = step.rewards - success + collision
        np.testing.assert_allclose(
            step.taught, 2.0 * progress + 3.0 * success - 5.0 * collision, atol=1e-5
        )
        assert not step.taught[~step.valid].any()
    assert min(ended.values()) > 5


@pytest.mark.parametrize("mode", MODES)
def test_the_tasks_own_reward_can_be_paid_beside_it_in_every_mode(mode):
    pay = GoalReward(goal=3.0, collision=5.0, progress=2.0, own=0.25)
    alone, beside = (
        Stepper(Measured(8, mode=mode.value, limit=12), goal_reward=each) for each in (PAY, pay)
    )
    alone.reset(seed=2)
    beside.reset(seed=2)
    for actions in moves(8, 100):
        first, second = alone.step(actions), beside.step(actions)
        extra = 0.25 * np.where(second.valid, second.rewards, 0.0)
        np.testing.assert_allclose(second.taught, first.taught + extra)


class Unnamed(Measured):
    """As `Measured`, but ends beside the corridor are not called collisions."""

    def step(self, actions):
        obs, reward, terminated, truncated, info = super().step(actions)
        for told in (info, info.get("final_info", {})):
            if "is_collision" in told:
                told["is_collision"] = np.zeros(self.num_envs, bool)
        return obs, reward, terminated, truncated, info


@pytest.mark.parametrize("mode", MODES)
def test_an_end_that_is_neither_goal_nor_collision_has_its_own_price_in_every_mode(mode):
    named = Stepper(Measured(8, mode=mode.value, limit=12), goal_reward=PAY)
    pay = GoalReward(goal=3.0, collision=70.0, progress=2.0, other_end=5.0)
    unnamed = Stepper(Unnamed(8, mode=mode.value, limit=12), goal_reward=pay)
    named.reset(seed=2)
    unnamed.reset(seed=2)
    dear = 0
    for actions in moves(8, 400):
        expected = named.step(actions).taught
        np.testing.assert_array_equal(unnamed.step(actions).taught, expected)
        dear += int((expected < -4.0).sum())
    assert dear > 5


def test_without_one_the_learner_is_given_the_tasks_own():
    stepper = Stepper(Measured(4))
    stepper.reset(seed=0)
    for actions in moves(4, 20):
        step = stepper.step(actions)
        np.testing.assert_array_equal(step.taught, step.rewards)


def test_the_way_to_the_next_goal_is_not_taken_for_going_back():
    env = gym.make_vec(
        "gazelle/TurtleBot3Stage1-v0",
        32,
        vectorization_mode="vector_entry_point",
        engine="planar",
        goals="training",
        starts="training",
    )
    stepper = Stepper(env, goal_reward=GoalReward(goal=10.0, collision=0.0, progress=1.0))
    obs = stepper.reset(seed=0)
    goals = 0
    for _ in range(150):
        step = stepper.step(np.where(obs[:, 24] > 0.3, 0, np.where(obs[:, 24] < -0.3, 4, 2)))
        obs = step.obs
        # 0.15 m/s for 0.2 s, and a hundredth of rounding.
        rest = step.taught - 10.0 * (step.taught > 5.0)
        goals += int((step.taught > 5.0).sum())
        assert np.abs(rest).max() < 0.03 + 0.011
    assert goals > 30
    env.close()


def test_a_saved_stepper_goes_on_alike():
    env = Measured(4)
    stepper = Stepper(env, goal_reward=PAY)
    stepper.reset(seed=0)
    for actions in moves(4, 9):
        stepper.step(actions)
    kept = stepper.get_state(), env.get_state()
    first = [stepper.step(actions).taught for actions in moves(4, 9)]
    twin = Measured(4)
    again = Stepper(twin, goal_reward=PAY)
    again.set_state(kept[0])
    twin.set_state(kept[1])
    np.testing.assert_array_equal(first, [again.step(actions).taught for actions in moves(4, 9)])


@pytest.mark.parametrize("count", [0, 1, 3, 5000])
def test_a_state_of_another_number_of_copies_is_refused(count):
    stepper = Stepper(Measured(4), goal_reward=PAY)
    stepper.reset(seed=0)
    state = stepper.get_state()
    for name, array in state.items():
        other = np.zeros((count, *array.shape[1:]), array.dtype)
        with pytest.raises(ValueError, match=f"'{name}' has the shape"):
            stepper.set_state(state | {name: other})


def test_reports_keep_the_tasks_reward_and_learners_get_the_other():
    paid, told = [], []
    for pay in (PAY, None):
        ended = []
        adapter = VectorEnvAdapter(
            Measured(4, limit=5), reward_scale=0.5, goal_reward=pay, on_episodes=ended.append
        )
        adapter.seed(3)
        adapter.reset()
        paid.append(sum(adapter.step(actions)[1] for actions in moves(4, 12)))
        told.append(np.concatenate([each.returns for each in ended]).tolist())
    assert not np.allclose(paid[0], paid[1])
    assert told[0] == told[1]
    assert len(told[0]) >= 8


def test_a_task_that_tells_no_distance_is_one_clear_error():
    with pytest.raises(TaskError, match=r"goal_reward needs info\['distance'\]"):
        Stepper(Corridor(4), goal_reward=PAY).reset(seed=0)


def test_points_on_the_way_are_paid_for_and_the_next_one_is_approached_from_there():
    """Two copies: one passes a point, then its goal; the other only drives."""
    teacher = GoalRewards(GoalReward(goal=7.0, progress=2.0, waypoint=3.0), 2)
    none = np.zeros(2, bool)
    teacher.begin(_way([4.0, 5.0], [0, 0]), ~none)
    slots = np.zeros(0, np.intp)
    taught = [
        teacher.of_step(_way(distance, points, success), None, slots, none, ~none)
        for distance, points, success in (
            ([3.0, 4.5], [0, 0], none),
            ([2.5, 4.0], [1, 0], none),  # the point is reached; the distance is still to it
            ([9.0, 3.5], [1, 0], none),  # to the next one: nothing can be said of this step
            ([8.0, 3.0], [1, 0], none),
            ([7.5, 3.0], [2, 0], np.array([True, False])),
        )
    ]
    np.testing.assert_allclose(taught, [[2, 1], [4, 1], [0, 1], [2, 1], [11, 0]])
    resumed = GoalRewards(teacher.pay, 2)
    resumed.set_state(teacher.get_state())
    assert resumed.waypoints.tolist() == [2.0, 0.0]
    teacher.begin(_way([6.0, 1.0], [0, 0]), np.array([True, False]))
    assert teacher.waypoints.tolist() == [0.0, 0.0]
    np.testing.assert_array_equal(teacher.distance, [6.0, 3.0])


def _way(distance, points, success=(False, False)):
    return {
        "distance": np.array(distance),
        "waypoints": np.array(points),
        "is_success": np.array(success),
        "is_collision": np.zeros(2, bool),
    }


def test_points_of_the_kobukis_way_are_told_and_paid_for():
    """Put in front of a point of its way, and driven over it, it is paid for that once."""
    env = gym.make_vec(
        "gazelle/KobukiMaze-v0",
        num_envs=2,
        vectorization_mode="vector_entry_point",
        engine="planar",
    )
    stepper = Stepper(env, goal_reward=GoalReward(collision=0.0, progress=0.0, waypoint=3.0))
    stepper.reset(seed=0)
    task = env.unwrapped.task
    task.robot.set_pose(np.tile((-8.5, 0.9, 0.0), (2, 1)), yaw=np.full(2, -np.pi / 2.0))
    taught = sum(stepper.step(np.array([[1.0, 0.0], [0.0, 0.0]])).taught for _ in range(6))
    env.close()
    np.testing.assert_array_equal(taught, [3.0, 0.0])
