"""``<inertial>``."""

from __future__ import annotations

import math

from gazelle.description import Inertia, Inertial, Parameters
from gazelle.formats import values
from gazelle.formats.sdf.pose import read_pose

_MOMENTS = ("ixx", "iyy", "izz")
_PRODUCTS = ("ixy", "ixz", "iyz")


def read_inertial(node: Parameters | None) -> Inertial | None:
    """Mass, centre of mass and inertia; None where the link has none.

    Raises:
        FormatError: The mass is not positive, or the inertia is not that of any body.
    """
    if node is None:
        return None
    mass = values.real(node, "mass", 1.0)
    if not (mass > 0.0 and math.isfinite(mass)):
        where = node.find("mass") or node
        raise values.fail(where, f"the mass must be greater than zero, found {mass:g}")
    inertia = node.find("inertia")
    return Inertial(
        mass=mass,
        pose=read_pose(node.find("pose")),
        inertia=Inertia() if inertia is None else read_inertia(inertia),
        source=node.source,
    )


def read_inertia(node: Parameters) -> Inertia:
    """The six numbers, checked."""
    moments = [values.real(node, name, 1.0) for name in _MOMENTS]
    products = [values.real(node, name, 0.0) for name in _PRODUCTS]
    inertia = Inertia(*moments, *products)
    check_inertia(inertia, node)
    return inertia


def check_inertia(inertia: Inertia, node: Parameters) -> None:
    """Refuse a tensor that is not positive definite (Sylvester's criterion).

    Raises:
        FormatError: It is not.
    """
    i = inertia
    minor = i.ixx * i.iyy - i.ixy * i.ixy
    whole = (
        i.izz * minor
        - i.iyz * (i.ixx * i.iyz - i.ixy * i.ixz)
        + i.ixz * (i.ixy * i.iyz - i.iyy * i.ixz)
    )
    if not (min(i.ixx, i.iyy, i.izz) > 0.0 and minor > 0.0 and whole > 0.0):
        raise values.fail(
            node,
            f"the inertia is not positive definite: ixx {i.ixx:g}, iyy {i.iyy:g}, "
            f"izz {i.izz:g}, ixy {i.ixy:g}, ixz {i.ixz:g}, iyz {i.iyz:g}",
            hint="the diagonal must be positive and outweigh the products of inertia",
        )
