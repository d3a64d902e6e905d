"""Where a cylinder touches a plane, also when it stands on it to the last digit.

MuJoCo looks for the lowest point of a cylinder's rim along the part of the plane's normal that is
across the axis. For a cylinder that stands upright that part is rounding, of any direction: along
the normal it has no contact, or one as deep as its radius, and a disc that spins where it
stands falls through the ground or is shot into the air. This does the same sums, but tells
upright from leaning by a hundred-millionth of a radian. It takes MuJoCo's place in the
table of collision functions, for the whole process.
"""

from __future__ import annotations

import ctypes
import functools
import math
import sys
from typing import Any, TypeAlias

import mujoco
import numpy as np
from mujoco.introspect import structs
from numpy.typing import NDArray

from gazelle.engines.mujoco.laws.layouts import offsets
from gazelle.engines.native import Native, floats, long_at, part, whole
from gazelle.engines.native.kinds import REAL, WHOLE

Floats: TypeAlias = NDArray[np.float64]

AT = offsets()

_UPRIGHT = 1e-8

# Numbers of a contact as MuJoCo's collision functions write it: distance, position, normal and
# tangent.
_FIELDS = ("dist", "pos", "normal", "tangent")
_NUMBERS = 10

_MASK = 0xFFFFFFFF  # C's integers leave the rest of a register as it was


@whole
def plane_cylinder(
    model: int, data: int, found: int, plane: int, cylinder: int, margin: float
) -> int:
    """Find up to four contacts of a cylinder with a plane.

    Args:
        model: Address of the ``mjModel``.
        data: Address of the ``mjData``.
        found: Address of the contacts to write.
        plane: Its geom.
        cylinder: Its geom.
        margin: Largest distance of a contact [m].

    Returns:
        How many there are.
    """
    flat, solid = plane & _MASK, cylinder & _MASK
    size = floats(long_at(model + AT.model_geom_size) + 24 * solid, 3)
    ground = floats(long_at(data + AT.geom_xmat) + 72 * flat, 9)
    turn = floats(long_at(data + AT.geom_xmat) + 72 * solid, 9)
    origin = floats(long_at(data + AT.geom_xpos) + 24 * flat, 3)
    centre = floats(long_at(data + AT.geom_xpos) + 24 * solid, 3)
    normal, down, rim, side = np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3)
    lean, height = 0.0, 0.0
    for axis in range(3):
        normal[axis], down[axis] = ground[3 * axis + 2], turn[3 * axis + 2]
        lean += normal[axis] * down[axis]
        height += (centre[axis] - origin[axis]) * normal[axis]
    sense = -1.0 if lean > 0.0 else 1.0
    lean *= sense
    length = 0.0
    for axis in range(3):
        down[axis] *= sense
        rim[axis] = down[axis] * lean - normal[axis]
        length += rim[axis] * rim[axis]
    length = math.sqrt(length)
    low = 0.0
    for axis in range(3):
        rim[axis] = size[0] * (turn[3 * axis] if length < _UPRIGHT else rim[axis] / length)
        low += rim[axis] * normal[axis]
        down[axis] *= size[1]
    near, far = height + lean * size[1], height - lean * size[1]
    if near + low > margin:
        return 0
    count = 1
    _write(found, 0, near + low, centre, down, 1.0, rim, 1.0, side, normal)
    if far + low <= margin:
        _write(found, 1, far + low, centre, down, -1.0, rim, 1.0, side, normal)
        count = 2
    if near - 0.5 * low <= margin:
        _across(rim, down, size[0], side)
        _write(found, count, near - 0.5 * low, centre, down, 1.0, rim, -0.5, side, normal)
        for axis in range(3):
            side[axis] = -side[axis]
        _write(found, count + 1, near - 0.5 * low, centre, down, 1.0, rim, -0.5, side, normal)
        count += 2
    return count


@part
def _across(rim: Floats, down: Floats, radius: float, side: Floats) -> None:
    """The way from the middle of a triangle's base on the rim to its corners."""
    side[0] = rim[1] * down[2] - rim[2] * down[1]
    side[1] = rim[2] * down[0] - rim[0] * down[2]
    side[2] = rim[0] * down[1] - rim[1] * down[0]
    length = math.sqrt(side[0] ** 2 + side[1] ** 2 + side[2] ** 2)
    for axis in range(3):
        side[axis] *= radius * math.sqrt(0.75) / max(length, 1e-300)


@part
def _write(
    found: int,
    index: int,
    distance: float,
    centre: Floats,
    down: Floats,
    along: float,
    rim: Floats,
    out: float,
    side: Floats,
    normal: Floats,
) -> None:
    contact = floats(found + 8 * _NUMBERS * index, _NUMBERS)
    contact[0] = distance
    for axis in range(3):
        point = centre[axis] + along * down[axis] + out * rim[axis] + side[axis]
        contact[1 + axis] = point - 0.5 * distance * normal[axis]
        contact[4 + axis] = normal[axis]
        contact[7 + axis] = 0.0


@functools.cache
def stand_upright() -> Any:
    """Let MuJoCo find contacts of cylinders and planes so, from now on.

    Returns:
        What keeps the function alive; None if this MuJoCo keeps its functions to itself, or
        describes contacts in another way, so that they remain its own.
    """
    described = structs.STRUCTS.get("mjPreContact")
    if described is not None and tuple(f.name for f in described.fields) != _FIELDS:
        return None
    kinds = int(mujoco.mjtGeom.mjNGEOMTYPES)
    try:
        library = ctypes.CDLL(sys.modules[mujoco.set_mjcb_time.__module__].__file__)
        table = (ctypes.c_void_p * (kinds * kinds)).in_dll(library, "mjCOLLISIONFUNC")
    except (OSError, ValueError):
        return None
    place = int(mujoco.mjtGeom.mjGEOM_PLANE) * kinds + int(mujoco.mjtGeom.mjGEOM_CYLINDER)
    function = _function()
    table[place] = ctypes.cast(function, ctypes.c_void_p).value
    return function


def _function() -> Any:
    """The compiled function, as C calls it."""
    made = ctypes.CFUNCTYPE(
        ctypes.c_int, *[ctypes.c_void_p] * 3, *[ctypes.c_int] * 2, ctypes.c_double
    )
    if isinstance(plane_cylinder, Native):
        return made(plane_cylinder.address((WHOLE,) * 5 + (REAL,)))
    return made(plane_cylinder)
