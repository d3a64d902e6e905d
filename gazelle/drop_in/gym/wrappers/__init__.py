"""Environments around environments."""

from __future__ import annotations

from gazelle.drop_in.gym.places import finding
from gazelle.drop_in.gym.wrappers.monitor import Monitor
from gazelle.drop_in.gym.wrappers.normalize import NormalizeObservation, NormalizeReward
from gazelle.drop_in.gym.wrappers.stacking import (
    FilterObservation,
    FlattenDictWrapper,
    FrameStack,
    LazyFrames,
    OrderEnforcing,
    TimeAwareObservation,
)
from gazelle.drop_in.gym.wrappers.time_limit import TimeLimit
from gazelle.drop_in.gym.wrappers.transforms import (
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
