"""DDPG with parameters from a YAML file."""

from __future__ import annotations

from typing import ClassVar

from gazelle.drop_in.frobs_rl.models.basic_model import BasicModel


class DDPG(BasicModel):
    """Deep deterministic policy gradient (https://arxiv.org/abs/1509.02971); see `BasicModel`."""

    algorithm: ClassVar[str] = "DDPG"
    has_noise: ClassVar[bool] = True
