"""The MuJoCo engine: a batch of worlds stepped on native threads."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.description import Model, World
from gazelle.engines.engine import DivergenceError
from gazelle.engines.history import Call
from gazelle.engines.laws import laws_of, with_profile
from gazelle.engines.limits import check_world, physics_step, whole_number
from gazelle.engines.mujoco.access import VELOCITY_STAGE, rows_of
from gazelle.engines.mujoco.attachments import Attachment
from gazelle.engines.mujoco.carrying import CarryingSteps
from gazelle.engines.mujoco.compiler import Compiled, CompilerInput, compile_world
from gazelle.engines.mujoco.editing import with_inertial
from gazelle.engines.mujoco.layout import MujocoLayout, layout_of
from gazelle.engines.mujoco.loose import keep_awake
from gazelle.engines.mujoco.motors import motor_again, motor_of, refuse_motors
from gazelle.engines.mujoco.overlaps import Overlaps
from gazelle.engines.mujoco.parameters import ParameterStore, as_rows, check
from gazelle.engines.mujoco.process import settle
from gazelle.engines.mujoco.suspects import suspect
from gazelle.engines.mujoco.transfer import carry_over
from gazelle.engines.mujoco.views import StateViews
from gazelle.errors import EngineError, did_you_mean
from gazelle.native.processors import processors

_NO_STAGE = mujoco.mjtStage.mjSTAGE_NONE.value

# Parameters that need terms which MuJoCo leaves out where they vanish.
_OFF_AXIS = frozenset({"link_centre", "link_inertia"})


class MujocoEngine(CarryingSteps):
    """Many copies of one world in MuJoCo; see ``gazelle.engines.engine.Engine``.

    Args:
        world: What to simulate.
        nworld: Number of copies.
        time_step: Physics step [s]; the world's ``max_step_size`` if None.
        threads: Native threads; all processors if None. The results do not depend on it.

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
        settle()
        step = physics_step(world.profile.max_step_size if time_step is None else time_step)
        nworld = whole_number("nworld", nworld)
        threads = None if threads is None else whole_number("threads", threads)
        if step != world.profile.max_step_size:
            world = with_profile(world, replace(world.profile, max_step_size=step))
        check_world(world)
        self._nworld = nworld
        self._threads = min(threads or processors(), nworld)
        self._parameters = ParameterStore(nworld)
        self._pending: CompilerInput | None = None
        self._run(CompilerInput(world, step), compile_world(CompilerInput(world, step)))

    def _run(self, recipe: CompilerInput, compiled: Compiled) -> None:
        """Go on with a compiled model, from its initial state."""
        keep_awake(compiled.model, recipe.world)
        batch = self._batch_of(compiled.model, recipe.world)
        self._sleepy = bool(batch.persistent)
        for name in ("xpos", "xquat", "cvel", "subtree_com"):
            batch.bind(name)
        layout = layout_of(compiled, (pair.name for pair in recipe.attachments))
        self._parameters.apply(batch, layout)
        batch.forward(stage=VELOCITY_STAGE)
        self._initial = batch.state[0].copy()
        self._before = batch.state.copy()
        self._recipe, self._compiled, self._pending = recipe, compiled, None
        self._batch, self._layout = batch, layout
        self._overlaps = Overlaps(compiled, recipe.world, self._nworld)
        self._overlaps.begin(batch)
        self._placed, self._dropped = False, {}
        self._state = StateViews.of(batch)
        self._tables = {}
        self._begin_carrying(batch, recipe)
        self._stale = True

    # -- what runs ---------------------------------------------------------------------

    @property
    def nworld(self) -> int:
        """Number of worlds."""
        return self._nworld

    @property
    def time_step(self) -> float:
        """Physics step [s]."""
        return self._recipe.time_step

    @property
    def world(self) -> World:
        """The world that runs, with what was spawned and without what was deleted."""
        return (self._pending or self._recipe).world

    @property
    def link_names(self) -> tuple[str, ...]:
        """Scoped names, ``model::link``."""
        return tuple(self._layout.links)  # what is pending, motors, changes no names

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Scoped names, ``model::joint``, of joints that can move."""
        return tuple(self._known().joints)

    # -- time --------------------------------------------------------------------------

    def step(self, count: int = 1) -> None:
        """Advance every world by ``count`` physics steps."""
        count = whole_number("the number of steps", count, 0)
        self._now()
        self._stale = True
        self._find_dropped()
        np.copyto(self._before, self._batch.state)
        failed = self._let_out(count) if self._overlaps.any else self._advance(count)
        self._placed = False
        # MuJoCo itself resets a simulation whose state became bad, and counts a warning.
        if len(failed) or np.count_nonzero(self._state.faults):
            bad = np.asarray(self._state.faults.any(axis=1))
            bad[sorted(failed)] = True
            self._give_up(np.flatnonzero(bad), count)

    def _find_dropped(self) -> None:
        """Let out slowly, too, what loose bodies were put into since the last step."""
        if self._dropped:
            self._overlaps.drop(self._batch, self._dropped)
            self._dropped = {}

    def _let_out(self, count: int) -> set[int]:
        """Make the steps with what overlaps rising; returns those in which MuJoCo gave up."""
        if self._placed:
            self._overlaps.clear(self._batch)
        failed: set[int] = set()
        while count > 0:
            piece = count
            if self._overlaps.any:
                piece = min(count, self._overlaps.rise(self._batch, self.time_step))
            failed |= self._overlaps.calmly(self._state, piece, self._advance)
            count -= piece
        return failed

    def _give_up(self, worlds: Worlds, count: int) -> None:
        """Reset worlds that broke down, and say so.

        Raises:
            DivergenceError: Always.
        """
        before = self._before[worlds].copy()
        who = suspect(self._layout, self._state, self._batch.state, before[0])
        self._batch.warning[worlds] = 0
        self.reset(worlds)
        raise DivergenceError(
            f"the state of {len(worlds)} of {self._nworld} worlds became infinite "
            f"(first: world {worlds[0]}{who and ', where ' + who})",
            worlds,
            before,
            count,
        )

    def reset(self, worlds: Worlds | None = None) -> None:
        """Put worlds back to their initial state: poses, rest, no forces."""
        self._now()
        if self._sleepy:
            self._batch.reset(worlds, stage=_NO_STAGE)  # wakes all that sleeps
        self._batch.state[rows_of(worlds)] = self._initial
        self._overlaps.reset(self._batch, worlds)
        self._stale = True

    # -- change ------------------------------------------------------------------------

    def spawn(self, model: Model) -> None:
        """Add a model to every world, at rest at its ``pose``; all else stays as it is."""
        recipe = self._pending or self._recipe
        names = {each.name for each in recipe.world.models}
        if model.name in names:
            raise EngineError(f"there is a model '{model.name}' already", source=model.source)
        world = replace(recipe.world, models=(*recipe.world.models, model))
        self._change(replace(recipe, world=world))

    def delete(self, model: str) -> None:
        """Take a model out of every world; all else stays as it is."""
        recipe = self._pending or self._recipe
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
            tyres=frozenset(n for n in recipe.tyres if not n.startswith(f"{model}::")),
        )
        self._parameters.drop(model)
        self._change(changed)

    def _held(self, gone: str) -> tuple[Attachment, ...]:
        """The attachments that hold something in some world, but for those of one model."""
        columns = self._layout.attachments
        return tuple(
            pair
            for pair in self._recipe.attachments
            if not pair.is_of(gone) and self._batch.eq_active[:, columns[pair.name]].any()
        )

    def add_motor(self, joint: str, max_effort: ArrayLike) -> None:
        """Give a joint a motor that holds a velocity with limited effort; see the protocol."""
        self._layout.joint(joint)  # motors do not change the layout of joints
        recipe = self._pending or self._recipe
        motor = motor_of(joint, max_effort, self._compiled.bodies, recipe.kinematic)
        if joint in self._recipe.motors:
            self.set_parameter("motor_effort", joint, motor.max_effort)
            return
        self._pending = replace(recipe, motors={**recipe.motors, joint: motor})

    def make_kinematic(self, model: str) -> None:
        """Let a model move only by ``set_model_placement``; it pushes, nothing pushes it."""
        recipe = self._pending or self._recipe
        self._layout.model(model)
        refuse_motors(model, recipe.motors)
        self._pending = replace(recipe, kinematic=recipe.kinematic | {model})

    def update_world(self, world: World) -> None:
        """Take over all of a world but its models: physics, gravity, air, lights, scene."""
        self._now()
        old, profile = self._recipe.world, world.profile
        check_world(world)
        recipe = replace(
            self._recipe,
            world=replace(world, models=old.models),
            time_step=profile.max_step_size,
        )
        if old.gravity != world.gravity:
            self._parameters.forget("gravity", "")
        if laws_of(old) == laws_of(world):
            self._recipe = recipe
        else:
            self._change(recipe)

    def _now(self) -> MujocoLayout:
        """The layout of what runs, once pending changes have been made."""
        if self._pending is not None:
            self._change(self._pending)
        return self._layout

    def _change(self, recipe: CompilerInput) -> None:
        """Go on with another model, with all states that both have."""
        self._pending = None
        compiled = compile_world(recipe)
        batch, layout, overlaps = self._batch, self._layout, self._overlaps
        self._run(recipe, compiled)
        carry_over(batch, layout, self._batch, self._layout)
        self._overlaps.carry(self._batch, overlaps)

    def _prepare(self, pair: Attachment) -> MujocoLayout:
        """The layout of what runs, in which two links can be held together."""
        if pair not in self._recipe.attachments:
            others = (each for each in self._recipe.attachments if each.name != pair.name)
            self._change(replace(self._recipe, attachments=(*others, pair)))
        return self._layout

    # -- parameters --------------------------------------------------------------------

    def parameter(self, kind: str, name: str, worlds: Worlds | None = None) -> Floats:
        """A physical parameter, shape (n, width)."""
        layout = self._now()
        values = self._parameters.read(self._batch, layout, kind, name)
        return values[rows_of(worlds)]

    def set_parameter(
        self, kind: str, name: str, values: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Change a physical parameter, shape (width,) or (n, width); a reset does not undo it."""
        layout = self._now()
        every = self._parameters.read(self._batch, layout, kind, name)
        rows = rows_of(worlds)
        every[rows] = as_rows(kind, name, every[rows].shape, values)
        check(kind, name, every)
        if kind == "wheel_slip":
            self._fit_tyre(name)
        if kind == "joint_damping" and every.any() and not self._recipe.damped:
            self._change(replace(self._recipe, damped=True))
        if kind in _OFF_AXIS and self._batch.model.body_simple[layout.link(name).body]:
            self._unsimplify(kind, name, every)
        self._parameters.write(self._batch, self._layout, (kind, name), every)
        self._stale = True

    def _fit_tyre(self, link: str) -> None:
        """Let a link's shapes slip on it.

        Raises:
            EngineError: The link is no wheel.
        """
        if self._layout.link(link).root == "free":
            raise EngineError(f"link '{link}' is no wheel: nothing holds it")
        if link not in self._recipe.tyres:
            self._change(replace(self._recipe, tyres=self._recipe.tyres | {link}))

    def _unsimplify(self, kind: str, name: str, values: Floats) -> None:
        """Compile a link's inertia as general as worlds need it.

        MuJoCo leaves out the terms that vanish for a link whose centre of mass is at its
        origin and whose principal axes are the link's; a value that needs them is compiled.
        """
        needed = values[:, :3] if kind == "link_centre" else values[:, 3:]
        general = np.flatnonzero(needed.any(axis=1))
        if general.size:
            world = with_inertial(self._recipe.world, name, kind, values[general[0]])
            self._change(replace(self._recipe, world=world))

    # -- saving ------------------------------------------------------------------------

    def history(self) -> list[Call]:
        """Calls that make a new engine of this ``world`` one like this, but for the state."""
        self._now()
        recipe = self._recipe
        calls = [Call("make_kinematic", (name,)) for name in sorted(recipe.kinematic)]
        calls += [Call("add_motor", (m.joint, m.max_effort)) for m in recipe.motors.values()]
        calls += [Call("attach", pair.arguments) for pair in recipe.attachments]
        values: Mapping[tuple[str, str], Floats] = self._parameters.values
        return calls + [
            Call("set_parameter", (kind, name, each)) for (kind, name), each in values.items()
        ]

    def adopt(self, history: Sequence[Call]) -> None:
        """Become what the calls of a ``history`` make of this world; ``restore`` fits then."""
        kinematic = [call.arguments[0] for call in history if call.method == "make_kinematic"]
        motors = [motor_again(*call.arguments) for call in history if call.method == "add_motor"]
        pairs = [Attachment(*call.arguments) for call in history if call.method == "attach"]
        recipe = CompilerInput(
            self.world,
            self._recipe.time_step,
            frozenset(kinematic),
            {motor.joint: motor for motor in motors},
            tuple(pairs),
        )
        self._parameters = ParameterStore(self._nworld)
        self._change(recipe)
        for call in history:
            if call.method == "set_parameter":
                self.set_parameter(*call.arguments)

    def snapshot(self) -> Floats:
        """The whole dynamic state, shape (nworld, size)."""
        self._now()
        self._find_dropped()
        state: Floats = np.hstack((self._batch.state, self._overlaps.saved()))
        if self._sleepy:
            # Who sleeps is not in the state; all awake, this future and a restored one agree.
            self.restore(state)
        return state

    def restore(self, state: Floats) -> None:
        """Put back what ``snapshot`` gave; the models must be the same."""
        self._now()
        rows, width = self._batch.state.shape
        if state.shape not in ((rows, width), (rows, width + self._overlaps.size)):
            raise EngineError(
                f"the saved state has the shape {state.shape}, the worlds that run need "
                f"{self._batch.state.shape}",
                hint="restore into a simulation with the same models and number of worlds",
            )
        if self._sleepy:
            self._batch.reset(stage=_NO_STAGE)
        self._batch.state[:] = state[:, :width]
        self._dropped = {}
        self._overlaps.take(self._batch, state[:, width:])
        self._stale = True

    def peek(self) -> Floats:
        """The whole dynamic state, shape (nworld, size), as a view that must not be kept."""
        self._now()
        view: Floats = self._batch.state
        return view

    def close(self) -> None:
        """Free threads and memory; the engine must not be used any more."""
        self._pending = None
        del self._batch, self._state
