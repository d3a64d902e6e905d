"""``Monitor``, where gym up to 0.12 had it; videos are not made."""

from gazelle.compat.gym.wrappers.monitor import Monitor

__all__ = ["Monitor"]
