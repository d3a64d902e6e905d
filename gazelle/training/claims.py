"""Published success rates: what trainings were measured to reach, and by which commands.

They are data, in ``claims.yaml`` beside this module. `gazelle tasks` and tables of the docs are
rendered from that file; ``gazelle bench recipes --write`` measures and rewrites it.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import yaml

from gazelle.argument_checks import checked
from gazelle.errors import FormatError, TaskError
from gazelle.training.prediction import predicted_range
from gazelle.training.statistics import SuccessRate
from gazelle_ros.base.writing import write_text

CLAIMS_FILE = Path(__file__).with_name("claims.yaml")
HELD_OUT = "held-out"
_HEAD = """\
# Published success rates, read by gazelle/training/claims.py, which documents each field.
# Written by: gazelle bench recipes --tasks TASK --write
"""
_LINE = 200


@checked(TaskError)
@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """One training with a seed, and what its policy reached."""

    seed: int
    """Seed of the training."""
    date: str
    """Day of the measurement, as YYYY-MM-DD."""
    commit: str
    """Commit of the source that was measured."""
    episodes: int
    """Episodes of the evaluation."""
    attempts: int
    """Goals that were tried in them."""
    success: int
    """Goals that were reached."""
    effective: float | None = None
    """Independent attempts that count as much as these; None for all of them."""
    distinct: int | None = None
    """Episodes that differ; None where it was not recorded."""
    collisions: int | None = None
    """Attempts that ended in a collision; None if unknown."""
    timeouts: int | None = None
    """Attempts that ran out of time; None where it was not recorded."""
    cpu: float
    """Processor time of the training [s]."""
    wall: float | None = None
    """Wall time of the training [s]; None where it was not measured."""
    processors: int | None = None
    """Processors that the training could run on."""
    others: float | None = None
    """Processors that other programs kept busy meanwhile, on average."""

    @property
    def rate(self) -> SuccessRate:
        """Share of goals reached, with the 95 % interval of this policy."""
        return SuccessRate(self.success, self.attempts, self.effective)


@checked(TaskError)
@dataclass(frozen=True, slots=True, kw_only=True)
class Claim:
    """The success rate of one task, algorithm and evaluation, over seeds."""

    task: str
    """Name of the task."""
    algo: str
    """Algorithm of the training."""
    engine: str
    """Engine of the evaluation."""
    goals: str = HELD_OUT
    """Goals of the evaluation: ``held-out``, ``in a row`` or ``published``."""
    train: str
    """Command that trains, without ``--seed`` and ``--out``."""
    evaluate: str
    """Command that evaluates; ``RUN`` stands for the folder of the run."""
    trials: tuple[Trial, ...] = ()
    """One for each seed; none where it was not measured yet."""

    @property
    def key(self) -> tuple[str, str, str]:
        """Command of the training, engine and goals of the evaluation: what identifies a claim."""
        return self.train, self.engine, self.goals

    @property
    def of_recipe(self) -> bool:
        """True if the training is that of the task's recipe, without an option."""
        return self.train == training_command(self.task)

    @property
    def seeds(self) -> tuple[int, ...]:
        """Seeds in ascending order."""
        return tuple(trial.seed for trial in self.trials)

    @property
    def success(self) -> SuccessRate | None:
        """Goals reached by all seeds together; None where nothing was measured."""
        return _summed(trial.rate for trial in self.trials)

    @property
    def predicted(self) -> tuple[float, float] | None:
        """Interval of one more seed's rate, see `predicted_range`; None for fewer than two seeds."""
        return predicted_range([trial.rate for trial in self.trials])

    def predicted_for(self, episodes: float) -> tuple[float, float] | None:
        """Return `predicted` for an evaluation of a given number of independent attempts."""
        return predicted_range([trial.rate for trial in self.trials], episodes)

    @property
    def cpu(self) -> float | None:
        """Mean processor time of a training [s]; None where nothing was measured."""
        return _mean([trial.cpu for trial in self.trials])

    @property
    def wall(self) -> float | None:
        """Mean wall time of a training [s]; None where a seed has none."""
        times = [trial.wall for trial in self.trials if trial.wall is not None]
        return _mean(times) if len(times) == len(self.trials) else None

    @property
    def others(self) -> float | None:
        """Processors that other programs kept busy meanwhile, on average."""
        return _mean([trial.others for trial in self.trials if trial.others is not None])

    @property
    def commits(self) -> tuple[str, ...]:
        """Commits that were measured, by seed, each once."""
        return tuple(dict.fromkeys(trial.commit for trial in self.trials))

    @property
    def dates(self) -> tuple[str, ...]:
        """Days of the measurements in order, each once."""
        return tuple(sorted({trial.date for trial in self.trials}))

    def with_trial(self, trial: Trial) -> Claim:
        """Return the claim with a trial added, which replaces one of the same seed."""
        others = [each for each in self.trials if each.seed != trial.seed]
        trials = sorted([*others, trial], key=lambda each: each.seed)
        return dataclasses.replace(self, trials=tuple(trials))


