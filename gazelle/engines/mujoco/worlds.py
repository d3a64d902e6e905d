"""Running MuJoCo worlds: the compiled model, its state, and recompilation."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Bools, Floats, Worlds
from gazelle.description import World
from gazelle.engines.mujoco.batch import WorldBatch
from gazelle.engines.mujoco.compiler.description_edits import with_inertial
from gazelle.engines.mujoco.compiler.free_bodies import keep_awake
from gazelle.engines.mujoco.compiler.motors import AXES, motor_count, motor_of, refuse_motors
from gazelle.engines.mujoco.compiler.shapes import OPEN_GROUP
from gazelle.engines.mujoco.compiler.spec import Compiled, CompilerInput, compile_world, trees_of
from gazelle.engines.mujoco.compiler.welds import Attachment
from gazelle.engines.mujoco.contact_laws.law_data_indices import WORLD
from gazelle.engines.mujoco.layout import MujocoLayout, layout_of, look_up
from gazelle.engines.mujoco.parameters import ParameterStore, as_rows, check
from gazelle.engines.mujoco.penetration_recovery import Overlaps
from gazelle.engines.mujoco.state import StateViews, rows_of
from gazelle.engines.mujoco.state_transfer import transfer_state
from gazelle.engines.mujoco.step_hooks import Hooks
from gazelle.errors import EngineError
from gazelle.kinematics.tree import TreeLink

VELOCITY_STAGE = mujoco.mjtStage.mjSTAGE_VEL.value

# Parameters that need terms which MuJoCo leaves out where they vanish.
_OFF_AXIS = frozenset({"link_centre", "link_inertia"})


# What there is of worlds once they are compiled.
_COMPILED = frozenset(
    {
        "compiled",
        "batch",
        "layout",
        "state",
        "overlaps",
        "initial",
        "before",
        "sheets",
        "sleepy",
        "stale",
        "placed",
        "dropped",
    }
)


class RunningWorlds:
    """Many copies of a compiled world, which the parts of the engine share.

    They are compiled on the first use of what only a compiled world has. Motors and kinematic
    models that are requested before that, as plugins do, are compiled with it.

    Args:
        recipe: Recipe to compile.
        nworld: Number of copies.
        make_batch: Makes them from a compiled model and the world that it is of.
        calls: Whether steps can call systems.

    Attributes:
        nworld: Number of worlds.
        recipe: Compiled recipe.
        compiled: Compiled model.
        pending: Parts to compile before the next step: motors, and models that become kinematic.
        batch: The copies.
        layout: Layout of their arrays.
        state: Views of their states.
        parameters: Physical parameters that were changed.
        overlaps: Bodies under penetration recovery.
        initial: The state that a reset puts back.
        before: Room for the states before a step, shape as those.
        sheets: Geoms that have no inside, shape (geoms,).
        sleepy: Whether bodies may fall asleep.
        stale: Whether the placement of links that are not roots has to be computed.
        computed: Number of computations.
        placed: Whether something was put elsewhere since the last step.
        moved: 1 where a system put something elsewhere since the last step, and where one changed
            velocities, else 0, shape (2,).
        dropped: MuJoCo's free bodies that were put elsewhere since the last step, and in which worlds.
        revision: Counts compiled models; 0 before the first.
    """

    recipe: CompilerInput
    compiled: Compiled
    batch: WorldBatch
    layout: MujocoLayout
    state: StateViews
    overlaps: Overlaps
    initial: Floats
    before: Floats
    sheets: Bools
    sleepy: bool
    stale: bool
    placed: bool
    dropped: dict[int, NDArray[np.bool_]]

    def __init__(
        self,
        recipe: CompilerInput,
        nworld: int,
        make_batch: Callable[[mujoco.MjModel, World], WorldBatch],
        *,
        calls: bool = True,
    ) -> None:
        self.nworld, self._make_batch, self._calls = nworld, make_batch, calls
        self.parameters = ParameterStore(nworld)
        self.recipe = recipe
        self.pending: CompilerInput | None = None
        self.revision = self.computed = 0
        self.moved: Floats = np.zeros(2)
        self._drafted: tuple[World, frozenset[str], dict[str, list[TreeLink]]] | None = None
        self._drafted_axes: tuple[Mapping[str, list[TreeLink]], dict[str, int]] | None = None

    if not TYPE_CHECKING:  # what is compiled is had by attributes that the class names

        def __getattr__(self, name: str) -> Any:
            """Return a compiled attribute; compile the worlds on the first access."""
            if self.revision or name not in _COMPILED:
                raise AttributeError(name)
            self.change(self.latest)
            return getattr(self, name)

    def _start(self, recipe: CompilerInput, compiled: Compiled) -> None:
        """Start a compiled model from its initial state."""
        keep_awake(compiled.model, recipe.world)
        batch = self._make_batch(compiled.model, recipe.world)
        self.sleepy = bool(batch.persistent)
        for name in ("xpos", "xquat", "cvel", "subtree_com"):
            batch.bind(name)
        layout = layout_of(compiled, (pair.name for pair in recipe.attachments))
        self.parameters.apply(batch, layout)
        batch.forward(stage=VELOCITY_STAGE)
        self.initial, self.before = batch.state[0].copy(), batch.state.copy()
        self.recipe, self.compiled, self.pending = recipe, compiled, None
        self.batch, self.layout, self.state = batch, layout, StateViews.of(batch)
        self.overlaps = Overlaps(compiled, recipe.world, self.nworld)
        self.overlaps.begin(batch)
        self.sheets = compiled.model.geom_group == OPEN_GROUP
        self.placed, self.dropped, self.stale = False, {}, True
        self.revision += 1
        if recipe.hooks:
            self.hooks.limit(layout.limits)
            self.hooks.show(self.state, self.motor_targets)
            if self.nworld > 1:
                batch.expand("numeric_data")[:, WORLD] = np.arange(self.nworld)

    @cached_property
    def hooks(self) -> Hooks:
        """Hooks by which steps call systems."""
        return Hooks(self.nworld)

    @property
    def motor_targets(self) -> Floats:
        """Velocities that motors hold, shape (nworld, motors); may be written."""
        return self.state.userdata[:, : motor_count(self.recipe.motors)]

    @property
    def time_step(self) -> float:
        """Physics step [s]."""
        return self.recipe.time_step

    @property
    def latest(self) -> CompilerInput:
        """Compiler input of the model that runs, or of the one that runs from the next step on."""
        return self.pending or self.recipe

    @property
    def world(self) -> World:
        """The simulated world, with spawned and without deleted models."""
        return self.latest.world

    # -- compiling ---------------------------------------------------------------------

    def up_to_date(self) -> MujocoLayout:
        """Make pending changes; return the layout of the running model."""
        if self.pending is not None:
            self.change(self.pending)
        return self.layout

    def bodies(self) -> Mapping[str, list[TreeLink]]:
        """Return the bodies of running and pending models, by name."""
        if self.revision:
            return self.compiled.bodies
        latest, drafted = self.latest, self._drafted
        if drafted is None or drafted[0] is not latest.world or drafted[1] != latest.kinematic:
            trees = trees_of(latest)
            bodies = {name: tree.bodies for name, tree in trees.items()}
            drafted = self._drafted = latest.world, latest.kinematic, bodies
        return drafted[2]

    def link_names(self) -> tuple[str, ...]:
        """Return scoped names of links; pending changes add none."""
        return tuple(body.name for parts in self.bodies().values() for body in parts)

    def model_names(self) -> tuple[str, ...]:
        """Return the names of models with links."""
        return tuple(name for name, parts in self.bodies().items() if parts)

    def axes_at_zero(self, joint: str) -> int:
        """Return the number of axes of a joint in uncompiled worlds, which are at zero; 0 if compiled."""
        return 0 if self.revision else self._drafted_joints().get(joint, 0)

    def joint_names(self) -> Mapping[str, Any]:
        """Return a mapping from scoped names of movable joints; the same one until a change."""
        return self.known().joints if self.revision else self._drafted_joints()

    def _drafted_joints(self) -> Mapping[str, int]:
        """Return the number of axes of each movable joint of uncompiled worlds."""
        parts, known = self.bodies(), self._drafted_axes
        if known is None or known[0] is not parts:
            joints = ((b.joint_name, b.joint) for each in parts.values() for b in each)
            moving = ((name, j.type) for name, j in joints if j is not None and j.type != "fixed")
            known = self._drafted_axes = parts, {name: AXES.get(t, 0) for name, t in moving}
        return known[1]

    def change(self, recipe: CompilerInput) -> None:
        """Replace the model, and keep the states of what both have."""
        self.pending = None
        if recipe.motors and self._calls and not recipe.hooks:  # what drives motors acts in steps
            recipe = replace(recipe, hooks=self.hooks.address)
        compiled = compile_world(recipe)
        if not self.revision:
            self._start(recipe, compiled)
            return
        batch, layout, overlaps = self.batch, self.layout, self.overlaps
        self._start(recipe, compiled)
        transfer_state(batch, layout, self.batch, self.layout)
        self.overlaps.transfer(self.batch, overlaps)

    def end(self) -> None:
        """Free threads and memory."""
        self.pending, self.revision = None, max(1, self.revision)
        for name in ("batch", "state"):
            self.__dict__.pop(name, None)

    def prepare(self, pair: Attachment) -> MujocoLayout:
        """Return the layout of the running model, in which two links can be attached."""
        if pair not in self.recipe.attachments:
            others = (each for each in self.recipe.attachments if each.name != pair.name)
            self.change(replace(self.recipe, attachments=(*others, pair)))
        return self.layout

    def known(self) -> MujocoLayout:
        """Return the layout to read states by, which pending motors do not change."""
        pending = self.pending
        if pending is None or pending.kinematic == self.recipe.kinematic:
            return self.layout
        return self.up_to_date()

    def refresh(self) -> None:
        """Compute the placement and motion of links that are not roots."""
        if self.stale or self.moved[0] or self.moved[1]:
            self.batch.forward(stage=VELOCITY_STAGE)
            self.stale = False
            self.computed += 1

    def add_motor(self, joint: str, max_effort: ArrayLike) -> None:
        """Add a motor to a joint that holds a velocity with limited effort; see the protocol."""
        recipe = self.latest
        if self.revision:
            self.layout.joint(joint)  # motors do not change the layout of joints
        else:
            look_up("joint", joint, self.joint_names())
        motor = motor_of(joint, max_effort, self.bodies(), recipe.kinematic)
        if joint in self.recipe.motors and self.revision:
            self.set_parameter("motor_effort", joint, motor.max_effort)
            return
        self.pending = replace(recipe, motors={**recipe.motors, joint: motor})

    def make_kinematic(self, model: str) -> None:
        """Make a model kinematic: ``set_model_placement`` moves it, nothing pushes it."""
        recipe = self.latest
        look_up("model", model, {name: parts for name, parts in self.bodies().items() if parts})
        refuse_motors(model, recipe.motors)
        self.pending = replace(recipe, kinematic=recipe.kinematic | {model})

    # -- parameters --------------------------------------------------------------------

    def parameter(self, kind: str, name: str, worlds: Worlds | None = None) -> Floats:
        """Return a physical parameter, shape (n, width)."""
        layout = self.up_to_date()
        values = self.parameters.read(self.batch, layout, kind, name)
        return values[rows_of(worlds)]

    def set_parameter(
        self, kind: str, name: str, values: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set a physical parameter, shape (width,) or (n, width); a reset does not undo it."""
        layout = self.up_to_date()
        every = self.parameters.read(self.batch, layout, kind, name)
        rows = rows_of(worlds)
        every[rows] = as_rows(kind, name, every[rows].shape, values)
        check(kind, name, every)
        if kind == "wheel_slip":
            self._add_slip_body(name)
        if kind == "joint_damping" and every.any() and not self.recipe.damped:
            self.change(replace(self.recipe, damped=True))
        if kind in _OFF_AXIS and self.batch.model.body_simple[layout.link(name).body]:
            self._unsimplify(kind, name, every)
        self.parameters.write(self.batch, self.layout, (kind, name), every)
        self.stale = True

    def _add_slip_body(self, link: str) -> None:
        """Add a slip body to a link, which gets its shapes.

        Raises:
            EngineError: The link is not a wheel.
        """
        if self.layout.link(link).root == "free":
            raise EngineError(f"link '{link}' is not a wheel: nothing holds it")
        if link not in self.recipe.slip_links:
            self.change(replace(self.recipe, slip_links=self.recipe.slip_links | {link}))

    def _unsimplify(self, kind: str, name: str, values: Floats) -> None:
        """Compile a link's inertia as general as worlds need it.

        MuJoCo leaves out the terms that vanish for a link whose centre of mass is at its
        origin and principal axes along the link's; a value that needs them is compiled.
        """
        needed = values[:, :3] if kind == "link_centre" else values[:, 3:]
        general = np.flatnonzero(needed.any(axis=1))
        if general.size:
            world = with_inertial(self.recipe.world, name, kind, values[general[0]])
            self.change(replace(self.recipe, world=world))

    def of_worlds(self, field: str) -> NDArray[np.float64]:
        """Return a field of the model, shape (nworld, ...), or (1, ...) where worlds share it."""
        own = self.batch.expanded(field)
        if own is not None:
            return np.asarray(own)
        model = self.batch.model
        shared = model.opt.gravity if field == "opt.gravity" else getattr(model, field)
        return np.asarray(shared)[None]
