"""What is let out of an overlap gains no energy from it.

The contacts of what overlaps each want to part at ``max_vel``. Where they face each other there
is a motion that lets all of them part, but it is fast: out of a wedge of the half angle a at
``max_vel`` / sin(a), and about two points that are d apart with ``max_vel`` / d. Where there is
none, as between rings that are linked, contacts throw what they hold. So as long as a loose body
is being let out, its speed grows beyond twice ``max_vel`` by no more than gravity's work.
"""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.engines.mujoco.views import StateViews

# How many times faster than ``max_vel`` a body may leave.
_FASTER = 2.0


class Calming:
    """Bounds the speeds of loose bodies that are let out.

    The speed of a body is that of its frame and what its spin is worth in energy.

    Args:
        model: What runs.
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
        self._most = np.zeros(len(bodies))
        np.maximum.at(self._most, self._place[self._place >= 0], speed[self._place >= 0])

    def concerns(self, marked: NDArray[np.bool_]) -> bool:
        """Whether any loose body is let out."""
        return bool((marked.any(axis=0) & (self._place >= 0)).any())

    def before(self, state: StateViews) -> tuple[Floats, Floats]:
        """Positions and velocities, to be given to ``after``."""
        return state.qpos.copy(), state.qvel.copy()

    def after(
        self, state: StateViews, marked: NDArray[np.bool_], before: tuple[Floats, Floats]
    ) -> None:
        """Slow down what has become too fast since.

        Args:
            state: Of all worlds.
            marked: Which geoms are let out, shape (nworld, geoms).
            before: What ``before`` gave.
        """
        worlds, geoms = np.nonzero(marked)
        bodies = self._place[geoms]
        worlds, bodies = worlds[bodies >= 0], bodies[bodies >= 0]
        if not len(worlds):
            return
        worlds, bodies = np.unique(np.stack((worlds, bodies)), axis=1)
        rows, dofs, places = worlds[:, None], self._dofs[bodies], self._heights[bodies]
        fallen = (state.qpos[rows, places] - before[0][rows, places]) @ self._gravity
        least = np.square(_FASTER * self._most[bodies])
        allowed = np.maximum(self._square(before[1][rows, dofs], bodies), least)
        allowed += 2.0 * np.maximum(fallen, 0.0)
        square = self._square(state.qvel[rows, dofs], bodies)
        share = np.sqrt(allowed / np.maximum(square, allowed))
        state.qvel[rows, dofs] *= share[:, None]

    def _square(self, velocity: Floats, bodies: NDArray[np.intp]) -> Floats:
        """Twice the energy over the mass [m²/s²]."""
        linear, angular = np.square(velocity[:, :3]), np.square(velocity[:, 3:])
        found: Floats = linear.sum(axis=1) + self._gyration[bodies] * angular.sum(axis=1)
        return found
