"""``Discrete``, where old scripts import it from."""

from gymnasium.spaces import Discrete

__all__ = ["Discrete"]
