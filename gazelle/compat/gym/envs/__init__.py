"""Environments by name."""

from __future__ import annotations

from gazelle.compat.gym.envs import registration
from gazelle.compat.gym.envs.registration import make, register, registry, spec
from gazelle.compat.gym.places import finding

__all__ = ["make", "register", "registration", "registry", "spec"]

__getattr__ = finding("envs")
