"""Environments around environments, with the old gym's or Gymnasium's interface as these have it."""

from __future__ import annotations

from gazelle.drop_in.frobs_rl.wrappers import (
    NormalizeActionWrapper,
    NormalizeObservWrapper,
    TimeLimitWrapper,
)

__all__ = ["NormalizeActionWrapper", "NormalizeObservWrapper", "TimeLimitWrapper"]
