"""Training, stopping and resuming as a whole."""

from __future__ import annotations

import csv
import dataclasses
import itertools
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import torch
from tensorboard.backend.event_processing.event_file_loader import EventFileLoader

from gazelle.errors import FormatError, MissingExtraError, SimulationWarning, TaskError
from gazelle.training import GoalReward, OffPolicySettings, Recipe, Run, evaluate, resume, train
from gazelle.training.supported_values import supported_only
from tests.training.interrupting import StopAt, weights

SMALL = OffPolicySettings(
    buffer_size=2000, batch_size=32, learning_starts=100, target_update_interval=100
)


def off_policy(algo):
    settings = supported_only(algo, SMALL)
    return Recipe(algo=algo, steps=320, num_envs=4, net_arch=(16,), settings=settings)


def curves(result):
    with (result.run.folder / "progress.csv").open() as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        del row["time/seconds"], row["time/steps_per_second"]
    return rows


CASES = [
    ("ppo", "SameStep", False),
    ("ahead", "SameStep", False),
    ("ahead", "NextStep", True),
    ("ppo", "NextStep", True),
    ("ppo", "Disabled", False),
    ("scaled", "SameStep", False),
    pytest.param("dqn", "SameStep", False, marks=pytest.mark.long),
    pytest.param("sac", "NextStep", True, marks=pytest.mark.long),
    pytest.param("td3", "SameStep", True, marks=pytest.mark.long),
    pytest.param("ddpg", "SameStep", True, marks=pytest.mark.long),
]


