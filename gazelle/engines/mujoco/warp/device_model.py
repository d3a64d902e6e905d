"""A compiled model on the device, with what worlds have of their own.

MuJoCo Warp keeps many fields of a model for each world, and the others once. A field of the others
can change, but not differ between worlds: that is refused, never left out.
"""

from __future__ import annotations

import copy
import dataclasses
from collections.abc import Mapping
from functools import cache
from typing import Any

import mujoco
import mujoco_warp
import numpy as np
import warp as wp

from gazelle.array_types import Floats
from gazelle.errors import EngineError

_LEAVE = "gazelle.Simulation(..., engine='mujoco') has it"

# What Warp looks for in none of the worlds where the shared model has none: there it has the most of all.
_BY_PRESENCE = ("body_gravcomp", "dof_damping", "dof_frictionloss", "jnt_limited")

# What only sleeping is judged by.
_UNUSED = frozenset({"dof_length"})


@cache
def _fields() -> Mapping[str, bool]:
    """Return the fields of MuJoCo Warp's model, and whether each has values per world."""
    found = {}
    for prefix, kind in (("", mujoco_warp.Model), ("opt.", mujoco_warp.Option)):
        for field in dataclasses.fields(kind):
            shape: Any = getattr(field.type, "shape", ())
            found[prefix + field.name] = bool(shape) and shape[0] == "*"
    return found


def _is_read(name: str) -> bool:
    """Return whether steps on the device depend on a field of the model."""
    return name in _BY_PRESENCE or (name in _fields() and name not in _UNUSED)


def put_model(host: mujoco.MjModel, own: Mapping[str, Floats]) -> Any:
    """Return a model on the device.

    Args:
        host: As compiled.
        own: Fields that differ from it, by name, shape (nworld, ...).

    Raises:
        EngineError: MuJoCo Warp does not know what the model needs, or a field cannot differ
            between worlds.
    """
    shared = copy.copy(host)
    for name, values in own.items():
        if _is_read(name):
            _write(shared, name, _common(host, name, values))
    try:
        model = mujoco_warp.put_model(shared)
    except (NotImplementedError, ValueError) as error:
        raise EngineError(
            f"the engine 'mujoco-warp' cannot simulate this world: {error}", hint=_LEAVE
        ) from error
    model.opt.warn_overflow = 0  # what overflows is enlarged
    for name, values in own.items():
        if _fields().get(name, False):
            share_field(model, name, values)
    return model


def share_field(model: Any, name: str, values: Floats) -> None:
    """Set the values of a field in each world, shape (nworld, ...)."""
    if name not in _fields():
        return
    holder, _, attribute = name.rpartition(".")
    target = model.opt if holder else model
    old = getattr(target, attribute)
    setattr(target, attribute, wp.array(np.ascontiguousarray(values), dtype=old.dtype))


def can_share(name: str) -> bool:
    """Return whether a field can be changed on the device without making the model again."""
    return not _is_read(name) or (_fields().get(name, False) and name not in _BY_PRESENCE)


def _common(host: mujoco.MjModel, name: str, values: Floats) -> Floats:
    """Return the common values of a field, shape (...).

    Raises:
        EngineError: Worlds differ, and there are no such values.
    """
    if name in _BY_PRESENCE:
        most: Floats = values.max(axis=0)
        return most
    first: Floats = values[0]
    if _fields().get(name, False) or (values == first).all():
        return first
    if name == "geom_priority":
        ranks = np.stack([np.unique(row, return_inverse=True)[1] for row in values])
        if (ranks == ranks[0]).all():
            order: Floats = ranks[0].astype(first.dtype)
            return order
        raise EngineError(
            "worlds differ in which of two surfaces is the more slippery ('collision_friction'), which "
            "the engine 'mujoco-warp' cannot",
            hint=f"change all coefficients in proportion; {_LEAVE}",
        )
    changed = np.argwhere((values != first).any(axis=0))
    row = int(changed[0][0]) if changed.size and changed.shape[1] else 0
    raise EngineError(
        f"worlds differ in MuJoCo's '{name}' of {_element(host, name, row)}, which the engine "
        "'mujoco-warp' has once for all of them",
        hint=_LEAVE,
    )


def _element(host: mujoco.MjModel, name: str, row: int) -> str:
    """Describe the element that a row of a field belongs to, by its name in the model."""
    kinds = {"geom": host.geom, "body": host.body, "jnt": host.joint, "pair": host.pair}
    named = kinds.get(name.split("_", maxsplit=1)[0])
    return f"'{named(row).name}'" if named is not None else f"row {row}"


def _write(model: mujoco.MjModel, name: str, values: Floats) -> None:
    holder, _, attribute = name.rpartition(".")
    target = model.opt if holder else model
    if np.ndim(getattr(target, attribute)):
        getattr(target, attribute)[:] = values
    else:
        setattr(target, attribute, values.item())
