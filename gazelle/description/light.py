"""Lights, of a world or of a link."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Literal

from gazelle.description.material import Color
from gazelle.description.nan_refusal import refuses_nan
from gazelle.description.pose import Pose, Vector3
from gazelle.description.source import Source


@refuses_nan
@dataclass(frozen=True, slots=True)
class Attenuation:
    """Attenuation of light: 1 / (constant + linear r + quadratic r²), up to ``range`` [m]."""

    range: float = 10.0
    constant: float = 1.0
    linear: float = 1.0
    quadratic: float = 0.0


@refuses_nan
@dataclass(frozen=True, slots=True)
class Light:
    """A light.

    Attributes:
        name: Unique in its parent.
        type: Directional lights have no position that matters.
        pose: In the world or link frame.
        diffuse: Colour of direct light.
        specular: Colour of highlights.
        direction: For directional and spot lights, in the light's frame.
        attenuation: For point and spot lights.
        cast_shadows: Whether things throw shadows in it.
        spot_inner_angle: Full cone of full light [rad].
        spot_outer_angle: Full cone outside which it is dark [rad].
        spot_falloff: Exponent between them.
        intensity: Factor on the colours.
    """

    name: str
    type: Literal["directional", "point", "spot"] = "point"
    pose: Pose = field(default_factory=Pose)
    diffuse: Color = (1.0, 1.0, 1.0, 1.0)
    specular: Color = (0.1, 0.1, 0.1, 1.0)
    direction: Vector3 = (0.0, 0.0, -1.0)
    attenuation: Attenuation = field(default_factory=Attenuation)
    cast_shadows: bool = False
    spot_inner_angle: float = math.pi / 4
    spot_outer_angle: float = math.pi / 4
    spot_falloff: float = 1.0
    intensity: float = 1.0
    source: Source | None = field(default=None, compare=False, repr=False)
