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

from gazelle.drop_in.gym.places import finding
from gazelle.drop_in.gym.spaces.prng import np_random, seed

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
