"""Environments by name."""

from __future__ import annotations

from gazelle.drop_in.gym.envs import registration
from gazelle.drop_in.gym.envs.registration import make, register, registry, spec
from gazelle.drop_in.gym.places import finding

__all__ = ["make", "register", "registration", "registry", "spec"]

__getattr__ = finding("envs")
