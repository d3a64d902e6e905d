"""The planar engine: a batch of worlds seen from above, moved by native kernels."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from gazelle.argument_checks import checked, indices, world_indices
from gazelle.array_types import Floats, Indices, Worlds
from gazelle.description import Model, World
from gazelle.engines.hanging_links import HangingLinks
from gazelle.engines.history import Call
from gazelle.engines.laws import with_profile
from gazelle.engines.limits import check_model, check_world, integer, physics_step
from gazelle.engines.planar import columns as c
from gazelle.engines.planar import unsupported
from gazelle.engines.planar.body_writes import rest_joints
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.kinematics import FROZEN
from gazelle.engines.planar.layout import FleetInput, PlanarLayout
from gazelle.engines.planar.ray_casting import PlanarRays
from gazelle.engines.planar.tables.joints import PlanarJointRow, PlanarJointRows
from gazelle.engines.planar.tables.links import PlanarLinkRow, PlanarLinkRows
from gazelle.engines.planar.tables.models import PlanarModelRow, PlanarModelRows
from gazelle.engines.planar.worlds import PlanarState, rows_of
from gazelle.engines.table import Table
from gazelle.errors import EngineError, did_you_mean
from gazelle.native.system import System

# Columns of a snapshot for each body: its row, command, velocity, stall. The row holds the cosine
# and sine of the heading too, which steps advance by themselves.
_BODY = c.BODY + 7


class PlanarEngine:
    """Many copies of one world in a plane; see ``gazelle.engines.engine.Engine``.

    Bases are kinematic: they go as their wheels roll, or as commanded, and stop at
    what they would run into. Nothing falls, and nothing is pushed. What is in the way is looked
    for where each step ends; on the way too if the profile's ``speculative_contacts`` is true.
    Bases go along the arc of their velocity; straight on, and then turn, if the profile's
    ``integrator`` is ``euler``. Models of a kind that lays itself out, such as those of Stage
    files, have its shapes, drives and bounds.

    Args:
        world: World to simulate; collision shapes are cut at the height of lidars and bases.
        nworld: Number of copies.
        time_step: Physics step [s]; the profile's ``kinematic_step`` if None, else its
            ``max_step_size``.
        threads: Native threads; all processors if None. The results do not depend on it.

    Attributes:
        links: Links of all models.
        joints: Joints of all models that can move.
        models: All models.

    Raises:
        EngineError: The world cannot be simulated.
    """

    def __init__(
        self,
        world: World,
        nworld: int = 1,
        *,
        time_step: float | None = None,
        threads: int | None = None,
    ) -> None:
        world = _at_pace(world)
        step = physics_step(world.profile.max_step_size if time_step is None else time_step)
        if step != world.profile.max_step_size:
            world = with_profile(world, replace(world.profile, max_step_size=step))
        check_world(world)
        self._run = PlanarState(FleetInput(world, step, {}), nworld, threads)
        self._make_parts()

    def _make_parts(self) -> None:
        """Make the parts, and expose their methods."""
        run = self._run
        self.make_kinematic = run.make_kinematic
        self.joints: Table[PlanarJointRow, PlanarJointRows] = Table(
            lambda: run.layout.joints,
            lambda name: PlanarJointRow(run, name),
            lambda names: PlanarJointRows(run, names),
        )
        self.models: Table[PlanarModelRow, PlanarModelRows] = Table(
            lambda: run.layout.models,
            lambda name: PlanarModelRow(run, name, self._kinematic),
            lambda names: PlanarModelRows(run, names),
        )
        self.links: Table[PlanarLinkRow, PlanarLinkRows] = Table(
            lambda: run.layout.owners,
            lambda name: PlanarLinkRow(run, name, self.models.__getitem__, hanging, rays.caster),
            lambda names: PlanarLinkRows(run, names),
        )
        rays = PlanarRays(run, self._kinematic)
        hanging = HangingLinks(lambda: run.recipe.world, self.links, self.joints, FROZEN)
        self.caster = rays.caster
        self.range_kind, self.range_table = rays.range_kind, rays.range_table
        self.contacts = unsupported.contacts
        self.attach, self.detach = unsupported.attach, unsupported.detach
        self.set_parameter = unsupported.set_parameter

    def _kinematic(self, model: str) -> None:
        """Make a model kinematic by the engine's own call, which a recorder records."""
        self.make_kinematic(model)

    @property
    def nworld(self) -> int:
        """Number of worlds."""
        return self._run.fleet.nworld

    @property
    def time_step(self) -> float:
        """Physics step [s]."""
        return self._run.recipe.time_step

    @property
    def world(self) -> World:
        """The simulated world, with spawned and without deleted models."""
        return self._run.recipe.world

    @property
    def fleet(self) -> Fleet:
        """Fleet that moves the bodies; it is replaced when models come or go."""
        return self._run.fleet

    @property
    def layout(self) -> PlanarLayout:
        """Indices of models, joints and links among the bodies; read-only."""
        return self._run.layout

    @property
    def revision(self) -> int:
        """Counts changes of models: systems then have to be bound to the state again."""
        return self._run.revision

    def add_motor(self, joint: str, max_effort: ArrayLike) -> None:
        """Add a motor to a single-axis joint that holds a velocity with unlimited effort."""
        self._run.add_motor(joint, max_effort)

    def surround(self, before: Sequence[System], after: Sequence[System]) -> None:
        """Set systems to update at the beginning and the end of every step, until models change.

        Those that are given to ``run`` come before them.
        """
        self._run.steps.surround(before, after)

    @property
    def bodies(self) -> dict[str, int]:
        """Index in the fleet of each model that can move."""
        return dict(self._run.layout.bodies)

    def prepare(self) -> None:
        """Do nothing: a planar world is built at once."""

    # -- time --------------------------------------------------------------------------

    def step(self, count: int = 1, systems: Sequence[System] = (), now_ns: int = 0) -> None:
        """Advance every world by ``count`` physics steps, and update systems that are due."""
        self._run.steps.make(systems, integer("the number of steps", count, 0), now_ns)

    @checked(EngineError, after=True)
    def update(self, system: System, now_ns: int = 0) -> None:
        """Update a system now, whatever its rate, on all threads."""
        self._run.fleet.pool.update(system, self.nworld, now_ns)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Reset worlds to their initial state: poses, rest, no commands."""
        chosen = np.arange(self.nworld) if worlds is None else worlds
        which = world_indices(chosen, self.nworld, EngineError)
        self._run.fleet.reset(which)
        rest_joints(which, self._run.angles, self._run.rates, self._run.targets)

    @checked(EngineError)
    def command(self, commands: ArrayLike) -> None:
        """Set the drive commands of all bodies, shape (nworld, nbody, 3); see ``Drive``."""
        self._run.fleet.command[:] = np.asarray(commands, np.float64)

    def place_body(
        self,
        body: int,
        pose: ArrayLike,
        worlds: Worlds | None = None,
        *,
        height: ArrayLike | None = None,
    ) -> None:
        """Set the pose of a body, regardless of obstacles; its command stays.

        Args:
            body: Its index in the fleet.
            pose: x, y [m] and heading [rad], shape (3,) or (n, 3).
            worlds: Worlds.
            height: Of its frame [m], shape () or (n,); as it was if None.
        """
        self._run.fleet.place(body, pose, worlds, height=height)
        self._run.fleet.stalled[rows_of(worlds), body] = False

    def place_bodies(self, which: Worlds, poses: ArrayLike) -> None:
        """Set the poses of some bodies, at rest; they keep their heights.

        Args:
            which: Bodies, counted through all worlds, shape (n,).
            poses: x, y [m] and heading [rad], shape (n, 3).
        """
        fleet = self._run.fleet
        rows = indices("bodies", which, fleet.stalled.size, EngineError)
        fleet.put(poses, fleet.heights.reshape(-1)[rows], rows)
        for values in (fleet.command, fleet.velocity):
            values.reshape(-1, 3)[rows] = 0.0
        fleet.stalled.reshape(-1)[rows] = False

    # -- change ------------------------------------------------------------------------

    def spawn(self, model: Model) -> None:
        """Add a model to every world, at rest at its ``pose``; all else stays as it is."""
        check_model(model)
        world = self.world
        if model.name in self._run.layout.models:
            raise EngineError(f"there is a model '{model.name}' already", source=model.source)
        self._run.change(
            replace(self._run.recipe, world=replace(world, models=(*world.models, model)))
        )

    def delete(self, model: str) -> None:
        """Delete a model from every world; all else stays as it is."""
        world, known = self.world, self._run.layout.models
        if model not in known:
            raise EngineError(f"there is no model '{model}'", hint=did_you_mean(model, known))
        kept = tuple(each for each in world.models if each.name != model)
        gone = known[model].tree.hinges
        motors = {name: most for name, most in self._run.recipe.motors.items() if name not in gone}
        self._run.change(
            replace(
                self._run.recipe,
                world=replace(world, models=kept),
                motors=motors,
                kinematic=self._run.recipe.kinematic - {model},
            )
        )

    def update_world(self, world: World) -> None:
        """Update all of a world but its models: physics, gravity, air, lights, scene."""
        self._run.update_world(world)

    # -- saving ------------------------------------------------------------------------

    def history(self) -> list[Call]:
        """Return the calls that make a new engine of this ``world`` like this one.

        The state is not included.
        """
        calls = [Call("make_kinematic", (name,)) for name in sorted(self._run.recipe.kinematic)]
        return calls + [Call("add_motor", pair) for pair in self._run.recipe.motors.items()]

    def adopt(self, history: Sequence[Call]) -> None:
        """Replay the calls of a ``history`` on this world; ``restore`` fits then."""
        kinematic = [call.arguments[0] for call in history if call.method == "make_kinematic"]
        motors = dict(call.arguments for call in history if call.method == "add_motor")
        self._run.change(replace(self._run.recipe, kinematic=frozenset(kinematic), motors=motors))

    def snapshot(self) -> Floats:
        """Return the whole dynamic state, shape (nworld, size)."""
        fleet = self._run.fleet
        rows = np.zeros((fleet.nworld, fleet.nbody, _BODY))
        rows[:, :, : c.BODY] = fleet.rows.reshape(fleet.nworld, fleet.nbody, c.BODY)
        rows[:, :, c.BODY : -1] = np.concatenate((fleet.command, fleet.velocity), axis=2)
        rows[:, :, -1] = fleet.stalled
        targets = np.nan_to_num(self._run.targets, nan=0.0)
        flat = rows.reshape(fleet.nworld, -1)
        return np.concatenate((flat, self._run.angles, self._run.rates, targets), axis=1)

    def peek(self) -> Floats:
        """Return the same as ``snapshot``."""
        return self.snapshot()

    def restore(self, state: Floats) -> None:
        """Restore what ``snapshot`` returned; the models must be the same."""
        fleet, axes = self._run.fleet, self._run.layout.axes
        size = fleet.nbody * _BODY
        shape = (fleet.nworld, size + 3 * axes)
        if state.shape != shape:
            raise EngineError(
                f"the saved state has the shape {state.shape}, the worlds that run need {shape}",
                hint="restore into a simulation with the same models and number of worlds",
            )
        rows = state[:, :size].reshape(fleet.nworld, fleet.nbody, _BODY)
        fleet.put_rows(rows[:, :, : c.BODY])
        fleet.command[:] = rows[:, :, c.BODY : c.BODY + 3]
        fleet.velocity[:] = rows[:, :, c.BODY + 3 : -1]
        fleet.stalled[:] = rows[:, :, -1] != 0.0
        joints = state[:, size:].reshape(fleet.nworld, 3, axes)
        self._run.angles[:], self._run.rates[:] = joints[:, 0], joints[:, 1]
        self._run.targets[:] = np.where(np.isnan(self._run.targets), math.nan, joints[:, 2])

    @checked(EngineError)
    def write_state(self, places: Indices, values: Floats) -> None:
        """Set entries of the state, by their places in ``peek``, flattened."""
        state = self.snapshot()
        state.reshape(-1)[indices("places", places, state.size, EngineError)] = values
        self.restore(state)

    # -- parameters --------------------------------------------------------------------

    def parameter(self, kind: str, name: str, worlds: Worlds | None = None) -> Floats:
        """Return the world's gravity, shape (n, 3); the plane has no other parameter."""
        if kind != "gravity" or name:
            raise unsupported.refuse(f"the parameter {kind}")
        every = np.arange(self.nworld) if worlds is None else worlds
        return np.tile(self.world.gravity, (len(world_indices(every, self.nworld, EngineError)), 1))

    def close(self) -> None:
        """Free threads."""
        self._run.fleet.close()


@checked(EngineError, after=True)
def _at_pace(world: World) -> World:
    """Return the world with its step for bodies without dynamics, at the same real-time factor."""
    profile = world.profile
    step = profile.kinematic_step
    if step is None:
        return world
    rate = profile.real_time_update_rate * profile.max_step_size / step
    return with_profile(world, replace(profile, max_step_size=step, real_time_update_rate=rate))