@pytest.mark.parametrize("bound", [1.2, 1000.0])  # with the second all entries are normalised
@pytest.mark.parametrize(("algo", "mode", "continuous"), CASES)
def test_an_interrupted_and_resumed_run_equals_an_uninterrupted_one(
    tmp_path, tiny, algo, mode, continuous, bound
):
    ahead = dataclasses.replace(tiny, settings=dataclasses.replace(tiny.settings, overlap=True))
    scaled = dataclasses.replace(
        tiny, settings=dataclasses.replace(tiny.settings, scale_rewards=True)
    )
    own = {"ppo": tiny, "ahead": ahead, "scaled": scaled}
    recipe = own.get(algo) or off_policy(algo)
    given = {"recipe": recipe, "seed": 5, "mode": mode, "continuous": continuous, "bound": bound}
    whole = train("test/Corridor-v0", out=tmp_path / "whole", **given)
    stop = StopAt(recipe.steps // 2)
    first = train("test/Corridor-v0", out=tmp_path / "broken", progress=stop, **given)
    assert first.interrupted
    assert stop.said
    assert recipe.steps // 2 <= first.steps < recipe.steps
    np.random.seed(99)  # noqa: NPY002  # resuming must not depend on it
    torch.manual_seed(99)
    second = resume(first.run.folder)
    assert second.steps == whole.steps
    assert not second.interrupted
    for name, expected in weights(whole).items():
        assert torch.equal(weights(second)[name], expected), name
    assert curves(second) == curves(whole)


def test_same_seed_same_weights_other_seed_other_weights(tmp_path, tiny):
    results = [
        train("test/Corridor-v0", recipe=tiny, seed=seed, out=tmp_path) for seed in (1, 1, 2)
    ]
    first, second, third = (weights(result)["action_net.weight"] for result in results)
    assert torch.equal(first, second)
    assert not torch.equal(first, third)


def test_a_forgetful_environment_resumes_with_a_warning(tmp_path, tiny):
    given = {"recipe": tiny, "out": tmp_path}
    first = train("test/Forgetful-v0", progress=StopAt(500), **given)
    with pytest.warns(SimulationWarning, match="cannot save its state"):
        second = resume(first.run.folder)
    assert second.steps == tiny.steps


@pytest.mark.long
def test_training_learns_the_corridor(tmp_path, tiny):
    recipe = dataclasses.replace(tiny, steps=20_000, learning_rate=3e-3, gamma=0.95)
    result = train("test/Corridor-v0", recipe=recipe, out=tmp_path)
    found = evaluate(result.run.folder, episodes=100)
    assert found.success.value > 0.9
    assert found.episodes == found.success.total == 100


def test_a_run_describes_itself(tmp_path, tiny):
    result = train("test/Corridor-v0", recipe=tiny, seed=4, out=tmp_path, limit=12)
    config = json.loads((result.run.folder / "config.json").read_text())
    assert config["task"] == "test/Corridor-v0"
    assert config["seed"] == 4
    assert config["options"] == {"limit": 12}
    assert config["recipe"]["net_arch"] == [16]
    assert {"python", "torch", "gymnasium", "stable-baselines3"} <= set(config["versions"])
    assert (result.run.folder / "policy.npz").is_file()
    assert list((result.run.folder / "tensorboard").iterdir())
    last = curves(result)[-1]
    assert int(last["time/steps"]) == result.steps
    assert float(last["episodes/success_rate"]) >= 0
    assert float(last["train/loss"])


def test_only_the_newest_checkpoints_are_kept(tmp_path, tiny):
    result = train("test/Corridor-v0", recipe=tiny, out=tmp_path, checkpoint_every=128)
    names = [int(path.name) for path in result.run.checkpoints()]
    assert names == [1024 - 256, 1024 - 128, 1024]


def test_a_finished_run_has_nothing_left_to_do(tmp_path, tiny):
    result = train("test/Corridor-v0", recipe=tiny, out=tmp_path)
    again = resume(result.run.folder)
    assert again.new_steps == 0
    assert again.steps == result.steps


@pytest.mark.parametrize("interrupted", [False, True])
def test_a_run_is_extended(tmp_path, tiny, interrupted):
    stop = StopAt(500) if interrupted else None
    first = train("test/Corridor-v0", recipe=tiny, out=tmp_path, progress=stop)
    more = resume(first.run.folder, steps=2048)
    assert more.steps == 2048
    assert more.new_steps == 2048 - first.steps
    assert more.run.config.recipe.steps == 2048
    assert json.loads((first.run.folder / "config.json").read_text())["recipe"]["steps"] == 2048
    steps = [int(row["time/steps"]) for row in curves(more)]
    assert steps == sorted(set(steps))
    assert steps[-1] == 2048
    assert resume(first.run.folder).new_steps == 0


def test_a_run_is_not_made_shorter_than_it_is(tmp_path, tiny):
    result = train("test/Corridor-v0", recipe=tiny, out=tmp_path)
    with pytest.raises(TaskError, match="has 1,024 steps already"):
        resume(result.run.folder, steps=512)
    assert Run.open(result.run.folder).config.recipe.steps == 1024


def test_seconds_and_rates_go_on_over_a_break(tmp_path, tiny):
    """The clock of a run stands still between its parts, and never goes back."""
    recipe = dataclasses.replace(tiny, steps=2048)
    first = train("test/Corridor-v0", recipe=recipe, out=tmp_path, progress=StopAt(700))
    time.sleep(1.0)
    second = resume(first.run.folder)
    with (second.run.folder / "progress.csv").open() as file:
        rows = list(csv.DictReader(file))
    seconds = [float(row["time/seconds"]) for row in rows]
    assert all(early <= late for early, late in itertools.pairwise(seconds))
    spent = first.wall_seconds + second.wall_seconds
    assert seconds[-1] <= spent + 0.8  # less than the break
    for row, told in zip(rows, seconds, strict=True):
        # the seconds of an update are few and stand there to the millisecond
        took = int(row["time/steps"]) / float(row["time/steps_per_second"])
        assert took == pytest.approx(told, rel=0.05, abs=0.001)


def tensorboard_steps(folder):
    """Return steps of one curve, file by file."""
    steps = []
    for file in sorted((folder / "tensorboard").glob("events.out.tfevents.*")):
        steps += [
            event.step
            for event in EventFileLoader(str(file)).Load()
            if any(value.tag == "episodes/length" for value in event.summary.value)
        ]
    return steps


@pytest.mark.long
def test_a_killed_run_has_no_step_twice(tmp_path):
    """Killed without a chance to save, far beyond its last checkpoint, in the middle of a file."""
    code = (
        "import sys; sys.path.insert(0, sys.argv[2])\n"
        "import corridor; corridor.register()\n"
        "from gazelle.training import PPOSettings, Recipe, train\n"
        "settings = PPOSettings(n_steps=16, batch_size=32, n_epochs=2)\n"
        "recipe = Recipe(steps=4_000_000, num_envs=8, net_arch=(16,), settings=settings)\n"
        "train('test/Corridor-v0', recipe=recipe, out=sys.argv[1], checkpoint_every=6_000)\n"
    )
    here = str(Path(__file__).parent)
    child = subprocess.Popen([sys.executable, "-c", code, str(tmp_path), here])
    deadline = time.monotonic() + 120
    while time.monotonic() < deadline:
        tables = list(tmp_path.glob("*/progress.csv"))
        rows = tables[0].read_text().splitlines() if tables else []
        if len(rows) > 2 and int(rows[-1].split(",")[0] or 0) > 10_000:
            os.kill(child.pid, signal.SIGSTOP)
            folder = tables[0].parent
            if max(tensorboard_steps(folder)) > int(Run.open(folder).newest_checkpoint().name):
                break
            os.kill(child.pid, signal.SIGCONT)
        time.sleep(0.01)
    child.kill()
    child.wait()
    (folder,) = tmp_path.iterdir()
    newest = int(Run.open(folder).newest_checkpoint().name)
    (events,) = (folder / "tensorboard").iterdir()
    with events.open("ab") as file:
        file.write(b"half a record")
    assert max(tensorboard_steps(folder)) > newest
    resume(folder, steps=newest + 4_000)
    steps = tensorboard_steps(folder)
    assert steps == sorted(set(steps))
    assert steps[-1] >= newest + 4_000
    table = [int(row["time/steps"]) for row in csv.DictReader((folder / "progress.csv").open())]
    assert steps == table


def test_being_told_to_end_saves_as_ctrl_c_does(tmp_path, tiny):
    class EndAt(StopAt):
        def update(self, done, summary):
            if done >= self.steps:
                self.steps = float("inf")
                os.kill(os.getpid(), signal.SIGTERM)

    before = signal.getsignal(signal.SIGTERM)
    whole = train("test/Corridor-v0", recipe=tiny, out=tmp_path / "whole")
    stop = EndAt(500)
    first = train("test/Corridor-v0", recipe=tiny, out=tmp_path / "broken", progress=stop)
    assert first.interrupted
    assert first.stop_signal == signal.SIGTERM
    assert 500 <= first.steps < 1024
    assert int(first.run.newest_checkpoint().name) == first.steps
    assert signal.getsignal(signal.SIGTERM) is before
    second = resume(first.run.folder)
    for name, expected in weights(whole).items():
        assert torch.equal(weights(second)[name], expected), name


def test_a_run_in_the_same_second_gets_a_folder_of_its_own(tmp_path, tiny):
    short = dataclasses.replace(tiny, steps=128)
    folders = {train("test/Corridor-v0", recipe=short, out=tmp_path).run.folder for _ in range(3)}
    assert len(folders) == 3


@pytest.mark.parametrize("name", ["learner.pt", "state.npz", "state.json"])
def test_a_damaged_checkpoint_is_one_clear_error(tmp_path, tiny, name):
    result = train("test/Corridor-v0", recipe=tiny, out=tmp_path)
    file = result.run.newest_checkpoint() / name
    file.write_bytes(file.read_bytes()[:40])
    with pytest.raises(FormatError, match=r"not a readable state|cannot use these weights"):
        resume(result.run.folder)


def test_weights_with_code_in_them_are_refused(tmp_path, tiny):
    class Evil:
        def __reduce__(self):
            return (print, ("run",))

    result = train("test/Corridor-v0", recipe=tiny, out=tmp_path)
    torch.save({"modules": Evil(), "tensors": {}}, result.run.newest_checkpoint() / "learner.pt")
    with pytest.raises(FormatError, match="cannot use these weights"):
        resume(result.run.folder)


def test_a_folder_without_a_run_is_refused(tmp_path):
    with pytest.raises(FormatError, match="no run here"):
        resume(tmp_path)


@pytest.mark.parametrize(
    ("algo", "continuous", "hint"), [("sac", False, "ppo or dqn"), ("dqn", True, "sac")]
)
def test_an_algorithm_that_does_not_fit_is_refused(tmp_path, algo, continuous, hint):
    with pytest.raises(TaskError, match=hint):
        train("test/Corridor-v0", recipe=off_policy(algo), out=tmp_path, continuous=continuous)
    assert not list(tmp_path.iterdir())


def test_an_unknown_option_is_refused(tmp_path):
    with pytest.raises(TaskError, match="does not take"):
        train("test/Corridor-v0", out=tmp_path, lidar_samples=24)


def test_an_option_that_no_file_can_hold_is_refused(tmp_path):
    with pytest.raises(TaskError, match="option tell is a object"):
        train("test/Corridor-v0", out=tmp_path, tell=object())


def test_evaluations_use_the_recipes_own_options(tmp_path, tiny):
    recipe = dataclasses.replace(tiny, evaluation_options={"limit": 3})
    result = train("test/Corridor-v0", recipe=recipe, out=tmp_path)
    assert evaluate(result.run.folder, episodes=20).mean_length <= 3
    assert evaluate(result.run.folder, episodes=20, limit=25).mean_length > 3


@pytest.mark.parametrize("steps", [128, 1024])
def test_weights_that_explode_are_one_clear_error(tmp_path, tiny, steps):
    hopeless = dataclasses.replace(tiny, steps=steps, reward_scale=1e15)
    with pytest.raises(TaskError, match="weights became infinite"):
        train("test/Corridor-v0", recipe=hopeless, out=tmp_path, scale=1e15)


@pytest.mark.parametrize("seed", [-1, 2**32])
def test_an_impossible_seed_is_refused(tmp_path, seed):
    with pytest.raises(TaskError, match="seed must be between"):
        train("test/Corridor-v0", out=tmp_path, seed=seed)


OWN = {"recipe": {}, "engine": "mujoco"}
TAUGHT = {"recipe": {"goal_reward": GoalReward(), "features": True}, "engine": "planar"}


@pytest.mark.long
@pytest.mark.parametrize("how", [OWN, TAUGHT], ids=["own", "taught"])
def test_a_turtlebot3_run_goes_on_exactly_where_it_was(tmp_path, tiny, how):
    settings = dataclasses.replace(tiny.settings, bfloat16=True)
    recipe = dataclasses.replace(tiny, steps=512, num_envs=4, settings=settings, **how["recipe"])
    given = {"recipe": recipe, "seed": 2, "engine": how["engine"]}
    whole = train("TurtleBot3Stage4", out=tmp_path / "whole", **given)
    first = train("TurtleBot3Stage4", out=tmp_path / "broken", progress=StopAt(200), **given)
    assert first.interrupted
    second = resume(first.run.folder)
    for name, expected in weights(whole).items():
        assert torch.equal(weights(second)[name], expected), name
    assert curves(second) == curves(whole)


def test_a_missing_part_says_how_to_install_it(monkeypatch):
    import gazelle.training as room

    monkeypatch.delitem(vars(room), "train", raising=False)
    monkeypatch.delitem(sys.modules, "gazelle.training.session")
    for name in [name for name in sys.modules if name.startswith("gazelle.training.learners")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "stable_baselines3", None)
    with pytest.raises(MissingExtraError, match=r'pip install "gazelle\[train\]"'):
        room.train  # noqa: B018  # the access is what is tested


def test_an_unknown_task_suggests_the_closest():
    with pytest.raises(TaskError, match="there is no task"):
        train("Coridor")
