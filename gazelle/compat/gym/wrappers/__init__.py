"""Environments around environments."""

from __future__ import annotations

from gazelle.compat.gym.wrappers.monitor import Monitor
from gazelle.compat.gym.wrappers.stacking import (
    FilterObservation,
    FrameStack,
    OrderEnforcing,
    TimeAwareObservation,
)
from gazelle.compat.gym.wrappers.time_limit import TimeLimit
from gazelle.compat.gym.wrappers.transforms import (
    ClipAction,
    FlattenObservation,
    RecordEpisodeStatistics,
    RescaleAction,
    TransformObservation,
    TransformReward,
)

__all__ = [
    "ClipAction",
    "FilterObservation",
    "FlattenObservation",
    "FrameStack",
    "Monitor",
    "OrderEnforcing",
    "RecordEpisodeStatistics",
    "RescaleAction",
    "TimeAwareObservation",
    "TimeLimit",
    "TransformObservation",
    "TransformReward",
]
