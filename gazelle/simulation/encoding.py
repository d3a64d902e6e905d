"""Descriptions and arrays as JSON, and back, without running any code of the file.

Only dataclasses of ``gazelle.description``, poses, paths and arrays can come back, and the classes
of modules that entry points of the group ``gazelle.descriptions`` name: those list them in ``__all__``.
"""

from __future__ import annotations

import base64
import dataclasses
import functools
from collections.abc import Callable, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from gazelle import description
from gazelle.description import Pose
from gazelle.engines import Call
from gazelle.errors import SimulationError
from gazelle_ros.base.entry_points import entry_points_of, load

_GROUP = "gazelle.descriptions"


def _classes_of(module: ModuleType) -> dict[str, type[Any]]:
    """Return the dataclasses and named tuples that a module lists, by name."""
    listed = {name: getattr(module, name) for name in module.__all__}
    return {
        name: each
        for name, each in listed.items()
        if isinstance(each, type) and (dataclasses.is_dataclass(each) or hasattr(each, "_fields"))
    }


_OWN = _classes_of(description)


@functools.cache
def _others() -> dict[str, type[Any]]:
    found: dict[str, type[Any]] = {}
    for name, point in entry_points_of(_GROUP).items():
        found |= _classes_of(load(point, f"the description '{name}'", SimulationError))
    return found


def _class_of(name: str | None) -> type[Any] | None:
    """Return the class of a name; other packages are looked at for unknown ones only."""
    return (_OWN.get(name) or _others().get(name)) if name else None


def encode(value: Any) -> Any:
    """Convert a value to what JSON can hold.

    Raises:
        SimulationError: It holds something that cannot be written.
    """
    for kinds, writer in _WRITERS:
        if isinstance(value, kinds):
            return writer(value)
    if dataclasses.is_dataclass(value) and _class_of(type(value).__name__) is type(value):
        fields = dataclasses.fields(value)
        return {
            "#": type(value).__name__,
            **{each.name: encode(getattr(value, each.name)) for each in fields},
        }
    raise SimulationError(f"a {type(value).__name__} cannot be recorded")


def _name_of(value: tuple[Any, ...]) -> str:
    kind = type(value)
    return kind.__name__ if hasattr(kind, "_fields") and _class_of(kind.__name__) else "tuple"


def _write_array(value: Any) -> dict[str, Any]:
    data = base64.b64encode(np.ascontiguousarray(value).tobytes()).decode()
    return {"#": "array", "type": value.dtype.str, "shape": value.shape, "data": data}


_WRITERS: tuple[tuple[Any, Callable[[Any], Any]], ...] = (
    ((type(None), bool, int, float, str), lambda v: v),
    (np.ndarray, _write_array),
    (np.generic, lambda v: v.item()),
    (Pose, lambda v: {"#": "pose", "position": v.position, "quaternion": v.quaternion}),
    (Path, lambda v: {"#": "path", "path": str(v)}),
    (Call, lambda v: {"#": "call", "method": v.method, "arguments": encode(v.arguments)}),
    (tuple, lambda v: {"#": _name_of(v), "items": [encode(each) for each in v]}),
    (list, lambda v: [encode(each) for each in v]),
    (Mapping, lambda v: {"#": "map", "items": [[encode(k), encode(x)] for k, x in v.items()]}),
)


def decode(value: Any) -> Any:
    """Decode a value that ``encode`` returned.

    Raises:
        SimulationError: It is nothing that ``encode`` gives.
    """
    if isinstance(value, list):
        return [decode(each) for each in value]
    if not isinstance(value, dict):
        return value
    kind = value.get("#")
    if kind in _READERS:
        return _READERS[kind](value)
    found = _class_of(kind)
    if found is not None and issubclass(found, tuple):
        return found(*(decode(each) for each in value["items"]))
    if found is not None:
        return found(**{k: decode(v) for k, v in value.items() if k != "#"})
    raise SimulationError(f"there is no kind of value '{kind}'")


def _array(value: dict[str, Any]) -> Any:
    kind = np.dtype(value["type"])
    if kind.hasobject:
        raise SimulationError("an array of objects cannot be read")
    flat = np.frombuffer(base64.b64decode(value["data"]), dtype=kind)
    return flat.reshape(value["shape"]).copy()


def _pose(value: dict[str, Any]) -> Pose:
    # Not ``from_quaternion``: normalising again could change the last bit.
    return Pose.exactly(Pose(*value["position"]).position, tuple(value["quaternion"]))


_READERS: dict[str, Callable[[dict[str, Any]], Any]] = {
    "array": _array,
    "call": lambda v: Call(v["method"], decode(v["arguments"])),
    "map": lambda v: {decode(key): decode(each) for key, each in v["items"]},
    "path": lambda v: Path(v["path"]),
    "pose": _pose,
    "tuple": lambda v: tuple(decode(each) for each in v["items"]),
}
