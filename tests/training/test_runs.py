from __future__ import annotations

import json

import numpy as np
import pytest

from gazelle.errors import FormatError, TaskError
from gazelle.training import Recipe, Run, RunConfig, list_runs

CONFIG = RunConfig(task="x/Corridor-v0", recipe=Recipe(), seed=3, options={"limit": 4})


def test_a_run_comes_back_as_it_was_written(tmp_path):
    run = Run.create(CONFIG, tmp_path)
    assert Run.open(run.folder).config == CONFIG
    assert run.folder.name.startswith("Corridor-ppo-")


def test_a_place_that_cannot_be_written_is_one_clear_error(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(TaskError, match="cannot write the run"):
        Run.create(CONFIG, tmp_path / "file")


def test_numbers_of_numpy_are_kept_as_numbers(tmp_path):
    recipe = Recipe(steps=np.int64(300), net_arch=(np.int32(8),), gamma=np.float32(0.5))
    config = RunConfig(task="x/Corridor-v0", recipe=recipe, seed=np.int64(3), sharded=np.True_)
    assert Run.open(Run.create(config, tmp_path).folder).config == config


@pytest.mark.parametrize("path", ["a" * 10_000, "\x00", "\ud800"])
def test_names_that_no_folder_can_have(tmp_path, path):
    for call in (Run.open, lambda out: Run.create(CONFIG, out), list_runs):
        with pytest.raises(TaskError):
            call(tmp_path / path)


@pytest.mark.parametrize(
    "change",
    [
        lambda config: config.update(format="other"),
        lambda config: config.pop("task"),
        lambda config: config["recipe"].update(algo="pppo"),
        lambda config: config["recipe"].update(gama=1),
        lambda config: config["recipe"].update(steps="many"),
    ],
)
def test_a_damaged_configuration_is_one_clear_error(tmp_path, change):
    run = Run.create(CONFIG, tmp_path)
    file = run.folder / "config.json"
    config = json.loads(file.read_text())
    change(config)
    file.write_text(json.dumps(config))
    with pytest.raises(FormatError, match=r"config\.json.*not a run's configuration"):
        Run.open(run.folder)


def test_a_failed_checkpoint_leaves_the_last_one(tmp_path):
    run = Run.create(CONFIG, tmp_path)

    def good(folder):
        (folder / "policy.npz").write_bytes(b"good")

    def bad(folder):
        (folder / "policy.npz").write_bytes(b"ba")
        raise OSError("disk full")

    run.add_checkpoint(100, good)
    with pytest.raises(OSError, match="disk full"):
        run.add_checkpoint(200, bad)
    assert run.newest_checkpoint().name == "000000000100"
    assert run.policy_file().read_bytes() == b"good"
    run.add_checkpoint(200, good)
    assert [path.name for path in run.checkpoints()] == ["000000000100", "000000000200"]


def test_a_run_without_checkpoint_says_so(tmp_path):
    run = Run.create(CONFIG, tmp_path)
    with pytest.raises(FormatError, match="no checkpoint"):
        run.newest_checkpoint()
    with pytest.raises(FormatError, match="no policy"):
        run.policy_file()
