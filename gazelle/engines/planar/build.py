"""A fleet made of a description, and where its models and joints are in it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.description import World
from gazelle.engines.planar.anatomy import Anatomy, anatomy_of, body_of, levels_of, statics_of
from gazelle.engines.planar.cuts import Levels
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.wheels import grouped, rolling


@dataclass(frozen=True, slots=True)
class Recipe:
    """All that a fleet is made of.

    Attributes:
        world: What to simulate.
        time_step: [s].
        motors: Joints with motors and the motors' largest efforts, in the order they were given.
        kinematic: Models that only move when told to.
        rays: Heights of rays beside those of the lidars [m].
    """

    world: World
    time_step: float
    motors: Mapping[str, float]
    kinematic: frozenset[str] = frozenset()
    rays: frozenset[float] = frozenset()


@dataclass(frozen=True, slots=True)
class RollingBase:
    """A base that its wheels drive.

    Attributes:
        body: Its index.
        columns: Of the wheels' joints.
        matrix: From wheel speeds to the twist, shape (3, wheels).
    """

    body: int
    columns: NDArray[np.intp]
    matrix: Floats


@dataclass(frozen=True, slots=True)
class Layout:
    """Where everything is.

    Attributes:
        models: By name.
        bodies: Index of the body of each model that is one.
        owners: The model of each link, by scoped name.
        joints: First column and number of axes of each joint, by scoped name.
        columns: First column of each model's joints.
        rollings: Bases with motors on their wheels.
        levels: Heights at which shapes are cut.
        limits: Least and greatest value of each joint axis, shape (2, axes).
    """

    models: dict[str, Anatomy]
    bodies: dict[str, int]
    owners: dict[str, str]
    joints: dict[str, tuple[int, int]]
    columns: dict[str, int]
    rollings: tuple[RollingBase, ...]
    levels: Levels
    limits: Floats

    @property
    def axes(self) -> int:
        """Joint axes of all models."""
        return int(self.limits.shape[1])


def build(recipe: Recipe, nworld: int, threads: int | None) -> tuple[Fleet, Layout]:
    """Make a fleet.

    Raises:
        EngineError: The world cannot be simulated.
        FormatError: A mesh cannot be read.
    """
    models = {
        model.name: anatomy_of(model, kinematic=model.name in recipe.kinematic)
        for model in recipe.world.models
    }
    levels = levels_of(models.values(), recipe.rays)
    movers = [each for each in models.values() if not each.still]
    statics = [part for each in models.values() if each.still for part in statics_of(each, levels)]
    bodies = [body_of(each, levels) for each in movers]
    fleet = Fleet(
        bodies,
        statics,
        nworld=nworld,
        time_step=recipe.time_step,
        sweep=bool(recipe.world.profile.speculative_contacts),
        threads=threads,
    )
    names = [each.model.name for each in movers]
    return fleet, _layout_of(models, names, recipe.motors, levels)


def _layout_of(
    models: dict[str, Anatomy], movers: list[str], motors: Iterable[str], levels: Levels
) -> Layout:
    joints: dict[str, tuple[int, int]] = {}
    columns: dict[str, int] = {}
    limits: list[tuple[float, float]] = []
    for name, each in models.items():
        columns[name] = len(limits)
        for hinge in each.skeleton.hinges.values():
            joints[hinge.name] = (len(limits), len(hinge.joint.axes))
            limits += [(axis.lower, axis.upper) for axis in hinge.joint.axes]
    bodies = {name: index for index, name in enumerate(movers)}
    wanted = list(motors)
    rollings = []
    for name, index in bodies.items():
        wheels = grouped(models[name].skeleton.wheels, wanted) if models[name].loose else ()
        if wheels:
            own = np.array([joints[wheel.joint][0] for wheel in wheels])
            rollings.append(RollingBase(index, own, rolling(wheels)))
    owners = {link: name for name, each in models.items() for link in each.skeleton.bones}
    bounds = np.array(limits).reshape(-1, 2).T.copy()
    return Layout(models, bodies, owners, joints, columns, tuple(rollings), levels, bounds)
