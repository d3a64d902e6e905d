"""The same experiment with many parameters and seeds, on many processors, in one table.

An experiment is a function of the user's::

    def run(*, seed, robots=10, speed=0.5):
        with gazelle.Simulation("hall.world", engine="planar", seed=seed) as sim:
            ...
        return {"stalls": ..., "mean_speed": ...}

and a `Study` says with which values it is called. The table has a row a call and is complete up to
the last row at any time, so that a study that was stopped continues where it was.
"""

from __future__ import annotations

import itertools
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gazelle.errors import FormatError, TaskError, did_you_mean
from gazelle.training.importing import TaskModule
from gazelle.training.tables import row_bytes
from gazelle.training.workers.callers import TRIES, call_all, workers_at
from gazelle_ros.base.text_files import read_rows
from gazelle_ros.base.writing import GrowingFile, write_bytes

_OWN = ("seed", "seconds", "error")
"""Columns that a study adds to those of parameters and results."""


@dataclass(frozen=True, kw_only=True)
class Study:
    """Function of a study, and the arguments it is called with."""

    function: str
    """``module:name`` or ``file.py:name``."""
    vary: Mapping[str, Sequence[Any]] = field(default_factory=dict)
    """Values of its parameters; all combinations are tried."""
    seeds: int = 1
    """Each combination is tried with the seeds from 0 on, so many."""

    def __post_init__(self) -> None:
        """Check that it can be done.

        Raises:
            TaskError: It cannot.
        """
        if self.seeds < 1:
            raise TaskError(f"a study needs at least 1 seed, not {self.seeds}")
        for name, values in self.vary.items():
            if name in _OWN or not values:
                raise TaskError(f"a study cannot vary '{name}' over {list(values)}")

    def calls(self) -> list[dict[str, Any]]:
        """Return the arguments of every call, in the table's order."""
        combinations = itertools.product(*self.vary.values())
        return [
            dict(zip(self.vary, values, strict=True)) | {"seed": seed}
            for values in combinations
            for seed in range(self.seeds)
        ]


@dataclass(frozen=True, slots=True)
class StudyResult:
    """Result of a study."""

    rows: list[dict[str, Any]]
    """The whole table."""
    new: int
    """Number of new rows."""
    failed: int
    """Number of all calls that ended in an error, which are in their rows."""


class ExperimentHost:
    """A worker's side of a study: calls the function.

    Args:
        module: Its module.
        name: Name there.
    """

    def __init__(self, module: TaskModule, name: str) -> None:
        self._module = module
        self._name = name

    def call(self, arguments: Mapping[str, Any]) -> dict[str, Any]:
        """Return a row: the arguments, what came of them, how long it took, or the error."""
        self._module.load()
        function = getattr(sys.modules[self._module.name], self._name)
        start = time.perf_counter()
        try:
            found = {key: _plain(key, value) for key, value in function(**arguments).items()}
        except Exception as error:  # noqa: BLE001  # it is one row of many
            found = {"error": " ".join(f"{type(error).__name__}: {error}".split())}
        return {**arguments, **found, "seconds": round(time.perf_counter() - start, 3)}

    def close(self) -> None:
        """Do nothing: there is nothing to close."""


def conduct(
    study: Study,
    table: Path,
    *,
    workers: int | None = None,
    ray: str | None = None,
    on_row: Callable[[int, int], None] | None = None,
) -> StudyResult:
    """Call the function with all that the study says; what the table has already is left out.

    Args:
        study: Study.
        table: A ``.csv`` file, made or continued.
        workers: Processes; by default as many as there are processors.
        ray: Address of the Ray cluster of the workers, ``local`` for one on this machine.
        on_row: Called with how many rows there are and how many there will be.

    Raises:
        TaskError: There is no such function, or workers are lost again and again.
        FormatError: The table is of another study.
        MissingExtraError: Ray is requested and not installed.
    """
    module, name = _found(study.function)
    count, start = workers_at(ray, workers, ExperimentHost, module, name)
    kept = _Table(table, study)
    calls = [call for call in study.calls() if not kept.has(call)]
    total = len(kept.rows) + len(calls)

    def done(call: dict[str, Any], row: dict[str, Any] | None) -> None:
        kept.add({**call, "error": f"its worker was lost {TRIES} times"} if row is None else row)
        if on_row is not None:
            on_row(len(kept.rows), total)

    try:
        call_all(calls, start, done, workers=min(count, len(calls)))
    finally:
        kept.close()
    failed = sum(bool(row.get("error")) for row in kept.rows)
    return StudyResult(kept.rows, len(calls), failed)


class _Table:
    """The file that grows by a row at a time."""

    def __init__(self, path: Path, study: Study) -> None:
        self._path = path
        self._names = [*study.vary, "seed"]
        self._lock = threading.Lock()
        self._done: set[tuple[str, ...]] = set()
        self.rows: list[dict[str, Any]] = []
        self._columns: list[str] = []
        self._made = not path.exists()
        if not self._made and path.stat().st_size:
            self._read()
        self._file = GrowingFile(path)
        if self._columns:
            self._rewrite([])  # without a line that was cut short

    def has(self, call: Mapping[str, Any]) -> bool:
        """Return whether the table has a row for these arguments."""
        return tuple(str(call[name]) for name in self._names) in self._done

    def add(self, row: dict[str, Any]) -> None:
        """Add a row; with other columns than so far the file is written again."""
        with self._lock:
            self.rows.append(row)
            columns = [*self._names, *(key for key in row if key not in {*self._names, *_OWN})]
            missing = [key for key in columns if key not in self._columns]
            if missing or not self._columns:
                self._rewrite(missing)
            else:
                self._file.write(row_bytes([row], self._columns))

    def close(self) -> None:
        """Close the file; one without a row, which was not there before, is removed."""
        with self._lock:
            self._file.close()
            if self._made and not self._columns:
                self._path.unlink(missing_ok=True)

    def _rewrite(self, more: list[str]) -> None:
        known = [key for key in self._columns if key not in _OWN[1:]]
        columns = [*known, *more, *_OWN[1:]]
        self._file.close()
        write_bytes(self._path, row_bytes(self.rows, columns, header=True))
        self._columns = columns
        self._file = GrowingFile(self._path)

    def _read(self) -> None:
        self._columns, rows = read_rows(self._path, whole=True)
        lacking = [name for name in self._names if name not in self._columns]
        if lacking:
            raise FormatError(
                f"this table has no column '{lacking[0]}'",
                file=str(self._path),
                hint="it is of another study: give another file",
            )
        self.rows = rows
        self._done = {tuple(row[name] for name in self._names) for row in self.rows}


def _found(function: str) -> tuple[TaskModule, str]:
    """Find a function by its name: its module, and the name in it."""
    place, colon, name = function.rpartition(":")
    if not colon:
        hint = "expected MODULE:FUNCTION or FILE.py:FUNCTION"
        raise TaskError(f"'{function}' does not name a function", hint=hint)
    module = TaskModule.find(place)
    module.load()
    there = vars(sys.modules[module.name])
    if not callable(there.get(name)):
        own = [key for key, value in there.items() if callable(value) and not key.startswith("_")]
        raise TaskError(f"{place} has no function '{name}'", hint=did_you_mean(name, own))
    return module, name


def _plain(name: str, value: Any) -> float | int | str | bool:
    """Return a result as a table takes it."""
    value = value.item() if hasattr(value, "item") else value
    if not isinstance(value, bool | int | float | str) or name in _OWN:
        raise TaskError(f"'{name}' is a {type(value).__name__}: a table takes numbers and text")
    return value
