"""Run one scene in two engines, and say how far apart they come."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from second_engine.bullet import Bullet

from gazelle.description import World
from gazelle.engines import make_engine

SAMPLE = 0.01


@dataclass(frozen=True)
class Measure:
    """Something that two engines should agree on.

    Attributes:
        name: What it is.
        unit: ``mm``, ``mrad`` or ``rad/s``.
        read: Its values now, from an engine.
        tolerance: Largest difference allowed at a physics step of 1 ms, in that unit: the measured
            one and about half as much again.
        why: What the difference comes from.
        after: Compared from this time on [s].
    """

    name: str
    unit: str
    read: Callable[[Any], list[float]]
    tolerance: float
    why: str
    after: float = 0.0


@dataclass(frozen=True)
class Scene:
    """A world that both engines move from the same start.

    Attributes:
        name: What moves.
        make: Its description.
        start: Sets the start, in either engine.
        seconds: How long it runs.
        measures: What is compared.
    """

    name: str
    make: Callable[[], World]
    start: Callable[[Any], None]
    seconds: float
    measures: tuple[Measure, ...]


@dataclass(frozen=True)
class Outcome:
    """How far two engines came apart, and how much moved at all; in the unit of the measure."""

    difference: float
    moved: float


_SCALES = {"mm": 1000.0, "mrad": 1000.0, "rad/s": 1.0}


def compare(scene: Scene, step: float) -> list[Outcome]:
    """Return the outcome of each measure, at a physics step [s], both engines by Euler."""
    world = scene.make()
    profile = replace(world.profile, max_step_size=step, integrator="euler")
    world = replace(world, physics=(profile,))
    ours = trajectory(scene, make_engine("mujoco", world), step)
    theirs = trajectory(scene, Bullet(world), step)
    return [
        _outcome(measure, mine, other)
        for measure, mine, other in zip(scene.measures, ours, theirs, strict=True)
    ]


def trajectory(scene: Scene, engine: Any, step: float) -> list[np.ndarray]:
    """Return the values of each measure at every sample, shape (samples, values)."""
    rows: list[list[list[float]]] = [[] for _ in scene.measures]
    try:
        scene.start(engine)
        for _ in range(round(scene.seconds / SAMPLE)):
            engine.step(round(SAMPLE / step))
            for row, measure in zip(rows, scene.measures, strict=True):
                row.append(measure.read(engine))
    finally:
        engine.close()
    return [np.array(row) for row in rows]


def _outcome(measure: Measure, ours: np.ndarray, theirs: np.ndarray) -> Outcome:
    first = round(measure.after / SAMPLE)
    scale = _SCALES[measure.unit]
    difference = float(np.abs(ours - theirs)[first:].max()) * scale
    return Outcome(difference, float(np.ptp(ours, axis=0).max()) * scale)
