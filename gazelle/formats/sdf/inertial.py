"""``<inertial>``."""

from __future__ import annotations

from gazelle.description import Inertia, Inertial, Parameters
from gazelle.formats import values
from gazelle.formats.sdf.pose import read_pose

_MOMENTS = ("ixx", "iyy", "izz")
_PRODUCTS = ("ixy", "ixz", "iyz")


def read_inertial(node: Parameters | None) -> Inertial | None:
    """Read mass, centre of mass and inertia as written; None where the link has none."""
    if node is None:
        return None
    inertia = node.find("inertia")
    return Inertial(
        mass=values.real(node, "mass", 1.0),
        pose=read_pose(node.find("pose")),
        inertia=Inertia() if inertia is None else read_inertia(inertia),
        source=node.source,
    )


def read_inertia(node: Parameters) -> Inertia:
    """Read the six numbers."""
    moments = [values.real(node, name, 1.0) for name in _MOMENTS]
    products = [values.real(node, name, 0.0) for name in _PRODUCTS]
    return Inertia(*moments, *products)
