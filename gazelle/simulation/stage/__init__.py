"""Stage worlds that run: fleets of robots in the plane."""

from gazelle.simulation.stage.finders import Blob, Fiducial
from gazelle.simulation.stage.layout import Ranger, StageRobot
from gazelle.simulation.stage.simulation import StageSimulation

__all__ = ["Blob", "Fiducial", "Ranger", "StageRobot", "StageSimulation"]
