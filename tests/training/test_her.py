"""Hindsight replay: goals of the same episode's future, their rewards, and trainings with it."""

import csv
import dataclasses
import os
import signal
import subprocess
import sys
from pathlib import Path

import gymnasium as gym
import numpy as np
import pytest
import slider_task

from gazelle.envs.dict_rows import ACHIEVED, DESIRED
from gazelle.errors import TaskError
from gazelle.training import (
    GoalReward,
    LibrarySettings,
    OffPolicySettings,
    Recipe,
    evaluate,
    export_policy,
    load_actor,
    resume,
    train,
)
from gazelle.training.learners.her import HindsightReplayBuffer
from gazelle.training.progress import NoProgress
from gazelle.training.vecenv import VectorEnvAdapter

SMALL = OffPolicySettings(buffer_size=2000, batch_size=32, learning_starts=100)
WALK = 7


class Walk(gym.vector.VectorEnv):
    """Each copy counts its steps in all (from 10,000 times its number), and ends when it likes."""

    def __init__(self, copies, mode, seed):
        self.num_envs, self.mode = copies, mode
        self.metadata = {"autoreset_mode": gym.vector.AutoresetMode(mode)}
        part = gym.spaces.Box(-np.inf, np.inf, (1,), np.float32)
        names = "observation", ACHIEVED, DESIRED
        self.single_observation_space = gym.spaces.Dict(dict.fromkeys(names, part))
        self.single_action_space = gym.spaces.Box(-1, 1, (1,), np.float32)
        self.count = 10_000.0 * np.arange(copies)
        self.goal, self.over = np.zeros(copies), np.zeros(copies, bool)
        self.rng = np.random.default_rng(seed)

    def obs(self):
        parts = {"observation": self.goal, ACHIEVED: self.count, DESIRED: self.goal}
        return {key: part[:, None].astype(np.float32) for key, part in parts.items()}

    def begin(self, where):
        # A gap, so that the end of an episode and the start of the next differ by 10.
        self.count[where] += 10.0
        self.goal[where] = -self.count[where]

    def reset(self, *, seed=None, options=None):
        self.begin((options or {}).get("reset_mask", np.ones(self.num_envs, bool)))
        return self.obs(), {}

    def step(self, actions):
        idle = self.over if self.mode == "NextStep" else np.zeros(self.num_envs, bool)
        self.begin(idle)
        self.count += ~idle
        done = ~idle & (self.rng.random(self.num_envs) < 0.15)
        self.over, info, last = done, {}, self.obs()
        if self.mode == "SameStep" and done.any():
            rows = [{key: part[i] for key, part in last.items()} for i in range(self.num_envs)]
            info = {"final_obs": np.array(rows, object), "final_info": {}}
            self.begin(done)
        nothing = np.zeros(self.num_envs, bool)
        return self.obs(), np.full(self.num_envs, WALK, float), done, nothing, info

    def compute_reward(self, achieved, desired, info):
        assert len(info) == len(achieved)
        return (desired - achieved)[:, 0]


def filled(mode, steps, copies=3, share=0.8, rows=40, seed=0, redraw=0.0, **several):
    adapter = VectorEnvAdapter(Walk(copies, mode, seed))
    memory = HindsightReplayBuffer(
        rows * copies,
        adapter.observation_space,
        adapter.action_space,
        device="cpu",
        n_envs=copies,
        goals=adapter.goal_replay,
        share=share,
        redraw=redraw,
        reward_scale=2.0,
        **several,
    )
    obs = adapter.reset()
    for _ in range(steps):
        after, rewards, dones, infos = adapter.step(np.zeros((copies, 1)))
        following = after.copy()
        for slot in np.flatnonzero(dones):
            following[slot] = infos[slot]["terminal_observation"]
        memory.add(obs, following, np.zeros((copies, 1)), rewards, dones, infos)
        obs = after
    return memory


