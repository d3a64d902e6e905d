"""``Tuple``, where old scripts import it from."""

from gymnasium.spaces import Tuple

__all__ = ["Tuple"]
