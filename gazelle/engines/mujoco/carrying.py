"""Steps that bring controllers of joints, without Python between (``laws.commands``)."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import mujoco
import numpy as np
from mujoco.batch import Batch

from gazelle.array_types import Bools, Floats
from gazelle.engines.engine import DivergenceError
from gazelle.engines.mujoco.compiler import CompilerInput
from gazelle.engines.mujoco.forcing import ForcedSteps
from gazelle.engines.mujoco.hooks import Hooks
from gazelle.engines.mujoco.joint_cells import JointCells
from gazelle.engines.mujoco.laws.numbers import WORLD
from gazelle.engines.mujoco.parameters import ParameterStore
from gazelle.native.joint_system import JointSystem

# Integrators that look at forces once in a step.
_ONCE = (
    mujoco.mjtIntegrator.mjINT_EULER,
    mujoco.mjtIntegrator.mjINT_IMPLICIT,
    mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
)
_NANOSECONDS = 1_000_000_000


class CarryingSteps(ForcedSteps):
    """The part of ``gazelle.engines.carrying.CarryingEngine``."""

    _recipe: CompilerInput
    _parameters: ParameterStore
    _cells: dict[tuple[str, ...], tuple[int, JointCells]]
    _revision = 0
    _looks_once = False

    @abstractmethod
    def step(self, count: int = 1) -> None:
        """Advance every world."""

    @abstractmethod
    def _change(self, recipe: CompilerInput) -> None:
        """Go on with another model."""

    @property
    def revision(self) -> int:
        """Counts changes of models: systems then have to be bound to joints anew."""
        self._now()
        return self._revision

    @cached_property
    def _hooks(self) -> Hooks:
        return Hooks(self._nworld)

    @property
    def carries(self) -> bool:
        """Whether it can, the way it integrates."""
        return self._looks_once

    def expect_systems(self) -> None:
        """Be ready to carry systems: what has to be compiled for that is."""
        self._now()
        if not self._recipe.hooks:
            self._change(replace(self._recipe, hooks=self._hooks.address))

    def _begin_carrying(self, batch: Batch, recipe: CompilerInput) -> None:
        """Tell a new batch which world is which, and what is too fast in it."""
        self._revision += 1
        self._cells = {}
        self._looks_once = batch.model.opt.integrator in _ONCE
        if not recipe.hooks:
            return
        self._hooks.limit(self._layout.limits)
        if self._nworld > 1:
            batch.expand("numeric_data")[:, WORLD] = np.arange(self._nworld)

    def bind_joints(self, system: JointSystem, joints: Sequence[str]) -> None:
        """Say where joints are, good for one ``revision``."""
        layout = self._now()
        slots = [layout.joint(name)[0] for name in joints]
        largest = [layout.limits.effort.get(name, (np.inf,))[0] for name in joints]
        driven = self._recipe.motors
        system.bind(
            np.array([slot.position.start for slot in slots], np.intp),
            np.array([slot.velocity.start for slot in slots], np.intp),
            np.array(largest, np.float64),
            np.array(
                [layout.motor(n).targets.start if n in driven else -1 for n in joints], np.intp
            ),
        )

    def read_joints(self, system: JointSystem) -> None:
        """Tell a bound system where its joints are now."""
        system.read(self._state.qpos, self._state.qvel)

    def push_joints(self, system: JointSystem) -> None:
        """Let act what a bound system says."""
        system.act(self._state.qfrc_applied, self._state.userdata)
        self._stale = True

    def place_joints(
        self, joints: tuple[str, ...], position: Floats, velocity: Floats, chosen: Bools
    ) -> None:
        """Put many joints somewhere, to their limits at most."""
        layout, writes = self._now(), self._parameters.writes
        known = self._cells.get(joints)
        if known is None or known[0] != writes:
            known = writes, JointCells.find(layout, joints, self.parameter)
            self._cells[joints] = known
        known[1].put(self._state.qpos, self._state.qvel, position, velocity, chosen)
        self._placed = self._stale = True

    def carry(self, systems: Sequence[JointSystem], count: int, now_ns: int) -> None:
        """Advance every world, and bring bound systems at the beginning of every step."""
        self._hooks.begin(systems, now_ns, round(self.time_step * _NANOSECONDS))
        self._holds_back = True
        try:
            self.step(count)
        except DivergenceError as error:
            self._hooks.kept[error.worlds] = 0.0
            raise
        finally:
            self._holds_back = False
            self._hooks.end(self._state.qfrc_applied)
