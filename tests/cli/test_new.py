"""A task that the command writes works as it is."""

from __future__ import annotations

import subprocess
import sys

import pytest

from gazelle.cli.main import main


@pytest.fixture
def written(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "task", "HoldUp"]) == 0
    return tmp_path, capsys.readouterr().out


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
    assert "trained: 4,096 steps" in done.stdout


def test_nothing_is_overwritten(written, capsys):
    folder, _ = written
    (folder / "hold_up.urdf").unlink()
    assert main(["new", "task", "HoldUp"]) == 1
    assert "hold_up.py is there already" in capsys.readouterr().err
    assert not (folder / "hold_up.urdf").exists()


def test_a_name_that_cannot_be(tmp_path, capsys):
    assert main(["new", "task", "my task", "--out", str(tmp_path)]) == 1
    assert "'my task' cannot be the name of a task" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_it_is_learnt_in_a_minute(written):
    folder, _ = written
    for words in (
        ["train", "hold_up.py:my/HoldUp-v0", "--steps", "300000", "--out", "runs"],
        ["eval", "runs/last", "--episodes", "100", "--json"],
    ):
        if words[0] == "eval":
            words[1] = str(next((folder / "runs").iterdir()))
        done = subprocess.run(
            [sys.executable, "-m", "gazelle", *words],
            cwd=folder,
            capture_output=True,
            text=True,
            check=True,
        )
    import json

    assert json.loads(done.stdout)["success"]["value"] > 0.95
