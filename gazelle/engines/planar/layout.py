"""Construction of a fleet from a description, and places of models and joints in it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.description import World
from gazelle.engines.planar.body_conversion import ConvertedModels, body_of, levels_of, statics_of
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.kind_layouts import KindLayout, lay_out_kind, parted_by_kind
from gazelle.engines.planar.shapes import joined, primitives_of
from gazelle.engines.planar.wheels import driven, rolling
from gazelle.engines.sections import Levels


@dataclass(frozen=True, slots=True)
class FleetInput:
    """All that a fleet is made of.

    Attributes:
        world: World to simulate.
        time_step: [s].
        motors: Joints with motors and the motors' largest efforts, in the order they were given.
        kinematic: Kinematic models.
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
class PlanarLayout:
    """Indices of models, bodies and joints.

    Attributes:
        models: By name.
        bodies: Index of the body of each model that is one.
        owners: The model of each link, by scoped name.
        joints: First column and number of axes of each joint, by scoped name.
        columns: First column of each model's joints.
        levels: Heights at which shapes are cut.
        limits: Least and greatest value of each joint axis, shape (2, axes).
        of_kind: Models of a kind that lays itself out; empty without such models.
    """

    models: ConvertedModels
    bodies: dict[str, int]
    owners: dict[str, str]
    joints: dict[str, tuple[int, int]]
    columns: dict[str, int]
    levels: Levels
    limits: Floats
    of_kind: KindLayout

    @property
    def axes(self) -> int:
        """Joint axes of all models."""
        return int(self.limits.shape[1])


def build(recipe: FleetInput, nworld: int, threads: int | None) -> tuple[Fleet, PlanarLayout]:
    """Build a fleet.

    Raises:
        EngineError: The world cannot be simulated.
        FormatError: A mesh cannot be read.
    """
    kind, own, others = parted_by_kind(recipe.world.models)
    converted = ConvertedModels(others, recipe.kinematic)
    movers = [each for each in converted.values() if not each.still]
    of_kind = lay_out_kind(kind, own, kinematic=recipe.kinematic, others=len(movers))
    levels = levels_of(converted.values(), recipe.rays | of_kind.heights)
    parts = [part for each in converted.values() if each.still for part in statics_of(each, levels)]
    profile = recipe.world.profile
    fleet = Fleet(
        [*of_kind.bodies, *(body_of(each, levels) for each in movers), *of_kind.extra_bodies],
        joined(of_kind.statics, primitives_of(parts)) if own else parts,
        nworld=nworld,
        time_step=recipe.time_step,
        euler=profile.integrator == "euler",
        sweep=bool(profile.speculative_contacts),
        threads=threads,
    )
    names = [*of_kind.names, *(each.model.name for each in movers)]
    models = ConvertedModels(recipe.world.models, recipe.kinematic.union(of_kind.passive))
    return fleet, _layout_of(models, list(converted), names, levels, of_kind)


def rolling_bases(layout: PlanarLayout, motors: Iterable[str]) -> list[RollingBase]:
    """Return the bases with motors on their wheels, which are in the motors' order."""
    order = {name: place for place, name in enumerate(motors)}
    bases = []
    owners = {joint.split("::", 1)[0] for joint in order}
    for name, index in layout.bodies.items():
        if name not in owners:
            continue
        own = layout.models[name]
        wheels = driven(own.tree.wheels, order) if own.free else ()
        if wheels:
            columns = np.array([layout.joints[wheel.joint][0] for wheel in wheels])
            bases.append(RollingBase(index, columns, rolling(wheels)))
    return bases


def _layout_of(
    models: ConvertedModels,
    jointed: Iterable[str],
    movers: list[str],
    levels: Levels,
    of_kind: KindLayout,
) -> PlanarLayout:
    joints: dict[str, tuple[int, int]] = {}
    columns = dict.fromkeys(models, 0)
    limits: list[tuple[float, float]] = []
    for name in jointed:
        columns[name] = len(limits)
        for scoped, joint in models[name].tree.hinges.items():
            joints[scoped] = (len(limits), len(joint.axes))
            limits += [(axis.lower, axis.upper) for axis in joint.axes]
    bodies = {name: index for index, name in enumerate(movers)}
    bounds = np.array(limits).reshape(-1, 2).T.copy()
    return PlanarLayout(models, bodies, models.owners(), joints, columns, levels, bounds, of_kind)
