"""``Space``, where old scripts import it from."""

from gymnasium.spaces import Space

__all__ = ["Space"]
