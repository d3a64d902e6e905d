"""Small things that environments use."""

from __future__ import annotations

from gymnasium.utils import EzPickle, colorize

from gazelle.compat.gym.places import finding
from gazelle.compat.gym.utils import seeding

__all__ = ["EzPickle", "colorize", "seeding"]

__getattr__ = finding("utils")
