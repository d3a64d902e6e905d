"""Steps with forces that depend on velocities: wind, and limits of efforts.

MuJoCo takes applied forces once for all steps of a call. Where such a force acts, or a wheel slips
(``compiler.wheel_slip``), the physics makes one step at a time.

Wind acts as Gazebo's plugin applies it. A link with ``<enable_wind>`` is pushed at its centre of mass
by F = mass * strength * (wind - velocity), in newtons with a strength of 1/s: after 1/strength
seconds its velocity is two thirds of the wind's. Neither shape nor size matter. The strength is the
WindPlugin's ``force_approximation_scaling_factor``, or 1. Gusts, noise and rise times of the plugin
are not simulated.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

import numpy as np
from mujoco.batch import SimulationError

from gazelle.array_types import Floats, Worlds
from gazelle.description import World
from gazelle.engines.motion import Motion
from gazelle.engines.mujoco.contact_laws import spun
from gazelle.engines.mujoco.divergence import divergence_report
from gazelle.engines.mujoco.layout import MujocoLayout
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.errors import EngineWarning


class ForcedSteps:
    """The part of ``gazelle.engines.engine.Engine`` that steps.

    Args:
        run: Running worlds.
        motion: Returns how a link moves, for the wind.

    Attributes:
        holds_back: Whether efforts are held back within steps.
    """

    def __init__(self, run: RunningWorlds, motion: Callable[[str], Motion]) -> None:
        self._run, self._motion = run, motion
        self.holds_back = False
        self._spun = False  # whether it was said that something turns too fast
        self._full = False  # whether it was said that contacts are left out
        self._plain: tuple[MujocoLayout, World] | None = None  # where no such force ever acts

    def advance(self, count: int) -> set[int]:
        """Step all worlds; returns those in which MuJoCo gave up."""
        layout, world, plain = self._run.layout, self._run.world, self._plain
        if plain is not None and plain[0] is layout and plain[1] is world:
            return self._step_batch(count)
        slip_links = layout.slip_links
        if not slip_links and not self._is_forced():
            if not layout.limits.dofs.size:
                self._plain = layout, world
            return self._step_batch(count)
        failed: set[int] = set()
        for _ in range(count):
            for slip_body in slip_links.values():
                self._run.state.qpos[:, slip_body.positions] = 0.0
            with self.forced():
                failed |= self._step_batch(1)
            self._run.stale = True
        return failed

    def _is_forced(self) -> bool:
        return self._is_governed() or self._is_windy()

    def _is_governed(self) -> bool:
        return not self.holds_back and self._run.layout.limits.govern(self._run.state)

    def _step_batch(self, count: int) -> set[int]:
        failed: set[int] = set()
        try:
            self._run.batch.step(nstep=count)
        except SimulationError as error:
            failed = {int(world) for world in error.ids}
        if not self._full and np.count_nonzero(self._run.state.overflows):
            self._warn_of_full_memory()
        if spun[0]:
            spun[0] = 0.0
            if not failed and not np.count_nonzero(self._run.state.faults):
                self._warn_of_spin()
        return failed

    def _warn_of_full_memory(self) -> None:
        """Warn once that contacts are left out."""
        self._full = True
        world = int(self._run.state.overflows.any(axis=1).argmax())
        warnings.warn(
            EngineWarning(
                f"there are more contacts than MuJoCo has memory for, and some are left out (first: "
                f"world {world}). Use fewer or simpler collision shapes"
            ),
            stacklevel=5,
        )

    def _warn_of_spin(self) -> None:
        """Warn once that the physics step is too long for how fast something turns."""
        if self._spun:
            return
        self._spun = True
        world = int(np.abs(self._run.state.qvel).max(axis=1).argmax())
        states = self._run.batch.state
        cause = divergence_report(self._run.layout, self._run.state, states, states[world])
        warnings.warn(
            EngineWarning(
                f"a body turns by more than 0.25 rad in a physics step of "
                f"{self._run.time_step:g} s (fastest: {cause}); its precession is more than 1 % too slow. "
                "Use a smaller step"
            ),
            stacklevel=5,
        )

    @contextmanager
    def forced(self) -> Iterator[None]:
        """Apply the forces of this moment while it lasts; the state keeps what was commanded."""
        if not self._is_forced():
            yield
            return
        with ExitStack() as stack:
            if self._is_governed():
                stack.enter_context(self._run.layout.limits.held_back(self._run.state))
            stack.enter_context(self._blown())
            yield

    def change_in_step(self, motion: Callable[[], Motion], worlds: Worlds | None) -> Motion:
        """Return the change of a motion in the next physics step of some worlds; nothing moves."""
        before = motion()
        state, warnings = self._run.batch.state.copy(), self._run.batch.warning.copy()
        with self.forced():
            self._run.batch.step(ids=worlds)
        self._run.stale = True
        after = motion()
        self._run.batch.state[:], self._run.batch.warning[:] = state, warnings
        self._run.stale = True
        rate = 1.0 / self._run.time_step
        return Motion(
            (after.linear - before.linear) * rate, (after.angular - before.angular) * rate
        )

    def _is_windy(self) -> bool:
        return bool(self._run.layout.windy) and any(self._run.world.wind)

    @contextmanager
    def _blown(self) -> Iterator[None]:
        """Apply the wind to enabled links, in proportion to their mass, while it lasts."""
        if not self._is_windy():
            yield
            return
        pushed = self._run.state.xfrc_applied
        commanded = pushed.copy()
        for link, body in self._run.layout.windy.items():
            pushed[:, body, :3] += self._drag(link, body)
        try:
            yield
        finally:
            pushed[:] = commanded

    def _drag(self, link: str, body: int) -> Floats:
        strength = wind_strength(self._run.world) * self._run.of_worlds("body_mass")[:, body, None]
        past = np.asarray(self._run.world.wind) - self._motion(link).linear
        drag: Floats = strength * past
        return drag


_PLUGINS = ("WindPlugin", "wind-effects")


def wind_strength(world: World) -> float:
    """Return the strength of the wind of a world [1/s]."""
    for plugin in world.plugins:
        if any(word in plugin.filename for word in _PLUGINS):
            return plugin.parameters.get("force_approximation_scaling_factor", 1.0)
    return 1.0
