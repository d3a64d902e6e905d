"""Success rates as `gazelle tasks` shows them."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from gazelle.cli.main import main
from gazelle.envs.descriptions import DESCRIPTIONS
from gazelle.training import (
    Claim,
    Claims,
    Trial,
    describe_task,
    find_task,
    list_tasks,
    published_claims,
)

OWN = {task.name for task in list_tasks() if task.id.startswith("gazelle/")}
WIDTH = 80


def shown(capsys, *arguments):
    assert main(["tasks", *arguments]) == 0
    out = capsys.readouterr().out
    assert max(map(len, out.splitlines())) <= WIDTH
    return out


@pytest.fixture
def claims(monkeypatch):
    """Return a setter of other published success rates."""

    def publish(*published, **unverified):
        found = Claims(published, unverified)
        monkeypatch.setattr("gazelle.training.published_claims", lambda: found)

    return publish


def claim(task, *counts, **changes):
    trials = tuple(
        Trial(
            seed=seed,
            date="2026-11-28",
            commit="0123456789ab",
            episodes=1000,
            attempts=1000,
            success=count,
            cpu=12.0,
            wall=31.0,
            processors=2,
            others=0.0,
        )
        for seed, count in enumerate(counts)
    )
    given = {"engine": "planar", "algo": "ppo", "train": f"gazelle train {task}"} | changes
    evaluate = f"gazelle eval RUN --engine {given['engine']} --episodes 1000"
    return Claim(task=task, evaluate=evaluate, trials=trials, **given)


@pytest.mark.parametrize("task", sorted(OWN))
def test_one_task_is_shown_with_its_commands_and_figures_in_80_columns(task, capsys):
    out = shown(capsys, task)
    assert out.startswith(find_task(task))
    why = published_claims().unverified.get(task)
    if why:
        assert why[:20] in out
        return
    assert f"  train   gazelle train {task}\n" in out
    text = re.sub(r"\s+", " ", out)
    for found in published_claims().claims:
        if found.task == task and found.goals == "held-out":
            assert found.train in text
            assert found.evaluate in text
            assert found.success is None or f" {100.0 * found.success.value:.1f} %" in text


def test_seeds_intervals_commit_and_times_are_shown(claims, capsys):
    other = claim("KobukiMaze", 700, algo="dqn", train="gazelle train KobukiMaze --algo dqn")
    claims(claim("KobukiMaze", 947, 730, 800), other)
    out = shown(capsys, "KobukiMaze")
    low, high = (f"{100.0 * end:.1f}" for end in claim("KobukiMaze", 947, 730, 800).predicted)
    assert f"planar  82.6 % (94.7, 73.0, 80.0); one more seed {low} to {high} %" in out
    assert "seeds   0, 1, 2; measured 2026-11-28 at 0123456789ab" in out
    assert "time    12 s of one processor for each training" in out
    assert "wall    31 s; of 2 processors, others kept 0.0 busy" in out
    assert "or      gazelle train KobukiMaze --algo dqn" in out
    assert "70.0 %; one seed (700 of 1000)" in out


def test_a_figure_of_each_engine_stands_in_its_column(claims, capsys):
    claims(claim("KobukiMaze", 900, 910), claim("KobukiMaze", 800, 820, engine="mujoco"))
    lines = {line.split()[0]: line for line in shown(capsys, "--long").splitlines() if line}
    assert re.split(r" {2,}", lines["KobukiMaze"])[1:] == [
        "ppo",
        "planar",
        "90.5 %",
        "81.0 %",
        "12",
        "31",
    ]


def test_wall_times_say_whether_something_ran_beside_them(claims, capsys):
    quiet = claim("KobukiEmpty", 900, 910)
    busy = tuple(replace(trial, others=1.4) for trial in claim("KobukiMaze", 900, 910).trials)
    unknown = tuple(replace(trial, wall=None) for trial in busy[:1]) + busy[1:]
    claims(
        quiet,
        replace(claim("KobukiMaze"), trials=busy),
        replace(claim("Husarion"), trials=unknown),
        claim("UR5Reach"),
    )
    rows = {
        line.split()[0]: line.split()[-1] for line in shown(capsys, "--long").splitlines() if line
    }
    walls = [rows[name] for name in ("KobukiEmpty", "KobukiMaze", "Husarion", "UR5Reach")]
    assert walls == ["31", "31*", "-", "-"]
    assert "31 s; of 2 processors, others kept 1.4 busy" in shown(capsys, "KobukiMaze")
    assert "not measured yet" in shown(capsys, "UR5Reach")


def test_a_task_without_a_figure_is_listed_with_the_reason(claims, capsys):
    claims(claim("KobukiMaze", 900), HopperStayUp="cannot be done")
    listed, _, without = shown(capsys, "--long").partition("WHY IT HAS NO FIGURE")
    assert "KobukiMaze" in listed
    assert re.search(r"^HopperStayUp +cannot be done$", without, re.MULTILINE)
    assert "HopperStayUp" not in listed
    assert "figure  cannot be done" in shown(capsys, "HopperStayUp")


@pytest.mark.parametrize("options", [(), ("--long",)])
def test_the_list_of_tasks_names_each(options, capsys):
    assert {line.split()[0] for line in shown(capsys, *options).splitlines() if line} >= OWN


def test_each_task_is_listed_with_its_success_and_a_sentence(claims, capsys):
    claims(claim("KobukiMaze", 900, 910), claim("KobukiMaze", 800, engine="mujoco"))
    lines = {line.split()[0]: line for line in shown(capsys).splitlines() if line}
    assert re.split(r" {2,}", lines["KobukiMaze"])[1:2] == ["90.5 %"]
    assert re.split(r" {2,}", lines["HopperStayUp"])[1:2] == ["-"]
    assert set(DESCRIPTIONS) == OWN
    assert all(text.endswith(".") and len(text) <= WIDTH for text in DESCRIPTIONS.values())
    assert f"\n{DESCRIPTIONS['KobukiMaze']}\n" in shown(capsys, "KobukiMaze")


def test_a_task_from_elsewhere_is_described_by_the_first_sentence_of_its_environment():
    assert describe_task("CartPole-v1").startswith("This environment corresponds to the version")


def test_a_task_that_no_figure_is_known_of_says_so(capsys):
    assert "none is known of this task" in shown(capsys, "CartPole-v1")


def test_an_unknown_task_is_one_line_and_a_hint(capsys):
    assert main(["tasks", "TurtleBot3Stag4"]) == 1
    assert "there is no task 'TurtleBot3Stag4'" in capsys.readouterr().err
