"""Trainings and evaluations by the commands of claims, and their results in the data file."""

from __future__ import annotations

import contextlib
import datetime as dt
import io
import json
import os
import re
import shlex
import shutil
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from _busy import Spent, StopWatch
from _checkout import is_since

from gazelle.cli.main import main as gazelle
from gazelle.errors import Error
from gazelle.training.claims import Claim, Trial, read_claims

_NOTE = "training.json"


@dataclass(frozen=True, slots=True)
class Trained:
    """A finished training."""

    folder: Path
    """Folder of the run."""
    spent: Spent
    """Time that it took."""


def trained(command: str, seed: int, commit: str, out: Path) -> Trained:
    """Train by a command, or find the finished run of the same command, seed and commit."""
    name = re.sub(r"[^A-Za-z0-9.]+", "-", command.removeprefix("gazelle train "))
    home = out / f"{name}-seed{seed}-{commit}"
    note = home / _NOTE
    if not note.exists():
        shutil.rmtree(home, ignore_errors=True)  # a training that was broken off
        import torch  # noqa: F401  # its seconds are not the training's

        watch = StopWatch()
        _typed(f"{command} --seed {seed} --out {shlex.quote(str(home))}")
        spent = watch.read()
        part = note.with_suffix(".part")
        part.write_text(json.dumps(asdict(spent)))
        part.replace(note)
    (folder,) = (path for path in home.iterdir() if path.is_dir())
    return Trained(folder, Spent(**json.loads(note.read_text())))


def evaluated(claim: Claim, run: Trained, seed: int, commit: str) -> Trial:
    """Evaluate a run by the command of a claim."""
    command = claim.evaluate.replace("RUN", shlex.quote(str(run.folder)))
    found = json.loads(_typed(f"{command} --json"))
    success, collision = found["success"], found["collision"]
    if success is None:
        raise Error(f"{claim.task} does not tell success, so that it has no success rate")
    effective = success["effective"]
    return Trial(
        seed=seed,
        date=str(dt.datetime.now(dt.UTC).date()),
        commit=commit,
        episodes=found["episodes"],
        distinct=found["distinct"],
        attempts=success["total"],
        success=success["count"],
        effective=None if effective == success["total"] else round(effective, 1),
        collisions=None if collision is None else collision["count"],
        timeouts=found["timeout"]["count"],
        cpu=round(run.spent.processor, 1),
        wall=round(run.spent.wall, 1),
        processors=run.spent.processors,
        others=None if run.spent.others is None else round(run.spent.others, 2),
    )


def _typed(command: str) -> str:
    """Run a command of Gazelle in this process and return what it prints."""
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        code = gazelle(shlex.split(command)[1:])
    if code:
        raise SystemExit(code)
    return text.getvalue()


@dataclass(frozen=True, slots=True, kw_only=True)
class Campaign:
    """Claims that are measured with seeds, one training after the other."""

    seeds: Sequence[int]
    """Of the trainings."""
    commit: str
    """Commit that is measured."""
    out: Path
    """Folder of the runs."""
    keep: bool
    """True to keep the runs there."""

    def results(
        self, claims: Sequence[Claim], done: dict[tuple[str, str, str], set[int]]
    ) -> Iterator[tuple[Claim, Trial]]:
        """Measure what is missing and yield each trial as soon as it is known.

        Args:
            claims: What is measured; those of one training stand together.
            done: Seeds that are not measured again, by the claim's key.
        """
        for command in dict.fromkeys(claim.train for claim in claims):
            for seed in self.seeds:
                due = [
                    claim
                    for claim in claims
                    if claim.train == command and seed not in done.get(claim.key, ())
                ]
                if not due:
                    continue
                run = trained(command, seed, self.commit, self.out)
                for claim in due:
                    yield claim, evaluated(claim, run, seed, self.commit)
                if not self.keep:
                    shutil.rmtree(run.folder.parent)


def seeds_since(claim: Claim, oldest: str) -> set[int]:
    """Return the seeds of a claim that were measured at a commit or later."""
    return {trial.seed for trial in claim.trials if is_since(trial.commit, oldest)}


def record(file: Path, claim: Claim, trial: Trial, seeds: Sequence[int], oldest: str) -> None:
    """Add a trial to the data file, beside other programs that do so.

    Trials of commits before `oldest` stay until all seeds are measured again, so that a campaign
    that is broken off leaves no claim with fewer seeds than it had.
    """
    with _alone(file):
        claims = read_claims(file)
        new = (claims.find(claim.key) or claim).with_trial(trial)
        claims.with_claim(_without_older(new, seeds, oldest)).write(file)


def _without_older(claim: Claim, seeds: Sequence[int], oldest: str) -> Claim:
    """Drop trials before a commit once all seeds have newer ones."""
    if not seeds_since(claim, oldest).issuperset(seeds):
        return claim
    return _since(claim, oldest)


@contextlib.contextmanager
def _alone(file: Path) -> Iterator[None]:
    """Lock the file's folder against other programs; the file is replaced."""
    import fcntl  # not on Windows, where nobody measures

    folder = os.open(file.parent, os.O_RDONLY)
    try:
        fcntl.flock(folder, fcntl.LOCK_EX)
        yield
    finally:
        os.close(folder)


def take(file: Path, other: Path, oldest: str) -> list[Claim]:
    """Add the trials of another checkout since a commit; return the claims that changed.

    Where both have a seed, the other one's trial is taken. Trials of before that commit go once
    the newer ones are as many, so that no claim gets fewer seeds than it had.
    """
    changed = []
    with _alone(file):
        claims = read_claims(file)
        for claim in read_claims(other).claims:
            here = claims.find(claim.key) or replace(claim, trials=())
            new = _since(claim, oldest)
            if new.trials:
                taken = here
                for trial in new.trials:
                    taken = taken.with_trial(trial)
                newer = _since(taken, oldest)
                if len(newer.trials) >= len(here.trials):
                    taken = newer
                if taken != here:
                    changed.append(taken)
                    claims = claims.with_claim(taken)
        claims.write(file)
    return changed


def _since(claim: Claim, oldest: str) -> Claim:
    """Return a claim without its trials of before a commit."""
    trials = tuple(trial for trial in claim.trials if is_since(trial.commit, oldest))
    return replace(claim, trials=trials)
