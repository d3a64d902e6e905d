"""Recordings of runs: the calls to the engine, and a hash of the state after every step.

A recording is text, one JSON object a line, and holds no code. The first line says what ran
and its state; every other line is one change, in order: a call of the engine, or entries of its state
that were written since the call before. A line cut off by a crash is left out on reading.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from pathlib import Path
from typing import IO, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.engines import CHANGES, Call, DivergenceError, Engine
from gazelle.errors import Error, SimulationError
from gazelle.native.joint_system import JointSystem
from gazelle.native.system import System
from gazelle.simulation.clock import Schedule
from gazelle.simulation.encoding import encode
from gazelle.simulation.running_state import RunningState
from gazelle_ros.base.closing import Closeable
from gazelle_ros.base.path_texts import shortened
from gazelle_ros.base.writing import write_text


class StepCuts(Protocol):
    """Protocol of what makes steps; see ``StepLoop``."""

    cut: bool


class RecordedRun(RunningState, Protocol):
    """Protocol of runs that can be recorded."""

    @property
    def loop(self) -> StepCuts:
        """Loop that makes its steps."""


FORMAT = "gazelle-recording"
VERSION = 3


def state_hash(state: NDArray[np.float64]) -> str:
    """Return a hash of a state, to the bit: 16 hexadecimal digits of BLAKE2b."""
    return hashlib.blake2b(np.ascontiguousarray(state).tobytes(), digest_size=8).hexdigest()


def header(
    simulation: RunningState, history: Iterable[Call], state: NDArray[np.float64], time_ns: int
) -> dict[str, Any]:
    """Return the first line of a recording: the simulation and its initial state."""
    return {
        "format": FORMAT,
        "version": VERSION,
        "engine": simulation.engine_name,
        "seed": simulation.seed,
        "time": time_ns,
        "world": encode(simulation.engine.world),
        "history": encode(list(history)),
        "state": encode(state),
    }


class Recorder(Closeable):
    """Writes down a run until it is closed; a context manager.

    It records the methods of the engine that change something, of any caller, and compares the
    state before each with that after the call before. As long as it records, systems are updated from
    here, one step at a time, so that what they write is found.

    Args:
        simulation: Simulation.
        path: File to write; an existing one is replaced.

    Raises:
        SimulationError: The file cannot be written.
    """

    def __init__(self, simulation: RecordedRun, path: str | Path) -> None:
        self.path = Path(path)
        self._simulation = simulation
        self._engine: Engine = simulation.engine
        now_ns = simulation.clock.now_ns
        first = header(simulation, self._engine.history(), self._engine.snapshot(), now_ns)
        try:
            write_text(self.path, _line(first))
            self._file: IO[str] = self.path.open("a", encoding="utf-8")
        except (OSError, ValueError) as error:
            raise self._unwritten(error) from error
        self._depth = 0
        self._pending: dict[str, Any] = {}
        self._steps = 0
        own = vars(self._engine)  # some engines keep methods of their parts there
        self._methods = {name: own[name] for name in CHANGES if name in own}
        self._seen = self._engine.peek().copy()
        self._step = self._engine.step
        self._listens = True
        for name in CHANGES:
            method = getattr(self._engine, name)
            listener = self._stepped if name == "step" else partial(self._called, name, method)
            setattr(self._engine, name, listener)

    def close(self) -> None:
        """Stop listening; a second call does nothing."""
        lock = self._simulation.lock
        lock.acquire()  # also of a simulation that is closed, and its engine with it
        try:
            if self._file.closed:
                return
            if not lock.closed:
                self._stop_listening()
                self._note_writes()
            self._flush()
            self._end()
        finally:
            lock.release()

    def _stop_listening(self) -> None:
        self._listens = False
        for name in CHANGES:
            delattr(self._engine, name)
            if name in self._methods:
                setattr(self._engine, name, self._methods[name])

    def _end(self) -> None:
        """Close the file, which may have lines to write yet."""
        try:
            self._file.close()
        except OSError as error:
            raise self._unwritten(error) from error

    def _unwritten(self, error: OSError | ValueError) -> SimulationError:
        reason = getattr(error, "strerror", None) or str(error)
        return SimulationError(
            f"the recording cannot be written: {reason}", file=shortened(str(self.path))
        )

    def _stepped(self, count: int = 1, systems: Sequence[System] = (), now_ns: int = 0) -> None:
        """Record steps, with updates of systems between them."""
        if self._depth or not systems:
            self._called("step", self._step, count, (), now_ns)
            return
        step_ns = self._simulation.clock.step_ns
        for number in range(count):
            time = now_ns + number * step_ns
            self._update([each for each in systems if not each.late], time)
            try:
                self._called("step", self._step, 1, (), time, past=number)
            except DivergenceError as error:
                raise DivergenceError(
                    error.message, error.worlds, error.before, error.steps, number + 1
                ) from None
            self._update([each for each in systems if each.late], time + step_ns)

    def _update(self, systems: Sequence[System], time: int) -> None:
        """Update those that are due; those of joints come after the others, as in engines."""
        for system in sorted(systems, key=lambda each: isinstance(each, JointSystem)):
            if system.due > time:
                continue
            self._engine.update(system, time)
            if system.rate > 0.0:
                schedule = Schedule(system.rate)
                schedule.done(time)
                system.due = schedule.due_ns

    def _called(
        self, name: str, method: Callable[..., Any], *args: Any, past: int = 0, **options: Any
    ) -> Any:
        """Call a method; record it unless it is part of a larger one."""
        if self._depth:
            return method(*args, **options)
        given = args[:1] if name == "step" else args  # systems write the state before
        line: dict[str, Any] = {"call": name, "arguments": encode(given)}
        if options:
            line["options"] = encode(options)
        self._note_writes()
        self._depth += 1
        try:
            result = method(*args, **options)
        except DivergenceError as error:
            line["diverged"] = [int(world) for world in error.worlds]
            self._note(name, line, args, past)
            raise
        except Error:
            raise  # nothing was changed
        finally:
            self._depth -= 1
        self._note(name, line, args, past)
        return result

    def _note_writes(self) -> None:
        """Write down which entries of the state were set since the last call."""
        state = self._engine.peek()
        changed = np.flatnonzero(state.view(np.int64) != self._seen.view(np.int64))
        if not len(changed):
            return
        self._flush()
        values = state.reshape(-1)[changed]
        arguments = encode((changed.astype(np.int64), values))
        time_ns = self._simulation.clock.now_ns
        self._write({"call": "write_state", "arguments": arguments, "time": time_ns})

    def _note(self, name: str, line: dict[str, Any], args: tuple[Any, ...], past: int) -> None:
        step_ns = self._simulation.clock.step_ns
        line["time"] = self._simulation.clock.now_ns + past * step_ns
        self._seen = self._engine.peek().copy()
        if name != "step":
            self._flush()
            self._write(line)
            return
        count = args[0] if args else 1
        line["time"] += count * step_ns
        line["hash"] = state_hash(self._seen)
        # Steps that were cut only to check for waiting threads are one run of steps.
        if not (self._pending and (past or self._simulation.loop.cut)):
            self._flush()
            self._steps = 0
        self._steps += count
        self._pending = {**line, "arguments": encode((self._steps,))}
        if "diverged" in line:
            self._flush()

    def _flush(self) -> None:
        """Write the last run of steps, which might have gone on."""
        if self._pending:
            self._write(self._pending)
            self._pending = {}

    def _write(self, line: dict[str, Any]) -> None:
        """Write a line; if there is no room the recording ends, and the simulation may continue."""
        if self._file.closed:
            return
        try:
            self._file.write(_line(line))
        except OSError as error:
            if self._listens:
                self._stop_listening()
            with contextlib.suppress(OSError):
                self._file.close()
            raise self._unwritten(error) from error


def _line(entry: dict[str, Any]) -> str:
    return json.dumps(entry, separators=(",", ":")) + "\n"
