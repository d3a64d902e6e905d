"""Calls of all that is public with wrong values, and a count of how they end."""

from __future__ import annotations

import collections
import contextlib
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
from pathlib import Path
from typing import Any

import numpy as np
from wrong_values import shown, wrong, wrong_parts

from gazelle import Error
from gazelle.description import Pose

SECONDS = 20.0
MEMORY = 64 * 2**30


_OURS = re.compile(r"/gazelle(?:_ros)?/")
_OF_CLASS = re.compile(
    r"\b(?!Path|Literal|None|Any|Callable|Mapping|Sequence|Iterable)[A-Z][a-z]\w+"
)


class TookTooLongError(BaseException):
    """A call did not end in time."""


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
    samples = {each.name: sample for each, sample in given}
    for each in parameters:
        annotation = annotation_of(each)
        if each.kind is each.VAR_KEYWORD:
            yield each.name, "no such", *_arguments(given, None, None, {"no_such": 1})
            continue
        sample = samples.get(each.name)
        if (
            each.name not in samples
            and _OF_CLASS.search(annotation)
            and "Mapping" not in annotation
        ):
            sample = good(each.name, annotation)
        for value in (*wrong(annotation), *wrong_parts(sample)):
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
    """Counts of calls, the errors of others that came, and what took no number for one."""

    def __init__(self) -> None:
        self.count = 0
        self.refused = 0
        self.foreign: dict[str, list[str]] = collections.defaultdict(list)
        self.late: list[str] = []
        self.accepted: list[str] = []

    def attempt(
        self, what: str, call: Callable[[], Any], documented: str = "", value: Any = None
    ) -> Any:
        """Make a call; return what it returns, None where it raises.

        Args:
            what: The call, for the report.
            call: Makes it.
            documented: The docstring: an error of Python's that it names is allowed.
            value: The wrong value, if it is one.
        """
        self.count += 1
        signal.setitimer(signal.ITIMER_REAL, SECONDS)
        try:
            returned = call()
        except Error:
            self.refused += 1
        except TookTooLongError:
            self.late.append(what)
            print("late", what, flush=True)
        except Exception as error:  # noqa: BLE001  # that is what is looked for
            if not any(f"{each.__name__}:" in documented for each in type(error).__mro__):
                self._add(what, error)
        else:
            nan = "NaN" not in documented and _has_nan(value)
            if nan or ("(worlds=" in what and _is_nowhere(value)):
                self.accepted.append(what)
            return returned
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
        return None

    @property
    def foreign_count(self) -> int:
        return sum(map(len, self.foreign.values()))

    def _add(self, what: str, error: Exception) -> None:
        frames = traceback.extract_tb(error.__traceback__)
        ours = [each for each in frames if _OURS.search(each.filename)]
        last = ours[-1] if ours else frames[-1]
        inside = ours and not last.filename.endswith("argument_checks.py")
        if inside or not isinstance(error, TypeError):  # else the call itself did not fit
            place = f"{_OURS.split(last.filename)[-1]}:{last.lineno}"
            self.foreign[f"{type(error).__name__} in {place}"].append(f"{what}: {error!s:.150}")

    def show(self, examples: int = 3) -> None:
        for place, found in sorted(self.foreign.items(), key=lambda pair: -len(pair[1])):
            print(f"{len(found):>6}  {place}\n          " + "\n          ".join(found[:examples]))
        for what in self.late:
            print(f"over {SECONDS:g} s: {what}")
        for what in sorted({each.replace("np.float64(nan)", "nan") for each in self.accepted}):
            print(f"took NaN: {what}")
        print(
            f"{self.count} calls: {self.refused} refused, {self.foreign_count} errors of others "
            f"in {len(self.foreign)} places, {len(self.late)} took over {SECONDS:g} s, "
            f"{len(self.accepted)} took NaN"
        )


def _has_nan(value: Any) -> bool:
    """Return whether a value is NaN, or a vector, list or pose with one."""
    numbers = value.numbers if isinstance(value, Pose) else value
    row = numbers if isinstance(numbers, tuple | list) else (numbers,)
    return any(isinstance(each, float) and math.isnan(each) for each in row)


def _is_nowhere(worlds: Any) -> bool:
    """Return whether indices of worlds are of none or of others; a mask of all is of them."""
    rows = np.asarray(worlds)
    ints = rows.dtype.kind in "iub" and rows.ndim == 1
    return rows.size > 0 and not (ints and 0 <= rows.min() <= rows.max() <= 1)


def public_members(handle: Any) -> Iterator[tuple[str, Any]]:
    """Yield the methods, and the setters of properties, of an object."""
    kind = type(handle)
    for name in dir(kind):
        if name.startswith("_") and name != "__getitem__":
            continue
        member = inspect.getattr_static(kind, name)
        if isinstance(member, property):
            if member.fset is not None:
                yield name, _Setter(handle, name, member)
        elif callable(member) or isinstance(member, (staticmethod, classmethod)):
            yield name, getattr(handle, name)


class _Setter:
    """A setter as a function of one argument."""

    def __init__(self, handle: Any, name: str, member: property) -> None:
        self._handle, self._name, self.__doc__ = handle, name, member.__doc__
        parameters = inspect.signature(member.fset).parameters.values()  # type: ignore[arg-type]
        self.__signature__ = inspect.Signature(list(parameters)[1:])

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
            findings.attempt(what, lambda c=call, p=positional, n=named: c(*p, **n), said, value)


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
