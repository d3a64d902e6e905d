"""``<transmission>`` of URDF."""

from __future__ import annotations

from gazelle.description import Parameters, Transmission
from gazelle.formats import values


def read_transmission(node: Parameters) -> Transmission:
    """One transmission; old files write its type and reduction in other places."""
    reduction = values.real(node, "mechanicalReduction", 1.0)
    return Transmission(
        name=node.attributes.get("name", ""),
        type=values.word(node, "type") or node.attributes.get("type", ""),
        joints=tuple(
            (
                values.attribute(joint, "name"),
                tuple(h.text for h in joint.find_all("hardwareInterface") if h.text),
            )
            for joint in node.find_all("joint")
        ),
        actuators=tuple(
            (
                values.attribute(actuator, "name"),
                values.real(actuator, "mechanicalReduction", reduction),
            )
            for actuator in node.find_all("actuator")
        ),
        source=node.source,
    )
