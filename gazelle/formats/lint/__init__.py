"""Checks of descriptions for likely mistakes, beyond the errors that readers raise."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from gazelle.description import World
from gazelle.formats.lint import inertias, joints, plugins, sensors, transmissions, worlds
from gazelle.formats.lint.diagnostic import Diagnostic

_RULES: tuple[Callable[[World], Iterable[Diagnostic]], ...] = (
    inertias.lint,
    joints.lint,
    transmissions.lint,
    sensors.lint,
    plugins.lint,
    worlds.lint,
)

__all__ = ["Diagnostic", "lint"]


def lint(world: World) -> list[Diagnostic]:
    """Return all diagnostics of a world, check by check."""
    return [finding for rule in _RULES for finding in rule(world)]
