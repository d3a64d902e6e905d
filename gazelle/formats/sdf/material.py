"""``<material>`` of a visual."""

from __future__ import annotations

from pathlib import Path

from gazelle.description import Color, Material, Parameters
from gazelle.formats import values
from gazelle.formats.materials import is_standard, with_script_colors
from gazelle.formats.reading import Reading


def read_material(node: Parameters | None, reading: Reading) -> Material | None:
    """Colours, script and texture; None where the visual has no material."""
    if node is None:
        return None
    script = node.find("script")
    name = ""
    uris: tuple[str, ...] = ()
    if script is not None:
        # files before SDF 1.3 write the script's name as the text itself
        name = values.word(script, "name") or script.text
        uris = tuple(uri.text for uri in script.find_all("uri") if uri.text)
        if is_standard(name, uris):
            uris = ()
    return with_script_colors(
        Material(
            ambient=_color(node, "ambient"),
            diffuse=_color(node, "diffuse"),
            specular=_color(node, "specular"),
            emissive=_color(node, "emissive"),
            script=name or None,
            script_uris=uris,
            texture=_texture(node, reading),
        )
    )


def _color(node: Parameters, tag: str) -> Color | None:
    child = node.find(tag)
    return values.parse_color(child, child.text) if child is not None and child.text else None


def _texture(node: Parameters, reading: Reading) -> Path | None:
    """The base colour map; a missing picture changes only the look, so it is no miss."""
    for workflow in ("metal", "specular"):
        uri = values.word(node, f"pbr/{workflow}/albedo_map")
        if uri:
            return reading.find(uri, node, required=False)
    return None
