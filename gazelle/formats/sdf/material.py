"""``<material>`` of a visual."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from gazelle.description import Color, Material, Parameters
from gazelle.formats import values
from gazelle.formats.materials import (
    STANDARD,
    URDF_COLOR,
    brightened,
    with_script_colors,
    with_urdf_color,
)
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.leftover import Pattern, leftover

_PATTERN: Pattern = {
    **dict.fromkeys(("ambient", "diffuse", "specular", "emissive")),
    "script": {"name": None, "uri": None},
    "pbr": {"metal": {"albedo_map": None}},
}


def read_material(node: Parameters | None, reading: Reading) -> Material | None:
    """Read colours, script and texture; None where the visual has no material."""
    if node is None:
        return None
    script = node.find("script")
    name = ""
    uris: tuple[str, ...] = ()
    if script is not None:
        # files before SDF 1.3 write the script's name as the text itself
        name = values.word(script, "name") or script.text
        uris = tuple(uri.text for uri in script.find_all("uri") if uri.text)
        if uris == (STANDARD,):  # Gazebo finds its own without a path
            uris = ()
    material = Material(
        ambient=_color(node, "ambient"),
        diffuse=_color(node, "diffuse"),
        specular=_color(node, "specular"),
        emissive=_color(node, "emissive"),
        script=name or None,
        script_uris=uris,
        script_places=_places(uris, node, reading),
        texture=_texture(node, reading),
        extras=leftover(node, _PATTERN).children,
    )
    saved = node.attributes.get(URDF_COLOR, "")
    if saved:
        color = values.parse_color(node, saved)
        if material.ambient == material.diffuse == brightened(color):  # it was not changed since
            return with_urdf_color(replace(material, ambient=None, diffuse=None), color)
    return with_script_colors(material)


def _color(node: Parameters, tag: str) -> Color | None:
    child = node.find(tag)
    return values.parse_color(child, child.text) if child is not None and child.text else None


def _places(uris: tuple[str, ...], node: Parameters, reading: Reading) -> tuple[Path, ...]:
    """Return the files of a script that exist; as with pictures, missing ones are not reported."""
    found = (reading.find(uri, node, required=False) for uri in uris)
    return tuple(path for path in found if path is not None)


def _texture(node: Parameters, reading: Reading) -> Path | None:
    """Return the base colour map; a missing picture changes only the look, so it is no miss."""
    for workflow in ("metal", "specular"):
        uri = values.word(node, f"pbr/{workflow}/albedo_map")
        if uri:
            return reading.find(uri, node, required=False)
    return None
