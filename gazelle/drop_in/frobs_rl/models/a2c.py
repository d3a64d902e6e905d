"""A2C with parameters from a YAML file."""

from __future__ import annotations

from typing import ClassVar

from gazelle.drop_in.frobs_rl.models.basic_model import BasicModel


class A2C(BasicModel):
    """Advantage actor critic (https://arxiv.org/abs/1602.01783); see `BasicModel`."""

    algorithm: ClassVar[str] = "A2C"
    has_sde: ClassVar[bool] = True
