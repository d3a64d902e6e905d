"""``MultiDiscrete``, where old scripts import it from."""

from gymnasium.spaces import MultiDiscrete

__all__ = ["MultiDiscrete"]
