"""PPO with parameters from a YAML file."""

from __future__ import annotations

from typing import ClassVar

from gazelle.drop_in.frobs_rl.models.basic_model import BasicModel


class PPO(BasicModel):
    """Proximal policy optimisation (https://arxiv.org/abs/1707.06347); see `BasicModel`."""

    algorithm: ClassVar[str] = "PPO"
    has_sde: ClassVar[bool] = True
