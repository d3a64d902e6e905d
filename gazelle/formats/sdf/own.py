"""Elements in Gazelle's own namespace for what URDF has and SDF lacks.

SDF allows elements with a prefix anywhere; other programs pass over them.
"""

from __future__ import annotations

from gazelle.description import Model, Parameters, SafetyController, Transmission
from gazelle.formats import values
from gazelle.formats.reading import Reading
from gazelle.formats.urdf.joint import read_safety
from gazelle.formats.urdf.transmission import read_transmission

PREFIX = "gazelle"
TRANSMISSION = f"{PREFIX}:transmission"
SAFETY = f"{PREFIX}:safety_controller"
STATIC = f"{PREFIX}:static"

_WORLD = "world"


def fixed_whole(model: Model) -> bool:
    """Return whether fixed joints hold all links of a model to the world, so that nothing can move.

    Such a robot of URDF is static to Gazelle. SDF's ``<static>`` would mean more: of a static model
    Gazebo has no joints.
    """
    held = {_WORLD}
    for joint in model.joints:
        if joint.type == "fixed" and joint.parent in held:
            held.add(joint.child)
    return all(link.name in held for link in model.links)


def own_static(node: Parameters) -> bool:
    """Return whether a model held by joints is static."""
    return values.flag(node, STATIC, default=False)


def own_transmissions(node: Parameters, reading: Reading) -> tuple[Transmission, ...]:
    """Return the transmissions of a model."""
    return tuple(read_transmission(child, reading) for child in node.find_all(TRANSMISSION))


def own_safety(node: Parameters) -> SafetyController | None:
    """Return the soft limits of a joint."""
    return read_safety(node.find(SAFETY))
