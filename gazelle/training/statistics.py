"""Rates with honest intervals, and a running account of the latest episodes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from gazelle.argument_checks import checked
from gazelle.errors import TaskError
from gazelle.training.episodes import Episodes

Z_95 = 1.959963984540054
_COLUMNS = ("return", "length", "goals", "attempts", "collisions", "timeouts")
_ENDS = {"success_rate": "goals", "collision_rate": "collisions", "timeout_rate": "timeouts"}


@checked(TaskError)
@dataclass(frozen=True, slots=True)
class SuccessRate:
    """Rate of an event, with a 95 % confidence interval."""

    count: int
    """Number of times it happened."""
    total: int
    """Number of times it could have happened."""
    effective: float | None = None
    """Effective number of independent draws; None for all of them."""

    @property
    def value(self) -> float:
        """Share, 0 to 1 (0 of nothing)."""
        return self.count / self.total if self.total else 0.0

    @property
    def interval(self) -> tuple[float, float]:
        """Lower and upper end of the 95 % interval; see `wilson_interval`."""
        size = self.total if self.effective is None else self.effective
        return wilson_interval(self.value * size, size)


@checked(TaskError)
def wilson_interval(count: float, total: float, z: float = Z_95) -> tuple[float, float]:
    """Return the confidence interval of a share, valid near 0 and 1 too.

    The score interval of E. B. Wilson, "Probable inference, the law of
    succession, and statistical inference", JASA 22 (1927) 209-212.

    Args:
        count: Number of occurrences.
        total: Number of trials; an effective number may have a fraction.
        z: Quantile of the normal distribution; the default gives 95 %.

    Returns:
        Lower and upper end, within 0 and 1.

    Raises:
        TaskError: The count is not within 0 and the total, or the quantile not above zero.
    """
    if not 0 <= count <= total or not z > 0:
        raise TaskError(f"there is no share of {count:g} in {total:g} with a quantile of {z:g}")
    if total == 0:
        return 0.0, 1.0
    share = count / total
    spread = z * math.sqrt(share * (1 - share) / total + z**2 / (4 * total**2))
    scale = 1 + z**2 / total
    centre = share + z**2 / (2 * total)
    return max(0.0, (centre - spread) / scale), min(1.0, (centre + spread) / scale)


def clustered_rate(
    counts: npt.NDArray[np.int64], totals: npt.NDArray[np.int64], clusters: npt.NDArray[np.int64]
) -> SuccessRate:
    """Return a rate over episodes of which some are repetitions of others.

    Repetitions count less than fresh draws: nothing more where they end alike. The number of
    draws that the interval counts is the total divided by the design effect of the clusters
    (E. L. Korn and B. I. Graubard, "Confidence intervals for proportions with small expected
    number of positive counts estimated from survey data", Survey Methodology 24 (1998)
    193-201), never more than the total. The variance is that of a ratio between clusters
    (W. G. Cochran, "Sampling Techniques", 3rd ed., 1977, sec. 2.11).

    Args:
        counts: Number of occurrences in each episode, shape (n,).
        totals: Number of trials, shape (n,).
        clusters: Groups of equal episodes: equal numbers from 0 up, shape (n,).
    """
    count, total = int(counts.sum()), int(totals.sum())
    sizes = np.bincount(clusters, weights=totals)
    hits = np.bincount(clusters, weights=counts)
    sizes, hits = sizes[sizes > 0], hits[sizes > 0]
    many = len(sizes)
    if sizes.max(initial=0.0) <= 1:
        return SuccessRate(count, total)
    # If all attempts of a cluster end alike (L. Kish, "Survey Sampling", 1965, sec. 8.2).
    alike = total**2 / float((sizes**2).sum())
    # Few clusters say little about how alike their attempts end. Two more that are, one of each
    # kind, keep the interval from being too short, as Agresti's and Coull's do for a share.
    usual = total / many
    sizes = np.append(sizes, (usual, usual))
    hits = np.append(hits, (usual, 0.0))
    share = hits.sum() / sizes.sum()
    variance = float(((hits - share * sizes) ** 2).sum()) / sizes.sum() ** 2
    draws = share * (1.0 - share) / variance * many / (many + 2)
    return SuccessRate(count, total, float(min(max(draws, alike), total)))


def rate_between_worlds(
    counts: npt.NDArray[np.int64], totals: npt.NDArray[np.int64], worlds: npt.NDArray[np.int64]
) -> SuccessRate:
    """Return a rate over episodes that are correlated within the same world.

    A robot that blocks an aisle blocks it for all. How much is seen from how far apart worlds are, with
    the variance of a ratio between them and Student's distribution for their number (E. L. Korn
    and B. I. Graubard, see `clustered_rate`). Worlds without a difference say nothing about it; then they count
    as repetitions do.

    Args:
        counts: Number of occurrences in each episode, shape (n,).
        totals: Number of trials, shape (n,).
        worlds: Groups of episodes in the same world: equal numbers from 0 up, shape (n,).
    """
    count, total = int(counts.sum()), int(totals.sum())
    sizes = np.bincount(worlds, weights=totals)
    hits = np.bincount(worlds, weights=counts)[sizes > 0]
    sizes = sizes[sizes > 0]
    many = len(sizes)
    share = count / total if total else 0.0
    errors = float(((hits - share * sizes) ** 2).sum())
    if many < 2 or errors == 0.0:
        return clustered_rate(counts, totals, worlds)
    alike = total**2 / float((sizes**2).sum())
    variance = errors / total**2 * many / (many - 1)
    draws = share * (1.0 - share) / variance * (Z_95 / student_quantile(many - 1)) ** 2
    return SuccessRate(count, total, float(min(max(draws, alike), total)))


def student_quantile(freedom: int) -> float:
    """Return the quantile of Student's t for a two-sided 95 %, to 1 % or better.

    M. Abramowitz and I. A. Stegun, "Handbook of Mathematical Functions", 1964, 26.7.5; one and two
    degrees of freedom have closed forms.
    """
    if freedom == 1:
        return math.tan(0.95 * math.pi / 2)
    if freedom == 2:
        return 0.95 * math.sqrt(2.0 / (1.0 - 0.95**2))
    z = Z_95
    terms = (
        z,
        (z**3 + z) / 4,
        (5 * z**5 + 16 * z**3 + 3 * z) / 96,
        (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / 384,
    )
    return float(sum(term / freedom**power for power, term in enumerate(terms)))


class EpisodeLog:
    """Returns, lengths and outcomes of the latest episodes.

    Args:
        window: Number of episodes to average.
    """

    def __init__(self, window: int = 200) -> None:
        self.window = window
        self.total = 0
        self._rows: npt.NDArray[np.float64] = np.zeros((0, len(_COLUMNS)))

    def add(self, episodes: Episodes) -> None:
        """Add the episodes that ended in one step."""
        unknown = np.full(len(episodes.slots), np.nan)
        outcomes = episodes.outcomes
        collisions, timeouts = (
            each & episodes.counted for each in (episodes.collisions, episodes.timeouts)
        )
        columns = {
            "return": episodes.returns,
            "length": episodes.lengths,
            "goals": episodes.counted_goals if "is_success" in outcomes else unknown,
            "attempts": episodes.attempts,
            "collisions": collisions if "is_collision" in outcomes else unknown,
            "timeouts": timeouts if "is_timeout" in outcomes else unknown,
        }
        rows = np.column_stack([columns[name] for name in _COLUMNS])
        self._rows = np.concatenate([self._rows, rows])[-self.window :]
        self.total += len(rows)

    def summary(self) -> dict[str, float]:
        """Return the means over the window, as far as the environment reports them.

        ``return`` and ``length`` are means over episodes; ``success_rate``,
        ``collision_rate`` and ``timeout_rate`` are shares of the goals that were tried, see
        `Episodes`: with one goal an episode, of the episodes.
        """
        if not len(self._rows):
            return {}
        means = dict(zip(_COLUMNS, self._rows.mean(axis=0).tolist(), strict=True))
        attempts = means.pop("attempts")
        for name, ends in _ENDS.items():
            ended = means.pop(ends)
            means[name] = ended / attempts if attempts else math.nan
        return {name: mean for name, mean in means.items() if not math.isnan(mean)}

    def succeeds(self, share: float) -> bool:
        """Return whether at least a given share of a whole window were successes."""
        return len(self._rows) == self.window and self.summary().get("success_rate", 0.0) >= share

    def get_state(self) -> dict[str, Any]:
        """Return the account, for a checkpoint."""
        return {"rows": self._rows, "total": self.total}

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore an account that `get_state` returned."""
        rows = np.array(state["rows"], np.float64)
        self._rows, self.total = rows.reshape(-1, len(_COLUMNS)), int(state["total"])
