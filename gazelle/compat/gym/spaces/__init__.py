"""Spaces of observations and actions: those of Gymnasium."""

from __future__ import annotations

from gymnasium.spaces import (
    Box,
    Dict,
    Discrete,
    MultiBinary,
    MultiDiscrete,
    Space,
    Tuple,
    flatdim,
    flatten,
    flatten_space,
    unflatten,
)

from gazelle.compat.gym.places import finding
from gazelle.compat.gym.spaces.prng import np_random, seed

__all__ = [
    "Box",
    "Dict",
    "Discrete",
    "MultiBinary",
    "MultiDiscrete",
    "Space",
    "Tuple",
    "flatdim",
    "flatten",
    "flatten_space",
    "np_random",
    "seed",
    "unflatten",
]

__getattr__ = finding("spaces")
