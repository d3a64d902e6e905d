"""The MuJoCo engine with its steps on a graphics card."""

from __future__ import annotations

import warnings

import mujoco

from gazelle.description import World
from gazelle.engines.mujoco.engine import MujocoEngine
from gazelle.engines.mujoco.warp.batch import WarpBatch
from gazelle.errors import EngineError, EngineWarning

_SLEEP, _SPECULATIVE = mujoco.mjtEnableBit.mjENBL_SLEEP, mujoco.mjtEnableBit.mjENBL_SPECULATIVE


class WarpEngine(MujocoEngine):
    """Many copies of one world in MuJoCo Warp; see ``gazelle.engines.engine.Engine``.

    Where there is no graphics card that Warp knows, it steps on the processor: to try, not to be fast.
    The arguments are those of ``MujocoEngine``.

    Raises:
        EngineError: The world cannot be simulated by MuJoCo Warp.
    """

    @property
    def carries(self) -> bool:
        """No: controllers of joints are not on the device, and are brought between steps."""
        return False

    def _batch_of(self, model: mujoco.MjModel, world: World) -> WarpBatch:
        """The worlds of a compiled model; nothing sleeps in them, and contacts are not foreseen."""
        if model.opt.enableflags & _SPECULATIVE:
            self._miss_foresight(world)
        model.opt.enableflags &= ~(int(_SLEEP) | int(_SPECULATIVE))
        model.tree_sleep_policy[:] = int(mujoco.mjtSleepPolicy.mjSLEEP_AUTO_NEVER)
        return WarpBatch(model, self._nworld, self._threads)

    def _miss_foresight(self, world: World) -> None:
        """Say that contacts are not sought on the way of a step.

        Raises:
            EngineError: The world asks for it.
        """
        if world.profile.speculative_contacts:
            raise EngineError(
                "the engine 'mujoco-warp' seeks no contacts on the way of a step "
                "('speculative_contacts')",
                hint="gazelle.Simulation(..., engine='mujoco') does",
            )
        warnings.warn(
            EngineWarning(
                "the engine 'mujoco-warp' seeks no contacts on the way of a step: a small body that is "
                "faster than 20 m/s may pass through something. Take a smaller step, or engine='mujoco'"
            ),
            stacklevel=5,
        )
