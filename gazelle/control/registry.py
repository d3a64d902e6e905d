"""Find a controller's class by its type.

A type is ``package/Class``. It is looked for among what a program gave to ``register``, then among the
entry points of other packages in the group ``gazelle.controllers`` (their names are types), then in
Gazelle's own table, then as the attribute ``Class`` of a Python package of that name.
``package.module:Class`` names a class itself.
"""

from __future__ import annotations

import functools
import importlib
import pkgutil
from typing import TypeVar

from gazelle.control.controller import Controller, ControllerSetup
from gazelle.control.table import CONTROLLERS
from gazelle.errors import ControlError, did_you_mean
from gazelle_ros.base.entry_points import UNIMPORTABLE, entry_points_of_others

C = TypeVar("C", bound=type[Controller])

_GROUP = "gazelle.controllers"
_registered: dict[str, type[Controller]] = {}


def register(controller_type: str, controller: C) -> C:
    """Register a controller class under a type, such as ``my_controllers/Spring``."""
    _registered[controller_type] = controller
    return controller


def types() -> list[str]:
    """Return all types that are known by name, sorted."""
    return sorted({*_registered, *entry_points_of_others(_GROUP), *CONTROLLERS})


def purpose(name: str) -> str:
    """Return the purpose of a controller type in a line; empty if undocumented or unknown.

    Raises:
        Exception: It is another package's, and cannot be imported; that may raise anything.
    """
    found = _find(name)
    return "" if found is None else (found.__doc__ or "").strip().partition("\n")[0]


def make(setup: ControllerSetup) -> Controller:
    """Create a controller of the requested type, not initialised yet.

    Raises:
        ControlError: There is no such type.
    """
    found = _find(setup.type)
    if found is None:
        raise ControlError(
            f"could not load controller '{setup.name}' because controller type '{setup.type}' does "
            "not exist",
            hint=did_you_mean(setup.type, _beside(setup.type)),
        )
    return found(setup)


def _beside(name: str) -> list[str]:
    """Return the types of the same package, to suggest a similar name; all if it has none."""
    package = name.partition("/")[0]
    return [each for each in types() if each.startswith(f"{package}/")] or types()


def _find(name: str) -> type[Controller] | None:
    if name in _registered:
        return _registered[name]
    point = entry_points_of_others(_GROUP).get(name)
    if point is not None:
        return _checked(point.load(), name)
    if name in CONTROLLERS:
        return _own(name)
    module, _, attribute = name.partition(":" if ":" in name else "/")
    if not attribute:
        return None
    try:
        loaded = importlib.import_module(module)
    except UNIMPORTABLE:
        return None
    found = getattr(loaded, attribute, None)
    return None if found is None else _checked(found, name)


@functools.cache
def _own(name: str) -> type[Controller]:
    """Return a class of the table, with the interface that the type is for."""
    found: type[Controller] = pkgutil.resolve_name(f"gazelle.control.{CONTROLLERS[name].code}")
    interfaces = CONTROLLERS[name].interfaces
    return type(found.__name__, (found,), {"interfaces": interfaces, "__doc__": found.__doc__})


def _checked(found: object, name: str) -> type[Controller]:
    if not (isinstance(found, type) and issubclass(found, Controller)):
        raise ControlError(
            f"'{name}' is not a controller class", hint="subclass gazelle.control.Controller"
        )
    return found
