"""The release check goes on where it stopped and writes down what it found."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import pytest

from gazelle.training import published_claims

ROOT = Path(__file__).parents[1]


@pytest.fixture
def release(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "tools"))
    import release_check

    yield release_check
    for name in ("release_check", "update_benchmarks", "_checkout", "_claim_table"):
        sys.modules.pop(name, None)


@pytest.fixture
def check(release, tmp_path, monkeypatch):
    """Run steps at a commit, a number; return whether all are good, and the report."""
    report = tmp_path / "report.md"
    monkeypatch.setattr(release, "is_since", lambda commit, oldest: int(commit) >= int(oldest))

    def run(chosen, everything, commit="5", since=None):
        monkeypatch.setattr(release, "clean_commit", lambda: commit)
        good = release.check(chosen, everything, report, since=since)
        return good, report.read_text()

    return run


def step(release, name, code, **changes):
    return release.Step(name, (sys.executable, "-c", code), **changes)


def counting(release, name, file, code=0):
    """Return a step that leaves a mark each time it runs."""
    return step(
        release,
        name,
        f"open({str(file)!r}, 'a').write('x'); print('passed 3'); raise SystemExit({code})",
    )


def test_outcomes_and_results_are_reported_with_the_commit(release, check):
    good = step(release, "good one", "print('first'); print('all | of it')")
    bad = step(release, "bad one", "print('2 failed'); raise SystemExit(3)")
    everything = [good, bad, step(release, "another", "")]
    passed, report = check([good, bad], everything)
    assert not passed
    assert "1 of 3 steps are good." in report
    assert "| good one | good | 5 |" in report
    assert "| all / of it |" in report
    assert "| bad one | FAILED |" in report
    assert "exit code 3; 2 failed" in report
    assert "| another | not run |" in report


def test_what_has_passed_is_not_run_again_and_what_failed_is(release, check, tmp_path):
    done, failed = tmp_path / "done", tmp_path / "failed"
    for passes in (False, True):
        code = 0 if passes else 1
        everything = [counting(release, "a", done), counting(release, "b", failed, code)]
        assert check(everything, everything)[0] is passes
    assert done.read_text() == "x"
    assert failed.read_text() == "xx"


def test_what_passed_at_an_older_commit_counts_only_where_that_is_asked_for(
    release, check, tmp_path
):
    mark = tmp_path / "mark"
    everything = [counting(release, "a", mark), step(release, "b", "print()")]
    check(everything[:1], everything, commit="5")
    good, report = check(everything, everything, commit="7", since="5")
    assert good
    assert mark.read_text() == "x"
    assert "| a | good | 5 |" in report
    assert "| b | good | 7 |" in report
    _, report = check(everything[1:], everything, commit="7")
    assert "| a | not run |" in report


def test_a_run_that_is_broken_off_keeps_what_it_has(release, check, tmp_path):
    class Broken(BaseException):
        pass

    def stop(_):
        raise Broken

    mark = tmp_path / "mark"
    everything = [counting(release, "a", mark), step(release, "b", "print()", judge=stop)]
    with pytest.raises(Broken):
        check(everything, everything)
    everything[1] = step(release, "b", "print('now')")
    assert check(everything, everything)[0]
    assert mark.read_text() == "x"


def test_all_trainings_tables_and_suites_are_steps(release):
    names = [each.name for each in release.steps()]
    assert len(names) == len(set(names))
    trainings = {claim.train.removeprefix("gazelle train ") for claim in published_claims().claims}
    assert {
        name.removeprefix("recipe ") for name in names if name.startswith("recipe ")
    } == trainings
    assert {"table physics", "table contacts", "table workers"} <= set(names)
    assert {"slow tests of bridges", "slow tests of the whole", "ROS suites"} <= set(names)


@pytest.mark.parametrize(("reached", "short"), [((950, 940, 960), False), ((950, 100, 960), False)])
def test_one_seed_below_its_interval_is_chance(release, reached, short):
    assert release.falls_short(*claims(reached)) is short


def test_most_seeds_below_the_published_interval_fail(release):
    old, new = claims((100, 200, 960))
    assert release.falls_short(old, new)
    assert "BELOW" in release.compared(old, new)
    assert not release.falls_short(replace(old, trials=old.trials[:1]), new)


def claims(reached):
    """Return a claim of three good seeds, and the same with other results."""
    (own,) = published_claims().of("KobukiEmpty")

    def of(counts):
        trials = [
            replace(own.trials[0], seed=seed, success=count, attempts=1000, effective=None)
            for seed, count in enumerate(counts)
        ]
        return replace(own, trials=tuple(trials))

    return of((950, 960, 970)), of(reached)
