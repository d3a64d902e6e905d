"""Prediction interval for the success rate of one more training.

A recipe is trained with a few seeds, and each policy is evaluated on a number of episodes. Someone
the same commands with another seed differ from these by two things: by what
seeds make of a policy, and by which episodes are drawn.

Rates are compared as angles, for which the variance of a binomial share hardly depends on the share
(F. J. Anscombe, "The transformation of Poisson, binomial and negative-binomial data", Biometrika
35 (1948) 246-254). The variance between seeds contains both causes, so the interval for one more
seed is that of one more normal observation, with Student's t and k - 1 degrees of freedom
(G. J. Hahn and W. Q. Meeker, "Statistical Intervals", 1991, sec. 4.7). Seeds that happen to agree
do not make it shorter than it would be if seeds made no difference at all.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from gazelle.argument_checks import checked
from gazelle.errors import TaskError
from gazelle.training.statistics import Z_95, SuccessRate, student_quantile


@checked(TaskError)
def predicted_range(
    rates: Sequence[SuccessRate], episodes: float | None = None
) -> tuple[float, float] | None:
    """Return the interval in which one more seed's rate lies with a probability of 95 %.

    Args:
        rates: Rate of each seed.
        episodes: Independent attempts of the new evaluation; by default as many as those of a seed.

    Returns:
        Lower and upper end, within 0 and 1; None for fewer than two seeds, which do not show how
        much seeds differ.

    Raises:
        TaskError: The episodes are not above zero.
    """
    if episodes is not None and not episodes > 0:
        raise TaskError(f"a seed is evaluated in more than {episodes:g} episodes")
    seeds = len(rates)
    if seeds < 2:
        return None
    sizes = [rate.total if rate.effective is None else rate.effective for rate in rates]
    angles = [_to_angle(rate.value, size) for rate, size in zip(rates, sizes, strict=True)]
    mean = math.fsum(angles) / seeds
    between = math.fsum((angle - mean) ** 2 for angle in angles) / (seeds - 1)
    within = math.fsum(map(_variance, sizes)) / seeds
    new = math.fsum(sizes) / seeds if episodes is None else episodes
    more = _variance(new) - within
    differing = student_quantile(seeds - 1) * math.sqrt(between * (1 + 1 / seeds) + max(0.0, more))
    alike = Z_95 * math.sqrt(within * (1 + 1 / seeds) + more)
    spread = max(differing, alike)
    return _to_share(mean - spread, new), _to_share(mean + spread, new)


def _variance(size: float) -> float:
    """Return the variance of the angle of a share of a given number of attempts."""
    return 1.0 / (4.0 * size + 2.0)


def _to_angle(share: float, size: float) -> float:
    return math.asin(math.sqrt((share * size + 0.375) / (size + 0.75)))


def _to_share(angle: float, size: float) -> float:
    sine = math.sin(min(max(angle, 0.0), math.pi / 2))
    return min(max((sine**2 * (size + 0.75) - 0.375) / size, 0.0), 1.0)
