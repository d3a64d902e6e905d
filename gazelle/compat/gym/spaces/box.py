"""``Box``, where old scripts import it from."""

from gymnasium.spaces import Box

__all__ = ["Box"]
