"""``<light>`` of a world or a link."""

from __future__ import annotations

from typing import Literal

from gazelle.description import Attenuation, Light, Parameters, Pose
from gazelle.formats import values

_TYPES: dict[str, Literal["directional", "point", "spot"]] = {
    "directional": "directional",
    "point": "point",
    "spot": "spot",
}


def read_light(node: Parameters, pose: Pose) -> Light:
    """Read a light at a pose that is already resolved.

    Raises:
        FormatError: It has no name, or an unknown type.
    """
    kind = node.attributes.get("type", "point") or "point"
    if kind not in _TYPES:
        raise values.fail(
            node, f"unknown light '{kind}'", hint="there are: directional, point, spot"
        )
    return Light(
        name=values.attribute(node, "name"),
        type=_TYPES[kind],
        pose=pose,
        diffuse=values.color(node, "diffuse", (1.0, 1.0, 1.0, 1.0)),
        specular=values.color(node, "specular", (0.1, 0.1, 0.1, 1.0)),
        direction=values.vector(node, "direction", (0.0, 0.0, -1.0)),
        attenuation=_attenuation(node),
        cast_shadows=values.flag(node, "cast_shadows", default=False),
        spot_inner_angle=values.real(node, "spot/inner_angle", 0.0),
        spot_outer_angle=values.real(node, "spot/outer_angle", 0.0),
        spot_falloff=values.real(node, "spot/falloff", 0.0),
        intensity=values.real(node, "intensity", 1.0),
        source=node.source,
    )


def _attenuation(node: Parameters) -> Attenuation:
    return Attenuation(
        range=values.limit(node, "attenuation/range", 10.0),
        constant=values.real(node, "attenuation/constant", 1.0),
        linear=values.real(node, "attenuation/linear", 1.0),
        quadratic=values.real(node, "attenuation/quadratic", 0.0),
    )
