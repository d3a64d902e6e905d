"""Planar worlds that run: their description, their state, and when they are made again."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Floats, Indices, Worlds
from gazelle.description import World
from gazelle.engines.limits import physics_step
from gazelle.engines.planar.body_conversion import ConvertedModel
from gazelle.engines.planar.body_poses import poses_of
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.layout import FleetInput, PlanarLayout, build, rolling_bases
from gazelle.engines.planar.rolling import Joints
from gazelle.engines.planar.system_steps import SystemSteps
from gazelle.engines.sections import LEVEL
from gazelle.errors import EngineError, did_you_mean

T = TypeVar("T")


class PlanarState:
    """Many copies of a world seen from above, which the parts of the engine share.

    Args:
        recipe: Recipe of the batch.
        nworld: Number of copies.
        threads: Native threads; all processors if None.

    Attributes:
        recipe: Recipe of the running plane.
        fleet: Moves the bodies.
        layout: Layout of models, joints and links.
        angles: Of all joints [m or rad], shape (nworld, axes).
        rates: Their velocities, likewise.
        targets: Velocities that motors hold, likewise; not a number where there is no motor.
        steps: Makes steps.
        revision: Counts changes of models and of the step.
        on_change: Called when other models run: caches of them are dropped.
    """

    recipe: FleetInput
    fleet: Fleet
    layout: PlanarLayout
    angles: Floats
    rates: Floats
    targets: Floats
    steps: SystemSteps

    def __init__(self, recipe: FleetInput, nworld: int, threads: int | None) -> None:
        self._threads = threads
        self.revision = 0
        self.on_change: list[Callable[[], None]] = []
        self._start(recipe, *build(recipe, nworld, threads))

    def _start(self, recipe: FleetInput, fleet: Fleet, layout: PlanarLayout) -> None:
        """Start a fleet from its initial state."""
        self.recipe, self.fleet, self.layout = recipe, fleet, layout
        self.revision += 1
        shape = (fleet.nworld, layout.axes)
        self.angles, self.rates = np.zeros(shape), np.zeros(shape)
        self.targets = np.full(shape, math.nan)
        for joint in recipe.motors:
            self.targets[:, layout.joints[joint][0]] = 0.0
        self.steps = SystemSteps(fleet, self._joints, layout.axes)
        for forget in self.on_change:
            forget()

    def _joints(self) -> Joints:
        """Return joints and rolling bases as kernels see them."""
        layout = self.layout
        bases = rolling_bases(layout, self.recipe.motors)
        return Joints(
            angles=self.angles,
            rates=self.rates,
            targets=self.targets,
            limits=layout.limits,
            base=np.array([each.body for each in bases], np.intp),
            first=np.cumsum([0, *(len(each.columns) for each in bases)], dtype=np.intp),
            column=np.concatenate([np.zeros(0, np.intp), *(each.columns for each in bases)]),
            matrix=np.vstack([np.zeros((0, 3)), *(each.matrix.T for each in bases)]),
        )

    # -- change ------------------------------------------------------------------------

    def change(self, recipe: FleetInput) -> None:
        """Replace the models, and keep the states of what both have."""
        fleet, layout = self.fleet, self.layout
        angles, rates, targets = self.angles, self.rates, self.targets
        self._start(recipe, *build(recipe, fleet.nworld, self._threads))
        for name, body in self.layout.bodies.items():
            if name in layout.bodies:
                self.fleet.copy_from(body, fleet, layout.bodies[name])
        for name, (first, count) in self.layout.joints.items():
            if name in layout.joints:
                here, there = slice(first, first + count), layout.joints[name][0]
                old = slice(there, there + count)
                self.angles[:, here], self.rates[:, here] = angles[:, old], rates[:, old]
                held = ~np.isnan(targets[:, old]) & ~np.isnan(self.targets[:, here])
                np.copyto(self.targets[:, here], targets[:, old], where=held)
        fleet.close()

    def make_kinematic(self, model: str) -> None:
        """Make a model kinematic: ``set_model_placement`` moves it."""
        self.model(model)
        if model not in self.recipe.kinematic:
            kinematic = self.recipe.kinematic | {model}
            self.change(replace(self.recipe, kinematic=kinematic))

    def add_motor(self, joint: str, max_effort: ArrayLike) -> None:
        """Add a motor to a single-axis joint that holds a velocity with unlimited effort."""
        axes = self.axes(joint)
        if axes.stop - axes.start != 1:
            raise EngineError(f"a motor needs a joint of one axis; '{joint}' has more")
        try:
            most = float(np.asarray(max_effort, np.float64).reshape(1)[0])
        except (TypeError, ValueError, OverflowError):
            raise EngineError(
                f"the largest effort of the motor on '{joint}' must be a number, not {max_effort!r}"
            ) from None
        if not most > 0.0:
            raise EngineError(f"the largest effort of a motor must be positive, not {most:g}")
        self.recipe = replace(self.recipe, motors={**self.recipe.motors, joint: most})
        held = self.targets[:, axes.start]
        held[np.isnan(held)] = 0.0
        self.steps.forget()

    def cut_at(self, height: float) -> None:
        """Cut shapes at one more height [m], for rays."""
        known = [*self.recipe.rays, *self.layout.levels.rays]
        if all(abs(level - height) > LEVEL / 2.0 for level in known):
            self.change(replace(self.recipe, rays=self.recipe.rays | {round(height, 4)}))

    def update_world(self, world: World) -> None:
        """Update all of a world but its models: physics, gravity, air, lights, scene."""
        step = physics_step(world.profile.max_step_size)
        models = self.recipe.world.models
        self.recipe = replace(self.recipe, world=replace(world, models=models), time_step=step)
        if step != self.fleet.time_step:
            self.revision += 1
        self.fleet.time_step = step
        self.fleet.sweep = bool(world.profile.speculative_contacts)
        self.steps.forget()

    # -- finding -----------------------------------------------------------------------

    def own(self, model: str, worlds: Worlds | None) -> tuple[Floats, Floats]:
        """Return positions and velocities of a model's joints, shapes (n, axes)."""
        first = self.layout.columns[model]
        columns = slice(first, first + self.layout.models[model].tree.width)
        rows = rows_of(worlds)
        return self.angles[rows, columns], self.rates[rows, columns]

    def model(self, name: str) -> ConvertedModel:
        """Return the model of a name."""
        return _look_up("model", name, self.layout.models)

    def owner(self, link: str) -> str:
        """Return the model of a link."""
        return _look_up("link", link, self.layout.owners)

    def axes(self, joint: str) -> slice:
        """Return the columns of a joint."""
        first, count = _look_up("joint", joint, self.layout.joints)
        return slice(first, first + count)

    def poses(self, body: Indices, leans: Floats, worlds: Worlds | None) -> tuple[Floats, Floats]:
        """Return poses of bodies, shapes (n, bodies, 3) and (n, bodies, 4).

        Args:
            body: Their indices, shape (bodies,).
            leans: Turns before their headings, shape (bodies, 4).
            worlds: Worlds; all if None.
        """
        some = np.arange(self.fleet.nworld) if worlds is None else worlds
        rows = some[:, None] * self.fleet.nbody + body
        at, turned = poses_of(self.fleet.bodies, rows.reshape(-1), leans)
        return at.reshape(*rows.shape, 3), turned.reshape(*rows.shape, 4)

    def rows(self, body: int, worlds: Worlds | None) -> slice | NDArray[np.intp]:
        """Return rows of a body in the fleet's tables."""
        nbody = self.fleet.nbody
        return slice(body, None, nbody) if worlds is None else worlds * nbody + body


def rows_of(worlds: Worlds | None) -> slice | Worlds:
    """Return an index for these worlds, all if None."""
    return slice(None) if worlds is None else worlds


def _look_up(kind: str, name: str, known: Mapping[str, T]) -> T:
    try:
        return known[name]
    except KeyError:
        raise EngineError(f"there is no {kind} '{name}'", hint=did_you_mean(name, known)) from None
