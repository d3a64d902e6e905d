"""Environments by name."""

from __future__ import annotations

from gazelle.compat.gym.envs import registration
from gazelle.compat.gym.envs.registration import make, register, registry, spec

__all__ = ["make", "register", "registration", "registry", "spec"]
