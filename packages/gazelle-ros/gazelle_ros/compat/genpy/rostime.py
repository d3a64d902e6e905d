"""Times, where genpy keeps them."""

from gazelle_ros.time import Duration, Time, TVal

__all__ = ["Duration", "TVal", "Time"]
