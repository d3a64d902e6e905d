"""Find a plugin's code by the file name that a description gives.

Gazelle's own and other packages' plugins are entry points of the group ``gazelle.plugins``,
named like the library without ``lib`` and ``.so``: ``libgazebo_ros_diff_drive.so`` is found as
``gazebo_ros_diff_drive``. A program can add its own with ``register``, and a file can name a
Python class itself: ``filename="package.module:Class"``.
"""

from __future__ import annotations

import functools
import importlib
import warnings
from importlib.metadata import EntryPoint, entry_points
from typing import TypeVar, cast

from gazelle import description
from gazelle.errors import SimulationError, SimulationWarning, did_you_mean, located
from gazelle.simulation.plugin import Plugin

P = TypeVar("P", bound=type[Plugin])

_GROUP = "gazelle.plugins"
_registered: dict[str, type[Plugin]] = {}
_missing: set[str] = set()


def register(filename: str, plugin: P) -> P:
    """Let descriptions name a plugin class by a file name, such as ``libmy_drive.so``."""
    _registered[_stem(filename)] = plugin
    return plugin


def names() -> list[str]:
    """All plugins that can be found, as descriptions name them."""
    return sorted(f"lib{stem}.so" for stem in {*_registered, *_entry_points()})


def find(plugin: description.Plugin) -> type[Plugin] | None:
    """The class for a ``<plugin>``; None, with one warning a file name, if there is none.

    Raises:
        SimulationError: The file names a Python class that cannot be had.
    """
    if ":" in plugin.filename:
        return _import(plugin)
    stem = _stem(plugin.filename)
    if stem in _registered:
        return _registered[stem]
    known = _entry_points()
    if stem in known:
        return _load(known[stem])
    if stem not in _missing:
        _missing.add(stem)
        text = (
            f"plugin '{plugin.name}' ({plugin.filename}) is not supported and is left out; "
            f"{_nearest(f'lib{stem}.so')}'gazelle plugins' lists those that are"
        )
        warnings.warn(SimulationWarning(located(text, plugin.source)), stacklevel=3)
    return None


def _nearest(filename: str) -> str:
    """What may have been meant; nothing where no name is near."""
    hint = did_you_mean(filename, names())
    return f"{hint} " if hint.startswith("did you mean") else ""


def _import(plugin: description.Plugin) -> type[Plugin]:
    """The Python class that a file names as ``package.module:Class``."""
    name, _, attribute = plugin.filename.partition(":")
    try:
        module = importlib.import_module(name)
    except ImportError as error:
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
            f"'{plugin.filename}' is no plugin class",
            source=plugin.source,
            hint="subclass gazelle.simulation's WorldPlugin, ModelPlugin or SensorPlugin",
        )
    return cast("type[Plugin]", found)


def _is_plugin(value: object) -> bool:
    return isinstance(value, type) and issubclass(value, Plugin)


def _load(point: EntryPoint) -> type[Plugin]:
    loaded = point.load()
    if not (isinstance(loaded, type) and issubclass(loaded, Plugin)):
        raise SimulationError(f"the entry point '{point.name}' ({point.value}) is no plugin class")
    return loaded


@functools.cache
def _entry_points() -> dict[str, EntryPoint]:
    return {point.name: point for point in entry_points(group=_GROUP)}


def _stem(filename: str) -> str:
    name = filename.rsplit("/", 1)[-1]
    return name.removeprefix("lib").removesuffix(".so")
