"""Memory for contacts and constraints, enough for shapes that have many."""

from __future__ import annotations

import ctypes

import mujoco
import numpy as np

from gazelle.engines.mujoco.contact_laws.struct_layout import memory_offset
from gazelle.engines.mujoco.library import address_of_struct

_FOR_SHAPE = 32 * 1024
"""Bytes for each shape that may collide and moves.

Four contacts of 600 bytes, and three rows of ten numbers for each, are a third of it.
"""

_LARGE, _MOST = 10_000, 4 << 30
"""Coordinates of motion for which MuJoCo would reserve more than this number of bytes.

It reserves by their square, for 24,000 of them 23 GB, which systems refuse.
"""


def compile_with_memory(spec: mujoco.MjSpec, coordinates: int) -> mujoco.MjModel:
    """Return a compiled model with memory for the constraints of all its shapes.

    MuJoCo reckons by degrees of freedom, and leaves out contacts where that is too little: a wheel
    that is a mesh of 900 convex pieces has thousands. Memory that is not used costs nothing.

    Args:
        spec: Specification; its size of memory is set where MuJoCo's is too little. The size is
            written to the model too, as compiling again would take as long as the first time.
        coordinates: Number of coordinates of motion.
    """
    if coordinates > _LARGE:
        spec.memory = _MOST
    compiled = spec.compile()
    moving = compiled.body_weldid[compiled.geom_bodyid] != 0
    colliding = (compiled.geom_contype | compiled.geom_conaffinity) != 0
    required = _FOR_SHAPE * int(np.count_nonzero(moving & colliding))
    if compiled.narena < required:
        spec.memory = required
        place = address_of_struct(compiled) + memory_offset()
        ctypes.c_int64.from_address(place).value = required
    return compiled
