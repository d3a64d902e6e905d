"""Many worlds with the same bodies in a plane, moved by native kernels."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.argument_checks import checked, indices, world_indices
from gazelle.array_types import Floats, Indices, Worlds
from gazelle.engines.limits import MAX_WORLDS, integer, physics_step
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.bodies import Bodies
from gazelle.engines.planar.body_writes import set_poses
from gazelle.engines.planar.fleet_bodies import Body, Drive, drive_row, radius_of
from gazelle.engines.planar.grid_cells import put_back, relink, relink_some
from gazelle.engines.planar.merged_steps import Moving
from gazelle.engines.planar.moving import Planning, Screening, Settling
from gazelle.engines.planar.scene import scene_of
from gazelle.engines.planar.shapes import PrimitiveTable, pieces_of, primitives_of
from gazelle.errors import EngineError
from gazelle.geometry.planar_part import PlanarPart
from gazelle.native.loop import SystemLoop
from gazelle.native.system import System
from gazelle.native.worker_pool import WorkerPool

_CELL = 1.0  # side of the grid's cells if none is wanted [m]
_SHARE = 700  # bodies that are worth a thread: waking it costs 50 to 100 us of work


@checked(EngineError)
class Fleet:
    """Bodies that drive among statics, in many copies of one world.

    A step that would make a body overlap something leaves it where it is, ``stalled``; bodies
    move one after another in their order, so none ever overlap if they did not at first.
    Results do not depend on the number of threads.

    Args:
        bodies: The same in all worlds.
        statics: Static parts, the same in all worlds.
        nworld: Number of worlds.
        time_step: Of a step [s].
        euler: Whether a step goes straight and then turns, as in Stage, not along an arc.
        sweep: Whether to look for what is in the way so often within a step that a body jumps over
            nothing, up to a thousand times its own half width a step; else it is looked for where
            each step ends.
        cell: Side of the grid's cells [m].
        threads: Number of threads; all processors if None.

    Attributes:
        changes: Grows whenever bodies move or are put somewhere.

    Raises:
        EngineError: A shape, drive or number is invalid.
    """

    def __init__(
        self,
        bodies: Sequence[Body],
        statics: Sequence[PlanarPart] | PrimitiveTable = (),
        *,
        nworld: int = 1,
        time_step: float = 0.1,
        euler: bool = False,
        sweep: bool = False,
        cell: float = _CELL,
        threads: int | None = None,
    ) -> None:
        nworld, time_step = integer("nworld", nworld, most=MAX_WORLDS), physics_step(time_step)
        threads = None if threads is None else integer("threads", threads)
        self.nworld, self.nbody = nworld, len(bodies)
        self.euler = euler
        self.changes = 0
        self.pool = WorkerPool(threads)
        self._describe(bodies)
        first = np.array([body.pose for body in bodies], np.float64).reshape(-1, 3)
        heights = np.array([body.z for body in bodies], np.float64)
        self._initial = _rows_of(np.column_stack((first, heights)))
        extent = first[:, :2] if len(bodies) else np.zeros((1, 2))
        side = max(cell, 2.0 * self._widest)
        self.scene = scene_of(statics, extent, side, nbody=self.nbody, nworld=nworld)
        self._make_state()
        self.bodies: Any = self._tables(time_step, sweep=sweep)
        self._loop: SystemLoop | None = None
        self._relink()

    def _describe(self, bodies: Sequence[Body]) -> None:
        """Fill the tables of what the bodies are; equal parts are stored once."""
        self.kinds = np.zeros((self.nbody, c.KIND_OF_BODY))
        self.drives = np.zeros((self.nbody, c.DRIVE))
        shapes: dict[tuple[PlanarPart, ...], int] = {}
        drives: dict[Drive | None, Floats] = {}
        for k, body in enumerate(bodies):
            self.kinds[k, c.FIRST_VISUAL] = shapes.setdefault(body.parts, len(shapes))
            self.kinds[k, c.FAMILY] = -1.0 - k if body.family is None else body.family
            if body.drive not in drives:
                drives[body.drive] = drive_row(body.drive)
            self.drives[k] = drives[body.drive]
        if len(drives) == 1:
            self.drives = self.drives[:1].copy()  # kernels take it as that of all
        tables = [primitives_of(parts) for parts in shapes]
        pieces = [pieces_of(parts) for parts in shapes]
        visuals = np.cumsum([0, *(len(table.rows) for table in tables)])
        bumps = np.cumsum([0, *(len(piece.rows) for piece in pieces)])
        corners = np.cumsum([0, *(len(piece.corners) for piece in pieces)])
        for piece, first in zip(pieces, corners, strict=False):
            piece.rows[:, c.FIRST] += first
        self.visuals = np.vstack([np.zeros((0, c.PRIMITIVE)), *(t.rows for t in tables)])
        self.tags = np.concatenate([np.zeros(0, np.int64), *(t.tags for t in tables)])
        self.pieces = np.vstack([np.zeros((0, c.PIECE)), *(p.rows for p in pieces)])
        self.corners = np.vstack([np.zeros((0, 2)), *(p.corners for p in pieces)])
        sizes = np.array([radius_of(parts) for parts in shapes])
        shape = self.kinds[:, c.FIRST_VISUAL].astype(int)
        columns = (visuals[:-1], visuals[1:], bumps[:-1], bumps[1:], sizes)
        for column, values in enumerate(columns, c.FIRST_VISUAL):
            self.kinds[:, column] = values[shape] if self.nbody else 0.0
        strides = np.array([piece.rows[:, c.SLIM].max(initial=0.0) for piece in pieces])
        if self.nbody:
            self.kinds[:, c.STRIDE] = np.where(strides > 0.0, strides, math.inf)[shape]
        self._widest = float(sizes.max()) if len(sizes) else 0.0

    def _make_state(self) -> None:
        total = self.nworld * self.nbody
        self.rows = np.tile(self._initial, (self.nworld, 1))
        self.goal = self.rows[:, : c.Z + 1].copy()
        self._command = np.zeros((total, 3))
        self._velocity = np.zeros((total, 3))
        self._state = np.zeros(total, np.int8)
        self._stalled = np.zeros(total, np.bool_)
        self.head = np.full((self.nworld, self.scene.cells), -1, np.int32)
        self.follow = np.full(total, -1, np.int32)
        self.cell = np.full(total, -1, np.int32)
        self.memory = np.full((total, c.MEMORY), math.inf)

    def _tables(self, time_step: float, *, sweep: bool) -> Bodies:
        """Return all bodies as kernels see them."""
        scene = self.scene
        return Bodies(
            nbody=self.nbody, nworld=self.nworld, dt=time_step, widest=self._widest,
            euler=self.euler, sweep=sweep, rows=self.rows, goal=self.goal, command=self._command,
            velocity=self._velocity, kinds=self.kinds, drives=self.drives, pieces=self.pieces,
            corners=self.corners, visuals=self.visuals, statics=scene.table.rows, lanes=scene.lanes,
            grid=scene.grid, start=scene.start, items=scene.items, near_grid=scene.near_grid,
            near_start=scene.near_start, near_items=scene.near_items, head=self.head,
            follow=self.follow, cell=self.cell, state=self._state,
            stalled=self._stalled.view(np.uint8), way=np.zeros(len(self.rows)),
            memory=self.memory,
        )  # fmt: skip

    @property
    def time_step(self) -> float:
        """Time step [s]; settable."""
        return float(self.bodies.dt)

    @time_step.setter
    def time_step(self, seconds: float) -> None:
        self.bodies.dt = physics_step(seconds)

    @property
    def sweep(self) -> bool:
        """True if collisions are also sought within a step; settable."""
        return bool(self.bodies.sweep)

    @sweep.setter
    def sweep(self, enabled: bool) -> None:
        self.bodies.sweep = enabled
        self._loop = None

    @property
    def initial(self) -> Floats:
        """The rows of a world's bodies as they were made, shape (nbody, columns.BODY)."""
        return self._initial.copy()

    # -- state -------------------------------------------------------------------------

    @property
    def pose(self) -> Floats:
        """x, y [m] and heading [rad] of every body, to be read, shape (nworld, nbody, 3)."""
        view = self.body_rows[:, :, :3]
        view.flags.writeable = False
        return view

    @property
    def body_rows(self) -> Floats:
        """Rows of the bodies, world by world, shape (nworld, nbody, columns.BODY)."""
        return self.rows.reshape(self.nworld, self.nbody, c.BODY)

    @property
    def directions(self) -> Floats:
        """Cosine and sine of every heading, to be read, shape (nworld, nbody, 2)."""
        return self.body_rows[:, :, c.COS : c.SIN + 1]

    @property
    def heights(self) -> Floats:
        """Heights of the bodies' frames [m], to be written, shape (nworld, nbody)."""
        return self.body_rows[:, :, c.Z]

    @property
    def command(self) -> Floats:
        """Wanted velocities, as ``Drive`` has them, to be written, shape (nworld, nbody, 3)."""
        return self._command.reshape(self.nworld, self.nbody, 3)

    @property
    def velocity(self) -> Floats:
        """Velocities of the drives, in the same meaning, shape (nworld, nbody, 3)."""
        return self._velocity.reshape(self.nworld, self.nbody, 3)

    @property
    def stalled(self) -> NDArray[np.bool_]:
        """True where the last move of a body was not made, shape (nworld, nbody)."""
        return self._stalled.reshape(self.nworld, self.nbody)

    @property
    def widest(self) -> float:
        """Radius of the largest body about its origin [m]."""
        return self._widest

    @checked(EngineError, after=True)
    def place(
        self,
        body: int,
        pose: ArrayLike,
        worlds: Worlds | None = None,
        *,
        height: ArrayLike | None = None,
    ) -> None:
        """Set the pose of a body, regardless of obstacles.

        Args:
            body: Its index.
            pose: x, y [m] and heading [rad], shape (3,) or (n, 3).
            worlds: Worlds; all if None.
            height: Of its frame [m], shape () or (n,); as it was if None.

        Raises:
            EngineError: A number is not finite, or there is no such body or world.
        """
        set_poses(self.bodies, self.which(body, worlds), pose, height)
        self.changes += 1

    @checked(EngineError, after=True)
    def which(self, body: int, worlds: Worlds | None = None) -> Indices:
        """Return a body in some worlds, all if None, counted through all worlds.

        Raises:
            EngineError: There is no such body or world.
        """
        if not 0 <= body < self.nbody:
            raise EngineError(f"there is no body {body}; bodies are 0 to {self.nbody - 1}")
        if worlds is None:
            return np.arange(body, len(self.rows), self.nbody)
        return world_indices(worlds, self.nworld, EngineError) * self.nbody + body

    def put(self, pose: ArrayLike, heights: ArrayLike, which: Indices | None = None) -> None:
        """Set the poses of bodies.

        Args:
            pose: x, y [m] and heading [rad], shape (nworld, nbody, 3), or (n, 3).
            heights: Of their frames [m], shape (nworld, nbody), or (n,).
            which: The n bodies, counted through all worlds; all if None.

        Raises:
            EngineError: A number is not finite, or there is no such body.
        """
        flat = np.asarray(pose, np.float64).reshape(-1, 3)
        rows = (
            slice(None) if which is None else indices("bodies", which, len(self.rows), EngineError)
        )
        self.rows[rows] = _rows_of(np.column_stack((flat, np.asarray(heights, np.float64).ravel())))
        self._relink()

    def put_rows(self, rows: ArrayLike) -> None:
        """Set all bodies to the ``rows`` of such a fleet, to the bit.

        Args:
            rows: Shape (nworld, nbody, columns.BODY).

        Raises:
            EngineError: A number is not finite.
        """
        self.rows[:] = np.asarray(rows, np.float64).reshape(-1, c.BODY)
        self._relink()

    def copy_from(self, body: int, other: Fleet, its: int) -> None:
        """Copy the state of a body from another fleet with as many worlds.

        Raises:
            EngineError: There is no such body.
        """
        indices("bodies", [body], self.nbody, EngineError)
        indices("bodies", [its], other.nbody, EngineError)
        here, there = slice(body, None, self.nbody), slice(its, None, other.nbody)
        self.rows[here], self._command[here] = other.rows[there], other._command[there]
        self._velocity[here], self._stalled[here] = other._velocity[there], other._stalled[there]
        relink_some(self.bodies, self.which(body))
        self.changes += 1

    @checked(EngineError, after=True)
    def reset(self, worlds: Worlds | None = None) -> None:
        """Reset worlds to their initial state: poses, rest, no commands.

        Raises:
            EngineError: There is no such world.
        """
        chosen = np.arange(self.nworld) if worlds is None else worlds
        which = world_indices(chosen, self.nworld, EngineError)
        put_back(self.bodies, np.ascontiguousarray(which), self._initial)
        self.changes += 1

    def _relink(self) -> None:
        """Update the lists of the grid for all bodies, which were placed."""
        self.changes += 1
        relink(self.bodies, 0, len(self.rows))

    # -- time --------------------------------------------------------------------------

    @checked(EngineError, after=True)
    def step(self, count: int = 1) -> None:
        """Advance every world by ``count`` steps.

        Raises:
            EngineError: It is not a number of steps.
        """
        count = integer("the number of steps", count, 0)
        if self._loop is None:
            self._loop = SystemLoop(self.systems(), self.nworld, 1, self.pool)
        self._loop.time = 0
        self._loop.run(count, self.threads)
        self.changes += 1

    def systems(self) -> list[System]:
        """Return the systems of a step, to be updated in this order.

        Large worlds are shared among threads, each of many worlds is stepped by one.
        """
        if self.nworld >= 2 * self.pool.size or self.alone or self.sweep:
            return [Moving(self.bodies)]
        return [Planning(self.bodies), Screening(self.bodies), Settling(self.bodies)]

    @property
    def threads(self) -> int:
        """Number of threads that pay off; 0 for all."""
        return 1 if self.alone else 0

    @property
    def alone(self) -> bool:
        """True if one thread does all of a step."""
        return self.pool.size == 1 or self.nworld * self.nbody < 2 * _SHARE

    def close(self) -> None:
        """Stop the threads."""
        self.pool.close()


def _rows_of(placed: Floats) -> Floats:
    """Return rows of bodies at x, y, heading and height, shape (n, 4)."""
    rows = np.zeros((len(placed), c.BODY))
    rows[:, c.X], rows[:, c.Y], rows[:, c.YAW], rows[:, c.Z] = placed.T
    rows[:, c.COS], rows[:, c.SIN] = np.cos(placed[:, 2]), np.sin(placed[:, 2])
    return rows
