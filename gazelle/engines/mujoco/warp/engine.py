"""The MuJoCo engine with its steps on a graphics card."""

from __future__ import annotations

import functools
import warnings
from collections.abc import Sequence
from typing import Any

import mujoco
import warp as wp

from gazelle.description import World
from gazelle.engines.mujoco.engine import MujocoEngine
from gazelle.engines.mujoco.warp.batch import WarpBatch
from gazelle.engines.mujoco.warp.rays import WarpRanges
from gazelle.engines.mujoco.warp.single_precision import soften
from gazelle.engines.range_rays import RangeRays, RangeTable
from gazelle.errors import EngineError, EngineWarning, did_you_mean

_SLEEP, _SPECULATIVE = mujoco.mjtEnableBit.mjENBL_SLEEP, mujoco.mjtEnableBit.mjENBL_SPECULATIVE

# What of joints can be had on the device, and MuJoCo's names for it.
_ON_DEVICE = {"position": "qpos", "velocity": "qvel"}


class WarpEngine(MujocoEngine):
    """Many copies of one world in MuJoCo Warp; see ``gazelle.engines.engine.Engine``.

    Where there is no graphics card that Warp knows, it steps on the processor: to try, not to be fast.
    The arguments are those of ``MujocoEngine``.

    Raises:
        EngineError: The world cannot be simulated by MuJoCo Warp.
    """

    _calls_systems = False  # they are not on the device, and act between steps

    def range_table(self, rays: Sequence[RangeRays]) -> RangeTable:
        """Return a table of range finders of one kind."""
        return WarpRanges(self.running, self.links, rays)

    def on_device(self, kind: str, joint: str) -> Any:
        """Return a joint's positions or velocities in all worlds on the device, without a copy.

        Args:
            kind: ``position`` or ``velocity``.
            joint: Scoped name.

        Returns:
            An array of Warp's for ``torch.from_dlpack``, ``numpy.from_dlpack`` and so on, float32, shape
            (nworld, axes), as the protocol has it but for quaternions, which are (w, x, y, z). It is
            good until the next step, and not to be written to.

        Raises:
            EngineError: There is no such joint or kind.
        """
        if kind not in _ON_DEVICE:
            raise EngineError(
                f"there is no '{kind}' of joints on the device", hint=did_you_mean(kind, _ON_DEVICE)
            )
        slots = self.running.up_to_date().joint(joint)
        columns = [slot.position if kind == "position" else slot.velocity for slot in slots]
        whole = self.running.batch.on_device(_ON_DEVICE[kind])
        return whole[:, columns[0].start : columns[-1].stop]

    @staticmethod
    def _batch_of(nworld: int, threads: int, model: mujoco.MjModel, world: World) -> WarpBatch:
        """Return the worlds of a compiled model; without sleep and speculative contacts."""
        _say_if_slow()
        if model.opt.enableflags & _SPECULATIVE:
            _miss_foresight(world)
        model.opt.enableflags &= ~(int(_SLEEP) | int(_SPECULATIVE))
        model.tree_sleep_policy[:] = int(mujoco.mjtSleepPolicy.mjSLEEP_AUTO_NEVER)
        profile = world.profile
        if profile.contacts == "fast" or profile.ode.friction_model not in (None, "cone_model"):
            warnings.warn(
                EngineWarning(
                    "the engine 'mujoco-warp' has friction as a cone only, not as the pyramid that the world "
                    "requires"
                ),
                stacklevel=5,
            )
        soften(model)
        return WarpBatch(model, nworld, threads)


@functools.cache
def _say_if_slow() -> None:
    """Warn, once in a process, that there is no graphics card."""
    if not wp.is_cuda_available():
        warnings.warn(
            EngineWarning(
                "the engine 'mujoco-warp' finds no graphics card and steps on the processor, many times "
                "slower than engine='mujoco'"
            ),
            stacklevel=5,
        )


def _miss_foresight(world: World) -> None:
    """Warn that speculative contacts are not computed.

    Raises:
        EngineError: The world requires it.
    """
    if world.profile.speculative_contacts:
        raise EngineError(
            "the engine 'mujoco-warp' does not support 'speculative_contacts'",
            hint="gazelle.Simulation(..., engine='mujoco') does",
        )
    warnings.warn(
        EngineWarning(
            "the engine 'mujoco-warp' computes no speculative contacts: a small body that is "
            "faster than 20 m/s may tunnel through others. Use a smaller step, or engine='mujoco'"
        ),
        stacklevel=5,
    )
