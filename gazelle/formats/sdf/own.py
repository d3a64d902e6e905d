"""What URDF says and SDF has no words for, in elements of Gazelle's own namespace.

SDF lets elements with a prefix stand anywhere; other programs pass over them.
"""

from __future__ import annotations

from gazelle.description import Parameters, SafetyController, Transmission
from gazelle.formats.reading import Reading
from gazelle.formats.urdf.joint import read_safety
from gazelle.formats.urdf.transmission import read_transmission

PREFIX = "gazelle"
TRANSMISSION = f"{PREFIX}:transmission"
SAFETY = f"{PREFIX}:safety_controller"


def own_transmissions(node: Parameters, reading: Reading) -> tuple[Transmission, ...]:
    """The transmissions of a model."""
    return tuple(read_transmission(child, reading) for child in node.find_all(TRANSMISSION))


def own_safety(node: Parameters) -> SafetyController | None:
    """The soft limits of a joint."""
    return read_safety(node.find(SAFETY))