@checked(TaskError)
@dataclass(frozen=True, slots=True)
class Claims:
    """All published success rates."""

    claims: tuple[Claim, ...]
    """In the order of the file."""
    unverified: Mapping[str, str]
    """Why a task has no success rate, by its name; one line each."""

    def of(self, task: str, algo: str | None = None) -> tuple[Claim, ...]:
        """Return the claims of a task on held-out goals, one for each engine.

        Args:
            task: Name of the task.
            algo: Algorithm, given with ``--algo``; by default that of the recipe.
        """
        return self.of_training(training_command(task, algo))

    def of_training(self, train: str, goals: str = HELD_OUT) -> tuple[Claim, ...]:
        """Return the claims of a training, one for each engine.

        Args:
            train: Command of the training, as in `Claim.train`.
            goals: Goals of the evaluation.
        """
        return tuple(claim for claim in self.claims if (claim.train, claim.goals) == (train, goals))

    def other_trainings(self, task: str) -> tuple[str, ...]:
        """Return the commands that train a task otherwise than by its recipe."""
        own = [claim for claim in self.claims if claim.task == task and not claim.of_recipe]
        return tuple(dict.fromkeys(claim.train for claim in own))

    def find(self, key: tuple[str, str, str]) -> Claim | None:
        """Return the claim with this `Claim.key`; None where there is none."""
        return next((claim for claim in self.claims if claim.key == key), None)

    def with_claim(self, claim: Claim) -> Claims:
        """Return all claims with this one, which replaces one of the same key."""
        known = {each.key: each for each in self.claims} | {claim.key: claim}
        unverified = {name: why for name, why in self.unverified.items() if name != claim.task}
        return Claims(tuple(sorted(known.values(), key=_place)), unverified)

    def write(self, file: Path) -> None:
        """Write them to a file, which is replaced as a whole.

        Raises:
            OSError: It cannot be written.
        """
        unverified = yaml.safe_dump({"unverified": dict(self.unverified)}, width=_LINE)
        claims = yaml.safe_dump(
            {"claims": [_to_dict(claim) for claim in self.claims]},
            sort_keys=False,
            width=_LINE,
            default_flow_style=None,  # a mapping of scalars only, such as a trial, is one line
        )
        write_text(file, _HEAD + unverified + claims)


def training_command(task: str, algo: str | None = None) -> str:
    """Return the command that trains a task with its recipe, or with that of an algorithm."""
    return f"gazelle train {task}" if algo is None else f"gazelle train {task} --algo {algo}"


def read_claims(file: Path = CLAIMS_FILE) -> Claims:
    """Read success rates from a file.

    Args:
        file: By default the file of this package.

    Raises:
        FormatError: The file is not valid.
    """
    loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        data = yaml.load(file.read_text(encoding="utf-8"), loader)  # noqa: S506  # a safe loader
        claims = tuple(map(_to_claim, data["claims"]))
        return Claims(claims, dict(data["unverified"]))
    except (yaml.YAMLError, KeyError, TypeError, ValueError, AttributeError) as error:
        raise FormatError(
            f"the claims cannot be read: {type(error).__name__}: {error}",
            file=str(file),
            hint="restore it with 'git checkout', then write it with 'gazelle bench recipes --write'",
        ) from error


@lru_cache(maxsize=1)
def published_claims() -> Claims:
    """Return the success rates of this package, read once."""
    return read_claims()


def _place(claim: Claim) -> tuple[str, str, str, bool, str]:
    """Return what claims are sorted by: the plane, where bases are trained, comes first."""
    return claim.task, claim.train, claim.goals, claim.engine != "planar", claim.engine


def _to_claim(data: dict[str, Any]) -> Claim:
    return Claim(**data | {"trials": tuple(Trial(**each) for each in data.get("trials") or ())})


def _to_dict(claim: Claim) -> dict[str, Any]:
    fields = dataclasses.asdict(claim) | {"trials": [_known(trial) for trial in claim.trials]}
    if claim.goals == HELD_OUT:
        del fields["goals"]
    return fields


def _known(trial: Trial) -> dict[str, Any]:
    fields = dataclasses.asdict(trial).items()
    return {name: value for name, value in fields if value is not None}


def _summed(rates: Iterable[SuccessRate]) -> SuccessRate | None:
    known = tuple(rates)
    if not known:
        return None
    effective = sum(rate.total if rate.effective is None else rate.effective for rate in known)
    count, total = sum(rate.count for rate in known), sum(rate.total for rate in known)
    return SuccessRate(count, total, None if effective == total else effective)


def _mean(values: list[float]) -> float | None:
    return sum(values) / len(values) if values else None
