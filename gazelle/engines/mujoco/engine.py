"""The MuJoCo engine: a batch of worlds stepped on native threads."""

from __future__ import annotations

import os
from dataclasses import replace

import mujoco
import numpy as np
from mujoco.batch import Batch, SimulationError

from gazelle.description import Model, World
from gazelle.engines.engine import Floats, Worlds
from gazelle.engines.mujoco.access import VELOCITY_STAGE, StateAccess, rows_of
from gazelle.engines.mujoco.compiler import Motor, Recipe, compile_world
from gazelle.engines.mujoco.layout import Layout, Slot, layout_of
from gazelle.engines.mujoco.transfer import carry_over
from gazelle.engines.mujoco.views import StateViews
from gazelle.errors import EngineError, did_you_mean


def _quiet() -> None:
    """Keep MuJoCo from writing a log file into the working directory: faults are raised."""
    config = mujoco.MjLogConfig.get()
    config.logto_file = False
    config.logto_console = False
    config.set()


class MujocoEngine(StateAccess):
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
        _quiet()
        step = world.profile.max_step_size if time_step is None else time_step
        if nworld < 1:
            raise EngineError(f"nworld must be at least 1, not {nworld}")
        if not step > 0.0:
            raise EngineError(f"the physics step must be positive, not {step:g} s")
        self._nworld = nworld
        self._threads = min(threads or os.cpu_count() or 1, nworld)
        self._recipe = Recipe(world, step)
        self._batch, self._layout = self._build(self._recipe)
        self._state = StateViews.of(self._batch)
        self._batch.forward(stage=VELOCITY_STAGE)
        self._initial = self._batch.state[0].copy()
        self._stale = False
        self._pending: Recipe | None = None

    def _build(self, recipe: Recipe) -> tuple[Batch, Layout]:
        compiled = compile_world(recipe)
        batch = Batch(compiled.model, self._nworld, self._threads)
        for name in ("xpos", "xquat", "cvel", "subtree_com"):
            batch.bind(name)
        return batch, layout_of(compiled)

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
        return tuple(self._now().links)

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Scoped names, ``model::joint``, of joints that can move."""
        return tuple(self._now().joints)

    # -- time --------------------------------------------------------------------------

    def step(self, count: int = 1) -> None:
        """Advance every world by ``count`` physics steps."""
        self._now()
        self._stale = True
        try:
            self._batch.step(nstep=count)
        except SimulationError as error:
            raise EngineError(f"the physics broke down: {error}") from error
        self._check_finite()

    def _check_finite(self) -> None:
        # MuJoCo resets a simulation whose state became bad and counts a warning.
        bad = self._state.faults
        if bad.any():
            worlds = np.flatnonzero(bad.any(axis=1))
            self._batch.warning[worlds] = 0
            raise EngineError(
                f"the state of {len(worlds)} of {self._nworld} worlds became infinite "
                f"(first: world {worlds[0]})",
                hint="take a smaller physics step, or check masses, inertias and gains",
            )

    def reset(self, worlds: Worlds | None = None) -> None:
        """Put worlds back to their initial state: poses, rest, no forces."""
        self._now()
        self._batch.state[rows_of(worlds)] = self._initial
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
        world = replace(recipe.world, models=kept)
        kinematic = recipe.kinematic - {model}
        self._change(replace(recipe, world=world, motors=motors, kinematic=kinematic))

    def add_motor(self, joint: str, max_effort: float) -> None:
        """Give a joint of one axis a motor that holds a velocity with limited effort [N or N m]."""
        slots = self._layout.joint(joint)  # motors do not change the layout of joints
        if len(slots) != 1 or _width(slots[0]) != 1:
            raise EngineError(f"a motor needs a joint of one axis; '{joint}' has more")
        if not max_effort > 0.0:
            raise EngineError(f"the largest effort of a motor must be positive, not {max_effort:g}")
        recipe = self._pending or self._recipe
        motors = {**recipe.motors, joint: Motor(joint, max_effort)}
        self._pending = replace(recipe, motors=motors)

    def make_kinematic(self, model: str) -> None:
        """Let a model move only by ``set_model_placement``; it pushes, nothing pushes it."""
        recipe = self._pending or self._recipe
        self._now().model(model)
        self._change(replace(recipe, kinematic=recipe.kinematic | {model}))

    def _now(self) -> Layout:
        """The layout of what runs, once pending changes have been made."""
        if self._pending is not None:
            recipe, self._pending = self._pending, None
            self._change(recipe)
        return self._layout

    def _change(self, recipe: Recipe) -> None:
        batch, layout = self._build(recipe)
        batch.forward(stage=VELOCITY_STAGE)
        initial = batch.state[:1].copy()
        carry_over(self._batch, self._layout, batch, layout)
        self._initial = initial[0]
        self._batch, self._layout, self._recipe = batch, layout, recipe
        self._state = StateViews.of(batch)
        self._pending = None
        self._stale = True

    # -- saving ------------------------------------------------------------------------

    def snapshot(self) -> Floats:
        """The whole dynamic state, shape (nworld, size)."""
        self._now()
        state: Floats = self._batch.state.copy()
        return state

    def restore(self, state: Floats) -> None:
        """Put back what ``snapshot`` gave; the models must be the same."""
        self._now()
        if state.shape != self._batch.state.shape:
            raise EngineError(
                f"the saved state has the shape {state.shape}, the worlds that run need "
                f"{self._batch.state.shape}",
                hint="restore into a simulation with the same models and number of worlds",
            )
        self._batch.state[:] = state
        self._stale = True

    def close(self) -> None:
        """Free threads and memory; the engine must not be used any more."""
        self._pending = None
        del self._batch, self._state


def _width(slot: Slot) -> int:
    width: int = slot.velocity.stop - slot.velocity.start
    return width
