"""Wrong values, of the right types, by what an annotation says.

Parameters are known by their annotations, so new ones are tried as soon as they are there.
"""

from __future__ import annotations

import contextlib
import enum
import math
import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from gazelle import Error
from gazelle.description import Pose

LONG = 10_000
"""Of a text or a list."""
MEMORY = 64 * 2**30

FLOATS: list[Any] = [
    math.nan,
    math.inf,
    -math.inf,
    -1.0,
    0.0,
    1e308,
    -1e308,
    1e-320,
    10**400,
    np.float64("nan"),
]
INTS: list[Any] = [-1, 0, -(2**31), 2**31, 2**63, 10**30, 10**400, np.int64(-1)]
TEXTS: list[Any] = [
    "",
    " ",
    "no such",
    "a::b",
    "::",
    "/",
    "//",
    "../..",
    "\x00",
    "\ud800",
    "a" * LONG,
    "é\u2028",
    "1",
]
PATHS: list[Any] = [
    "",
    "no/such/file",
    "/",
    "/dev/null/a",
    "a" * 300,
    "a" * LONG,
    "\x00",
    "\ud800",
    "~nobody/a",
    ".",
]
ARRAYS: list[Any] = [
    *(
        [],
        [[]],
        [[[]]],
        [math.nan],
        [math.inf],
        [0.0],
        [1.0] * 3,
        [1.0] * 4,
        [1.0] * LONG,
        math.nan,
        math.inf,
    ),
    *(
        1e308,
        [1e308] * 3,
        [math.nan] * 3,
        [0.0] * 4,
        [[1.0, 2.0, 3.0]] * 7,
        [[0.0], [1.0, 2.0]],
        -1.0,
        0.0,
    ),
    *(
        np.zeros((0, 3)),
        np.full((2, 3), math.nan),
        np.zeros((2, 2, 2, 2)),
        np.zeros(3, complex),
        [10**400],
    ),
]
NO_FLOATS = (16, 22, 23)
"""Places of ``ARRAYS`` that are no arrays of floats."""
ROWS: list[Any] = [
    *([], [math.nan], [math.inf], [0.0], [-1.0], [1.0] * 3, [1.0] * 4, [1.0] * LONG, [1e308] * 3),
    *([math.nan] * 3, [10**400], [10**400] * 3),
]
WORLDS: list[Any] = [
    [-1],
    [99],
    [],
    [0, 0],
    [2**70],
    [math.nan],
    [[0]],
    [True],
    np.array([-1]),
    [0] * LONG,
]
VECTORS: list[Any] = [
    (math.nan, 0.0, 0.0),
    (math.inf, 0.0, 0.0),
    (1e308,) * 3,
    (0.0,) * 3,
    (1.0, 2.0),
    (),
    (1.0,) * 4,
]
POINTS: list[Any] = [
    *([], [()], [(math.nan, 0.0)], [(0.0, math.inf)], [(1e308, -1e308)], [(0.0,)], [(0.0,) * 3]),
    *([[0.0, 0.0], [0.0]], [(10**400, 0)], [(0.0, 0.0)] * 2, [[[0.0, 0.0]]]),
]
POSES: list[Any] = [
    *(Pose(math.nan), Pose(yaw=math.nan), Pose(0.0, -math.inf), Pose(1e308, 1e308)),
    *(Pose(pitch=1e308), Pose.exactly((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0))),
]
LISTS: list[Any] = [[], [""], ["no such"], ["no such", "no such"], ["a" * LONG], ["a"] * LONG]
MAPPINGS: list[Any] = [
    {},
    {"no such": 1},
    {"": math.nan},
    {"type": "no such"},
    {"a": {"b": {"c": math.inf}}},
]
DATA: list[Any] = [b"", b"\x00", b"PK\x03\x04", b"a" * LONG, b"\xff" * 100]

BROKEN = 24
"""Wrong values at most of a parameter that takes a dataclass."""

