"""``MultiBinary``, where old scripts import it from."""

from gymnasium.spaces import MultiBinary

__all__ = ["MultiBinary"]
