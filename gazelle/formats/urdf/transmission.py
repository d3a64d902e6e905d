"""``<transmission>`` of URDF."""

from __future__ import annotations

from collections.abc import Iterable

from gazelle.description import Parameters, Transmission
from gazelle.errors import FormatError
from gazelle.formats import values
from gazelle.formats.reading import Reading


def read_transmission(node: Parameters, reading: Reading) -> Transmission:
    """Read one transmission; old files write its type and reduction in other places."""
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
        offsets=_of_joints(node, "offset", 0.0, reading),
        joint_reductions=_of_joints(node, "mechanicalReduction", 1.0, reading),
        joint_roles=_roles(node.find_all("joint")),
        actuator_roles=_roles(node.find_all("actuator")),
        source=node.source,
    )


def _of_joints(node: Parameters, tag: str, default: float, reading: Reading) -> tuple[float, ...]:
    """Return a number of each joint; empty if all have the default."""
    numbers = tuple(_number(joint, tag, default, reading) for joint in node.find_all("joint"))
    return numbers if any(each != default for each in numbers) else ()


def _roles(nodes: Iterable[Parameters]) -> tuple[str, ...]:
    roles = tuple(values.word(each, "role") for each in nodes)
    return roles if any(roles) else ()


def _interfaces(node: Parameters) -> tuple[str, ...]:
    return tuple(each.text for each in node.find_all("hardwareInterface") if each.text)


def _reduction(node: Parameters, default: float, reading: Reading) -> float:
    return _number(node, "mechanicalReduction", default, reading)


def _number(node: Parameters, tag: str, default: float, reading: Reading) -> float:
    """Return a number; Gazebo reads a URDF with another text, for it reads no transmissions."""
    try:
        return values.real(node, tag, default)
    except FormatError as error:
        reading.tolerate(error, f"{default:g} was taken")
        return default
