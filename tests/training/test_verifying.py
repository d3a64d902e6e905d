"""Today's code beside the published success rates, with trainings replaced by given results."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from gazelle.training.claims import Claim, Trial

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture
def verifying(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    import _verify

    yield _verify
    for name in [
        name
        for name in sys.modules
        if name.startswith("_") and hasattr(sys.modules[name], "__file__")
    ]:
        if str(BENCHMARKS) in str(sys.modules[name].__file__):
            del sys.modules[name]


def trial(seed, success, cpu=10.0, attempts=1000):
    return Trial(
        seed=seed,
        date="2026-11-28",
        commit="0" * 12,
        episodes=attempts,
        attempts=attempts,
        success=success,
        cpu=cpu,
    )


def claim(task, *counts, cpu=10.0, engine="planar", goals="held-out"):
    return Claim(
        task=task,
        algo="ppo",
        engine=engine,
        goals=goals,
        train=f"gazelle train {task}",
        evaluate="gazelle eval RUN",
        trials=tuple(trial(seed, count, cpu) for seed, count in enumerate(counts)),
    )


@pytest.fixture
def outcomes(verifying, monkeypatch, tmp_path):
    """Check claims with given results of each seed; returns failures and seeds trained."""

    def verify(claims, reached, seeds=(100,)):
        trained = []

        def result(claim, run, seed, commit):
            trained.append(seed)
            return trial(seed, reached[seed])

        campaign = sys.modules["_campaign"]
        monkeypatch.setattr(verifying, "commit", lambda: "0" * 12)
        monkeypatch.setattr(campaign, "evaluated", result)
        home = tmp_path / "home" / "run"
        monkeypatch.setattr(
            campaign, "trained", lambda *_: home.mkdir(parents=True) or campaign.Trained(home, None)
        )
        return [each.claim.task for each in verifying.verify(claims, seeds, tmp_path)], trained

    return verify


@pytest.mark.parametrize(
    ("first", "second", "failed", "trained"),
    [
        (955, None, [], [100]),
        (1000, None, [], [100]),
        (700, 950, [], [100, 101]),
        (700, 710, ["Task"], [100, 101]),
        (0, 0, ["Task"], [100, 101]),
    ],
)
def test_a_rate_below_its_interval_fails_if_one_more_seed_does(
    outcomes, first, second, failed, trained, capsys
):
    published = claim("Task", 950, 960, 970)
    assert outcomes([published], {100: first, 101: second}) == (failed, trained)
    assert capsys.readouterr().out.count("BELOW") == len(trained) - (0 if failed else 1)


def test_one_published_seed_gives_no_interval_to_fall_below(outcomes, capsys):
    assert outcomes([claim("Task", 950)], {100: 3}) == ([], [100])
    assert "one seed is published, 95.0 %" in capsys.readouterr().out


def test_only_trainings_that_fell_short_are_repeated(outcomes):
    good, bad = claim("Good", 400, 500, 600), claim("Bad", 950, 960, 970)
    assert outcomes([good, bad], {100: 500, 101: 510}) == (["Bad"], [100, 100, 101])


def test_claims_without_a_figure_or_of_other_goals_are_left_out(verifying):
    some = claim("A", 900, 910), claim("B", 900, 910, cpu=24.9), claim("C", 900, 910, cpu=25.1)
    others = claim("D"), claim("E", 900, 910, goals="in a row")
    assert verifying.worth_verifying([*some, *others], cheap=False) == list(some)
    assert verifying.worth_verifying([*some, *others], cheap=True) == list(some[:2])


@pytest.mark.parametrize("budget", [5.0, 10.0, 35.0, 1e9])
def test_a_budget_takes_trainings_in_turn_until_each_was_there(verifying, budget):
    claims = [
        claim(task, 900, 910, cpu=cpu, engine=engine)
        for task, cpu in (("A", 10.0), ("B", 20.0), ("C", 5.0), ("D", 24.0))
        for engine in ("planar", "mujoco")
    ]
    seen = []
    for turn in range(50, 54):
        chosen = verifying.within(claims, budget, turn)
        tasks = {each.task for each in chosen}
        assert len(chosen) == 2 * len(tasks)
        spent = sum(each.cpu for each in chosen) / 2
        assert spent <= budget or len(tasks) == 1
        seen += tasks
    assert set(seen) == set("ABCD")


def test_seeds_of_turns_differ_and_none_is_published(verifying):
    seeds = [verifying.seed_of(turn) for turn in range(5000, 5900)]
    assert len(set(seeds)) == len(seeds)
    assert min(seeds) > 50
