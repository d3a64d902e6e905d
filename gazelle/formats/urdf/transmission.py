"""``<transmission>`` of URDF."""

from __future__ import annotations

from gazelle.description import Parameters, Transmission
from gazelle.errors import FormatError
from gazelle.formats import values
from gazelle.formats.reading import Reading


def read_transmission(node: Parameters, reading: Reading) -> Transmission:
    """One transmission; old files write its type and reduction in other places."""
    reduction = _reduction(node, 1.0, reading)
    # Before ROS Indigo the interface was the actuator's.
    before = tuple(text for actuator in node.find_all("actuator") for text in _interfaces(actuator))
    return Transmission(
        name=node.attributes.get("name", ""),
        type=values.word(node, "type") or node.attributes.get("type", ""),
        joints=tuple(
            (
                values.attribute(joint, "name"),
                _interfaces(joint) or before,
            )
            for joint in node.find_all("joint")
        ),
        actuators=tuple(
            (
                values.attribute(actuator, "name"),
                _reduction(actuator, reduction, reading),
            )
            for actuator in node.find_all("actuator")
        ),
        source=node.source,
    )


def _interfaces(node: Parameters) -> tuple[str, ...]:
    return tuple(each.text for each in node.find_all("hardwareInterface") if each.text)


def _reduction(node: Parameters, default: float, reading: Reading) -> float:
    """A reduction; Gazebo reads a URDF with another text, for it reads no transmissions."""
    try:
        return values.real(node, "mechanicalReduction", default)
    except FormatError as error:
        reading.tolerate(error, f"{default:g} was taken")
        return default
