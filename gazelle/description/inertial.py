"""Mass and inertia of a link."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.argument_checks import checked
from gazelle.description.nan_refusal import refuses_nan
from gazelle.description.pose import Pose
from gazelle.description.source import Source
from gazelle.errors import FormatError


@refuses_nan
@dataclass(frozen=True, slots=True)
class Inertia:
    """Inertia tensor about the centre of mass, in the inertial frame [kg m²]."""

    ixx: float = 1.0
    iyy: float = 1.0
    izz: float = 1.0
    ixy: float = 0.0
    ixz: float = 0.0
    iyz: float = 0.0

    @classmethod
    @checked(FormatError, after=True)
    def from_matrix(cls, matrix: ArrayLike) -> Inertia:
        """Create an inertia from a symmetric matrix, shape (3, 3) [kg m²].

        Raises:
            FormatError: It has another shape, or is no matrix of numbers.
        """
        rows = np.asarray(matrix, np.float64)
        if rows.shape != (3, 3):
            raise FormatError(f"an inertia must be a matrix of shape (3, 3), not {rows.shape}")
        (ixx, ixy, ixz), (_, iyy, iyz), (_, _, izz) = rows.tolist()
        return cls(ixx, iyy, izz, ixy, ixz, iyz)

    def matrix(self) -> NDArray[np.float64]:
        """Return the tensor as a matrix, shape (3, 3) [kg m²]."""
        return np.array(
            [
                [self.ixx, self.ixy, self.ixz],
                [self.ixy, self.iyy, self.iyz],
                [self.ixz, self.iyz, self.izz],
            ]
        )


@refuses_nan
@dataclass(frozen=True, slots=True)
class Inertial:
    """Mass, centre of mass and inertia of a link.

    Attributes:
        mass: [kg].
        pose: The inertial frame in the link frame; its origin is the centre of mass.
        inertia: About the centre of mass, in the inertial frame.
        written: Values of the file where no body can have them; they are saved again.
    """

    mass: float = 1.0
    pose: Pose = field(default_factory=Pose)
    inertia: Inertia = field(default_factory=Inertia)
    written: Inertia | None = field(default=None, compare=False, repr=False, kw_only=True)
    source: Source | None = field(default=None, compare=False, repr=False)
