"""Distance and direction to a fixed goal, computed from the observed position of the base.

A network must distinguish 0.05 m from 0.1 m beside a goal that x and y of a whole hall are
scaled by, and know sines and cosines to steer there. So it is given the logarithm of the distance,
and the direction as a vector of length 1: ahead and to the left.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.array_types import Floats32
from gazelle.errors import TaskError, did_you_mean

if TYPE_CHECKING:
    import torch  # policies act without it

COUNT = 3
"""Number of added entries: distance, ahead, left."""
NEAR = 0.03
"""Distance below which the logarithm hardly changes [m]."""
CENTRE, HALF = -0.6, 2.9
"""Logarithms of distances of 0 to 10 m lie this far to either side of this."""
SHORTEST = 1e-3
"""Directions of shorter ways are shortened [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Bearing:
    """Indices of the observation entries with the base's pose, and the goal's position."""

    x: int
    """Entry with the base's x [m]."""
    y: int
    """Entry with its y [m]."""
    yaw: int | None = None
    """Entry with its yaw [rad]; None where that is not observed: then ahead is along x."""
    goal: tuple[float, float]
    """Goal position, x and y [m]."""

    def check(self, entries: int) -> None:
        """Raise TaskError unless observations of a given number of entries have these."""
        for entry in (self.x, self.y, 0 if self.yaw is None else self.yaw):
            if not 0 <= entry < entries:
                hint = f"observations have entries 0 to {entries - 1}"
                raise TaskError(f"there is no entry {entry} for a bearing", hint=hint)

    def of(self, obs: Floats32) -> Floats32:
        """Return distance, ahead and left for observations (N, entries), shape (N, 3), float32."""
        dx = np.float32(self.goal[0]) - obs[:, self.x]
        dy = np.float32(self.goal[1]) - obs[:, self.y]
        away = np.sqrt(dx * dx + dy * dy)
        yaw = np.zeros_like(dx) if self.yaw is None else obs[:, self.yaw]
        cos, sin = np.cos(yaw), np.sin(yaw)
        length = np.maximum(away, np.float32(SHORTEST))
        distance = (np.log(away + np.float32(NEAR)) - np.float32(CENTRE)) / np.float32(HALF)
        ahead, left = (dx * cos + dy * sin) / length, (dy * cos - dx * sin) / length
        result: Floats32 = np.column_stack((distance, ahead, left)).astype(np.float32, copy=False)
        return result

    def of_tensor(self, obs: torch.Tensor) -> torch.Tensor:
        """Return the same as `of`, in torch."""
        import torch

        dx, dy = self.goal[0] - obs[:, self.x], self.goal[1] - obs[:, self.y]
        away = (dx * dx + dy * dy).sqrt()
        yaw = torch.zeros_like(dx) if self.yaw is None else obs[:, self.yaw]
        cos, sin = yaw.cos(), yaw.sin()
        length = away.clamp(min=SHORTEST)
        distance = ((away + NEAR).log() - CENTRE) / HALF
        ahead, left = (dx * cos + dy * sin) / length, (dy * cos - dx * sin) / length
        return torch.stack((distance, ahead, left), dim=1)


def bearing_of(value: Mapping[str, Any] | Bearing) -> Bearing:
    """Return a bearing of its values by name, as in JSON.

    Raises:
        TaskError: One is missing or unknown, or is invalid.
    """
    if isinstance(value, Bearing):
        return value
    known = ("x", "y", "yaw", "goal")
    for name in value if isinstance(value, Mapping) else ():
        if name not in known:
            raise TaskError(f"'{name}' is not part of Bearing", hint=did_you_mean(name, known))
    try:
        yaw = value.get("yaw")
        x, y = map(float, value["goal"])
        entries = {"x": int(value["x"]), "y": int(value["y"])}
        return Bearing(**entries, yaw=None if yaw is None else int(yaw), goal=(x, y))
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        hint = 'such as {"x": 5, "y": 6, "yaw": 7, "goal": [2.0, 1.0]}'
        raise TaskError(f"{value!r} is not a bearing", hint=hint) from error
