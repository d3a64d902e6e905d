"""SAC with parameters from a YAML file."""

from __future__ import annotations

from typing import ClassVar

from gazelle.drop_in.frobs_rl.models.basic_model import BasicModel


class SAC(BasicModel):
    """Soft actor critic (https://arxiv.org/abs/1801.01290); see `BasicModel`."""

    algorithm: ClassVar[str] = "SAC"
    has_noise: ClassVar[bool] = True
    has_sde: ClassVar[bool] = True
