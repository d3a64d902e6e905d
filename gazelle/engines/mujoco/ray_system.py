"""Range finders' rays, cast by MuJoCo's own functions without Python."""

# mypy: disallow-untyped-decorators=False
# mypy: disable-error-code="misc"

from __future__ import annotations

from typing import Protocol

import cython
import numpy as np
from cython.cimports.gazelle.native.memory import call_ray, call_two, floats
from cython.cimports.gazelle.native.ray_frames import FrameRays
from cython.cimports.gazelle.native.system import System
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats
from gazelle.engines.mujoco.state import StateViews

# Columns of ``Workspaces.table``.
TAKEN = cython.declare(cython.int, 0)
DATA = cython.declare(cython.int, 1)
QPOS = cython.declare(cython.int, 2)
MOCAP_POS = cython.declare(cython.int, 3)
MOCAP_QUAT = cython.declare(cython.int, 4)
XPOS = cython.declare(cython.int, 5)
XQUAT = cython.declare(cython.int, 6)


class Workspaces(Protocol):
    """``mjData`` in which threads compute where bodies of a world are.

    Attributes:
        model: Address of the ``mjModel``.
        table: For each: 1 while a thread uses it, and its address and those of five of its fields.
        kinematics: Address of ``mj_kinematics``.
        ray: Address of ``mj_ray``.
    """

    model: int
    table: NDArray[np.int64]
    kinematics: int
    ray: int


@cython.cclass
class RaySystem(System):
    """Range finders with as many rays each, a row each.

    Args:
        rays: Rays of each range finder, in all worlds.
        spaces: As many as there are threads.
        state: State of the worlds.
        bodies: Body that carries each range finder; 0 for the world's.
        poses: Pose of each in the world where that carries it: position [m] and quaternion
            (w, x, y, z), shape (finders, 7).
        beside: Added to every origin [m], shape (3,).
        sheets: Geoms that have no inside, shape (geoms,).
        groups: Whether geoms of a group are met, shape (groups,).

    Attributes:
        ranges: Distances [m], shape (nworld * finders, rays); infinite for nothing, minus infinite
            from inside of something.
    """

    def __init__(
        self,
        rays: FrameRays,
        spaces: Workspaces,
        state: StateViews,
        bodies: NDArray[np.int64],
        poses: Floats,
        beside: Floats,
        sheets: Bools,
        groups: NDArray[np.uint8],
    ) -> None:
        System.__init__(self, len(bodies))
        self.rays, self.spaces, self.groups = rays, spaces, groups
        self.ranges = rays.distance.reshape(rays.distance.shape[0] * len(bodies), -1)
        self.model, self.table = spaces.model, spaces.table
        self.kinematics, self.ray = spaces.kinematics, spaces.ray
        self.group_at = groups.ctypes.data
        arrays = rays.start, rays.along, rays.distance, rays.geom, rays.normal
        self.start_at, self.along_at, self.distance_at, self.geom_at, self.normal_at = (
            each.ctypes.data for each in arrays
        )
        self.bodies, self.poses, self.beside = bodies, poses, beside
        self.poses_at = poses.ctypes.data
        self.qpos, self.mocap_pos, self.mocap_quat = state.qpos, state.mocap_pos, state.mocap_quat
        self.sheets = sheets.view(np.uint8)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def update(
        self,
        first: cython.Py_ssize_t,
        last: cython.Py_ssize_t,
        time: cython.longlong,  # noqa: ARG002
    ) -> cython.void:
        """Cast the rays of rows first to last, where worlds are now."""
        known: cython.Py_ssize_t = -1
        row: cython.Py_ssize_t
        space: cython.Py_ssize_t = self.take()
        for row in range(first, last):
            world: cython.Py_ssize_t = row // self.rows
            if world != known:
                self.place(space, world)
                known = world
            self.cast(space, world, row - world * self.rows)
        self.give(space)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def take(self) -> cython.Py_ssize_t:
        """Return a workspace that no other thread uses."""
        space: cython.Py_ssize_t = 0
        if cython.compiled:
            while gazelle_fetch_add(cython.address(self.table[space, TAKEN]), 1):  # type: ignore[name-defined]  # noqa: F821
                space = (space + 1) % self.table.shape[0]
        return space

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def give(self, space: cython.Py_ssize_t) -> cython.void:
        """Return a workspace."""
        if cython.compiled:
            gazelle_write(cython.address(self.table[space, TAKEN]), 0)  # type: ignore[name-defined]  # noqa: F821

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def place(self, space: cython.Py_ssize_t, world: cython.Py_ssize_t) -> cython.void:
        """Compute where the bodies of a world are."""
        i: cython.Py_ssize_t
        k: cython.Py_ssize_t
        qpos = floats(self.table[space, QPOS])
        for i in range(self.qpos.shape[1]):
            qpos[i] = self.qpos[world, i]
        position = floats(self.table[space, MOCAP_POS])
        quaternion = floats(self.table[space, MOCAP_QUAT])
        for i in range(self.mocap_pos.shape[1]):
            for k in range(3):
                position[3 * i + k] = self.mocap_pos[world, i, k]
            for k in range(4):
                quaternion[4 * i + k] = self.mocap_quat[world, i, k]
        call_two(self.kinematics, self.model, self.table[space, DATA])

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def cast(
        self, space: cython.Py_ssize_t, world: cython.Py_ssize_t, frame: cython.Py_ssize_t
    ) -> cython.void:
        """Cast the rays of one range finder."""
        body: cython.longlong = self.bodies[frame]
        p = floats(self.table[space, XPOS] + 24 * body)
        q = floats(self.table[space, XQUAT] + 32 * body)
        if body == 0:
            p = floats(self.poses_at + 56 * frame)
            q = floats(self.poses_at + 56 * frame + 24)
        x: cython.double = p[0] + self.beside[0]
        y: cython.double = p[1] + self.beside[1]
        z: cython.double = p[2] + self.beside[2]
        self.rays.point_frame(world, frame, x, y, z, q[1], q[2], q[3], q[0])
        count: cython.Py_ssize_t = self.rays.carried.shape[1]
        first: cython.Py_ssize_t = frame * count
        at: cython.Py_ssize_t = world * self.rays.carried.shape[0] * count + first
        ray: cython.Py_ssize_t
        for ray in range(at, at + count):
            floats(self.distance_at)[ray] = call_ray(
                self.ray,
                self.model,
                self.table[space, DATA],
                self.start_at + 24 * ray,
                self.along_at + 24 * ray,
                self.group_at,
                1,
                -1,
                self.geom_at + 4 * ray,
                self.normal_at + 24 * ray,
            )
        self.rays.judge_some(world, first, first + count, self.sheets, True)
