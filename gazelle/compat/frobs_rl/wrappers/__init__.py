"""Environments around environments; they have Gymnasium's interface, whatever they are around."""

from __future__ import annotations

from gazelle.compat.frobs_rl.wrappers import (
    NormalizeActionWrapper,
    NormalizeObservWrapper,
    TimeLimitWrapper,
)

__all__ = ["NormalizeActionWrapper", "NormalizeObservWrapper", "TimeLimitWrapper"]
