"""Recovery from penetration at SDF's ``max_vel``, without a gain of energy.

A contact corrects its depth within some steps, however deep it is: a box that a file puts
1 m into the ground would leave it at 90 m/s. ODE limits the velocity of the correction. Here
the surface of what overlaps starts as deep as it is and rises at that velocity: a contact
margin below zero, that grows to zero. That holds for what a file, a spawn or the placing of a
free body at run time makes overlap; what strikes or pushes is left to the contact.

The contacts of what overlaps each want to part at ``max_vel``. Where they face each other there
is a motion that parts all of them, but it is fast: out of a wedge of the half angle a at
``max_vel`` / sin(a), and about two points that are d apart with ``max_vel`` / d. Where there is
none, as between rings that are linked, contacts throw what they hold. So while a free body
recovers, its speed grows beyond twice ``max_vel``, and beyond that at which its joints move its own
parts, by no more than gravity's work: a robot drives while it rises out of the ground.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from collections.abc import Set as AbstractSet

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Contact, World
from gazelle.engines.mujoco.compiler.geom_names import geom_ids, geom_names
from gazelle.engines.mujoco.compiler.options import DEEPEST, SENSORS_OFF
from gazelle.engines.mujoco.compiler.spec import Compiled
from gazelle.engines.mujoco.compiler.surfaces import TOUCHING
from gazelle.engines.mujoco.state import StateViews

# Physics steps between two rises of a surface, counted by the time of each world, so that
# it does not matter how many steps are made at once.
_PIECE = 10

# Margin of what touches with other pieces of a body under penetration recovery [m]: it marks them.
_MARK = -1e-9

# Least depth that penetration recovery handles [m]: a contact pushes out gently what is less deep.
_SHALLOW = 2e-4

_STATE = mujoco.mjtState.mjSTATE_INTEGRATION.value
_POSITION_STAGE = mujoco.mjtStage.mjSTAGE_POS.value


class Overlaps:
    """Contact margins of what overlaps, in each world.

    Args:
        compiled: The model that runs, as compiled.
        world: Its description.
        nworld: Number of worlds.
    """

    def __init__(self, compiled: Compiled, world: World, nworld: int) -> None:
        model = self._model = compiled.model
        ode = world.profile.ode
        self._shallow = max(ode.contact_surface_layer, _SHALLOW)
        self._allowed = np.full(model.ngeom, self._shallow)
        self._speed = np.zeros(model.ngeom)
        for geom, contact in _contacts_of(compiled):
            self._allowed[geom] = max(self._allowed[geom], contact.min_depth)
            self._speed[geom] = min(contact.max_vel, ode.contact_max_correcting_vel)
        pairs = zip(model.pair_geom1.tolist(), model.pair_geom2.tolist(), strict=True)
        self._pairs = {(min(pair), max(pair)): i for i, pair in enumerate(pairs)}
        self._springs = frozenset(compiled.springs)
        self._names = geom_names(model)
        self._names += ["|".join(sorted(self._names[g] for g in pair)) for pair in self._pairs]
        # A column for every geom, then one for every pair.
        self._rates = np.zeros(model.ngeom + model.npair)
        self._start = np.zeros(model.ngeom + model.npair)
        self._margins = np.zeros((nworld, model.ngeom + model.npair))
        self._marked = np.zeros((nworld, model.ngeom), np.bool_)
        self._roots = model.body_rootid[model.geom_bodyid]
        self._moves = model.body_weldid[model.geom_bodyid] != 0
        self._speed_limit = RecoverySpeedLimit(model, self._speed)
        self._scratch = mujoco.MjData(model)  # to make one takes longer than all that it is for
        self.any = False

    def begin(self, batch: Batch) -> None:
        """Find what overlaps in the initial state, the same in all worlds."""
        self._start = self._depths(batch.state[0])
        self._margins[:] = self._start
        self._show(batch)

    def transfer(self, batch: Batch, old: Overlaps) -> None:
        """Continue after a change of the model, and find new overlaps."""
        was = {name: column for column, name in enumerate(old._names)}
        known = np.array([name in was for name in self._names], np.bool_)
        before = [was[name] for name in self._names if name in was]
        self._margins[:] = self._find(batch)
        self._margins[:, known] = old._margins[:, before]
        self._rates[known] = np.maximum(self._rates[known], old._rates[before])
        self._show(batch)

    def clear(self, batch: Batch) -> None:
        """Discard overlaps that ended because a body was placed elsewhere."""
        np.maximum(self._margins, self._find(batch), out=self._margins)
        self._show(batch)

    def drop(self, batch: Batch, placed: Mapping[int, NDArray[np.bool_]]) -> None:
        """Start the recovery of free bodies that were placed into others.

        Args:
            batch: The worlds.
            placed: MuJoCo's bodies that were, and in which worlds.
        """
        worlds = np.flatnonzero(np.logical_or.reduce(list(placed.values())))
        deep = worlds[self._deepest(batch, worlds) < -self._shallow]
        for world in deep.tolist():
            bodies = {body for body, where in placed.items() if where[world]}
            depths = self._depths(batch.state[world], bodies)
            np.minimum(self._margins[world], depths, out=self._margins[world])
        if deep.size:
            self._show(batch)

    def _deepest(self, batch: Batch, worlds: Worlds) -> Floats:
        """Return the least distance of any contact in worlds [m]."""
        column = int(self._model.sensor(DEEPEST).adr[0])
        found = batch.bind("sensordata")
        flags = batch.expand("opt.disableflags")
        state = batch.state[worlds]
        flags &= ~SENSORS_OFF
        try:
            batch.forward(worlds, stage=_POSITION_STAGE)
        finally:
            flags |= SENSORS_OFF
            batch.state[worlds] = state
        least: Floats = found[worlds, column]
        return least

    def _find(self, batch: Batch) -> Floats:
        """Return margins at which nothing is too deep now, shape (nworld or 1, geoms + pairs)."""
        alike = bool((batch.state == batch.state[0]).all())
        return np.stack([self._depths(state) for state in batch.state[: 1 if alike else None]])

    def reset(self, batch: Batch, worlds: Worlds | None) -> None:
        """Restore the margins of the initial state."""
        if self.any or self._start.any():
            self._margins[slice(None) if worlds is None else worlds] = self._start
            self._marked[slice(None) if worlds is None else worlds] = False
            self._show(batch)

    def rise(self, batch: Batch, step: float) -> int:
        """Advance penetration recovery in the worlds whose turn it is.

        Args:
            batch: The worlds.
            step: Physics step [s].

        Returns:
            How many steps may be made until the next turn of some world.
        """
        done = np.rint(batch.state[:, 0] / step).astype(np.int64) % _PIECE
        due = np.flatnonzero(done == 0)
        if due.size:
            raised = self._margins[due] + self._rates * (step * _PIECE)
            self._margins[due] = np.minimum(raised, 0.0)
            self._mark(batch, due)
            self._show(batch)
        return int(_PIECE - done.max())

    def advance_bounded(
        self, state: StateViews, count: int, advance: Callable[[int], set[int]]
    ) -> set[int]:
        """Advance so that recovering bodies gain no energy; returns the worlds that failed."""
        if not (self.any and self._speed_limit.concerns(self._marked)):
            return advance(count)
        failed: set[int] = set()
        for _ in range(count):
            before = self._speed_limit.before(state)
            failed |= advance(1)
            self._speed_limit.after(state, self._marked, before)
        return failed

    def _mark(self, batch: Batch, worlds: Worlds) -> None:
        """Mark all pieces of recovering bodies, until none of them is deep in anything."""
        ngeom = self._model.ngeom
        margins = self._margins[worlds]
        rising = margins < _MARK
        margins[~rising] = 0.0
        waiting = worlds[self._marked[worlds].any(axis=1) & ~rising.any(axis=1)]
        if waiting.size:
            out = waiting[self._deepest(batch, waiting) >= -self._shallow]
            self._marked[out] = False
        np.minimum(margins[:, :ngeom], self._marked[worlds] * _MARK, out=margins[:, :ngeom])
        self._margins[worlds] = margins

    def _pieces(self) -> None:
        """Update which pieces belong to recovering bodies."""
        ngeom = self._model.ngeom
        self._marked |= self._margins[:, :ngeom] < 0.0
        for world, geom in np.argwhere(self._margins[:, :ngeom] < _MARK).tolist():
            self._marked[world] |= (self._roots == self._roots[geom]) & self._moves

    @property
    def size(self) -> int:
        """Number of entries in ``saved`` of a world while something overlaps."""
        return 2 * len(self._rates)

    def saved(self) -> Floats:
        """Return all that ``take`` needs, shape (nworld, n); n is 0 while nothing overlaps."""
        if not self.any:
            return np.zeros((len(self._margins), 0))
        return np.hstack((self._margins, np.tile(self._rates, (len(self._margins), 1))))

    def take(self, batch: Batch, saved: Floats) -> None:
        """Restore what ``saved`` returned."""
        self._marked[:] = False
        if saved.shape[1]:
            margins, rates = np.split(saved, 2, axis=1)
            self._margins[:], self._rates[:] = margins, rates[0]
        else:
            self._margins[:] = 0.0
        self._show(batch)

    def _show(self, batch: Batch) -> None:
        self._pieces()
        was, self.any = self.any, bool(self._margins.any())
        if was or self.any:
            ngeom = self._model.ngeom
            batch.expand("geom_margin")[:] = _shown(self._margins[:, :ngeom], TOUCHING, TOUCHING)
            if self._pairs:
                pairs = _shown(self._margins[:, ngeom:], 2.0 * TOUCHING, 0.0)
                batch.expand("pair_margin")[:] = pairs

    def _depths(self, state: Floats, placed: AbstractSet[int] | None = None) -> Floats:
        """Return margins at which nothing of a state is too deep, shape (geoms + pairs,).

        Args:
            state: Of a world.
            placed: The roots of the bodies that matter; None for all.
        """
        model, margins = self._model, np.zeros_like(self._rates)
        if not model.nv:
            return margins
        data = self._scratch
        mujoco.mj_resetData(model, data)
        mujoco.mj_setState(model, data, state, _STATE)
        mujoco.mj_fwdPosition(model, data)
        ends: NDArray[np.int32] = data.contact.geom.reshape(-1, 2)
        for (one, two), distance in zip(ends.tolist(), data.contact.dist.tolist(), strict=True):
            if -distance <= max(self._allowed[one], self._allowed[two]):
                continue
            root = int(self._roots[two])
            if placed is not None and placed.isdisjoint((int(self._roots[one]), root)):
                continue
            turned = placed is not None and root not in placed
            column = self._column(two, one) if turned else self._column(one, two)
            if column - model.ngeom in self._springs:
                continue
            margins[column] = min(margins[column], distance)
            self._rates[column] = min(self._speed[one], self._speed[two])
        return margins

    def _column(self, one: int, two: int) -> int:
        """Return the column of a contact between two geoms: of the pair, or of the moving one."""
        pair = self._pairs.get((min(one, two), max(one, two)))
        if pair is not None:
            return int(self._model.ngeom) + pair
        return two if self._moves[two] else one


def _shown(margins: Floats, usual: float, other: float) -> Floats:
    """Return the margins for MuJoCo, which adds that of the ``other`` geom; ``usual`` elsewhere."""
    return np.where(margins < 0.0, margins - other, usual)


def _contacts_of(compiled: Compiled) -> Iterator[tuple[int, Contact]]:
    """Yield every geom of the description with its terms of contact."""
    ids = geom_ids(compiled.model)
    for parts in compiled.bodies.values():
        for body in parts:
            for collision in body.link.collisions:
                for name in compiled.geoms.get(f"{body.name}::{collision.name}", ()):
                    yield ids[name], collision.surface.contact


# How many times faster than ``max_vel`` a body may leave.
_FASTER = 2.0


class RecoverySpeedLimit:
    """Bounds the speeds of free bodies under penetration recovery.

    The speed of a body is that of its frame and what its spin is worth in energy.

    Args:
        model: Running model.
        speed: At which each geom leaves what it overlaps [m/s].
    """

    def __init__(self, model: mujoco.MjModel, speed: Floats) -> None:
        free = int(mujoco.mjtJoint.mjJNT_FREE)
        joints = np.flatnonzero(model.jnt_type == free)
        bodies = model.jnt_bodyid[joints]
        mass = np.maximum(model.body_subtreemass[bodies], 1e-12)
        self._dofs = model.jnt_dofadr[joints][:, None] + np.arange(6)
        self._heights = model.jnt_qposadr[joints][:, None] + np.arange(3)
        self._gyration = model.body_inertia[bodies].sum(axis=1) / (2.0 * mass)
        self._gravity: Floats = model.opt.gravity.copy()
        place = np.full(model.nbody, -1)
        place[bodies] = np.arange(len(bodies))
        self._place = place[model.body_rootid[model.geom_bodyid]]
        own = np.flatnonzero(
            (model.jnt_type != free) & (place[model.body_rootid[model.jnt_bodyid]] >= 0)
        )
        self._driven = place[model.body_rootid[model.jnt_bodyid[own]]]
        self._dof = model.jnt_dofadr[own]
        self._reach = np.array([_reach(model, joint) for joint in own.tolist()])
        self._most = np.zeros(len(bodies))
        np.maximum.at(self._most, self._place[self._place >= 0], speed[self._place >= 0])

    def concerns(self, marked: NDArray[np.bool_]) -> bool:
        """Return whether any free body is under penetration recovery."""
        return bool((marked.any(axis=0) & (self._place >= 0)).any())

    def before(self, state: StateViews) -> tuple[Floats, Floats]:
        """Return positions and velocities, for ``after``."""
        return state.qpos.copy(), state.qvel.copy()

    def after(
        self, state: StateViews, marked: NDArray[np.bool_], before: tuple[Floats, Floats]
    ) -> None:
        """Limit velocities that have become too fast since.

        Args:
            state: Of all worlds.
            marked: Mask of geoms under penetration recovery, shape (nworld, geoms).
            before: Result of ``before``.
        """
        worlds, geoms = np.nonzero(marked)
        bodies = self._place[geoms]
        worlds, bodies = worlds[bodies >= 0], bodies[bodies >= 0]
        if not len(worlds):
            return
        worlds, bodies = np.unique(np.stack((worlds, bodies)), axis=1)
        rows, dofs, places = worlds[:, None], self._dofs[bodies], self._heights[bodies]
        fallen = (state.qpos[rows, places] - before[0][rows, places]) @ self._gravity
        least = np.square(np.maximum(_FASTER * self._most, self._of_joints(state))[worlds, bodies])
        allowed = np.maximum(self._square(before[1][rows, dofs], bodies), least)
        allowed += 2.0 * np.maximum(fallen, 0.0)
        square = self._square(state.qvel[rows, dofs], bodies)
        share = np.sqrt(allowed / np.maximum(square, allowed))
        state.qvel[rows, dofs] *= share[:, None]

    def _of_joints(self, state: StateViews) -> Floats:
        """Return the greatest speed at which joints move parts of each body [m/s], by world."""
        found = np.zeros((len(state.qvel), len(self._most)))
        speed = np.abs(state.qvel[:, self._dof]) * self._reach
        np.maximum.at(found.T, self._driven, speed.T)
        return found

    def _square(self, velocity: Floats, bodies: NDArray[np.intp]) -> Floats:
        """Return twice the energy over the mass [m²/s²]."""
        linear, angular = np.square(velocity[:, :3]), np.square(velocity[:, 3:])
        found: Floats = linear.sum(axis=1) + self._gyration[bodies] * angular.sum(axis=1)
        return found


def _reach(model: mujoco.MjModel, joint: int) -> float:
    """Return how far a joint moves its link's farthest point at 1 rad/s, or 1 m/s [m]."""
    if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_SLIDE:
        return 1.0
    geoms = np.flatnonzero(model.geom_bodyid == model.jnt_bodyid[joint])
    apart = np.linalg.norm(model.geom_pos[geoms] - model.jnt_pos[joint], axis=1)
    return float((apart + model.geom_rbound[geoms]).max(initial=0.0))
