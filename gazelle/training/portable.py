"""Nested values to JSON plus arrays and back, without pickle.

A checkpoint may come from anywhere, and unpickling a file runs what is in it.
So every state is split into plain JSON and plain arrays (`numpy.load` with
``allow_pickle=False``), which can hold data only.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from gazelle.bounded_npz import BROKEN, open_npz
from gazelle.errors import FormatError
from gazelle.training.limits import MAX_BYTES

Arrays = dict[str, npt.NDArray[Any]]

_ARRAY, _BYTES, _TUPLE, _SCALAR = "__array__", "__bytes__", "__tuple__", "__scalar__"


def pack(value: Any) -> tuple[Any, Arrays]:
    """Split a value into a JSON tree and the arrays it refers to.

    Args:
        value: Nested dicts (with text keys), lists, tuples, numbers, text,
            None, bytes, numpy scalars and arrays without Python objects.

    Returns:
        The tree, and the arrays by name.

    Raises:
        FormatError: Something in the value is of another type.
    """
    arrays: Arrays = {}
    return _pack(value, arrays, "state"), arrays


def unpack(tree: Any, arrays: Arrays) -> Any:
    """Join what `pack` split."""
    if isinstance(tree, list):
        return [unpack(item, arrays) for item in tree]
    if not isinstance(tree, dict):
        return tree
    if _ARRAY in tree:
        return arrays[tree[_ARRAY]]
    if _SCALAR in tree:
        return arrays[tree[_SCALAR]][()]
    if _BYTES in tree:
        return arrays[tree[_BYTES]].tobytes()
    if _TUPLE in tree:
        return tuple(unpack(item, arrays) for item in tree[_TUPLE])
    return {key: unpack(item, arrays) for key, item in tree.items()}


def save(path: Path, value: Any) -> None:
    """Write a value as ``PATH.json`` and ``PATH.npz``.

    Raises:
        FormatError: Something in the value is of a type that `pack` does not know.
        OSError: The files cannot be written.
    """
    tree, arrays = pack(value)
    np.savez(path.with_suffix(".npz"), allow_pickle=False, **arrays)
    path.with_suffix(".json").write_text(json.dumps(tree, indent=1), encoding="utf-8")


def load(path: Path) -> Any:
    """Read what `save` wrote.

    Raises:
        FormatError: The files cannot be read, are damaged, or hold Python objects.
    """
    try:
        tree = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
        with open_npz(path.with_suffix(".npz"), MAX_BYTES) as file:
            arrays = {name: file[name] for name in file.files}
        return unpack(tree, arrays)
    except BROKEN as error:
        raise FormatError(
            f"not a readable state: {error}",
            file=str(path),
            hint="the file is damaged, or was not written by Gazelle",
        ) from error


def _pack(value: Any, arrays: Arrays, name: str) -> Any:
    if value is None or isinstance(value, bool | int | float | str):
        return value.item() if isinstance(value, np.generic) else value
    if isinstance(value, dict):
        return {
            _key(key, name): _pack(item, arrays, f"{name}.{key}") for key, item in value.items()
        }
    if isinstance(value, list):
        return [_pack(item, arrays, f"{name}.{i}") for i, item in enumerate(value)]
    if isinstance(value, tuple):
        return {_TUPLE: [_pack(item, arrays, f"{name}.{i}") for i, item in enumerate(value)]}
    if isinstance(value, bytes | bytearray | memoryview):
        arrays[name] = np.frombuffer(bytes(value), dtype=np.uint8)
        return {_BYTES: name}
    if isinstance(value, np.ndarray) and not value.dtype.hasobject:
        arrays[name] = value
        return {_ARRAY: name}
    if isinstance(value, np.generic):
        arrays[name] = np.asarray(value)
        return {_SCALAR: name}
    raise FormatError(
        f"cannot store {name}: it is a {type(value).__name__}",
        hint="use numbers, text, bytes, lists, dicts and numpy arrays",
    )


def _key(key: Any, name: str) -> str:
    if not isinstance(key, str):
        raise FormatError(f"cannot store {name}: the key {key!r} is not text")
    return key
