"""Appearance of the pieces of a mesh file: a colour or a texture."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.array_types import Bytes, Floats

Rgb = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class MeshMaterial:
    """Material of a piece of a mesh.

    Attributes:
        color: Red, green and blue, 0 to 1; None if the file has none.
        texture: The picture file that it names; empty for none.
        pixels: The picture, where it is inside the mesh file: bytes of shape (height, width, 3), top
            row first.
        alpha: 0 for what cannot be seen to 1.
        uv: Texture coordinates of the corners of each triangle, to the right and up, 0 to 1 and
            again beyond, shape (m, 3, 2); None for nowhere.
    """

    color: Rgb | None = None
    texture: str = ""
    uv: Floats | None = None
    pixels: Bytes | None = None
    alpha: float = 1.0


PLAIN = MeshMaterial()


def texture_file(mesh: Path, name: str) -> Path | None:
    """Return the picture that a mesh file names, beside it or in a Gazebo model's folders.

    Only files in the folder of the mesh's model are found: two above the mesh, and what is below.

    Args:
        mesh: The mesh file.
        name: As the file has it: a path relative to it, or of the machine that it was made on.
    """
    plain = name.removeprefix("file://").replace("\\", "/").replace("%20", " ")
    last = plain.rpartition("/")[2]
    if not last:
        return None
    here = mesh.resolve().parent
    model = here.parent
    places = (
        here / plain,
        here / last,
        model / "materials" / "textures" / last,
        here / "materials" / "textures" / last,
        model / "textures" / last,
    )
    for place in places:
        found = place.resolve()
        if found.is_file() and found.is_relative_to(model):
            return found
    return None


def material_of_trimesh(mesh: Any) -> MeshMaterial:
    """Return the material of a trimesh: glTF's and PLY's colours, and pictures inside the file."""
    visual: Any = getattr(mesh, "visual", None)
    kind = getattr(visual, "kind", None)
    if kind in {"vertex", "face"}:  # one colour is shown: their mean
        red, green, blue, alpha = (visual.face_colors.mean(axis=0) / 255.0).tolist()
        return MeshMaterial(color=(red, green, blue), alpha=alpha)
    material = getattr(visual, "material", None)
    if material is None:
        return PLAIN
    red, green, blue, alpha = _factor(getattr(material, "baseColorFactor", None), material)
    picture = getattr(material, "baseColorTexture", None) or getattr(material, "image", None)
    uv = getattr(visual, "uv", None)
    pixels: Bytes | None = None
    if picture is not None and uv is not None:
        tinted = np.asarray(picture.convert("RGB"), np.float64) * (red, green, blue)
        pixels = np.clip(np.rint(tinted), 0.0, 255.0).astype(np.uint8)
    if getattr(material, "alphaMode", None) != "BLEND":
        alpha = 1.0  # glTF: alpha counts only for blended materials
    places = None if pixels is None else np.asarray(uv, np.float64)[np.asarray(mesh.faces)]
    return MeshMaterial((red, green, blue), uv=places, pixels=pixels, alpha=alpha)


def _factor(factor: Any, material: Any) -> tuple[float, float, float, float]:
    """Return red, green, blue and alpha, 0 to 1, of glTF's base colour or an older material's."""
    color = factor if factor is not None else getattr(material, "diffuse", None)
    if color is None:
        return (1.0, 1.0, 1.0, 1.0)
    values = np.asarray(color, np.float64).ravel()
    if np.asarray(color).dtype.kind in "iu":
        values = values / 255.0
    red, green, blue, alpha = np.clip(np.append(values, 1.0)[:4], 0.0, 1.0).tolist()
    return (red, green, blue, alpha)
