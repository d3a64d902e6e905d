"""A task that the command writes works as it is."""

from __future__ import annotations

import subprocess
import sys

import pytest

from gazelle.cli.main import main
from gazelle.training import evaluate, train


@pytest.fixture
def written(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "task", "HoldUp"]) == 0
    return tmp_path, capsys.readouterr().out


@pytest.mark.long
def test_its_own_test_passes(written):
    folder, told = written
    assert sorted(file.name for file in folder.iterdir()) == [
        "hold_up.py",
        "hold_up.urdf",
        "test_hold_up.py",
    ]
    assert "train hold_up.py:my/HoldUp-v0" in told
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "test_hold_up.py"],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout
    assert "2 passed" in done.stdout


@pytest.mark.long
def test_it_trains_as_the_command_says(written):
    folder, _ = written
    words = ["train", "hold_up.py:my/HoldUp-v0", "--steps", "4096", "--num-envs", "16"]
    done = subprocess.run(
        [sys.executable, "-m", "gazelle", *words],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "trained: 4,096 control steps" in done.stdout


def test_nothing_is_overwritten(written, capsys):
    folder, _ = written
    (folder / "hold_up.urdf").unlink()
    assert main(["new", "task", "HoldUp"]) == 1
    assert "hold_up.py is there already" in capsys.readouterr().err
    assert not (folder / "hold_up.urdf").exists()


def test_a_name_that_cannot_be(tmp_path, capsys):
    assert main(["new", "task", "my task", "--out", str(tmp_path)]) == 1
    assert "'my task' is not a valid name of a task" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_it_is_learnt_in_a_minute(written):
    folder, _ = written
    run = train(f"{folder}/hold_up.py:my/HoldUp-v0", steps=300_000, out=folder).run
    assert evaluate(run.folder, episodes=100).success.value > 0.95
