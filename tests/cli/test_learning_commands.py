"""`gazelle train` and `gazelle eval` on Gymnasium's own CartPole."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time

import pytest

SHORT = ("--steps", "2048", "--num-envs", "8")


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Return the folder of a short run."""
    from gazelle.cli.main import main

    out = tmp_path_factory.mktemp("runs")
    assert main(["train", "CartPole-v1", *SHORT, "--out", str(out)]) == 0
    (folder,) = out.iterdir()
    return folder


@pytest.mark.long
def test_train_says_what_it_did_and_what_to_type_next(cli, tmp_path):
    code, out, err = cli("train", "CartPole-v1", *SHORT, "--out", tmp_path, "--seed", 3)
    assert code == 0
    assert err == "ppo: 2,048 steps, 8 environments, seed 3\n"
    (folder,) = tmp_path.iterdir()
    assert re.search(r"trained: 2,048 control steps, [\d,]+ a second\n +[\d.]+ s for .* RTF", out)
    assert f"next:    gazelle eval {folder}" in out
    assert json.loads((folder / "config.json").read_text())["seed"] == 3


@pytest.mark.long
def test_train_says_what_it_does_before_it_imports_torch(tmp_path):
    code = (
        "import sys; from gazelle.cli.main import main\n"
        "sys.modules['torch'] = None\n"
        "main(['train', 'TurtleBot3Stage1', '--seed', '3', '--out', sys.argv[1]])"
    )
    ran = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path)], capture_output=True, text=True, check=False
    )
    assert ran.stderr.startswith("ppo: 507,904 steps, ")
    assert "  500,000 steps, rounded up to whole rollouts of " in ran.stderr
    assert "torch" in ran.stderr


def test_eval_prints_rates(cli, run):
    code, out, _ = cli("eval", run, "--episodes", 20)
    assert code == 0
    assert "CartPole-v1, 20 episodes (20 distinct), seed 10000" in out
    assert re.search(r"time-out +0\.0 % +95 % interval 0\.0 % to 16\.1 % +\(0 of 20\)", out)
    assert "RTF" in out


def test_eval_prints_json(cli, run):
    code, out, _ = cli("eval", run, "--episodes", 20, "--json", "--seed", 5)
    assert code == 0
    found = json.loads(out)
    assert found["episodes"] == 20
    assert found["seed"] == 5
    assert found["timeout"]["total"] == 20


def test_resume_of_a_finished_run_has_nothing_to_do(cli, run):
    code, out, _ = cli("train", "--resume", run)
    assert code == 0
    assert out.startswith("nothing left to do")


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        ((), "a task, or a run with --resume, is required"),
        (("CartPole-v1", "--resume", "x"), "leave out task"),
        (("--resume", "x", "--num-envs", "5"), "leave out --num-envs"),
        (("--resume", "x", "--goals", "published"), "leave out --goals"),
        (("--resume", "x", "--option", "a=1"), "leave out --option"),
        (("CartPole-v1", "--steps", "0"), "above 0"),
    ],
)
def test_what_cannot_go_together_is_a_wrong_command_line(cli, arguments, complaint):
    code, _, err = cli("train", *arguments)
    assert code == 2
    assert complaint in err


def test_unknown_task_suggests_the_closest(cli):
    code, _, err = cli("train", "CartPol")
    assert code == 1
    assert "there is no task 'CartPol'" in err
    assert "hint:" in err


def test_eval_of_nothing_is_one_line(cli, tmp_path):
    code, _, err = cli("eval", tmp_path)
    assert code == 1
    assert "no run here" in err


@pytest.mark.long
@pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")
def test_interrupt_saves_says_how_to_resume_and_resumes(cli, tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-m", "gazelle.cli.main", "train", "CartPole-v1", "--steps", "1e9",
         "--out", str(tmp_path)],
        stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    deadline = time.monotonic() + 120
    while not list(tmp_path.glob("*/progress.csv")) and time.monotonic() < deadline:
        time.sleep(0.1)
    time.sleep(1.0)
    os.kill(process.pid, signal.SIGINT)
    _, err = process.communicate(timeout=120)
    assert process.returncode == 130
    assert "Traceback" not in err
    (folder,) = tmp_path.iterdir()
    assert f"gazelle train --resume {folder}" in err
    config = json.loads((folder / "config.json").read_text())
    done = int(max(path.name for path in (folder / "checkpoints").iterdir()))
    config["recipe"]["steps"] = done + 2048
    (folder / "config.json").write_text(json.dumps(config))
    code, out, err = cli("train", "--resume", folder)
    assert code == 0
    assert "trained: 2,048 control steps" in out
    assert "cannot save its state" in err
