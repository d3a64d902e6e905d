"""The states of a batch on the device of MuJoCo Warp, and its steps there."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import mujoco
import mujoco_warp
import numpy as np
import warp as wp
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.engines.mujoco.warp.device_laws import DeviceLaws
from gazelle.engines.mujoco.warp.device_model import can_share, put_model, share_field
from gazelle.errors import EngineError

# What a step reads, and what of it a step writes.
_READ = (
    "qpos",
    "qvel",
    "qacc_warmstart",
    "qfrc_applied",
    "xfrc_applied",
    "eq_active",
    "mocap_pos",
    "mocap_quat",
    "userdata",
)
WRITTEN = ("qpos", "qvel", "qacc_warmstart", "userdata")

_OVERFLOW = mujoco_warp.OverflowType
_TOO_MANY_ROWS = _OVERFLOW.NEFC | _OVERFLOW.NJMAX_NNZ
_TOO_MANY_CONTACTS = _OVERFLOW.BROADPHASE | _OVERFLOW.NARROWPHASE | _OVERFLOW.CCD

# Least room for contacts and rows of constraints of a world; it grows as need be.
_CONTACTS, _ROWS = 32, 64
_MOST_ROWS = 1 << 15


class DeviceWorlds:
    """Worlds on the device.

    Args:
        host: The compiled model.
        nworld: Number of worlds.

    Raises:
        EngineError: MuJoCo Warp cannot simulate it.
    """

    def __init__(self, host: mujoco.MjModel, nworld: int) -> None:
        self._host, self._nworld = host, nworld
        self._contacts, self._rows = _CONTACTS, max(_ROWS, 2 * (host.nv + 6 * host.neq))
        self._own: dict[str, Floats] = {}
        self._graph: Any = None
        self._make()

    def _make(self) -> None:
        """Build the model, and allocate the worlds."""
        self._graph = None
        self._model = put_model(self._host, self._own)
        self._make_data()

    def _make_data(self) -> None:
        self._graph = None
        self._data = mujoco_warp.make_data(
            self._host, nworld=self._nworld, nconmax=self._contacts, njmax=self._rows
        )
        self._model.callback.control = None
        self._laws = DeviceLaws(self._host, self._model, self._data)

    def share(self, own: Mapping[str, Floats]) -> None:
        """Send values that differ between worlds, by field, shapes (nworld, ...).

        Raises:
            EngineError: They cannot differ in that.
        """
        changed = [n for n, v in own.items() if not np.array_equal(v, self._own.get(n, ()))]
        if not changed:
            return
        before, self._own = self._own, {name: values.copy() for name, values in own.items()}
        if all(name in before and can_share(name) for name in changed):
            self._graph = None
            for name in changed:
                share_field(self._model, name, self._own[name])
            self._laws.share(self._model)
            return
        try:
            self._make()
        except EngineError:
            self._own = before
            raise

    def step(self, state: Mapping[str, Floats], count: int) -> Mapping[str, Floats]:
        """Advance from a state; returns the fields that changed.

        Raises:
            EngineError: There are more contacts than memory could hold.
        """
        while True:
            self._put(state)
            self._data.overflow.zero_()
            self._launch(count)
            if not self._enlarge(self._data.overflow.numpy()):
                break
        return {n: getattr(self._data, n).numpy().astype(np.float64) for n in WRITTEN}

    def turned_too_far(self) -> bool:
        """Return whether something turned too fast for the step since the last call."""
        found = bool(self._laws.too_fast.numpy()[0])
        if found:
            self._laws.too_fast.zero_()
        return found

    def field(self, state: Mapping[str, Floats], name: str) -> Any:
        """Return a field of a state on the device."""
        self._put(state)
        return getattr(self._data, name)

    def _put(self, state: Mapping[str, Floats]) -> None:
        for name in _READ:
            target = getattr(self._data, name)
            if target.size:
                values = state[name] != 0.0 if name == "eq_active" else state[name]
                target.assign(np.ascontiguousarray(values))

    def _launch(self, count: int) -> None:
        """Launch steps: on a graphics card one captured graph each, else kernel by kernel."""
        one: Callable[[], Any] = lambda: mujoco_warp.step(self._model, self._data)  # noqa: E731
        if self._data.qpos.device.is_cuda and count:
            if self._graph is None:
                with wp.ScopedCapture() as capture:
                    one()
                self._graph = capture.graph
            one = lambda: wp.capture_launch(self._graph)  # noqa: E731
        for _ in range(count):
            one()

    def _enlarge(self, overflow: NDArray[np.int32]) -> bool:
        """Allocate more memory after an overflow; returns whether there was one."""
        rows = bool((overflow & int(_TOO_MANY_ROWS)).any())
        contacts = bool((overflow & int(_TOO_MANY_CONTACTS)).any())
        if not rows and not contacts:
            return False
        self._rows *= 2 if rows else 1
        self._contacts *= 2 if contacts else 1
        if max(self._rows, self._contacts) > _MOST_ROWS:
            raise EngineError(
                f"a world has more than {_MOST_ROWS} rows of constraints",
                hint="some bodies may overlap with a thousand contact points",
            )
        self._make_data()
        return True

    def cast(
        self, state: Mapping[str, Floats], start: Floats, along: Floats, groups: Any, excluded: int
    ) -> tuple[Floats, NDArray[np.int32], Floats]:
        """Cast rays in all worlds; see ``WarpBatch.meet``."""
        self._put(state)
        mujoco_warp.kinematics(self._model, self._data)
        shape = start.shape[:2]
        distance, geom = wp.zeros(shape, dtype=float), wp.zeros(shape, dtype=int)
        normal = wp.zeros(shape, dtype=wp.vec3)
        mujoco_warp.rays(
            self._model,
            self._data,
            wp.array(start.astype(np.float32), dtype=wp.vec3),
            wp.array(along.astype(np.float32), dtype=wp.vec3),
            groups,
            True,
            wp.full(shape[1], excluded, dtype=int),
            distance,
            geom,
            normal,
        )
        found = distance.numpy().astype(np.float64), geom.numpy().copy()
        return *found, normal.numpy().astype(np.float64)
