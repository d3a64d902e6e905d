"""``<plugin>``, kept whole."""

from __future__ import annotations

from gazelle.description import Parameters, Plugin
from gazelle.formats.sdf.leftover import without

_NAMES = {"filename", "name"}


def read_plugin(node: Parameters) -> Plugin:
    """Read a plugin with its parameters; one without a name is named after its file."""
    filename = node.attributes.get("filename", "")
    return Plugin(
        name=node.attributes.get("name", "") or filename,
        filename=filename,
        parameters=without(node, _NAMES),
        source=node.source,
    )


def read_plugins(node: Parameters) -> tuple[Plugin, ...]:
    """Read all plugins directly in an element, in file order."""
    return tuple(map(read_plugin, node.find_all("plugin")))
