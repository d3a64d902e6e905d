"""Tables of success rates, in Markdown that is aligned for terminals as well."""

from __future__ import annotations

import shlex
from collections.abc import Sequence

from gazelle.training.claims import Claim

_SHORT = ("training", "evaluated in", "success", "of each seed", "one more seed", "processor time")
_LONG = ("training", "evaluated in", "goals", *_SHORT[2:-1], "collided", "late")


def table(claims: Sequence[Claim], *, long: bool) -> str:
    """Return a row for each claim, and a line that says when they were measured.

    Args:
        claims: In the order of the rows.
        long: Also show which goals were evaluated and how attempts failed.
    """
    head = _LONG if long else _SHORT
    rows = [head, *(_long(claim) if long else _short(claim) for claim in claims)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    rows.insert(1, ["-" * width for width in widths])
    padded = [[f"{cell:<{width}}" for cell, width in zip(row, widths, strict=True)] for row in rows]
    lines = "".join(f"| {' | '.join(row)} |\n" for row in padded)
    return f"{lines}\n{_source(claims)}\n"


def _short(claim: Claim) -> list[str]:
    cpu = "" if claim.cpu is None else f"{claim.cpu:.0f} s"
    return [f"`{name(claim)}`", claim.engine, *_rates(claim), cpu]


def _long(claim: Claim) -> list[str]:
    ends = [_share(claim, end) for end in ("collisions", "timeouts")]
    return [f"`{name(claim)}`", claim.engine, claim.goals, *_rates(claim), *ends]


def name(claim: Claim) -> str:
    """Return what stands behind ``gazelle train`` in the command of a training."""
    return claim.train.removeprefix("gazelle train ")


def _rates(claim: Claim) -> list[str]:
    """Return the cells of the success rate, of each seed, and of one more seed."""
    success = claim.success
    if success is None:
        return ["not measured yet", "", ""]
    each = ", ".join(percent(trial.rate.value) for trial in claim.trials)
    tried = sorted({trial.attempts for trial in claim.trials})
    several = f"{tried[0]:,}" if len(tried) == 1 else f"{tried[0]:,} to {tried[-1]:,}"
    return [f"{percent(success.value)} %", f"{each} of {several}", expected(claim)]


def expected(claim: Claim) -> str:
    """Return the interval of one more seed, or that there is only one."""
    interval = claim.predicted
    return "one seed" if interval is None else f"{' to '.join(map(percent, interval))} %"


def _share(claim: Claim, end: str) -> str:
    counts = [getattr(trial, end) for trial in claim.trials]
    if not counts or None in counts:
        return ""
    return f"{percent(sum(counts) / sum(trial.attempts for trial in claim.trials))} %"


def percent(share: float) -> str:
    """Return a share in per cent with one decimal, without a sign."""
    return f"{100.0 * share:.1f}"


def _source(claims: Sequence[Claim]) -> str:
    """Return one line with days, commits and the command that measures again."""
    trials = [trial for claim in claims for trial in claim.trials]
    days = sorted({trial.date for trial in trials})
    commits = sorted({f"`{trial.commit}`" for trial in trials})
    when = (
        f"Measured {' to '.join(dict.fromkeys((days[0], days[-1])))} at {', '.join(commits)}; "
        if days
        else ""
    )
    names = shlex.join(dict.fromkeys(name(claim) for claim in claims))
    return f"{when}again: `gazelle bench recipes --tasks {names}`."
