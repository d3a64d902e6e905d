"""The MuJoCo engine: a batch of worlds stepped on native threads."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import replace
from functools import partial

import mujoco
import numpy as np

from gazelle.argument_checks import checked, indices, world_indices
from gazelle.array_types import Floats, Indices, Worlds
from gazelle.description import Model, World
from gazelle.engines.hanging_links import HangingLinks
from gazelle.engines.history import Call
from gazelle.engines.laws import laws_of, with_profile
from gazelle.engines.limits import MAX_WORLDS, check_model, check_world, integer, physics_step
from gazelle.engines.mujoco.attachments import LinkHolding
from gazelle.engines.mujoco.batch import WorldBatch
from gazelle.engines.mujoco.compiler.motors import motor_again
from gazelle.engines.mujoco.compiler.spec import CompilerInput
from gazelle.engines.mujoco.compiler.welds import Attachment
from gazelle.engines.mujoco.contacts import ContactAccess
from gazelle.engines.mujoco.joint_wrenches import JointReactions
from gazelle.engines.mujoco.library import disable_logging
from gazelle.engines.mujoco.parameters import ParameterStore
from gazelle.engines.mujoco.rays import MujocoRanges, RaySpaces
from gazelle.engines.mujoco.state import rows_of
from gazelle.engines.mujoco.step import WorldSteps
from gazelle.engines.mujoco.step_forces import ForcedSteps
from gazelle.engines.mujoco.tables.joints import MujocoJointRow, MujocoJointRows
from gazelle.engines.mujoco.tables.links import MujocoLinkRow, MujocoLinkRows
from gazelle.engines.mujoco.tables.models import MujocoModelRow, MujocoModelRows
from gazelle.engines.mujoco.tables.root_poses import note_moves
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.engines.range_rays import RangeRays, RangeTable
from gazelle.engines.state import JointRow, JointRows, LinkRow, LinkRows, ModelRow, ModelRows
from gazelle.engines.table import Table
from gazelle.errors import EngineError, did_you_mean
from gazelle.native.joint_system import JointSystem
from gazelle.native.processors import processors
from gazelle.native.system import System
from gazelle.native.worker_pool import WorkerPool

# Integrators that evaluate forces once per step.
_ONCE = (
    mujoco.mjtIntegrator.mjINT_EULER,
    mujoco.mjtIntegrator.mjINT_IMPLICIT,
    mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
)

_NO_STAGE = mujoco.mjtStage.mjSTAGE_NONE.value


class MujocoEngine:
    """Many copies of one world in MuJoCo; see ``gazelle.engines.engine.Engine``.

    It is put together of parts that share what runs; most of what it offers is a method of one of
    them, taken over as it is so that a call costs no more for that.

    Args:
        world: World to simulate.
        nworld: Number of copies.
        time_step: Physics step [s]; the world's ``max_step_size`` if None.
        threads: Native threads; all processors if None. The results do not depend on it.
        late: Compile the world only when ``prepare`` says so, or when something is requested that
            only a compiled world has: after motors and kinematic models have been requested.

    Attributes:
        running: Running worlds.
        reactions: Wrenches of joints.
        links: Links of all models.
        joints: Joints of all models that can move.
        models: All models.

    Raises:
        EngineError: The world cannot be simulated.
    """

    _calls_systems = True  # steps are made where compiled systems are

    def __init__(
        self,
        world: World,
        nworld: int = 1,
        *,
        time_step: float | None = None,
        threads: int | None = None,
        late: bool = False,
    ) -> None:
        disable_logging()
        step = physics_step(world.profile.max_step_size if time_step is None else time_step)
        nworld = integer("nworld", nworld, most=MAX_WORLDS)
        threads = None if threads is None else integer("threads", threads)
        if step != world.profile.max_step_size:
            world = with_profile(world, replace(world.profile, max_step_size=step))
        check_world(world)
        self._pool = WorkerPool(min(threads or processors(), nworld))
        make_batch = partial(self._batch_of, nworld, self._pool.size)
        self.running = RunningWorlds(
            CompilerInput(world, step), nworld, make_batch, calls=self._calls_systems
        )
        self._make_parts(self.running)
        if not late:
            self.prepare()

    def _make_parts(self, run: RunningWorlds) -> None:
        """Make the parts, and expose their methods."""
        self._run = run
        self._steps = steps = ForcedSteps(run, lambda link: self.links[link].motion())
        self.reactions = JointReactions(run, steps)
        self.joints: Table[JointRow, JointRows] = Table(
            run.joint_names,
            lambda name: MujocoJointRow(run, name, self.reactions.joint_wrench),
            lambda names: MujocoJointRows(run, names, self._acts_in_step),
        )
        self.links: Table[LinkRow, LinkRows] = Table(
            run.link_names,
            lambda name: MujocoLinkRow(
                run, steps, name, self.links.__getitem__, hanging, self._kinematic
            ),
            lambda names: MujocoLinkRows(run, steps, names),
        )
        self.models: Table[ModelRow, ModelRows] = Table(
            run.model_names,
            lambda name: MujocoModelRow(run, name, self.links, self._kinematic),
            lambda names: MujocoModelRows(run, names, self.links),
        )
        hanging = HangingLinks(lambda: run.world, self.links, self.joints)
        holding = LinkHolding(run, self.links)
        self.attach, self.detach = holding.attach, holding.detach
        self.add_motor, self.make_kinematic = run.add_motor, run.make_kinematic
        self.parameter, self.set_parameter = run.parameter, run.set_parameter
        touches = ContactAccess(run, steps, self.reactions)
        self.contacts = touches.contacts
        self._made = WorldSteps(run, steps, self.reset, self._acts_in_step, self._pool)
        self._spaces: RaySpaces | None = None

    def _acts_in_step(self) -> bool:
        """Return whether steps can call systems of joints: the integrator looks once at forces."""
        return self._calls_systems and self._run.batch.model.opt.integrator in _ONCE

    def _kinematic(self, model: str) -> None:
        """Make a model kinematic by the engine's own call, which a recorder records."""
        self.make_kinematic(model)

    @staticmethod
    def _batch_of(nworld: int, threads: int, model: mujoco.MjModel, _: World) -> WorldBatch:
        """Return the worlds of a compiled model."""
        sleepy = bool(model.opt.enableflags & mujoco.mjtEnableBit.mjENBL_SLEEP)
        return WorldBatch(model, nworld, threads, persistent=sleepy)

    # -- models -----------------------------------------------------------------------

    @property
    def nworld(self) -> int:
        """Number of worlds."""
        return self._run.nworld

    @property
    def time_step(self) -> float:
        """Physics step [s]."""
        return self._run.recipe.time_step

    @property
    def world(self) -> World:
        """The simulated world, with spawned and without deleted models."""
        return self._run.world

    def prepare(self) -> None:
        """Compile the world with everything requested, so that the next step is one like others.

        Raises:
            EngineError: The world cannot be simulated.
        """
        self._run.up_to_date()

    # -- time --------------------------------------------------------------------------

    def step(self, count: int = 1, systems: Sequence[System] = (), now_ns: int = 0) -> None:
        """Advance every world by ``count`` physics steps, and update systems that are due."""
        self._made.make(integer("the number of steps", count, 0), systems, now_ns)

    @checked(EngineError, after=True)
    def update(self, system: System, now_ns: int = 0) -> None:
        """Update a system now, whatever its rate; one of joints reads them and acts on them."""
        if isinstance(system, JointSystem):
            system.read(self._run.state.qpos, self._run.state.qvel)
            system.update_from_python(0, self._run.nworld, now_ns)
        else:
            self._pool.update(system, self._run.nworld, now_ns)
        if isinstance(system, JointSystem):
            system.act(self._run.state.qfrc_applied, self._run.state.userdata)
            self._run.stale = True

    @checked(EngineError, after=True)
    def range_kind(self, rays: RangeRays) -> Hashable | None:
        """Return a key that is equal for rays that ``range_table`` can cast together."""
        return len(rays.origins)

    @checked(EngineError, after=True)
    def range_table(self, rays: Sequence[RangeRays]) -> RangeTable:
        """Return a table of range finders of one kind."""
        run = self._run
        run.up_to_date()
        if self._spaces is None or self._spaces.compiled is not run.compiled.model:
            self._spaces = RaySpaces(run.compiled.model, self._pool.size)
        return MujocoRanges(run, rays, self._spaces, self.update)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Reset worlds to their initial state: poses, rest, no forces."""
        self._run.up_to_date()
        if worlds is not None:
            worlds = world_indices(worlds, self._run.nworld, EngineError)
        if self._run.sleepy:
            self._run.batch.reset(worlds, stage=_NO_STAGE)  # wakes sleeping bodies
        self._run.batch.state[rows_of(worlds)] = self._run.initial
        self._run.overlaps.reset(self._run.batch, worlds)
        self._run.stale = True

    # -- change ------------------------------------------------------------------------

    def spawn(self, model: Model) -> None:
        """Add a model to every world, at rest at its ``pose``; all else stays as it is."""
        check_model(model)
        recipe = self._run.latest
        names = {each.name for each in recipe.world.models}
        if model.name in names:
            raise EngineError(f"there is a model '{model.name}' already", source=model.source)
        world = replace(recipe.world, models=(*recipe.world.models, model))
        self._run.change(replace(recipe, world=world))

    def delete(self, model: str) -> None:
        """Delete a model from every world; all else stays as it is."""
        recipe = self._run.latest
        names = [each.name for each in recipe.world.models]
        if model not in names:
            raise EngineError(f"there is no model '{model}'", hint=did_you_mean(model, names))
        kept = tuple(each for each in recipe.world.models if each.name != model)
        motors = {n: m for n, m in recipe.motors.items() if not n.startswith(f"{model}::")}
        changed = replace(
            recipe,
            world=replace(recipe.world, models=kept),
            motors=motors,
            kinematic=recipe.kinematic - {model},
            attachments=self._held(model),
            slip_links=frozenset(n for n in recipe.slip_links if not n.startswith(f"{model}::")),
        )
        self._run.parameters.drop(model)
        self._run.change(changed)

    def _held(self, gone: str) -> tuple[Attachment, ...]:
        """Return the active attachments, except those of one model."""
        columns = self._run.layout.attachments
        return tuple(
            pair
            for pair in self._run.recipe.attachments
            if not pair.is_of(gone) and self._run.batch.eq_active[:, columns[pair.name]].any()
        )

    def update_world(self, world: World) -> None:
        """Update all of a world but its models: physics, gravity, air, lights, scene."""
        self._run.up_to_date()
        old, profile = self._run.recipe.world, world.profile
        check_world(world)
        recipe = replace(
            self._run.recipe,
            world=replace(world, models=old.models),
            time_step=profile.max_step_size,
        )
        if old.gravity != world.gravity:
            self._run.parameters.forget("gravity", "")
        if laws_of(old) == laws_of(world):
            self._run.recipe = recipe
        else:
            self._run.change(recipe)

    # -- systems -----------------------------------------------------------------------

    @property
    def revision(self) -> int:
        """Counts changes of models: systems then have to be bound to joints again."""
        if self._run.revision:  # before the first nothing can be bound, and nothing is changed
            self._run.up_to_date()
        return self._run.revision

    # -- saving ------------------------------------------------------------------------

    def history(self) -> list[Call]:
        """Return the calls that make a new engine of this ``world`` like this one.

        The state is not included.
        """
        self._run.up_to_date()
        recipe = self._run.recipe
        calls = [Call("make_kinematic", (name,)) for name in sorted(recipe.kinematic)]
        calls += [Call("add_motor", (m.joint, m.max_effort)) for m in recipe.motors.values()]
        calls += [Call("attach", pair.arguments) for pair in recipe.attachments]
        values: Mapping[tuple[str, str], Floats] = self._run.parameters.values
        return calls + [
            Call("set_parameter", (kind, name, each)) for (kind, name), each in values.items()
        ]

    def adopt(self, history: Sequence[Call]) -> None:
        """Replay the calls of a ``history`` on this world; ``restore`` fits then."""
        kinematic = [call.arguments[0] for call in history if call.method == "make_kinematic"]
        motors = [motor_again(*call.arguments) for call in history if call.method == "add_motor"]
        pairs = [Attachment(*call.arguments) for call in history if call.method == "attach"]
        recipe = CompilerInput(
            self._run.world,
            self._run.recipe.time_step,
            frozenset(kinematic),
            {motor.joint: motor for motor in motors},
            tuple(pairs),
        )
        self._run.parameters = ParameterStore(self._run.nworld)
        self._run.change(recipe)
        for call in history:
            if call.method == "set_parameter":
                self._run.set_parameter(*call.arguments)

    def snapshot(self) -> Floats:
        """Return the whole dynamic state, shape (nworld, size)."""
        self._run.up_to_date()
        self._made.find_dropped()
        state: Floats = np.hstack((self._run.batch.state, self._run.overlaps.saved()))
        if self._run.sleepy:
            # Sleep is not part of the state: wake all, so that this run and a restored one stay equal.
            self.restore(state)
        return state

    def restore(self, state: Floats) -> None:
        """Restore what ``snapshot`` returned; the models must be the same."""
        self._run.up_to_date()
        rows, width = self._run.batch.state.shape
        if state.shape not in ((rows, width), (rows, width + self._run.overlaps.size)):
            raise EngineError(
                f"the saved state has the shape {state.shape}, the worlds that run need "
                f"{self._run.batch.state.shape}",
                hint="restore into a simulation with the same models and number of worlds",
            )
        if self._run.sleepy:
            self._run.batch.reset(stage=_NO_STAGE)
        self._run.batch.state[:] = state[:, :width]
        self._run.dropped = {}
        self._run.overlaps.take(self._run.batch, state[:, width:])
        self._run.stale = True

    def peek(self) -> Floats:
        """Return the whole dynamic state, shape (nworld, size).

        The array is a view and must not be kept.
        """
        self._run.up_to_date()
        view: Floats = self._run.batch.state
        return view

    @checked(EngineError)
    def write_state(self, places: Indices, values: Floats) -> None:
        """Set entries of the state, by their places in ``peek``, flattened."""
        self._run.up_to_date()
        before, state = self._run.state.qpos.copy(), self._run.batch.state.reshape(-1)
        state[indices("places", places, len(state), EngineError)] = values
        note_moves(self._run, before)
        self._run.stale = True

    def close(self) -> None:
        """Free threads and memory; the engine must not be used any more."""
        self._pool.close()
        self._run.end()
