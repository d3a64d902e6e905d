"""MuJoCo's batch of worlds, with steps and rays of MuJoCo Warp."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import warp as wp
from mujoco.batch import MODEL_FIELDS
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.engines.mujoco.batch import WorldBatch
from gazelle.engines.mujoco.contact_laws.law_data import spun
from gazelle.engines.mujoco.warp.device_worlds import WRITTEN, DeviceWorlds
from gazelle.native.ray_frames import FrameRays

_BAD_ACCELERATION = mujoco.mjtWarning.mjWARN_BADQACC
_LARGEST = 1e10  # as MuJoCo judges what is broken
_ALL = slice(None)


class WarpBatch(WorldBatch):
    """Worlds with states here, in double precision, between calls of ``step``.

    A step takes them to the device and back, in single precision. Queries of a state that stands
    (places of links, contacts, forces of joints) MuJoCo computes on the processor.

    Args:
        model: Compiled.
        nworld: Number of worlds.
        threads: Native threads.

    Raises:
        EngineError: MuJoCo Warp cannot simulate it.
    """

    def __init__(self, model: mujoco.MjModel, nworld: int, threads: int) -> None:
        super().__init__(model, nworld, threads)
        self._device = DeviceWorlds(model, nworld)
        self._touched = False

    def expand(self, name: str) -> NDArray[Any]:
        """Return a field of the model for each world, to be written; see MuJoCo's."""
        self._touched = True
        found: NDArray[Any] = super().expand(name)
        return found

    def set_const(self, *args: Any, **kwargs: Any) -> None:
        """Compute the constants that depend on masses; see MuJoCo's."""
        self._touched = True
        super().set_const(*args, **kwargs)

    def step(self, ids: Any = None, nstep: int = 1, stage: int = 0) -> None:
        """Advance on the device; ``stage`` is computed here after the steps, as MuJoCo's does."""
        self._share()
        rows = _ALL if ids is None else np.asarray(ids)
        written = self._device.step(self._fields(), nstep)
        for name in WRITTEN:
            self.bind(name)[rows] = written[name][rows]
        for _ in range(nstep):  # as MuJoCo adds it up
            self.bind("time")[rows] += self.model.opt.timestep
        bad = [~(np.abs(self.bind(name)) < _LARGEST).all(axis=1) for name in ("qpos", "qvel")]
        self.warning[bad[0] | bad[1], int(_BAD_ACCELERATION), 1] += 1
        if self._device.turned_too_far():
            spun[0] = 1.0
        if stage:
            self.forward(ids, stage=stage)

    def meet(self, rays: FrameRays, groups: NDArray[np.uint8], worlds: Worlds | None) -> None:
        """Find what rays meet, on the device; see MuJoCo's."""
        self._share()
        start, along = np.zeros((2, self.nsim, *rays.start.shape[1:]))
        rows = _ALL if worlds is None else worlds
        start[rows], along[rows] = rays.start, rays.along
        along[~along.any(axis=-1)] = (0.0, 0.0, 1.0)  # in worlds that were not requested
        shown = wp.types.vector(length=6, dtype=float)(*(float(each) for each in groups))
        found = self._device.cast(self._fields(), start, along, shown, int(rays.passed[0, 0]))
        rays.distance[:], rays.geom[:], rays.normal[:] = (each[rows] for each in found)

    def on_device(self, name: str) -> Any:
        """Return a field of the state on the device, float32, shape (nworld, n)."""
        self._share()
        return self._device.field(self._fields(), name)

    def _fields(self) -> dict[str, Floats]:
        names = ("qfrc_applied", "xfrc_applied", "eq_active", "mocap_pos", "mocap_quat")
        return {name: self.bind(name) for name in (*WRITTEN, *names)}

    def _share(self) -> None:
        """Send fields that differ between worlds to the device, if they changed."""
        if self._touched:
            fields = {name: self.expanded(name) for name in MODEL_FIELDS}
            self._device.share({n: v for n, v in fields.items() if v is not None})
            self._touched = False
