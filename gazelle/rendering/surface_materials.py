"""Appearance of a surface: from the visual, its material script, and the mesh file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from gazelle.array_types import Bytes
from gazelle.description import Material, Visual
from gazelle.formats.materials import script_colors
from gazelle.formats.ogre import ScriptMaterial, find_material
from gazelle.rendering.shape_meshes import ShapePiece
from gazelle.rendering.textures import Rgb

GREY = (0.7, 0.7, 0.7)
_NOTHING = ScriptMaterial()


@dataclass(frozen=True, slots=True)
class SurfaceMaterial:
    """Material of a surface, ready to be drawn.

    Attributes:
        color: Red, green and blue, 0 to 1.
        glow: Emitted light, likewise.
        texture: The picture on it, in place of the colour; None for none.
        alpha: 1 for what hides all behind it, 0 for what cannot be seen.
    """

    color: Rgb
    glow: Rgb = (0.0, 0.0, 0.0)
    texture: Path | Bytes | None = None
    alpha: float = 1.0


def surface_material(visual: Visual, piece: ShapePiece) -> SurfaceMaterial:
    """Return the material of a piece of a visual: that of the visual, else that of the mesh file."""
    clear = 1.0 - visual.transparency
    material = visual.material
    if material is None:
        return SurfaceMaterial(
            piece.color or GREY, texture=piece.texture, alpha=clear * piece.alpha
        )
    script, picture = _script_of(material)
    diffuse = material.diffuse or script.diffuse or material.ambient or script.ambient
    emissive = material.emissive or script.emissive
    return SurfaceMaterial(
        GREY if diffuse is None else diffuse[:3],
        (0.0, 0.0, 0.0) if emissive is None else emissive[:3],
        material.texture or picture,
        clear * _alpha(material, script),
    )


def _script_of(material: Material) -> tuple[ScriptMaterial, Path | None]:
    if material.script is None or not material.script_places:
        return _NOTHING, None
    return find_material(material.script, material.script_places) or (_NOTHING, None)


def _alpha(material: Material, script: ScriptMaterial) -> float:
    """Return the opacity: a colour's alpha counts only where the script blends, as in OGRE."""
    if script.blended and script.diffuse is not None:
        return script.diffuse[3]
    known = None if material.script is None else script_colors(material.script)
    return 1.0 if known is None else known[1][3]
