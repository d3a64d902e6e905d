"""Sines, cosines, logarithms and bearings of observations, which small networks are slow to make themselves.

To keep away from what is near, a policy must distinguish 0.2 m from 0.3 m and need not distinguish 2.2 m from
2.3 m; and an angle of pi is one of -pi. What an entry is shows in its bounds: one between -pi and
pi is an angle, one that cannot be negative is a range, a distance or a count. Angles of joints have
limits of their own, so those have to be named.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import gymnasium as gym
import numpy as np

from gazelle.array_types import Floats32, Indices
from gazelle.errors import TaskError
from gazelle.training import bearing as bearings
from gazelle.training.bearing import Bearing

LEAST = 0.03
"""Share of an entry's upper bound below which its logarithm hardly changes."""
MIDDLE = 1.75
"""Added to logarithms, so that they lie between -1.76 and 1.78."""
_ROUNDED = 0.01
"""Bounds of an angle may be off by so much [rad]: published tasks write 3.14 or 3.15."""


@dataclass(frozen=True, slots=True)
class Features:
    """Features that are added to observations.

    Attributes:
        angles: The entries with added sines and cosines, shape (a,).
        magnitudes: Those with added logarithms, shape (m,).
        spans: The upper bounds of those, shape (m,), float32.
        bearing: Of a fixed goal, if that is added.
    """

    angles: Indices
    magnitudes: Indices
    spans: Floats32
    bearing: Bearing | None = None

    @classmethod
    def of(
        cls,
        space: gym.spaces.Box,
        *,
        by_bounds: bool = True,
        angles: Sequence[int] = (),
        bearing: Bearing | None = None,
    ) -> Features:
        """Return the features that the bounds of a space and the given entries call for.

        Args:
            space: Of the observations.
            by_bounds: Whether bounds count.
            angles: Entries that are angles anyway.
            bearing: Of a fixed goal, if that shall be added.

        Raises:
            TaskError: There is no such entry.
        """
        low, high = space.low.reshape(-1), space.high.reshape(-1)
        for entry in angles:
            if not 0 <= entry < len(low):
                hint = f"observations have entries 0 to {len(low) - 1}"
                raise TaskError(f"there is no entry {entry} that could be an angle", hint=hint)
        if bearing is not None:
            bearing.check(len(low))
        pi = np.float32(np.pi)
        with np.errstate(invalid="ignore"):
            turning = (np.abs(low + pi) < _ROUNDED) & (np.abs(high - pi) < _ROUNDED) & by_bounds
        turning[list(angles)] = True
        magnitudes = (low >= 0) & (high > low) & np.isfinite(high) & by_bounds
        return cls(
            np.flatnonzero(turning),
            np.flatnonzero(magnitudes),
            high[magnitudes].astype(np.float32),
            bearing,
        )

    @property
    def count(self) -> int:
        """Number of added entries."""
        steered = 0 if self.bearing is None else bearings.COUNT
        return 2 * len(self.angles) + len(self.magnitudes) + steered

    def added_to(self, obs: Floats32) -> Floats32:
        """Return observations of shape (N, entries) with the added ones appended, float32."""
        angles = obs[:, self.angles]
        share = np.maximum(obs[:, self.magnitudes] / self.spans, np.float32(0))
        logs = np.log(share + np.float32(LEAST)) + np.float32(MIDDLE)
        parts = [obs, np.sin(angles), np.cos(angles), logs]
        if self.bearing is not None:
            parts.append(self.bearing.of(obs))
        result: Floats32 = np.concatenate(parts, axis=1, dtype=np.float32)
        return result
