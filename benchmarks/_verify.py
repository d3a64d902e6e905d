"""Trainings of today's code beside the published success rates."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from _campaign import Campaign
from _checkout import commit
from _claim_table import name, percent

from gazelle.training.claims import HELD_OUT, Claim, Trial

CHEAP = 25.0
"""Processor time of a training up to which it is cheap [s]."""
_FIRST_SEED, _SEEDS = 100, 900


@dataclass(frozen=True, slots=True)
class Comparison:
    """A success rate of today beside the published interval."""

    claim: Claim
    trial: Trial

    @property
    def expected(self) -> tuple[float, float] | None:
        """Interval for as many attempts; None where one seed was published."""
        return self.claim.predicted_for(self.trial.effective or self.trial.attempts)

    @property
    def below(self) -> bool:
        """Return True if the rate falls below the interval."""
        return self.expected is not None and self.trial.rate.value < self.expected[0]

    def __str__(self) -> str:
        """Return one line with rate, interval and outcome."""
        rate = f"{percent(self.trial.rate.value)} %"
        if self.expected is None:
            outcome = f"one seed is published, {percent(self.claim.trials[0].rate.value)} %"
        else:
            low, high = map(percent, self.expected)
            outcome = f"{low} to {high} %{', BELOW' if self.below else ''}"
        about = f"{name(self.claim)} --seed {self.trial.seed}"
        return f"{about:<45}{self.claim.engine:<8}{rate:>8}   published: {outcome}"


def seed_of(turn: int) -> int:
    """Return the seed of a turn, which is none of those that figures are published of."""
    return _FIRST_SEED + turn % _SEEDS


def worth_verifying(claims: Sequence[Claim], *, cheap: bool) -> list[Claim]:
    """Return the claims that there are figures of; of those of one training all or none."""
    return [
        claim
        for claim in claims
        if claim.cpu is not None and claim.goals == HELD_OUT and (not cheap or claim.cpu < CHEAP)
    ]


def within(claims: Sequence[Claim], budget: float, turn: int) -> list[Claim]:
    """Return those of the trainings whose turn it is that fit a budget of processor time [s].

    Each turn begins one training later than the one before, and goes round.
    """
    times = {claim.train: claim.cpu or 0.0 for claim in claims}
    trains = sorted(times)
    start = turn % max(len(trains), 1)
    chosen, left = set(), budget
    for train in [*trains[start:], *trains[:start]]:
        left -= times[train]
        if left < 0.0 and chosen:
            break
        chosen.add(train)
    return [claim for claim in claims if claim.train in chosen]


def verify(claims: Sequence[Claim], seeds: Sequence[int], out: Path) -> list[Comparison]:
    """Train and evaluate claims, print each comparison, and return those that failed.

    One rate in forty falls below its interval by chance. So a training with one that does is
    repeated with one more seed, and has failed where that falls below, too.
    """
    campaign = Campaign(seeds=seeds, commit=commit(), out=out, keep=False)
    again = replace(campaign, seeds=[max(seeds) + 1])
    low = [each for each in _compared(campaign, claims) if each.below]
    return [each for each in _compared(again, [each.claim for each in low]) if each.below]


def _compared(campaign: Campaign, claims: Sequence[Claim]) -> list[Comparison]:
    found = []
    for claim, trial in campaign.results(claims, {}):
        found.append(Comparison(claim, trial))
        sys.stdout.write(f"{found[-1]}\n")
        sys.stdout.flush()
    return found
