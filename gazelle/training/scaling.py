"""Observations to the range that networks like, as the first layer of the network itself.

Entries with bounds that fit the observations are mapped from them to [-1, 1], once and for all. An
entry without bounds, or one that spreads over so little of them that a network would hardly see it
change, is normalised by what was observed so far. Either way it is one factor and one summand an entry,
which fold exactly into the first layer of the numpy actor, and all of it is saved with the weights.
"""

from __future__ import annotations

from collections.abc import Sequence

import gymnasium as gym
import numpy as np
import numpy.typing as npt
import torch
from stable_baselines3.common.torch_layers import BaseFeaturesExtractor

from gazelle.array_types import Floats, Floats32
from gazelle.training.bearing import Bearing
from gazelle.training.features import LEAST, MIDDLE, Features

_LARGEST_BOUND = 1e4
# Least standard deviation of an entry with fitting bounds, as a share of their span: a tenth of what
# an entry has that fills them evenly. The range says less, as one rare value can fill it.
_LEAST_SPREAD = 0.03
_FARTHEST = 10.0  # from the mean, in what the network sees
_SMALLEST = 1e-6  # spread, relative to the mean, that is more than rounding

_COUNT, _DECIDED = 0, 1
_MEAN, _SQUARES, _LOW, _HIGH, _UNBOUNDED = range(5)


class ObservationScale:
    """The scale of each entry, shared by all networks of a learner.

    Moments are merged as in T. F. Chan, G. H. Golub and R. J. LeVeque, "Updating formulae and a
    pairwise algorithm for computing sample variances" (1979).

    Args:
        space: A Box.
        scale: False keeps all entries as they are, for good.
        cut: At how many standard deviations from the mean entries that are normalised end; None for
            nowhere, and then the farthest that was observed counts for how they are scaled.

    Attributes:
        gain: Factor of an entry, shape (entries,).
        offset: Offset added afterwards, shape (entries,).
        limits: Limits of entries before that, least and greatest, shape (2, entries).
        moments: Of what was observed: mean, squared deviations, least, greatest, and whether the
            entry is normalised by them, shape (5, entries).
        tally: Number of observations, and whether the normalised entries are decided.
    """

    def __init__(
        self, space: gym.spaces.Box, *, scale: bool = True, cut: float | None = None
    ) -> None:
        low = space.low.reshape(-1).astype(np.float64)
        high = space.high.reshape(-1).astype(np.float64)
        bounded = (np.abs(low) < _LARGEST_BOUND) & (np.abs(high) < _LARGEST_BOUND) & (high > low)
        self._scale, self._cut = scale, cut
        self._span = np.where(bounded, high - low, np.inf)
        bounded &= scale
        low, high = np.where(bounded, low, -1.0), np.where(bounded, high, 1.0)
        span, centre = high - low, 0.5 * (high + low)
        self.gain = torch.as_tensor(2.0 / span, dtype=torch.float32)
        self.offset = torch.as_tensor(-2.0 * centre / span, dtype=torch.float32)
        self.moments = torch.zeros((5, len(low)), dtype=torch.float64)
        self.tally = torch.zeros(2, dtype=torch.float64)
        self.limits = torch.full((2, len(low)), torch.inf)
        self.limits[0] = -torch.inf
        self.moments[_LOW], self.moments[_HIGH] = torch.inf, -torch.inf

    @property
    def normalised(self) -> npt.NDArray[np.bool_]:
        """Mask of the entries that are normalised by observed moments, shape (entries,)."""
        unbounded: npt.NDArray[np.bool_] = self.moments.numpy()[_UNBOUNDED] != 0.0
        return unbounded

    @property
    def cuts(self) -> bool:
        """True if any entry can be clipped."""
        return self._cut is not None

    @property
    def decided(self) -> bool:
        """True once it is decided which entries are normalised."""
        return bool(self.tally.numpy()[_DECIDED])  # several times as fast as indexing a tensor

    def observe(self, observations: Floats32) -> None:
        """Update the statistics by observations, shape (N, ...)."""
        if not self._scale or (self.decided and not np.count_nonzero(self.normalised)):
            return
        rows: Floats = observations.reshape(len(observations), -1).astype(np.float64)
        moments, tally = self.moments.numpy(), self.tally.numpy()
        before, total = tally[_COUNT], tally[_COUNT] + len(rows)
        mean = rows.mean(axis=0)
        away = mean - moments[_MEAN]
        moments[_SQUARES] += ((rows - mean) ** 2).sum(axis=0)
        moments[_SQUARES] += away**2 * (before * len(rows) / total)
        moments[_MEAN] += away * (len(rows) / total)
        np.minimum(moments[_LOW], rows.min(axis=0), out=moments[_LOW])
        np.maximum(moments[_HIGH], rows.max(axis=0), out=moments[_HIGH])
        tally[_COUNT] = total

    def refresh(self) -> bool:
        """Update the scaling from the observations so far; call it between rollouts.

        Returns:
            Whether this was the first time, and changed something.
        """
        moments, tally = self.moments.numpy(), self.tally.numpy()
        if not self._scale or tally[_COUNT] == 0.0:
            return False
        first = not self.decided
        mean = moments[_MEAN]
        spread = np.sqrt(moments[_SQUARES] / tally[_COUNT])
        if first:
            moments[_UNBOUNDED] = spread < _LEAST_SPREAD * self._span
            tally[_DECIDED] = 1.0
        reach = np.maximum(moments[_HIGH] - mean, mean - moments[_LOW])
        size = spread if self.cuts else np.maximum(spread, reach / _FARTHEST)
        some = self.normalised & (size > _SMALLEST * np.maximum(np.abs(mean), _SMALLEST))
        self.gain.numpy()[some] = 1.0 / size[some]
        self.offset.numpy()[some] = -mean[some] / size[some]
        if self._cut is not None:
            self.limits.numpy()[:, some] = (mean + np.outer([-self._cut, self._cut], size))[:, some]
        return first and bool(some.any())


