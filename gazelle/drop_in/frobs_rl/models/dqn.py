"""DQN with parameters from a YAML file."""

from __future__ import annotations

from typing import ClassVar

from gazelle.drop_in.frobs_rl.models.basic_model import BasicModel


class DQN(BasicModel):
    """Deep Q network (https://arxiv.org/abs/1312.5602); see `BasicModel`."""

    algorithm: ClassVar[str] = "DQN"
