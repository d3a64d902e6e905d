"""``<plugin>``, as it was kept."""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType

from gazelle.description import Parameters, Plugin


def write_plugin(plugin: Plugin) -> Parameters:
    """Write a plugin with its parameters, word for word."""
    attributes = {
        "name": plugin.name,
        "filename": plugin.filename,
        **plugin.parameters.attributes,
    }
    return replace(plugin.parameters, tag="plugin", attributes=MappingProxyType(attributes))
