from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
from corridor import MODES, PERIOD

from gazelle.errors import TaskError
from gazelle.training import Actor, evaluate
from gazelle.training.copies import TaskCopies
from gazelle.training.tasks import make_task
from gazelle.training.workers.shards import Shard, ShardSpec


def actor(gain=0.0, bias=(0.0, 0.0, 0.0)):
    """Return an actor towards the goal with a gain, or the same way with a bias."""
    weight = np.array([[gain, 0, -gain], [-gain, 0, gain], [0, 0, 0]], dtype=np.float32)
    return Actor((weight,), (np.array(bias, dtype=np.float32),), "tanh", "categorical")


TASK = "test/Corridor-v0"
RIGHT = actor(bias=(0.0, 0.0, 1.0))


@pytest.mark.parametrize("mode", MODES)
def test_all_modes_find_the_same_rates(mode):
    found = evaluate(actor(gain=1.0), task=TASK, episodes=60, mode=mode.value)
    assert found.success.count == 60
    assert found.collision.count == found.timeout.count == 0


@pytest.mark.parametrize("copies", [1, 7, 50])
def test_short_episodes_are_not_favoured(copies):
    """Rightwards, a goal ahead is met and a goal behind is a collision: half and half.

    Counting whatever ends first would prefer copies whose episodes are short.
    """
    found = evaluate(RIGHT, task=TASK, episodes=400, num_envs=copies)
    assert found.success.total == found.collision.total == 400
    assert found.success.count + found.collision.count + found.timeout.count == 400
    assert found.success.value == pytest.approx(0.5, abs=0.08)
    assert found.mean_length == pytest.approx(9, abs=3)


def test_same_seed_same_result():
    first, second = (evaluate(RIGHT, task=TASK, episodes=50, seed=3).to_dict() for _ in range(2))
    for result in (first, second):
        del result["wall_seconds"], result["rtf"]
    assert first == second


def test_time_is_told():
    found = evaluate(actor(bias=(0.0, 1.0, 0.0)), task=TASK, episodes=10, limit=20)
    assert found.mean_length > 15
    assert found.sim_seconds == pytest.approx(20 * 10 * PERIOD)
    assert found.rtf == pytest.approx(found.sim_seconds / found.wall_seconds)


def test_a_task_that_tells_no_outcome_still_counts_time_outs():
    found = evaluate(actor(bias=(0.0, 1.0, 0.0)), task=TASK, episodes=10, tell=False)
    assert found.success is None
    assert found.collision is None
    assert found.timeout.count >= 8
    assert found.to_dict()["success"] is None


def test_a_policy_file_needs_a_task(tmp_path):
    RIGHT.save(tmp_path / "policy.npz")
    with pytest.raises(TaskError, match="does not name its task"):
        evaluate(tmp_path / "policy.npz")
    assert evaluate(tmp_path / "policy.npz", task=TASK, episodes=5).episodes == 5


def test_a_policy_of_another_shape_is_refused():
    weight = np.zeros((26, 3), dtype=np.float32)
    wide = Actor((weight,), (np.zeros(3, dtype=np.float32),), "tanh", "categorical")
    with pytest.raises(TaskError, match="takes 26 observations, the task gives 3"):
        evaluate(wide, task=TASK)


@pytest.mark.parametrize("given", [{"episodes": 0}, {"num_envs": 0}])
def test_nothing_to_do_is_refused(given):
    with pytest.raises(TaskError, match="at least 1"):
        evaluate(RIGHT, task=TASK, **given)


@pytest.mark.long
def test_evaluation_works_without_torch():
    import subprocess
    import sys

    code = "import sys, gazelle.training; gazelle.training.evaluate; print('torch' in sys.modules)"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "False"


class Dice(gym.Env):
    """Ends at once, as one of ``sides`` episodes has it: a user's own task, of the plainest kind."""

    observation_space = gym.spaces.Box(-(2.0**21), 2.0**21, (1,), np.float32)
    action_space = gym.spaces.Discrete(2)

    def __init__(self, sides=5, tell=True, good=3, noise=0.0):
        self.sides, self.tell, self.good, self.noise = sides, tell, good, noise

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        self.side = int(self.np_random.integers(self.sides))
        info = {"scenario": [self.side, 7.0]} if self.tell else {}
        return self.look(), info

    def step(self, action):
        success = self.side < self.good
        ends = {"is_success": success, "is_collision": not success, "goal": np.ones(2)}
        return self.look(), float(success), True, False, ends

    def look(self):
        noise = self.noise * self.np_random.standard_normal()
        return np.array([self.side + noise], np.float32)


class Choosy(Dice):
    """Is to be evaluated on more sides than it is trained on."""

    @classmethod
    def evaluation_options(cls, trained):
        return {"sides": trained.get("sides", 5) + 4}


for _name, _kind in (("Dice", Dice), ("Choosy", Choosy)):
    if f"test/{_name}-v0" not in gym.registry:
        gym.register(f"test/{_name}-v0", entry_point=_kind, max_episode_steps=10)

ONLY = Actor(
    (np.zeros((1, 2), np.float32),), (np.array([1.0, 0.0], np.float32),), "tanh", "categorical"
)


@pytest.mark.parametrize("noise", [0.0, 0.01])
@pytest.mark.parametrize("num_envs", [1, 7, 128])
def test_repeated_episodes_count_once_in_the_interval(num_envs, noise):
    found = evaluate(ONLY, task="test/Dice-v0", episodes=300, num_envs=num_envs, noise=noise)
    assert (found.episodes, found.distinct, found.success.total) == (300, 5, 300)
    low, high = found.success.interval
    assert low < 0.3
    assert high > 0.8
    assert found.to_dict()["distinct"] == 5


