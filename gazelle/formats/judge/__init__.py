"""Judge a description as an experienced engineer would, beyond what a reader must refuse."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from gazelle.description import World
from gazelle.formats.judge import inertias, joints, plugins, sensors, worlds
from gazelle.formats.judge.finding import Finding

_JUDGES: tuple[Callable[[World], Iterable[Finding]], ...] = (
    inertias.judge,
    joints.judge,
    sensors.judge,
    plugins.judge,
    worlds.judge,
)

__all__ = ["Finding", "judge"]


def judge(world: World) -> list[Finding]:
    """Everything about a world that deserves a second look, room by room."""
    return [finding for rule in _JUDGES for finding in rule(world)]
