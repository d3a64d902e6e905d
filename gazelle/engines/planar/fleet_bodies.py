"""Bodies of a fleet, and their drives."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.engines.planar import columns as c
from gazelle.errors import EngineError
from gazelle.geometry.planar_part import PlanarPart

DriveKind = Literal["diff", "omni", "car"]

_KINDS = {"diff": c.DIFFERENTIAL, "omni": c.OMNIDIRECTIONAL, "car": c.CAR}


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class Drive:
    """Drive of a body: its kind and limits.

    Attributes:
        kind: ``diff`` goes forward and turns, ``omni`` also goes sideways, ``car`` steers: its
            command is the speed of its front wheel and, as turning, the steering angle.
        slowest: Least velocity along x and y and about z [m/s, rad/s]; of a car that of its body,
            whatever its command.
        fastest: Greatest.
        brake: Least acceleration [m/s², rad/s²].
        push: Greatest.
        wheelbase: Between the axles of a car [m].

    Raises:
        EngineError: A number is invalid.
    """

    kind: DriveKind = "diff"
    slowest: tuple[float, float, float] = (-math.inf, -math.inf, -math.inf)
    fastest: tuple[float, float, float] = (math.inf, math.inf, math.inf)
    brake: tuple[float, float, float] = (-math.inf, -math.inf, -math.inf)
    push: tuple[float, float, float] = (math.inf, math.inf, math.inf)
    wheelbase: float = 1.0


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class Body:
    """Something that can be moved, with the same parts in every world.

    Attributes:
        parts: In its own frame.
        pose: Initial pose: x, y [m], heading [rad].
        z: Height of its frame [m].
        drive: Drive; None for nothing but ``Fleet.place``.
        family: Bodies of one family neither see nor bump each other; None for its own.

    Raises:
        EngineError: A number is invalid.
    """

    parts: tuple[PlanarPart, ...]
    pose: tuple[float, float, float] = (0.0, 0.0, 0.0)
    z: float = 0.0
    drive: Drive | None = None
    family: int | None = None


def drive_row(drive: Drive | None) -> Floats:
    """Return a drive as kernels see it, shape (columns.DRIVE,).

    Raises:
        EngineError: There is no such kind, or the wheelbase is not positive.
    """
    row = np.zeros(c.DRIVE)
    if drive is None:
        row[c.DRIVE_KIND] = c.PASSIVE
        return row
    if drive.kind not in _KINDS:
        raise EngineError(f"a drive must be one of {', '.join(_KINDS)}, not '{drive.kind}'")
    if drive.kind == "car" and not drive.wheelbase > 0.0:
        raise EngineError(f"the wheelbase must be positive, not {drive.wheelbase:g} m")
    row[c.DRIVE_KIND], row[c.WHEELBASE] = _KINDS[drive.kind], drive.wheelbase
    row[c.SLOWEST : c.FASTEST], row[c.FASTEST : c.BRAKE] = drive.slowest, drive.fastest
    row[c.BRAKE : c.PUSH], row[c.PUSH : c.FREE] = drive.brake, drive.push
    row[c.FREE] = np.isinf(row[c.SLOWEST : c.FREE]).all()
    return row


def radius_of(parts: Sequence[PlanarPart]) -> float:
    """Return the distance of the farthest point of some parts from the origin [m]."""
    return max(
        (math.hypot(x, y) + part.radius for part in parts for x, y in part.points), default=0.0
    )
