"""Interface of the simulation for the devices on its robots."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

from gazelle.array_types import Floats
from gazelle.engines.planar import Fleet, PlanarEngine
from gazelle.stage.description import StageModel, StageWorld
from gazelle.stage.robots import StageRobot


class StageBodies(ABC):
    """All robots and objects of Stage files, and where they are.

    Attributes:
        engine: Moves them.
        nworld: Copies of the world.
    """

    engine: PlanarEngine
    nworld: int

    @property
    @abstractmethod
    def description(self) -> StageWorld:
        """Description of the world in the file."""

    @property
    @abstractmethod
    def robots(self) -> tuple[StageRobot, ...]:
        """Robots in file order."""

    @property
    @abstractmethod
    def things(self) -> tuple[StageModel, ...]:
        """Models that grippers can take."""

    @property
    @abstractmethod
    def placed(self) -> Sequence[StageModel]:
        """Kinematic models."""

    @property
    @abstractmethod
    def still(self) -> Sequence[StageModel]:
        """Models that never move."""

    @property
    @abstractmethod
    def fleet(self) -> Fleet:
        """The bodies in the plane."""

    @property
    @abstractmethod
    def poses(self) -> Floats:
        """True x, y [m] and heading [rad], shape (nworld, nrobot, 3); to be read."""

    @property
    @abstractmethod
    def time_step(self) -> float:
        """Time step [s]: the world's ``interval_sim``."""
