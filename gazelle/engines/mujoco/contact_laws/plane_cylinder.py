"""Contact of a cylinder with a plane, also when it stands on it to the last digit.

MuJoCo looks for the lowest point of a cylinder's rim along the part of the plane's normal that is
across the axis. For a cylinder that stands upright that part is rounding, of any direction: along
the normal it has no contact, or one as deep as its radius, and a disc that spins where it
stands falls through the ground or is shot into the air. This computes the same, but distinguishes
upright from leaning by a hundred-millionth of a radian.

A wheel that is level touches with both edges of its tread. It stands on the middle of it (``wheel_contacts``),
and two contacts in one place say everything twice, which costs the solver half as much again.
So such a wheel has the contact of its lower edge only.
"""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.contact_laws.struct_offsets import AT
from cython.cimports.gazelle.engines.mujoco.contact_laws.wheel_contacts import is_upright_wheel
from cython.cimports.gazelle.native.memory import floats, word
from cython.cimports.libc.math import sqrt

_UPRIGHT = cython.declare(cython.double, 1e-8)

# Numbers of a contact as MuJoCo's collision functions write it: distance, position, normal and
# tangent.
_NUMBERS = cython.declare(cython.int, 10)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def plane_cylinder(
    model: cython.size_t, data: cython.size_t, found: cython.size_t, plane: cython.int,
    cylinder: cython.int, margin: cython.double,
) -> cython.int:  # fmt: skip
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
    size = floats(word(model + AT.model_geom_size) + 24 * cylinder)
    ground = floats(word(data + AT.geom_xmat) + 72 * plane)
    turn = floats(word(data + AT.geom_xmat) + 72 * cylinder)
    origin = floats(word(data + AT.geom_xpos) + 24 * plane)
    centre = floats(word(data + AT.geom_xpos) + 24 * cylinder)
    normal = cython.declare(cython.double[3])
    down = cython.declare(cython.double[3])
    rim = cython.declare(cython.double[3])
    side = cython.declare(cython.double[3])
    side[0] = side[1] = side[2] = 0.0
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
    length = sqrt(length)
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
    if is_upright_wheel(model, cylinder, lean, size[1]):
        return 1
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


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _across(
    rim: cython.p_double, down: cython.p_double, radius: cython.double, side: cython.p_double
) -> cython.void:
    """Compute the way from the middle of a triangle's base on the rim to its corners."""
    side[0] = rim[1] * down[2] - rim[2] * down[1]
    side[1] = rim[2] * down[0] - rim[0] * down[2]
    side[2] = rim[0] * down[1] - rim[1] * down[0]
    length = sqrt(side[0] * side[0] + side[1] * side[1] + side[2] * side[2])
    for axis in range(3):
        side[axis] *= radius * sqrt(0.75) / max(length, 1e-300)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _write(
    found: cython.size_t,
    index: cython.int,
    distance: cython.double,
    centre: cython.p_double,
    down: cython.p_double,
    along: cython.double,
    rim: cython.p_double,
    out: cython.double,
    side: cython.p_double,
    normal: cython.p_double,
) -> cython.void:
    contact = floats(found + 8 * _NUMBERS * index)
    contact[0] = distance
    for axis in range(3):
        point = centre[axis] + along * down[axis] + out * rim[axis] + side[axis]
        contact[1 + axis] = point - 0.5 * distance * normal[axis]
        contact[4 + axis] = normal[axis]
        contact[7 + axis] = 0.0


def address() -> int:
    """Return the address of ``plane_cylinder``, for MuJoCo; 0 where Python runs it."""
    if cython.compiled:
        return int(cython.cast(cython.size_t, cython.cast(cython.p_void, plane_cylinder)))
    return 0
