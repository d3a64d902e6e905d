"""TD3 with parameters from a YAML file."""

from __future__ import annotations

from typing import ClassVar

from gazelle.drop_in.frobs_rl.models.basic_model import BasicModel


class TD3(BasicModel):
    """Twin delayed DDPG (https://arxiv.org/abs/1802.09477); see `BasicModel`."""

    algorithm: ClassVar[str] = "TD3"
    has_noise: ClassVar[bool] = True
