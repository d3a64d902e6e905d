"""Environments around environments."""

from __future__ import annotations

from gazelle.compat.gym.places import finding
from gazelle.compat.gym.wrappers.monitor import Monitor
from gazelle.compat.gym.wrappers.normalize import NormalizeObservation, NormalizeReward
from gazelle.compat.gym.wrappers.stacking import (
    FilterObservation,
    FlattenDictWrapper,
    FrameStack,
    LazyFrames,
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
    "FlattenDictWrapper",
    "FlattenObservation",
    "FrameStack",
    "LazyFrames",
    "Monitor",
    "NormalizeObservation",
    "NormalizeReward",
    "OrderEnforcing",
    "RecordEpisodeStatistics",
    "RescaleAction",
    "TimeAwareObservation",
    "TimeLimit",
    "TransformObservation",
    "TransformReward",
]

__getattr__ = finding("wrappers")
