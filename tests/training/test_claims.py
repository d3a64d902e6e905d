"""Published success rates as data, and how measurements are entered."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from gazelle.cli import evaluate, train
from gazelle.errors import FormatError
from gazelle.training import list_tasks, recipe_for
from gazelle.training.claims import CLAIMS_FILE, Claim, Trial, published_claims, read_claims
from gazelle.training.recipes import task_name
from gazelle_ros.cli.parsing import Parser

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"
CLAIMS = published_claims().claims
NAMES = [f"{claim.train}, {claim.engine}, {claim.goals}" for claim in CLAIMS]
OWN = {task.name for task in list_tasks() if task.id.startswith("gazelle/")}


@pytest.fixture
def campaign(monkeypatch):
    """Yield the module of the benchmarks, which know of no package."""
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    import _campaign

    yield _campaign
    for name in [name for name in sys.modules if name.startswith(("_campaign", "_checkout"))]:
        del sys.modules[name]


def parsed(command, module):
    parser = Parser(prog="gazelle")
    module.configure(parser)
    return parser.parse_args(shlex.split(command)[2:])


@pytest.mark.parametrize("claim", CLAIMS, ids=NAMES)
def test_commands_are_valid_and_of_what_the_claim_says(claim):
    training = parsed(f"{claim.train} --seed 3 --out runs", train)
    assert task_name(training.task) == claim.task
    assert recipe_for(claim.task, training.algo).algo == claim.algo
    evaluation = parsed(f"{claim.evaluate} --json", evaluate)
    assert str(evaluation.run) == "RUN"
    assert evaluation.engine == claim.engine or (":" in training.task and not evaluation.engine)
    assert claim.evaluate.count("RUN") == 1


@pytest.mark.parametrize("claim", CLAIMS, ids=NAMES)
def test_trials_are_possible_and_have_a_commit_and_a_day(claim):
    assert len(set(claim.seeds)) == len(claim.seeds)
    for trial in claim.trials:
        assert 0 <= trial.success <= trial.attempts
        assert trial.episodes <= trial.attempts
        assert (trial.effective or trial.attempts) <= trial.attempts
        assert re.fullmatch("[0-9a-f]{12}", trial.commit)
        assert re.fullmatch(r"\d{4}-\d\d-\d\d", trial.date)
        assert trial.cpu > 0.0


def test_each_claim_is_there_once_and_each_task_has_one_or_a_line_that_says_why_not():
    assert len({claim.key for claim in CLAIMS}) == len(CLAIMS)
    unverified = published_claims().unverified
    listed = {claim.task for claim in CLAIMS if ".py:" not in claim.train}
    assert listed | set(unverified) == OWN
    assert not {claim.task for claim in CLAIMS} & set(unverified)
    assert all(why and "\n" not in why for why in unverified.values())


def test_the_file_is_as_the_program_writes_it(tmp_path):
    copy = tmp_path / "claims.yaml"
    read_claims().write(copy)
    assert copy.read_text() == CLAIMS_FILE.read_text()


@pytest.mark.parametrize(
    "text",
    [
        "",
        "claims: [",
        "claims: []",
        "claims: 3\nunverified: {}",
        "claims: [{task: A}]\nunverified: {}",
    ],
)
def test_a_damaged_file_is_one_error_that_names_it(text, tmp_path):
    file = tmp_path / "claims.yaml"
    file.write_text(text)
    with pytest.raises(FormatError, match="cannot be read") as caught:
        read_claims(file)
    assert str(file) in str(caught.value)


def trial(seed, commit="a", success=9):
    return Trial(
        seed=seed,
        date="2026-11-28",
        commit=commit,
        episodes=10,
        attempts=10,
        success=success,
        cpu=3,
    )


def claim(*trials):
    return Claim(
        task="Task",
        algo="ppo",
        engine="planar",
        train="gazelle train Task",
        evaluate="gazelle eval RUN",
        trials=trials,
    )


def test_a_trial_replaces_that_of_the_same_seed():
    found = claim(trial(0, success=1), trial(2)).with_trial(trial(0)).with_trial(trial(1))
    assert found.trials == (trial(0), trial(1), trial(2))
    assert (found.success.count, found.success.total) == (27, 30)


def test_trials_of_older_commits_stay_until_all_seeds_are_measured_again(
    campaign, tmp_path, monkeypatch
):
    monkeypatch.setattr(campaign, "is_since", lambda commit, _: commit == "new")
    file = tmp_path / "claims.yaml"
    old = claim(trial(0, "old"), trial(1, "old"), trial(5, "old"))
    replace(read_claims(), claims=(old,)).write(file)
    for seed, left in ((0, ["new", "old", "old"]), (1, ["new", "new"])):
        campaign.record(file, old, trial(seed, "new"), [0, 1], "new")
        (found,) = read_claims(file).claims
        assert [each.commit for each in found.trials] == left


def test_what_another_checkout_measured_is_taken(campaign, tmp_path, monkeypatch):
    monkeypatch.setattr(campaign, "is_since", lambda commit, _: commit != "old")
    here, there = tmp_path / "claims.yaml", tmp_path / "others.yaml"
    untouched = replace(claim(trial(0, "old")), train="gazelle train Other", task="Other")
    mine = claim(trial(0, "old"), trial(1, "mine"), trial(2, "mine"), trial(9, "old"))
    theirs = claim(trial(0, "theirs"), trial(2, "theirs", success=4), trial(7, "old"))
    first = replace(untouched, train="gazelle train New", task="New", trials=(trial(0, "theirs"),))
    replace(read_claims(), claims=(mine, untouched)).write(here)
    replace(read_claims(), claims=(theirs, untouched, first)).write(there)
    taken = claim(
        trial(0, "theirs"), trial(1, "mine"), trial(2, "theirs", success=4), trial(9, "old")
    )
    assert campaign.take(here, there, "oldest") == [taken, first]
    assert set(read_claims(here).claims) == {taken, first, untouched}
    assert campaign.take(here, there, "oldest") == []
    replace(
        read_claims(), claims=(claim(*theirs.trials[:2], trial(5, "theirs"), trial(6, "theirs")),)
    ).write(there)
    campaign.take(here, there, "oldest")
    (found,) = (each for each in read_claims(here).claims if each.key == mine.key)
    assert {each.seed for each in found.trials} == {0, 1, 2, 5, 6}


def test_every_published_rate_has_at_least_three_seeds():
    few = [each.key for each in read_claims().claims if len({t.seed for t in each.trials}) < 3]
    assert not few


def test_a_first_figure_takes_the_place_of_the_line_that_says_why_there_is_none(tmp_path):
    before = replace(read_claims(), unverified={"Task": "not tried", "Other": "neither"})
    after = before.with_claim(claim(trial(0)))
    assert after.find(claim().key) == claim(trial(0))
    assert after.unverified == {"Other": "neither"}


@pytest.mark.long
def test_programs_that_write_at_once_lose_nothing(tmp_path):
    file = tmp_path / "claims.yaml"
    replace(read_claims(), claims=()).write(file)
    script = (
        f"import sys; sys.path[:0] = [{str(BENCHMARKS)!r}, {str(Path(__file__).parent)!r}]\n"
        "from pathlib import Path\n"
        "from _campaign import record\n"
        "from test_claims import claim, trial\n"
        f"for seed in map(int, sys.argv[1:]): record(Path({str(file)!r}), claim(), trial(seed), [99], 'HEAD')\n"
    )
    writers = [
        subprocess.Popen([sys.executable, "-c", script, *map(str, range(first, 20, 2))])
        for first in (0, 1)
    ]
    assert [writer.wait() for writer in writers] == [0, 0]
    (found,) = read_claims(file).claims
    assert found.seeds == tuple(range(20))


def test_a_campaign_trains_each_seed_once_and_leaves_alone_what_is_done(campaign, monkeypatch):
    planar, mujoco = claim(), replace(claim(), engine="mujoco")
    trained = []
    monkeypatch.setattr(
        campaign,
        "trained",
        lambda *about: trained.append(about[:2]) or campaign.Trained(None, None),
    )
    monkeypatch.setattr(campaign, "evaluated", lambda claim, run, seed, commit: trial(seed, commit))
    runs = campaign.Campaign(seeds=[0, 1, 2], commit="new", out=None, keep=True)
    done = {planar.key: {0, 1}, mujoco.key: {0}}
    found = [(each.engine, one.seed) for each, one in runs.results([planar, mujoco], done)]
    assert found == [("mujoco", 1), ("planar", 2), ("mujoco", 2)]
    assert trained == [("gazelle train Task", 1), ("gazelle train Task", 2)]


@pytest.mark.long
def test_a_training_is_measured_by_its_commands_and_found_again(campaign, tmp_path):
    own = replace(
        claim(),
        train="gazelle train TurtleBot3Stage1 --steps 20000",
        evaluate="gazelle eval RUN --engine planar --episodes 20",
    )
    run = campaign.trained(own.train, 3, "abc", tmp_path)
    found = campaign.evaluated(own, run, 3, "abc")
    assert (found.seed, found.commit, found.episodes, found.attempts) == (3, "abc", 20, 20)
    assert found.cpu == pytest.approx(run.spent.processor, abs=0.1)
    again = campaign.trained(own.train, 3, "abc", tmp_path)
    assert again == run
    assert replace(campaign.evaluated(own, again, 3, "abc"), date=found.date) == found
    assert campaign.trained(own.train, 4, "abc", tmp_path).folder != run.folder
