"""Checks of one file or text: findings of the reader, the engine and the plugins."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from pathlib import Path

from gazelle.control.checking import check_controllers, is_controllers
from gazelle.description import World
from gazelle.errors import ControlError, Error, FormatWarning, GazelleWarning, PluginWarning
from gazelle.formats import Problem
from gazelle.formats.check import INCLUDED, TOLERATED, examine, examine_string
from gazelle.formats.opening import on_ground
from gazelle.simulation import Simulation
from gazelle.stage import stage_world


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
        engine: Builds it, for an empty name that of ``gazelle run``; None reads the file only.
        urdf: The robot of controllers, or of an SRDF.
        xacro_args: Values of ``<xacro:arg>``.

    Raises:
        ControlError: The file holds controllers, and no robot is given.
    """
    if is_controllers(Path(file)):
        if urdf is None:
            raise ControlError(f"{file} holds controllers", hint="name their robot: --urdf FILE")
        return check_controllers(file, urdf)
    found, world = examine(file, urdf=urdf, xacro_args=xacro_args)
    return found if engine is None else found + _build(found, world, engine)


def check_text(text: str, name: str, engine: str | None) -> list[Problem]:
    """Return the problems of SDF, URDF or xacro text.

    Args:
        text: The text.
        name: Stands for the file in the problems.
        engine: As for ``check_file``.
    """
    found, world = examine_string(text, name=name)
    return found if engine is None else found + _build(found, world, engine)


def _stops(found: list[Problem]) -> bool:
    """Return whether there is nothing to build."""
    return any(
        each.rule == INCLUDED or (each.severity == "error" and each.rule != TOLERATED)
        for each in found
    )


def _build(found: list[Problem], world: World | None, engine: str) -> list[Problem]:
    """Return the problems that the engine and the plugins report, if a file can be read."""
    if world is None or _stops(found):
        return []
    return _built(on_ground(world) if world.bare else world, engine)


def _built(world: World, engine: str) -> list[Problem]:
    found: list[Problem] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            usual = "mujoco" if stage_world(world) is None else "planar"
            Simulation(world, engine or usual).close()
        except Error as error:
            found.append(Problem.of(error))
    for warning in caught:
        # What the files hold was reported by `gazelle.formats.check` already.
        ours = issubclass(warning.category, GazelleWarning)
        failed = issubclass(warning.category, PluginWarning)
        if ours and not issubclass(warning.category, FormatWarning):
            found.append(Problem("error" if failed else "warning", str(warning.message)))
    return found
