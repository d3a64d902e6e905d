"""Mobile robots on plain numbers: control loops and motions, for any number of robots at once."""

from gazelle.navigation.agv import Limits, Motions, Outcome
from gazelle.navigation.pid import Pid

__all__ = ["Limits", "Motions", "Outcome", "Pid"]
