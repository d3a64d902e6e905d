"""Descriptions and arrays as JSON, and back, without running any code of the file.

Only dataclasses of ``gazelle.description``, poses, paths and arrays can come back.
"""

from __future__ import annotations

import base64
import dataclasses
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from gazelle import description
from gazelle.description import Pose, StagePose, StageSize
from gazelle.engines import Call
from gazelle.errors import SimulationError

_KINDS: dict[str, Callable[..., Any]] = {
    name: kind
    for name in description.__all__
    if dataclasses.is_dataclass(kind := getattr(description, name)) and isinstance(kind, type)
}


def encode(value: Any) -> Any:
    """Convert a value to what JSON can hold.

    Raises:
        SimulationError: It holds something that cannot be written.
    """
    for kinds, writer in _WRITERS:
        if isinstance(value, kinds):
            return writer(value)
    if type(value).__name__ in _KINDS:
        fields = dataclasses.fields(value)
        return {
            "#": type(value).__name__,
            **{each.name: encode(getattr(value, each.name)) for each in fields},
        }
    raise SimulationError(f"a {type(value).__name__} cannot be recorded")


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
    ((StagePose, StageSize), lambda v: {"#": type(v).__name__, "items": list(v)}),
    (tuple, lambda v: {"#": "tuple", "items": [encode(each) for each in v]}),
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
    if kind in _KINDS:
        return _KINDS[kind](**{k: decode(v) for k, v in value.items() if k != "#"})
    raise SimulationError(f"there is no kind of value '{kind}'")


def _array(value: dict[str, Any]) -> Any:
    kind = np.dtype(value["type"])
    if kind.hasobject:
        raise SimulationError("an array of objects cannot be read")
    flat = np.frombuffer(base64.b64decode(value["data"]), dtype=kind)
    return flat.reshape(value["shape"]).copy()


def _pose(value: dict[str, Any]) -> Pose:
    # Not ``from_quaternion``: normalising again could change the last bit.
    return Pose.exactly(tuple(value["position"]), tuple(value["quaternion"]))


_READERS: dict[str, Callable[[dict[str, Any]], Any]] = {
    "array": _array,
    "call": lambda v: Call(v["method"], decode(v["arguments"])),
    "map": lambda v: {decode(key): decode(each) for key, each in v["items"]},
    "path": lambda v: Path(v["path"]),
    "pose": _pose,
    "StagePose": lambda v: StagePose(*v["items"]),
    "StageSize": lambda v: StageSize(*v["items"]),
    "tuple": lambda v: tuple(decode(each) for each in v["items"]),
}
