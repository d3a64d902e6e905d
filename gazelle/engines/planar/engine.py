"""The planar engine: a batch of worlds seen from above, moved by native kernels."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.description import Model, World
from gazelle.engines.history import Call
from gazelle.engines.laws import with_profile
from gazelle.engines.limits import check_world, physics_step, whole_number
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.access import PlanarAccess, rows_of
from gazelle.engines.planar.build import FleetInput, PlanarLayout, build, rolling_bases
from gazelle.engines.planar.cuts import LEVEL
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.paths import PathFollower
from gazelle.engines.planar.refusals import Refusals
from gazelle.engines.planar.rolling import Joints
from gazelle.engines.planar.system_steps import SystemSteps
from gazelle.errors import EngineError, did_you_mean
from gazelle.native.system import System

# Columns of a snapshot for each body: its row, command, velocity, stall. The row holds the cosine
# and sine of the heading too, which steps advance by themselves.
_BODY = c.BODY + 7


class PlanarEngine(Refusals, PlanarAccess):
    """Many copies of one world in a plane; see ``gazelle.engines.engine.Engine``.

    Bases are kinematic: they go as their wheels roll, or as they were told to, and stop at
    what they would run into. Nothing falls, and nothing is pushed. What is in the way is looked
    for where each step ends; on the way too if the profile's ``speculative_contacts`` is true.
    Bases go along the arc of their velocity; straight on, and then turn, if the profile's
    ``integrator`` is ``euler``. Models of Stage files have the shapes, drives and bounds that
    Stage gives them, and the world then has Stage's time step.

    Args:
        world: What to simulate; collision shapes are cut at the height of lidars and bases.
        nworld: Number of copies.
        time_step: Physics step [s]; the world's ``max_step_size`` if None.
        threads: Native threads; all processors if None. The results do not depend on it.

    Attributes:
        own_changes: Methods that change it beside those of every engine.

    Raises:
        EngineError: The world cannot be simulated.
    """

    own_changes = ("command", "place_bodies", "place_body")

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
        self._threads = threads
        recipe = FleetInput(world, step, {})
        self._run(recipe, *build(recipe, nworld, threads))

    def _run(self, recipe: FleetInput, fleet: Fleet, layout: PlanarLayout) -> None:
        """Go on with a fleet, from its initial state."""
        self._recipe, self._fleet, self._layout = recipe, fleet, layout
        self._revision = getattr(self, "_revision", 0) + 1
        shape = (fleet.nworld, layout.axes)
        self._angles, self._rates = np.zeros(shape), np.zeros(shape)
        self._targets = np.full(shape, math.nan)
        for joint in recipe.motors:
            self._targets[:, layout.joints[joint][0]] = 0.0
        self._casters, self._recent, self._tables, self._model_tables = {}, {}, {}, {}
        self._steps = SystemSteps(fleet, self._joints, layout.axes)

    def _joints(self) -> Joints:
        """Joints and rolling bases as kernels see them."""
        layout = self._layout
        bases = rolling_bases(layout, self._recipe.motors)
        return Joints(
            angles=self._angles,
            rates=self._rates,
            targets=self._targets,
            limits=layout.limits,
            base=np.array([each.body for each in bases], np.intp),
            first=np.cumsum([0, *(len(each.columns) for each in bases)], dtype=np.intp),
            column=np.concatenate([np.zeros(0, np.intp), *(each.columns for each in bases)]),
            matrix=np.vstack([np.zeros((0, 3)), *(each.matrix.T for each in bases)]),
        )

    @property
    def nworld(self) -> int:
        """Number of worlds."""
        return self._fleet.nworld

    @property
    def time_step(self) -> float:
        """Physics step [s]."""
        return self._recipe.time_step

    @property
    def world(self) -> World:
        """The world that runs, with what was spawned and without what was deleted."""
        return self._recipe.world

    @property
    def link_names(self) -> tuple[str, ...]:
        """Scoped names, ``model::link``."""
        return tuple(self._layout.owners)

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Scoped names, ``model::joint``, of joints that can move."""
        return tuple(self._layout.joints)

    @property
    def fleet(self) -> Fleet:
        """What moves the bodies; it is replaced when models come or go."""
        return self._fleet

    @property
    def layout(self) -> PlanarLayout:
        """Where models, joints and links are among the bodies; to be read."""
        return self._layout

    @property
    def revision(self) -> int:
        """Counts changes of models: systems then have to be bound to the state anew."""
        return self._revision

    def motor_targets(self, joint: str) -> tuple[Floats, int]:
        """Velocities that motors hold, shape (nworld, axes), to be written, and a joint's column.

        Raises:
            EngineError: There is no motor on the joint.
        """
        column = self._axes(joint).start
        if np.isnan(self._targets[:, column]).any():
            raise EngineError(f"there is no motor on joint '{joint}'", hint="give it one first")
        return self._targets, column

    def follow(self, model: str, path: PathFollower) -> None:
        """Let a path carry a model, which has to be kinematic."""
        path.carry(self._fleet.bodies, self._layout.bodies[model])

    def surround(self, before: Sequence[System], after: Sequence[System]) -> None:
        """Have systems updated at the beginning and the end of every step, until models change.

        Those that are given to ``run`` come before them.
        """
        self._steps.surround(before, after)

    @property
    def bodies(self) -> dict[str, int]:
        """Index in the fleet of each model that can move."""
        return dict(self._layout.bodies)

    # -- time --------------------------------------------------------------------------

    def step(self, count: int = 1) -> None:
        """Advance every world by ``count`` physics steps."""
        self.run((), count, 0)

    def run(self, systems: Sequence[System], count: int, now_ns: int) -> None:
        """The same, with systems that are updated whenever they are due, in this order.

        Args:
            systems: They may write commands, motors' velocities and poses in their own worlds.
            count: Of steps.
            now_ns: Time [ns].
        """
        self._steps.make(systems, whole_number("the number of steps", count, 0), now_ns)

    def update(self, system: System) -> None:
        """Update a system now, whatever its rate, on all threads."""
        fleet = self._fleet
        rows = fleet.nworld * system.rows
        fleet.pool.share(lambda first, last, _: system.bring(first, last, 0), rows, system.least)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Put worlds back to their initial state: poses, rest, no commands."""
        self._fleet.reset(worlds)
        if not self._layout.axes:
            return
        rows = rows_of(worlds)
        self._angles[rows], self._rates[rows] = 0.0, 0.0
        # Where there is no motor there is no number, and that in all worlds.
        self._targets[rows] = np.where(np.isnan(self._targets[0]), math.nan, 0.0)

    def command(self, wanted: ArrayLike) -> None:
        """Set what drives of all bodies are told, shape (nworld, nbody, 3); see ``Drive``."""
        self._fleet.command[:] = np.asarray(wanted, np.float64)

    def place_body(
        self,
        body: int,
        pose: ArrayLike,
        worlds: Worlds | None = None,
        *,
        height: ArrayLike | None = None,
    ) -> None:
        """Put a body somewhere, whatever is there; what it is told stays.

        Args:
            body: Its index in the fleet.
            pose: x, y [m] and heading [rad], shape (3,) or (n, 3).
            worlds: Which worlds.
            height: Of its frame [m], shape () or (n,); as it was if None.
        """
        self._fleet.place(body, pose, worlds)
        self._fleet.stalled[rows_of(worlds), body] = False
        if height is not None:
            self._fleet.heights[rows_of(worlds), body] = height

    def place_bodies(self, which: Worlds, poses: ArrayLike) -> None:
        """Put some bodies somewhere, at rest; they keep their heights.

        Args:
            which: Bodies, counted through all worlds, shape (n,).
            poses: x, y [m] and heading [rad], shape (n, 3).
        """
        fleet = self._fleet
        for values in (fleet.command, fleet.velocity):
            values.reshape(-1, 3)[which] = 0.0
        fleet.stalled.reshape(-1)[which] = False
        fleet.put(poses, fleet.heights.reshape(-1)[which], which)

    # -- change ------------------------------------------------------------------------

    def spawn(self, model: Model) -> None:
        """Add a model to every world, at rest at its ``pose``; all else stays as it is."""
        world = self.world
        if model.name in self._layout.models:
            raise EngineError(f"there is a model '{model.name}' already", source=model.source)
        self._change(replace(self._recipe, world=replace(world, models=(*world.models, model))))

    def delete(self, model: str) -> None:
        """Take a model out of every world; all else stays as it is."""
        world, known = self.world, self._layout.models
        if model not in known:
            raise EngineError(f"there is no model '{model}'", hint=did_you_mean(model, known))
        kept = tuple(each for each in world.models if each.name != model)
        gone = known[model].skeleton.hinges
        motors = {name: most for name, most in self._recipe.motors.items() if name not in gone}
        self._change(
            replace(
                self._recipe,
                world=replace(world, models=kept),
                motors=motors,
                kinematic=self._recipe.kinematic - {model},
            )
        )

    def add_motor(self, joint: str, max_effort: ArrayLike) -> None:
        """Give a joint of one axis a motor that holds a velocity, whatever that takes."""
        axes = self._axes(joint)
        if axes.stop - axes.start != 1:
            raise EngineError(f"a motor needs a joint of one axis; '{joint}' has more")
        most = float(np.asarray(max_effort, np.float64).reshape(-1)[0])
        if not most > 0.0:
            raise EngineError(f"the largest effort of a motor must be positive, not {most:g}")
        self._recipe = replace(self._recipe, motors={**self._recipe.motors, joint: most})
        held = self._targets[:, axes.start]
        held[np.isnan(held)] = 0.0
        self._steps.forget()

    def make_kinematic(self, model: str) -> None:
        """Let a model move only by ``set_model_placement``."""
        self._model(model)
        if model not in self._recipe.kinematic:
            kinematic = self._recipe.kinematic | {model}
            self._change(replace(self._recipe, kinematic=kinematic))

    def update_world(self, world: World) -> None:
        """Take over all of a world but its models: physics, gravity, air, lights, scene."""
        step = world.profile.max_step_size
        if not step > 0.0:
            raise EngineError(f"the physics step must be positive, not {step:g} s")
        models = self.world.models
        self._recipe = replace(self._recipe, world=replace(world, models=models), time_step=step)
        if step != self._fleet.time_step:
            self._revision += 1
        self._fleet.time_step = step
        self._fleet.sweep = bool(world.profile.speculative_contacts)
        self._steps.forget()

    def _cut_at(self, height: float) -> None:
        """Cut shapes at one more height [m], for rays."""
        known = [*self._recipe.rays, *self._layout.levels.rays]
        if all(abs(level - height) > LEVEL / 2.0 for level in known):
            self._change(replace(self._recipe, rays=self._recipe.rays | {round(height, 4)}))

    def _change(self, recipe: FleetInput) -> None:
        """Go on with other models, with all states that both have."""
        fleet, layout = self._fleet, self._layout
        angles, rates, targets = self._angles, self._rates, self._targets
        made = build(recipe, fleet.nworld, self._threads)
        self._run(recipe, *made)
        for name, body in self._layout.bodies.items():
            if name in layout.bodies:
                self._fleet.take_over(body, fleet, layout.bodies[name])
        for name, (first, count) in self._layout.joints.items():
            if name in layout.joints:
                here, there = slice(first, first + count), layout.joints[name][0]
                old = slice(there, there + count)
                self._angles[:, here], self._rates[:, here] = angles[:, old], rates[:, old]
                held = ~np.isnan(targets[:, old]) & ~np.isnan(self._targets[:, here])
                np.copyto(self._targets[:, here], targets[:, old], where=held)
        fleet.close()

    # -- saving ------------------------------------------------------------------------

    def history(self) -> list[Call]:
        """Calls that make a new engine of this ``world`` one like this, but for the state."""
        calls = [Call("make_kinematic", (name,)) for name in sorted(self._recipe.kinematic)]
        return calls + [Call("add_motor", pair) for pair in self._recipe.motors.items()]

    def adopt(self, history: Sequence[Call]) -> None:
        """Become what the calls of a ``history`` make of this world; ``restore`` fits then."""
        kinematic = [call.arguments[0] for call in history if call.method == "make_kinematic"]
        motors = dict(call.arguments for call in history if call.method == "add_motor")
        self._change(replace(self._recipe, kinematic=frozenset(kinematic), motors=motors))

    def snapshot(self) -> Floats:
        """The whole dynamic state, shape (nworld, size)."""
        fleet = self._fleet
        rows = np.zeros((fleet.nworld, fleet.nbody, _BODY))
        rows[:, :, : c.BODY] = fleet.rows.reshape(fleet.nworld, fleet.nbody, c.BODY)
        rows[:, :, c.BODY : -1] = np.concatenate((fleet.command, fleet.velocity), axis=2)
        rows[:, :, -1] = fleet.stalled
        targets = np.nan_to_num(self._targets, nan=0.0)
        flat = rows.reshape(fleet.nworld, -1)
        return np.concatenate((flat, self._angles, self._rates, targets), axis=1)

    def peek(self) -> Floats:
        """The same as ``snapshot``."""
        return self.snapshot()

    def restore(self, state: Floats) -> None:
        """Put back what ``snapshot`` gave; the models must be the same."""
        fleet, axes = self._fleet, self._layout.axes
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
        self._angles[:], self._rates[:] = joints[:, 0], joints[:, 1]
        self._targets[:] = np.where(np.isnan(self._targets), math.nan, joints[:, 2])

    # -- parameters --------------------------------------------------------------------

    def parameter(self, kind: str, name: str, worlds: Worlds | None = None) -> Floats:
        """Gravity, as the world has it, shape (n, 3); the plane knows no other parameter."""
        if kind != "gravity" or name:
            raise self.refuse(f"the parameter {kind}")
        count = self.nworld if worlds is None else len(worlds)
        return np.tile(self.world.gravity, (count, 1))

    def close(self) -> None:
        """Free threads."""
        self._fleet.close()


def _at_pace(world: World) -> World:
    """The world of a Stage file with Stage's time step, at the pace that the file asks for."""
    if world.stage is None:
        return world
    profile, step = world.profile, world.stage.interval_sim
    rate = profile.real_time_update_rate * profile.max_step_size / step
    return with_profile(world, replace(profile, max_step_size=step, real_time_update_rate=rate))
