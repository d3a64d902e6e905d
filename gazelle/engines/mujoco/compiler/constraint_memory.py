"""Memory for contacts and constraints, enough for shapes that have many."""

from __future__ import annotations

import mujoco
import numpy as np

_FOR_SHAPE = 32 * 1024
"""Bytes for each shape that may collide and moves.

Four contacts of 600 bytes, and three rows of ten numbers for each, are a third of it.
"""


def with_memory(spec: mujoco.MjSpec, compiled: mujoco.MjModel) -> mujoco.MjModel:
    """Return a model with memory for the constraints of all its shapes.

    MuJoCo reckons by degrees of freedom, and leaves out contacts where that is too little: a wheel
    that is a mesh of 900 convex pieces has thousands. Memory that is not used costs nothing.

    Args:
        spec: Specification; its size of memory is set.
        compiled: Model compiled from it.
    """
    moving = compiled.body_weldid[compiled.geom_bodyid] != 0
    colliding = (compiled.geom_contype | compiled.geom_conaffinity) != 0
    required = _FOR_SHAPE * int(np.count_nonzero(moving & colliding))
    if compiled.narena >= required:
        return compiled
    spec.memory = required
    return spec.compile()
