"""Checks of one file or text: findings of the reader, the engine and the plugins."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from pathlib import Path

from gazelle import formats
from gazelle.control.checking import check_controllers, is_controllers
from gazelle.description import World
from gazelle.errors import ControlError, Error, FormatWarning, GazelleWarning, PluginWarning
from gazelle.formats import Problem
from gazelle.formats.check import INCLUDED, TOLERATED, is_semantic
from gazelle.simulation import Simulation


def check_file(
    file: str,
    engine: str | None,
    *,
    urdf: str | None = None,
    xacro_args: Mapping[str, str] | None = None,
) -> list[Problem]:
    """Return the problems of a file.

    Args:
        file: As for ``gazelle.formats.load``; or controllers, or an SRDF.
        engine: Builds it; None reads the file only.
        urdf: The robot of controllers, or of an SRDF.
        xacro_args: Values of ``<xacro:arg>``.

    Raises:
        ControlError: The file holds controllers, and no robot is given.
    """
    if is_controllers(Path(file)):
        if urdf is None:
            raise ControlError(f"{file} holds controllers", hint="name their robot: --urdf FILE")
        return check_controllers(file, urdf)
    found = formats.check(file, urdf=urdf, xacro_args=xacro_args)
    if engine is None or is_semantic(Path(file)) or _stops(found):
        return found

    def source() -> World | str:
        return formats.load(file, xacro_args=xacro_args) if xacro_args else file

    return found + _build(source, engine)


def check_text(text: str, name: str, engine: str | None) -> list[Problem]:
    """Return the problems of SDF, URDF or xacro text.

    Args:
        text: The text.
        name: Stands for the file in the problems.
        engine: Builds it; None reads the text only.
    """
    found = formats.check_string(text, name=name)
    if engine is None or _stops(found):
        return found
    return found + _build(lambda: formats.load_string(text, name=name), engine)


def _stops(found: list[Problem]) -> bool:
    """Return whether there is nothing to build."""
    return any(
        each.rule == INCLUDED or (each.severity == "error" and each.rule != TOLERATED)
        for each in found
    )


def _build(source: Callable[[], World | str], engine: str) -> list[Problem]:
    """Return the problems that the engine and the plugins report."""
    found: list[Problem] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            Simulation(source(), engine).close()
        except Error as error:
            found.append(Problem.of(error))
    for warning in caught:
        # What the files hold was reported by `gazelle.formats.check` already.
        ours = issubclass(warning.category, GazelleWarning)
        failed = issubclass(warning.category, PluginWarning)
        if ours and not issubclass(warning.category, FormatWarning):
            found.append(Problem("error" if failed else "warning", str(warning.message)))
    return found
