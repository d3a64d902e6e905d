"""Wrong values, of the right types, for everything that is public.

``python tests/wrong_values.py`` calls all of it, and prints what ends in another error than Gazelle's.
Parameters are known by their annotations, so new ones are tried as soon as they are there.
"""

from __future__ import annotations

import collections
import contextlib
import enum
import inspect
import math
import os
import re
import resource
import signal
import tempfile
import traceback
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from gazelle import Error

SECONDS = 20.0
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
LISTS: list[Any] = [[], [""], ["no such"], ["no such", "no such"], ["a" * LONG], ["a"] * LONG]
MAPPINGS: list[Any] = [
    {},
    {"no such": 1},
    {"": math.nan},
    {"type": "no such"},
    {"a": {"b": {"c": math.inf}}},
]
DATA: list[Any] = [b"", b"\x00", b"PK\x03\x04", b"a" * LONG, b"\xff" * 100]

BY_WORD: list[tuple[str, list[Any]]] = [
    (r"\bWorlds\b", WORLDS),
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
    (r"\b(Sequence|Iterable|list|tuple)\[str", LISTS),
    (r"(?<!\[)\b(Sequence|Iterable|list|tuple)\[(int|float)", ROWS),
    (r"\b(Sequence|Iterable|list|tuple)\[", [[], ()]),
    (r"\bPath(Like)?\b", PATHS),
    (r"\bLiteral\[|\bstr\b", TEXTS),
    (r"\bbytes\b", DATA),
    (r"\bfloat\b|\bSeconds\b", FLOATS),
    (r"\bint\b", INTS),
]
"""Wrong values by what an annotation says; all that fit are tried."""


class TookTooLongError(BaseException):
    """A call did not end in time."""


def wrong(annotation: str) -> list[Any]:
    """Return wrong values of a type."""
    plain = re.sub(r"Callable\[.*\]", "", annotation)
    for word, values in BY_WORD:
        if re.search(word, plain):
            return values + (FLOATS if values is VECTORS else [])
    return []


def annotation_of(parameter: inspect.Parameter) -> str:
    found = parameter.annotation
    if found is inspect.Parameter.empty:
        return ""
    return found if isinstance(found, str) else getattr(found, "__name__", str(found))


def calls(
    call: Callable[..., Any], good: Callable[[str, str], Any]
) -> Iterator[tuple[str, Any, list[Any], dict[str, Any]]]:
    """Yield parameters, wrong values, and arguments of which that one is wrong."""
    try:
        parameters = list(inspect.signature(call).parameters.values())
    except (TypeError, ValueError):
        return
    given = [
        (each, good(each.name, annotation_of(each)))
        for each in parameters
        if each.default is each.empty and each.kind not in (each.VAR_KEYWORD, each.VAR_POSITIONAL)
    ]
    for each in parameters:
        values = wrong(annotation_of(each))
        if each.kind is each.VAR_KEYWORD:
            yield each.name, "no such", *_arguments(given, None, None, {"no_such": 1})
            continue
        for value in values:
            yield each.name, value, *_arguments(given, each, value)


def _arguments(
    given: list[tuple[inspect.Parameter, Any]],
    wrong_one: inspect.Parameter | None,
    value: Any,
    more: Mapping[str, Any] | None = None,
) -> tuple[list[Any], dict[str, Any]]:
    positional: list[Any] = []
    named = dict(more or {})
    known = {each.name for each, _ in given}
    for each, sample in given:
        at = value if wrong_one is not None and each.name == wrong_one.name else sample
        if each.kind is each.KEYWORD_ONLY:
            named[each.name] = at
        else:
            positional.append(at)
    if wrong_one is not None and wrong_one.name not in known:
        if wrong_one.kind is wrong_one.VAR_POSITIONAL:
            positional.append(value)
        else:
            named[wrong_one.name] = value
    return positional, named