@pytest.mark.parametrize("mode", ["SameStep", "NextStep", "Disabled"])
@pytest.mark.parametrize("steps", [5, 37, 40, 41, 95, 400])
def test_goals_come_from_the_future_of_the_same_episode(mode, steps):
    memory = filled(mode, steps)
    place = memory._goals
    batch = memory.sample(500)
    before, after = batch.observations.numpy(), batch.next_observations.numpy()
    virtual = np.arange(500) < 400
    goal = before[:, place.desired][:, 0]
    np.testing.assert_array_equal(goal, after[:, place.desired][:, 0])
    reached = after[:, place.achieved][:, 0]
    np.testing.assert_array_equal(reached - before[:, place.achieved][:, 0], 1.0)
    ahead = (goal - reached)[virtual]
    assert (ahead >= 0.0).all()
    assert (goal[~virtual] < 0.0).all()  # as it was
    assert (ahead == 0.0).any()
    assert (ahead > 3.0).any()
    rewards = batch.rewards.numpy()[:, 0]
    np.testing.assert_array_equal(rewards[virtual], 2.0 * ahead)
    np.testing.assert_array_equal(rewards[~virtual], WALK)
    # Of the same episode: there is no gap of 10 in between.
    counts = memory.next_observations[:, :, place.achieved][..., 0]
    for start, end in zip(reached[virtual], goal[virtual], strict=True):
        slot = int(start // 10_000)
        assert np.isin(np.arange(start, end + 1), counts[:, slot]).all()


def test_rewards_of_several_steps_are_those_of_the_other_goal():
    memory = filled("SameStep", 95, n_steps=3, gamma=0.5)
    place = memory._goals
    batch = memory.sample(500)
    before = batch.observations.numpy()[:, place.achieved][:, 0]
    steps = batch.next_observations.numpy()[:, place.achieved][:, 0] - before
    assert set(steps) == {1.0, 2.0, 3.0}
    np.testing.assert_array_equal(batch.discounts.numpy()[:, 0], 0.5**steps)
    goal = batch.observations.numpy()[:, place.desired][:, 0]
    after = np.arange(3)
    weights = 0.5**after * (after < steps[:, None])
    virtual = np.arange(500) < 400
    wanted = np.where(virtual[:, None], 2.0 * (goal - before - 1.0)[:, None] - 2.0 * after, WALK)
    np.testing.assert_allclose(batch.rewards.numpy()[:, 0], (weights * wanted).sum(axis=1))


def test_every_later_step_is_as_likely():
    memory = filled("SameStep", 40, copies=1, rows=60, seed=8)
    place = memory._goals
    ends = np.flatnonzero(memory.dones[:40, 0])
    start, end = ends[0] + 1, ends[1]
    assert end - start >= 3
    rows, slots = np.full(60_000, start), np.zeros(60_000, np.intp)
    later = memory._later(rows, slots) - start
    shares = np.bincount(later, minlength=end - start + 1) / len(rows)
    np.testing.assert_allclose(shares, 1.0 / (end - start + 1), atol=0.01)
    assert place.achieved != place.desired


class Doorstep(Walk):
    """What is reached changes with the 10th step of the second copy alone."""

    def obs(self):
        parts = super().obs()
        parts[ACHIEVED] = np.float32((np.arange(self.num_envs) == 1) & (self.count % 1000 > 20))[
            :, None
        ]
        return parts

    def compute_reward(self, achieved, desired, info):
        return np.where(np.abs(desired - achieved)[:, 0] < 0.5, 0.0, -1.0)


@pytest.mark.parametrize("redraw", [0.0, 0.5, 1.0])
def test_steps_from_where_the_goal_is_reached_are_drawn_again(monkeypatch, redraw):
    monkeypatch.setitem(globals(), "Walk", Doorstep)
    memory = filled("SameStep", 30, redraw=redraw, seed=2)
    place, idle = memory._goals, []
    for _ in range(40):
        batch = memory.sample(500)
        before, after = batch.observations.numpy()[:400], batch.next_observations.numpy()[:400]
        goal = before[:, place.desired]
        assert (goal == after[:, place.desired]).all()
        reached = (goal == after[:, place.achieved])[:, 0]
        np.testing.assert_array_equal(batch.rewards.numpy()[:400, 0], np.where(reached, 0, -2))
        idle.append((goal == before[:, place.achieved]).mean())
    first = np.mean(idle)
    # Twice drawn again: what was idle with share s still is with s (1 - r) + r s (s (1 - r) + r s s).
    plain = 1.0 - np.mean([_moving(memory) for _ in range(40)])
    wanted = plain
    for _ in range(2):
        wanted = plain * (1.0 - redraw) + plain * redraw * wanted
    assert first == pytest.approx(wanted, abs=0.02)


def _moving(memory):
    rows, slots = memory._draw(1000)
    later = memory._later(rows, slots)
    achieved = memory._goals.achieved
    before = memory.observations[rows, slots][:, achieved]
    return (memory._achieved(later, slots) != before).mean()


def test_the_share_is_kept_and_none_is_the_plain_memory():
    plain = filled("SameStep", 60, share=0.0)
    assert (plain.sample(200).rewards.numpy() == WALK).all()
    everything = filled("SameStep", 60, share=1.0)
    assert (everything.sample(200).rewards.numpy() != WALK).any()


def test_the_memory_comes_back_from_its_state():
    memory, other = filled("SameStep", 130), filled("SameStep", 5, seed=3)
    other.set_state(memory.get_state())
    batches = []
    for each in (memory, other):
        np.random.seed(0)  # noqa: NPY002  # the memory draws from the global generator
        batches.append(each.sample(64))
    for left, right in zip(batches[0][:5], batches[1][:5], strict=True):
        np.testing.assert_array_equal(left.numpy(), right.numpy())


def recipe(algo, **changes):
    settings = SMALL
    if algo == "tqc":
        settings = LibrarySettings(options={"learning_starts": 100, "batch_size": 32})
    base = Recipe(algo=algo, steps=600, num_envs=4, net_arch=(16,), settings=settings)
    return dataclasses.replace(base, **changes)


def curves(run):
    with (run.folder / "progress.csv").open() as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        del row["time/seconds"], row["time/steps_per_second"]
    return rows


class StopAt(NoProgress):
    def __init__(self, steps):
        self.steps = steps

    def update(self, done, summary):
        if done >= self.steps:
            self.steps = float("inf")
            os.kill(os.getpid(), signal.SIGINT)


MORE = {
    "hindsight_redraw": 0.9,
    "goal_differences": True,
    "settings": dataclasses.replace(
        SMALL, random_actions=0.3, action_penalty=1.0, bound_values=True, bfloat16=True
    ),
}


@pytest.mark.long
@pytest.mark.parametrize(
    ("algo", "more"),
    [("ddpg", {}), ("ddpg", MORE), ("sac", {}), ("td3", {}), ("td3", MORE), ("tqc", {})],
    ids=["ddpg", "ddpg and more", "sac", "td3", "td3 and more", "tqc"],
)
def test_every_algorithm_learns_from_it_and_resumes_with_the_same_bits(tmp_path, algo, more):
    pytest.importorskip("sb3_contrib")
    given = {"recipe": recipe(algo, **more), "seed": 5}
    whole = train("test/Slider-v0", out=tmp_path / "whole", **given)
    first = train("test/Slider-v0", out=tmp_path / "cut", progress=StopAt(300), **given)
    assert first.interrupted
    second = resume(first.run.folder)
    assert curves(second.run) == curves(whole.run)
    ours, theirs = (load_actor(each.run.policy_file()) for each in (second, whole))
    for left, right in zip(ours.weights, theirs.weights, strict=True):
        np.testing.assert_array_equal(left, right)


@pytest.mark.long
def test_a_policy_is_evaluated_and_exported(tmp_path):
    result = train("test/Slider-v0", recipe=recipe("td3"), out=tmp_path)
    found = evaluate(result.run.folder, episodes=12)
    assert found.success.total == 12
    files = export_policy(result.run.folder, "numpy")
    actor, env = load_actor(files.policy), slider_task.SliderEnv()
    obs, _ = env.reset(seed=0)
    row = gym.spaces.flatten(env.observation_space, obs)
    assert env.action_space.contains(actor.act(row[None])[0])
    names = [part["name"] for part in env.contract.to_dict()["observation"]]
    assert names == ["achieved_goal", "desired_goal", "observation"]
    env.close()


@pytest.mark.long
def test_an_environment_without_a_vector_version_and_workers_learn_too(tmp_path):
    train("test/SingleSlider-v0", recipe=recipe("sac", steps=300, num_envs=2), out=tmp_path)


def test_success_is_being_there_in_the_end(tmp_path):
    """An episode that passes its goal and goes on has failed once, not succeeded and failed."""
    result = train("test/Slider-v0", recipe=recipe("ddpg", steps=200), out=tmp_path)
    found = evaluate(result.run.folder, episodes=40)
    for record in found.records:
        assert record.goals + sum(record.ends) == 1


def test_another_pay_is_refused_unless_hindsight_is_off(tmp_path):
    paid = recipe("td3", goal_reward=GoalReward(), steps=150)
    with pytest.raises(TaskError, match="goal_reward cannot be worked out"):
        train("test/Slider-v0", recipe=paid, out=tmp_path)
    with pytest.raises(TaskError, match="hindsight must be between"):
        dataclasses.replace(paid, hindsight=1.5)


@pytest.mark.slow
def test_it_learns_what_plain_replay_does_not(tmp_path):
    """Goals within 0.1 m are hardly met by chance: half of a square metre, twenty steps."""
    rates = {}
    settings = OffPolicySettings(batch_size=128, learning_starts=400, gradient_steps=4, tau=0.02)
    for share in (0.0, 0.8):
        given = recipe("td3", steps=12_000, num_envs=16, net_arch=(64, 64), settings=settings)
        changes = {"learning_rate": 1e-3, "learning_rate_decay": False, "activation": "relu"}
        given = dataclasses.replace(given, hindsight=share, gamma=0.95, **changes)
        result = train("test/Slider-v0", recipe=given, out=tmp_path, seed=1)
        rates[share] = evaluate(result.run.folder, episodes=100).success.value
    assert rates[0.8] > 0.95  # 1.00
    assert rates[0.0] < 0.7  # 0.34


KILLED = """
import os, signal, sys
sys.path.insert(0, sys.argv[1])
import slider_task
from pathlib import Path
from gazelle.training import Run, train
from gazelle.training.progress import NoProgress

class KillAt(NoProgress):
    def update(self, done, summary):
        if done >= 450:
            os.kill(os.getpid(), signal.SIGKILL)

config = Run.open(Path(sys.argv[2])).config
train(config.task, recipe=config.recipe, seed=5, checkpoint_every=200, out=sys.argv[3], progress=KillAt())
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")
def test_a_killed_run_goes_on_with_the_same_bits(tmp_path):
    given = {"recipe": recipe("sac"), "seed": 5, "checkpoint_every": 200}
    whole = train("test/Slider-v0", out=tmp_path / "whole", **given)
    here = str(Path(slider_task.__file__).parent)
    out = tmp_path / "killed"
    command = [sys.executable, "-c", KILLED, here, str(whole.run.folder), str(out)]
    assert subprocess.run(command, check=False, timeout=300).returncode == -signal.SIGKILL
    (folder,) = out.iterdir()
    again = resume(folder)
    assert curves(again.run) == curves(whole.run)
    ours, theirs = (load_actor(each.run.policy_file()) for each in (again, whole))
    for left, right in zip(ours.weights, theirs.weights, strict=True):
        np.testing.assert_array_equal(left, right)


@pytest.mark.slow
def test_any_number_of_workers_gives_the_same_policy(tmp_path):
    given = {"recipe": recipe("td3", num_envs=16), "seed": 5, "imports": [slider_task.__file__]}
    runs = [
        train("test/Slider-v0", out=tmp_path / str(count), workers=count, **given).run
        for count in (1, 2)
    ]
    left, right = (load_actor(run.policy_file()).weights for run in runs)
    for one, other in zip(left, right, strict=True):
        np.testing.assert_array_equal(one, other)
