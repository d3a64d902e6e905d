"""Contacts of cylinders and planes in MuJoCo, replaced by ours (``plane_cylinder``).

It takes MuJoCo's place in the table of collision functions, for the whole process.
"""

from __future__ import annotations

import ctypes
import functools
import sys
from typing import Any

import mujoco
from mujoco.introspect import structs

from gazelle.engines.mujoco.contact_laws import plane_cylinder
from gazelle.engines.mujoco.contact_laws.struct_layout import offsets
from gazelle.engines.mujoco.contact_laws.struct_offsets import fill

# Numbers of a contact as MuJoCo's collision functions write it.
_FIELDS = ("dist", "pos", "normal", "tangent")


@functools.cache
def replace_plane_cylinder() -> Any:
    """Replace MuJoCo's contact function of cylinders and planes from now on.

    Returns:
        What keeps the function alive; None if this MuJoCo keeps its functions to itself, or
        describes contacts in another way, so that they remain its own.
    """
    described = structs.STRUCTS.get("mjPreContact")
    if described is not None and tuple(f.name for f in described.fields) != _FIELDS:
        return None
    kinds = int(mujoco.mjtGeom.mjNGEOMTYPES)
    try:
        library = ctypes.CDLL(sys.modules[mujoco.set_mjcb_time.__module__].__file__)
        table = (ctypes.c_void_p * (kinds * kinds)).in_dll(library, "mjCOLLISIONFUNC")
    except (OSError, ValueError):
        return None
    place = int(mujoco.mjtGeom.mjGEOM_PLANE) * kinds + int(mujoco.mjtGeom.mjGEOM_CYLINDER)
    function = _function()
    table[place] = ctypes.cast(function, ctypes.c_void_p).value
    return function


def _function() -> Any:
    """Return the compiled function, as C calls it."""
    fill(offsets())
    made = ctypes.CFUNCTYPE(
        ctypes.c_int, *[ctypes.c_size_t] * 3, *[ctypes.c_int] * 2, ctypes.c_double
    )
    return made(plane_cylinder.address() or plane_cylinder.plane_cylinder)
