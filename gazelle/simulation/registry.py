"""Find a plugin's code by the file name that a description gives.

``libgazebo_ros_diff_drive.so`` is looked for as ``gazebo_ros_diff_drive``: among what a program gave
to ``register``, then among the entry points of other packages in the group ``gazelle.plugins``, then
in Gazelle's own table. A file can also name a Python class itself: ``filename="package.module:Class"``.
"""

from __future__ import annotations

import importlib
import pkgutil
import warnings
from importlib.metadata import EntryPoint
from typing import TypeVar, cast

from gazelle import description
from gazelle.errors import SimulationError, SimulationWarning, did_you_mean, located
from gazelle.simulation.base_plugin import BasePlugin
from gazelle.simulation.plugin_table import known_plugins
from gazelle_ros.base.entry_points import UNIMPORTABLE, entry_points_of_others

P = TypeVar("P", bound=type[BasePlugin])

_GROUP = "gazelle.plugins"
_registered: dict[str, type[BasePlugin]] = {}
_missing: set[str] = set()


def register(filename: str, plugin: P) -> P:
    """Register a plugin class under a file name, such as ``libmy_drive.so``."""
    _registered[_stem(filename)] = plugin
    return plugin


def names() -> list[str]:
    """Return all known plugins, as descriptions name them, including those not simulated."""
    stems = {*_registered, *entry_points_of_others(_GROUP), *known_plugins()}
    return sorted(f"lib{stem}.so" for stem in stems)


def purpose(filename: str) -> str:
    """Return the purpose of the plugin of a file name in a line; empty if undocumented or unknown.

    Raises:
        Exception: It is another package's, and cannot be imported; that may raise anything.
    """
    stem = _stem(filename)
    if stem in _registered:
        return _first_line(_registered[stem])
    point = entry_points_of_others(_GROUP).get(stem)
    if point is not None:
        return _first_line(_load(point))
    row = known_plugins().get(stem)
    return row.purpose if row is not None else ""


def find(plugin: description.Plugin) -> type[BasePlugin] | None:
    """Return the class for a ``<plugin>``; None, with a warning where a function is missing.

    A plugin that is not known is warned of once a file name.

    Raises:
        SimulationError: The file names a Python class that cannot be had.
    """
    if ":" in plugin.filename:
        return _import(plugin)
    stem = _stem(plugin.filename)
    if stem in _registered:
        return _registered[stem]
    point = entry_points_of_others(_GROUP).get(stem)
    if point is not None:
        return _load(point)
    row = known_plugins().get(stem)
    if row is not None and row.code:
        return cast("type[BasePlugin]", pkgutil.resolve_name(row.code))
    if row is not None and row.missing:
        _warn(plugin, f": {row.missing}")
    elif row is None and stem not in _missing:
        _missing.add(stem)
        hint = (
            f"{_nearest(f'lib{stem}.so')}'gazelle plugins' lists those that are, and docs/how-to/write-plugin.md "
            "shows how to write it in Python"
        )
        _warn(plugin, f" is not supported and is left out; {hint}")
    return None


def _warn(plugin: description.Plugin, what: str) -> None:
    text = f"plugin '{plugin.name}' ({plugin.filename}){what}"
    warnings.warn(SimulationWarning(located(text, plugin.source)), stacklevel=4)


def _nearest(filename: str) -> str:
    """Return a hint at the name that may have been meant; empty where no name is near."""
    hint = did_you_mean(filename, names())
    return f"{hint} " if hint.startswith("did you mean") else ""


def _import(plugin: description.Plugin) -> type[BasePlugin]:
    """Import the Python class that a file names as ``package.module:Class``."""
    name, _, attribute = plugin.filename.partition(":")
    try:
        module = importlib.import_module(name)
    except UNIMPORTABLE as error:
        raise SimulationError(
            f"the module of plugin '{plugin.name}' cannot be imported: {error}",
            source=plugin.source,
            hint="put its folder on PYTHONPATH, or give it as 'gazelle run --plugins DIR'",
        ) from error
    found = getattr(module, attribute, None)
    if found is None:
        known = [each for each, value in vars(module).items() if _is_plugin(value)]
        raise SimulationError(
            f"the module '{name}' has no '{attribute}'",
            source=plugin.source,
            hint=did_you_mean(attribute, known),
        )
    if not _is_plugin(found):
        raise SimulationError(
            f"'{plugin.filename}' is not a plugin class",
            source=plugin.source,
            hint="subclass gazelle.simulation's WorldPlugin, ModelPlugin or SensorPlugin",
        )
    return cast("type[BasePlugin]", found)


def _is_plugin(value: object) -> bool:
    return isinstance(value, type) and issubclass(value, BasePlugin)


def _load(point: EntryPoint) -> type[BasePlugin]:
    loaded = point.load()
    if not (isinstance(loaded, type) and issubclass(loaded, BasePlugin)):
        raise SimulationError(
            f"the entry point '{point.name}' ({point.value}) is not a plugin class"
        )
    return loaded


def _first_line(plugin: type[BasePlugin]) -> str:
    return (plugin.__doc__ or "").strip().partition("\n")[0]


def _stem(filename: str) -> str:
    name = filename.rsplit("/", 1)[-1]
    return name.removeprefix("lib").removesuffix(".so")