class ScaledObservations(BaseFeaturesExtractor):  # type: ignore[misc]  # untyped base
    """Flattens, scales each entry, and adds `Features` and differences if requested.

    Args:
        observation_space: A Box.
        scale: By what; that of all networks of the learner. By default the bounds alone.
        features: Whether sines, cosines and logarithms are added by the bounds.
        angles: Entries with sines and cosines added in any case.
        bearing: Of a fixed goal, if that is added.
        goals: Places of achieved and desired goal, if their difference is added,
            scaled as the goal is.
    """

    def __init__(
        self,
        observation_space: gym.spaces.Box,
        *,
        scale: ObservationScale | None = None,
        features: bool = False,
        angles: Sequence[int] = (),
        bearing: Bearing | None = None,
        goals: tuple[slice, slice] | None = None,
    ) -> None:
        scale = scale or ObservationScale(observation_space)
        size = int(np.prod(observation_space.shape))
        self.features = None
        if features or angles or bearing is not None:
            self.features = Features.of(
                observation_space, by_bounds=features, angles=angles, bearing=bearing
            )
        added = 0 if self.features is None else self.features.count
        self.goals = goals
        if goals is not None:
            added += goals[1].stop - goals[1].start
        super().__init__(observation_space, features_dim=size + added)
        # The very tensors of the scale, which changes them in place.
        for name in ("gain", "offset", "moments", "tally", *(["limits"] if scale.cuts else [])):
            self.register_buffer(name, getattr(scale, name))
        self.cuts = scale.cuts
        if self.features is not None:
            for name in ("angles", "magnitudes", "spans"):
                values = torch.as_tensor(getattr(self.features, name))
                self.register_buffer(f"_{name}", values, persistent=False)

    def forward(self, observations: torch.Tensor) -> torch.Tensor:
        """Map shape (N, ...) to (N, entries and those added)."""
        flat = observations.flatten(1)
        if self.cuts:
            flat = flat.clamp(*self.limits)
        parts = [flat * self.gain + self.offset]
        if self.features is not None:
            parts.append(self._added(flat))
        if self.goals is not None:
            achieved, desired = self.goals
            parts.append((flat[:, desired] - flat[:, achieved]) * self.gain[desired])
        return torch.cat(parts, dim=1) if len(parts) > 1 else parts[0]

    def _added(self, flat: torch.Tensor) -> torch.Tensor:
        """Return the features that `Features.added_to` adds, shape (N, added)."""
        angles = flat[:, self._angles]
        share = (flat[:, self._magnitudes] / self._spans).clamp(min=0.0)
        parts = [angles.sin(), angles.cos(), (share + LEAST).log() + MIDDLE]
        if self.features is not None and self.features.bearing is not None:
            parts.append(self.features.bearing.of_tensor(flat))
        return torch.cat(parts, dim=1)
