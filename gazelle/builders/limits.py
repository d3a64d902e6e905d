"""Limits of what the arguments of builders make large."""

from __future__ import annotations

MAX_THINGS = 10_000
"""Random things of one call."""

MAX_PARTS = 10_000
"""Shapes of a model."""

SMALLEST = 1e-6
"""Least length [m]: what is smaller has no mass that is a number."""
