"""Rates with honest intervals, and a running account of the latest episodes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from gazelle.training.stepper import Episodes

_Z_95 = 1.959963984540054
_COLUMNS = ("return", "length", "goals", "attempts", "collision_rate", "timeout_rate")


@dataclass(frozen=True, slots=True)
class Rate:
    """How often something happened, with a 95 % confidence interval."""

    count: int
    """How often it happened."""
    total: int
    """How often it could have."""

    @property
    def value(self) -> float:
        """Share, 0 to 1 (0 of nothing)."""
        return self.count / self.total if self.total else 0.0

    @property
    def interval(self) -> tuple[float, float]:
        """Lower and upper end of the 95 % interval; see `wilson_interval`."""
        return wilson_interval(self.count, self.total)


def wilson_interval(count: int, total: int, z: float = _Z_95) -> tuple[float, float]:
    """Confidence interval of a share, also sound near 0 and 1.

    The score interval of E. B. Wilson, "Probable inference, the law of
    succession, and statistical inference", JASA 22 (1927) 209-212.

    Args:
        count: How often it happened.
        total: How often it could have.
        z: Quantile of the normal distribution; the default gives 95 %.

    Returns:
        Lower and upper end, within 0 and 1.
    """
    if total == 0:
        return 0.0, 1.0
    share = count / total
    spread = z * math.sqrt(share * (1 - share) / total + z**2 / (4 * total**2))
    scale = 1 + z**2 / total
    centre = share + z**2 / (2 * total)
    return max(0.0, (centre - spread) / scale), min(1.0, (centre + spread) / scale)


class EpisodeLog:
    """Returns, lengths and outcomes of the latest episodes.

    Args:
        window: How many episodes to look back on.
    """

    def __init__(self, window: int = 200) -> None:
        self.window = window
        self.total = 0
        self._rows: npt.NDArray[np.float64] = np.zeros((0, len(_COLUMNS)))

    def add(self, episodes: Episodes) -> None:
        """Take in the episodes that ended in one step."""
        unknown = np.full(len(episodes.slots), np.nan)
        known = {name: values.astype(np.float64) for name, values in episodes.outcomes.items()}
        success = known.get("is_success", unknown)
        timeout = known.get("is_timeout", np.zeros(len(episodes.slots)))
        undecided = (timeout > 0) & (episodes.goals > 0)
        failures = np.where(undecided, 0.0, 1.0 - success)
        columns = {
            "return": episodes.returns,
            "length": episodes.lengths,
            "goals": np.where(np.isnan(success), np.nan, episodes.goals),
            "attempts": episodes.goals + failures,
            "collision_rate": known.get("is_collision", unknown),
            "timeout_rate": known.get("is_timeout", unknown),
        }
        rows = np.column_stack([columns[name] for name in _COLUMNS])
        self._rows = np.concatenate([self._rows, rows])[-self.window :]
        self.total += len(rows)

    def summary(self) -> dict[str, float]:
        """What the window shows, as far as the environment tells it.

        ``return`` and ``length`` are means over episodes, ``collision_rate`` and
        ``timeout_rate`` shares of episodes. ``success_rate`` is the share of goals that
        were reached: every goal reached is a success, every episode that ends without
        reaching its last goal is a failure, unless time ran out on the way from one
        goal to the next. With one goal an episode that is the share of episodes.
        """
        if not len(self._rows):
            return {}
        means = dict(zip(_COLUMNS, self._rows.mean(axis=0).tolist(), strict=True))
        goals, attempts = means.pop("goals"), means.pop("attempts")
        means["success_rate"] = goals / attempts
        return {name: mean for name, mean in means.items() if not math.isnan(mean)}

    def get_state(self) -> dict[str, Any]:
        """The account, for a checkpoint."""
        return {"rows": self._rows, "total": self.total}

    def set_state(self, state: dict[str, Any]) -> None:
        """Continue an account that `get_state` returned."""
        self._rows, self.total = np.array(state["rows"]), int(state["total"])