class Findings:
    """Counts of calls, and the errors of others that came."""

    def __init__(self) -> None:
        self.count = 0
        self.refused = 0
        self.foreign: dict[str, list[str]] = collections.defaultdict(list)
        self.late: list[str] = []

    def attempt(self, what: str, call: Callable[[], Any], documented: str = "") -> Any:
        """Make a call; return what it returns, None where it raises."""
        self.count += 1
        signal.setitimer(signal.ITIMER_REAL, SECONDS)
        try:
            return call()
        except Error:
            self.refused += 1
        except OSError as error:
            if "OSError" not in documented:
                self._add(what, error)
        except TookTooLongError:
            self.late.append(what)
            print("late", what, flush=True)
        except Exception as error:  # noqa: BLE001  # that is what is looked for
            self._add(what, error)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
        return None

    def _add(self, what: str, error: Exception) -> None:
        frames = traceback.extract_tb(error.__traceback__)
        ours = [each for each in frames if "/gazelle/" in each.filename]
        if ours and not ours[-1].filename.endswith("argument_checks.py"):
            # else the call itself did not fit
            last = ours[-1]
            place = f"{last.filename.rpartition('/gazelle/')[2]}:{last.lineno}"
            self.foreign[f"{type(error).__name__} in {place}"].append(f"{what}: {error!s:.150}")

    def show(self) -> None:
        for place, examples in sorted(self.foreign.items(), key=lambda pair: -len(pair[1])):
            print(f"{len(examples):>6}  {place}\n          " + "\n          ".join(examples[:3]))
        for what in self.late:
            print(f"over {SECONDS:g} s: {what}")
        wrong_ones = sum(map(len, self.foreign.values()))
        print(
            f"{self.count} calls: {self.refused} refused, {wrong_ones} errors of others "
            f"in {len(self.foreign)} places, {len(self.late)} took over {SECONDS:g} s"
        )


def shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) < 60 else f"{text[:40]}...({type(value).__name__})"


def public_members(handle: Any) -> Iterator[tuple[str, Any]]:
    """Yield the methods, and the setters of properties, of an object."""
    kind = type(handle)
    for name in dir(kind):
        if name.startswith("_") and name != "__getitem__":
            continue
        member = inspect.getattr_static(kind, name)
        if isinstance(member, property):
            if member.fset is not None:
                yield name, _Setter(handle, name, member.fset)
        elif callable(member) or isinstance(member, (staticmethod, classmethod)):
            yield name, getattr(handle, name)


class _Setter:
    """A setter as a function of one argument."""

    def __init__(self, handle: Any, name: str, setter: Callable[..., Any]) -> None:
        self._handle, self._name = handle, name
        self.__signature__ = inspect.Signature(
            list(inspect.signature(setter).parameters.values())[1:]
        )

    def __call__(self, value: Any) -> None:
        setattr(self._handle, self._name, value)


def try_members(
    path: str,
    handle: Any,
    good: Callable[[str, str], Any],
    findings: Findings,
    skipped: Callable[[Any, str], bool],
) -> None:
    """Call all that is public of an object."""
    for name, call in public_members(handle):
        if skipped(handle, name):
            continue
        for parameter, value, positional, named in calls(call, good):
            what = f"{path}.{name}({parameter}={shown(value)})"
            said = inspect.getdoc(call) or ""
            findings.attempt(what, lambda c=call, p=positional, n=named: c(*p, **n), said)


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


@contextlib.contextmanager
def limits() -> Iterator[None]:
    """Limit memory, and let calls be ended that take too long."""

    def end(_number: int, _frame: object) -> None:
        raise TookTooLongError

    before = signal.signal(signal.SIGALRM, end)
    memory = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, memory[1]))
    here = Path.cwd()
    try:
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            os.chdir(folder)
            try:
                yield
            finally:
                os.chdir(here)
    finally:
        resource.setrlimit(resource.RLIMIT_AS, memory)
        signal.signal(signal.SIGALRM, before)
