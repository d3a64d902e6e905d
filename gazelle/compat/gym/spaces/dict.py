"""``Dict``, where old scripts import it from."""

from gymnasium.spaces import Dict

__all__ = ["Dict"]
