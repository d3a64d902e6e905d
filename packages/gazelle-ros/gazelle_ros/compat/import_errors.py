"""Imports that fail in scripts, as one line that says what to do."""

from __future__ import annotations

import pkgutil
import re
import sys
import traceback
from collections.abc import Iterable

from gazelle_ros.base.errors import RosError, closest_of
from gazelle_ros.compat import finder
from gazelle_ros.compat.module_hints import attribute_hint, module_hint
from gazelle_ros.messages.library import bundled_packages

_ANYWHERE = "a ROS package goes on ROS_PACKAGE_PATH, a package of PyPI comes with 'pip install'"
_NAME = re.compile(r"cannot import name '(\w+)'")
_KINDS = {"msg": "definitions of messages", "srv": "definitions of services"}


def import_fault(error: BaseException) -> RosError | None:
    """Return the error that takes the place of a traceback; None for what is no import of a script.

    Args:
        error: Exception of the script.
    """
    hint: str | None
    if isinstance(error, ModuleNotFoundError) and error.name:
        message, hint = f"there is no module '{error.name}'", _hint_of_module(error.name)
    elif isinstance(error, ImportError) and error.name and (found := _NAME.search(str(error))):
        module = public_name(error.name)
        if module == error.name and not isinstance(_loader(module), finder.LOADERS):
            return None  # nothing is known of modules that are not ours
        message = f"'{module}' has no '{found[1]}'"
        hint = attribute_hint(module, found[1]) or closest_of(found[1], _names(error.name))
    else:
        return None
    place = _importing_line(error)
    file, line = (None, None) if place is None else (place.filename, place.lineno)
    return RosError(message, file=file, line=line, hint=hint)


def public_name(name: str) -> str:
    """Return the name that scripts know a module of Gazelle by."""
    for known, place in finder.substitutes().items():
        if f"{name}.".startswith(f"{place}."):
            return known + name.removeprefix(place)
    return name.removeprefix(f"{finder.HOME}.")


def _hint_of_module(name: str) -> str:
    parent, _, last = name.rpartition(".")
    if sys.modules.get(parent) is not None:  # Python imports parents first
        none = f"'{parent}' has no {_KINDS.get(last, f'module {last!r}')}"
        return attribute_hint(parent, last) or closest_of(last, _names(parent)) or none
    top = name.partition(".")[0]
    return module_hint(name) or closest_of(top, _tops()) or _ANYWHERE


def _tops() -> Iterable[str]:
    return {*finder.own_modules(), *finder.substitutes(), *bundled_packages()}


def _names(module: str) -> Iterable[str]:
    """Return what can be imported from a module that is there."""
    found = sys.modules[module]
    below = pkgutil.iter_modules(getattr(found, "__path__", ()))
    return {*(each.name for each in below), *(each for each in dir(found) if each[0] != "_")}


def _loader(module: str) -> object:
    spec = getattr(sys.modules.get(module), "__spec__", None)
    return getattr(spec, "loader", None)


def _importing_line(error: BaseException) -> traceback.FrameSummary | None:
    """Return the place of the statement, not those in the import system that it led to."""
    frames = traceback.extract_tb(error.__traceback__)
    return next((each for each in reversed(frames) if "importlib" not in each.filename), None)
