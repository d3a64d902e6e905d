"""Colour and texture of a visual."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from gazelle.description.nan_refusal import refuses_nan
from gazelle.description.parameters import Parameters

Color = tuple[float, float, float, float]


@refuses_nan
@dataclass(frozen=True, slots=True)
class Material:
    """Look of a surface; colours are (red, green, blue, alpha), each 0 to 1.

    Attributes:
        ambient: Colour in ambient light; None when the file says none.
        diffuse: Colour in direct light; None when the file says none.
        specular: Colour of highlights; None when the file says none.
        emissive: Colour it glows with; None when the file says none.
        script: Name of a material script such as ``Gazebo/Grey``; readers
            put the colours of a known script into the fields above.
        script_uris: Locations of the script in the file; empty for Gazebo's own.
        script_places: The files and folders behind ``script_uris`` that are there.
        texture: Image file of the diffuse texture, or None.
        extras: Elements without effect, kept as in the file: shaders, other maps, ...
        urdf_color: The colour that a URDF's own ``<material>`` gives, which a script hides.
    """

    ambient: Color | None = None
    diffuse: Color | None = None
    specular: Color | None = None
    emissive: Color | None = None
    script: str | None = None
    script_uris: tuple[str, ...] = ()
    script_places: tuple[Path, ...] = field(default=(), compare=False)
    texture: Path | None = None
    extras: tuple[Parameters, ...] = field(default=(), hash=False)
    urdf_color: Color | None = field(default=None, compare=False)
