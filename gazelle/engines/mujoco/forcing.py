"""Steps with forces that depend on how fast things move: wind, and efforts held back.

MuJoCo is told forces once for all steps of a call. Where such a force acts, or a tyre slips on
its wheel (see ``tyres``), the physics is stepped one step at a time; where none does, which is
nearly always, nothing is different.
"""

from __future__ import annotations

import warnings
from abc import abstractmethod
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

import mujoco
import numpy as np
from mujoco.batch import Batch, SimulationError

from gazelle.array_types import Floats
from gazelle.description import World
from gazelle.engines.mujoco.laws import spun
from gazelle.engines.mujoco.suspects import suspect
from gazelle.engines.mujoco.touching import TouchAccess
from gazelle.engines.mujoco.wind import wind_strength
from gazelle.errors import EngineWarning


class ForcedSteps(TouchAccess):
    """The part of ``gazelle.engines.engine.Engine`` that steps."""

    _spun = False
    """Whether it was said that something turns too fast."""
    _holds_back = False
    """Whether efforts are held back within steps."""
    _threads: int
    """Native threads."""

    @property
    @abstractmethod
    def world(self) -> World:
        """The world that runs."""

    def _batch_of(self, model: mujoco.MjModel, _: World) -> Batch:
        """The worlds of a compiled model."""
        sleepy = bool(model.opt.enableflags & mujoco.mjtEnableBit.mjENBL_SLEEP)
        return Batch(model, self._nworld, self._threads, persistent=sleepy)

    def _advance(self, count: int) -> set[int]:
        """Step all worlds; returns those in which MuJoCo gave up."""
        tyres = self._layout.tyres
        if not tyres and not self._is_forced():
            return self._step_batch(count)
        failed: set[int] = set()
        for _ in range(count):
            for tyre in tyres.values():
                self._state.qpos[:, tyre.positions] = 0.0
            with self._forced():
                failed |= self._step_batch(1)
            self._stale = True
        return failed

    def _is_forced(self) -> bool:
        return self._is_governed() or self._is_windy()

    def _is_governed(self) -> bool:
        return not self._holds_back and self._layout.limits.govern(self._state)

    def _step_batch(self, count: int) -> set[int]:
        failed: set[int] = set()
        try:
            self._batch.step(nstep=count)
        except SimulationError as error:
            failed = {int(world) for world in error.ids}
        if spun[0]:
            spun[0] = 0.0
            if not failed and not np.count_nonzero(self._state.faults):
                self._warn_of_spin()
        return failed

    def _warn_of_spin(self) -> None:
        """Say once that the physics step is too long for how fast something turns."""
        if self._spun:
            return
        self._spun = True
        world = int(np.abs(self._state.qvel).max(axis=1).argmax())
        states = self._batch.state
        who = suspect(self._layout, self._state, states, states[world])
        warnings.warn(
            EngineWarning(
                f"something turns more than a quarter of a radian in a physics step of "
                f"{self.time_step:g} s (fastest: {who}); it precesses more than 1 % too slowly. "
                "Take a smaller step"
            ),
            stacklevel=5,
        )

    @contextmanager
    def _forced(self) -> Iterator[None]:
        """Let the forces of this moment act while it lasts; the state keeps what was commanded."""
        if not self._is_forced():
            yield
            return
        with ExitStack() as stack:
            if self._is_governed():
                stack.enter_context(self._layout.limits.held_back(self._state))
            stack.enter_context(self._blown())
            yield

    def _is_windy(self) -> bool:
        return bool(self._layout.windy) and any(self.world.wind)

    @contextmanager
    def _blown(self) -> Iterator[None]:
        """Let the wind push the links that it is enabled for, in proportion to their mass."""
        if not self._is_windy():
            yield
            return
        pushed = self._state.xfrc_applied
        commanded = pushed.copy()
        for link, body in self._layout.windy.items():
            pushed[:, body, :3] += self._drag(link, body)
        try:
            yield
        finally:
            pushed[:] = commanded

    def _drag(self, link: str, body: int) -> Floats:
        strength = wind_strength(self.world) * self._of_worlds("body_mass")[:, body, None]
        past = np.asarray(self.world.wind) - self.link_motion(link).linear
        drag: Floats = strength * past
        return drag