BY_WORD: list[tuple[str, list[Any]]] = [
    (r"\bWorlds\b", WORLDS),
    (r"\bMapping\[str, str\]", [{}, {"": ""}, {"no such": "::"}, {"a": "a" * LONG}, {"\x00": "a"}]),
    (r"\b(Mapping|dict)\[", MAPPINGS),
    (r"\bArrayLike\b", ARRAYS),
    (
        r"\bFloats\d*\b|\bNDArray\b|\bPicture\b",
        [np.asarray(each, float) for n, each in enumerate(ARRAYS) if n not in NO_FLOATS],
    ),
    (r"\bInts\d*\b|\bIndices\b", [np.asarray(each) for each in ([], [-1], [99], [[0]], [2**62])]),
    (r"\bBools\b", [np.asarray(each, bool) for each in ([], [True] * 99, [[True]], False)]),
    (r"\bVector3\b|\bVector\b", VECTORS),
    (
        r"(?<!\[)tuple\[float, float\]",
        [(math.nan, 0.0), (0.0, math.inf), (1e308, -1e308), (0.0, 0.0)],
    ),
    (r"(?<!\[)tuple\[int, int\]", [(-1, 5), (0, 0), (2**31, 2**31), (10**400, 1)]),
    (r"\b(Sequence|Iterable|list|tuple)\[Pose\b", [[each] for each in POSES]),
    (r"(^|\| )Pose\b", POSES),
    (r"\b(Sequence|Iterable|list|tuple)\[str", LISTS),
    (r"(?<!\[)\b(Sequence|Iterable|list|tuple)\[(int|float)", ROWS),
    (r"\b(Sequence|Iterable|list)\[tuple\[float, float\]", POINTS),
    (r"\b(Sequence|Iterable|list|tuple)\[", [[], ()]),
    (r"\bPath(Like)?\b", PATHS),
    (r"\bLiteral\[|\bstr\b", TEXTS),
    (r"\bbytes\b", DATA),
    (r"\bfloat\b|\bSeconds\b", FLOATS),
    (r"\bint\b", INTS),
]
"""Wrong values by what an annotation says; all that fit are tried."""


def wrong(annotation: str) -> list[Any]:
    """Return wrong values of a type."""
    plain = re.sub(r"Callable\[.*\]", "", annotation)
    if re.fullmatch(r"Path( \| None)?", plain):
        return [Path(each) for each in PATHS]
    for word, values in BY_WORD:
        if re.search(word, plain):
            return values + (FLOATS if values is VECTORS else [])
    return []


def shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) < 60 else f"{text[:40]}...({type(value).__name__})"


def broken_parts(root: Any, path: str = "", depth: int = 9) -> Iterator[tuple[str, Any]]:
    """Yield copies of a description, each with one wrong value somewhere in it."""
    if depth and is_dataclass(root):
        for each in fields(root):
            if not each.init or each.name == "source":
                continue
            value = getattr(root, each.name)
            for value_path, other in _replaced(value, str(each.type), f"{path}.{each.name}", depth):
                with contextlib.suppress(Error):
                    yield value_path, replace(root, **{each.name: other})


def _replaced(value: Any, annotation: str, path: str, depth: int) -> Iterator[tuple[str, Any]]:
    if is_dataclass(value) and not isinstance(value, type):
        yield from broken_parts(value, path, depth - 1)
    elif isinstance(value, tuple) and value and any(map(is_dataclass, value)):
        yield f"{path} twice", value + value[:1]
        for place, each in enumerate(value):
            for inner, other in broken_parts(each, f"{path}[{place}]", depth - 1):
                yield inner, (*value[:place], other, *value[place + 1 :])
    elif not isinstance(value, enum.Enum):
        for other in wrong(annotation):
            yield f"{path}={shown(other)}", other


def wrong_parts(sample: Any) -> list[Any]:
    """Return copies of a dataclass that are wrong somewhere."""
    if not is_dataclass(sample) or isinstance(sample, type):
        return []
    found = [value for _, value in broken_parts(sample, depth=2)]
    return found[:: max(1, len(found) // BROKEN)]
