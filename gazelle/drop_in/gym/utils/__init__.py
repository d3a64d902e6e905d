"""Small things that environments use."""

from __future__ import annotations

from gymnasium.utils import EzPickle, colorize

from gazelle.drop_in.gym.places import finding
from gazelle.drop_in.gym.utils import seeding

__all__ = ["EzPickle", "colorize", "seeding"]

__getattr__ = finding("utils")
