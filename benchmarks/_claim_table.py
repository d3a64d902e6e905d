"""The table of success rates that ``gazelle bench recipes`` prints."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.training.claims import Claim

_COLUMNS = (
    "engine",
    "goals",
    "tried",
    "of each seed",
    "all",
    "one more seed",
    "collided",
    "late",
    "CPU s",
)
_ENDS = ("collisions", "timeouts")


def table(claims: Sequence[Claim]) -> str:
    """Return a row for each claim: rates of each seed and of one more, and how others failed."""
    rows = [("task, or training", *_COLUMNS), *map(_row, claims)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    left = {0, 1, 2, 4}
    return "".join(
        "  ".join(
            cell.ljust(width) if place in left else cell.rjust(width)
            for place, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        + "\n"
        for row in rows
    )


def _row(claim: Claim) -> tuple[str, ...]:
    success, cpu = claim.success, claim.cpu
    name = claim.train.removeprefix("gazelle train ")
    if success is None or cpu is None:
        return name, claim.engine, claim.goals, "0", *("-" for _ in _COLUMNS[3:])
    return (
        name,
        claim.engine,
        claim.goals,
        f"{success.total}",
        " ".join(f"{percent(trial.rate.value):>5}" for trial in claim.trials),
        percent(success.value),
        expected(claim),
        *(_share(claim, name) for name in _ENDS),
        f"{cpu:.0f}",
    )


def percent(share: float) -> str:
    """Return a share with one decimal, without a sign."""
    return f"{100.0 * share:.1f}"


def expected(claim: Claim) -> str:
    """Return the interval of one more seed, or that there is only one seed."""
    if claim.predicted is None:
        return "one seed"
    low, high = claim.predicted
    return f"{percent(low)} to {percent(high)}"


def _share(claim: Claim, end: str) -> str:
    counts = [getattr(trial, end) for trial in claim.trials]
    if None in counts:
        return "-"
    return percent(sum(counts) / sum(trial.attempts for trial in claim.trials))