def test_without_a_word_equal_trails_are_the_same_episode():
    assert evaluate(ONLY, task="test/Dice-v0", episodes=300, tell=False).distinct == 5
    noisy = evaluate(ONLY, task="test/Dice-v0", episodes=300, tell=False, noise=0.01)
    assert noisy.distinct == 300
    assert evaluate(RIGHT, task=TASK, episodes=200).distinct == 200


def test_a_task_says_how_it_is_evaluated():
    assert evaluate(ONLY, task="test/Choosy-v0", episodes=400).distinct == 9
    assert evaluate(ONLY, task="test/Choosy-v0", episodes=400, sides=2).distinct == 2


def test_failures_are_told_one_by_one():
    found = evaluate(ONLY, task="test/Dice-v0", episodes=200)
    assert len(found.failures) == found.collision.count
    for record in found.failures:
        row = record.to_row()
        assert row["outcome"] == "collision"
        assert row["scenario_0"] >= 3
        assert (row["goal_x"], row["goal_y"], row["length"]) == (1.0, 1.0, 1)


def turn(size, action):
    """Return always the same of five actions."""
    bias = np.zeros(5, np.float32)
    bias[action] = 1.0
    return Actor((np.zeros((size, 5), np.float32),), (bias,), "tanh", "categorical")


def shares(found):
    return [found.success.value, found.collision.value, found.timeout.value, found.other.value]


@pytest.mark.long
@pytest.mark.parametrize("engine", ["planar", "mujoco"])
@pytest.mark.parametrize("respawn", [True, False])
@pytest.mark.parametrize("action", [0, 2])
def test_shares_add_up(engine, respawn, action):
    """Circling for ever is a time-out, straight on meets some goals and then a wall."""
    found = evaluate(
        turn(26, action),
        task="TurtleBot3Stage1",
        episodes=64,
        engine=engine,
        respawn=respawn,
        max_episode_steps=120,
    )
    assert sum(shares(found)) == pytest.approx(1.0)
    assert found.distinct == 64
    if action == 2:
        assert found.collision.value > 0.5
        assert found.success.value > 0.0
    else:
        assert found.timeout.value > 0.8


@pytest.mark.parametrize("engine", ["planar", "mujoco"])
def test_a_policy_that_always_arrives_succeeds_always(engine):
    """The next goal ahead: goals on a line, and time runs out on the way to one more."""
    found = evaluate(
        turn(26, 2),
        task="TurtleBot3Stage1",
        episodes=10,
        engine=engine,
        respawn=True,
        starts="published",
        goals=[(0.6, 0.0), (0.9, 0.0)],
        max_episode_steps=30,
    )
    assert shares(found) == [1.0, 0.0, 0.0, 0.0]
    assert found.success.total == found.success.count >= 10
    assert found.distinct == 1


@pytest.mark.long
def test_the_published_list_is_thirteen_episodes():
    given = {"task": "TurtleBot3Stage4", "engine": "planar", "respawn": False}
    published = evaluate(turn(28, 2), episodes=300, goals="published", starts="published", **given)
    assert published.distinct == 13
    fresh = evaluate(turn(28, 2), episodes=300, **given)
    assert fresh.distinct == 300
    assert published.floor_plan is not None
    narrow, wide = (np.ptp(found.collision.interval) for found in (fresh, published))
    assert wide > 3 * narrow


@pytest.mark.parametrize("episodes", [4, 20, 100])
def test_the_fleet_is_evaluated_in_any_number(episodes):
    weight = np.zeros((28, 2), np.float32)
    weight[25, 1] = 1.5
    actor = Actor((weight,), (np.array([0.6, 0.0], np.float32),), "tanh", "gaussian",
                  low=np.full(2, -1.0, np.float32), high=np.full(2, 1.0, np.float32))  # fmt: skip
    found = evaluate(actor, task="AGVFleet", episodes=episodes, max_episode_steps=200)
    assert found.episodes == found.distinct == -(-episodes // 8) * 8  # of each AGV of a hall
    assert sum(shares(found)) == pytest.approx(1.0)
    assert found.success.value > 0.1
    assert found.collision.count > 0
    assert found.success.total > episodes


def drawn_by_trainings(seed, **options):
    """Return the starts of a training's copies of the task: alone, and in two shards."""
    blueprint = ShardSpec(task="test/Dice-v0", sizes=(8, 8), options=options)
    plain = TaskCopies(make_task("test/Dice-v0", 16, **options)).reset(seed)
    shards = [Shard(blueprint, number).reset(seed) for number in range(2)]
    return set(np.concatenate([plain, *shards]).ravel().tolist())


@pytest.mark.parametrize(
    ("workers", "seed"),
    [
        *((None, seed) for seed in (0, 7, 10_000, 2**32 - 1)),
        pytest.param(1, 7, marks=pytest.mark.long),
    ],
)
def test_no_episode_of_a_training_is_drawn_again_by_an_evaluation(workers, seed):
    many = {"sides": 2**20, "good": 0}
    given = {"task": "test/Dice-v0", "imports": [__file__], "seed": seed, "workers": workers}
    found = evaluate(ONLY, episodes=48, num_envs=16, **given, **many)
    drawn = {record.to_row()["scenario_0"] for record in found.failures}
    assert len(drawn) > 40
    assert not drawn & drawn_by_trainings(seed, **many)


def test_a_negative_seed_is_refused():
    with pytest.raises(TaskError, match="seed must not be negative: -1"):
        evaluate(ONLY, task="test/Dice-v0", seed=-1)
