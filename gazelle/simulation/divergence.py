"""Handling of a diverged world: it is reported, dumped for replay, and reset."""

from __future__ import annotations

import json
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from gazelle.engines import Call, DivergenceError
from gazelle.errors import SimulationError, did_you_mean
from gazelle.simulation.encoding import encode
from gazelle.simulation.recording import header
from gazelle.simulation.running_state import RunningState
from gazelle_ros.base.writing import write_text

Policy = Literal["raise", "reset"]
POLICIES = ("raise", "reset")

# A run that breaks down again and again must not fill the disk.
_MOST_DUMPS = 10


@dataclass(frozen=True, slots=True)
class Fault:
    """Report of a diverged world.

    Attributes:
        world: Its index.
        time: Simulated time of its last good state [s].
        dump: A recording of the steps that broke it; None after the first ten, and without room.
    """

    world: int
    time: float
    dump: Path | None


class FaultLog:
    """Keeps and dumps faults.

    Args:
        policy: ``raise`` an error after the other worlds made their steps, or ``reset`` the
            world and continue.
        dump: File for the recording of a fault; those after the first get a number. A
            temporary file if None.

    Raises:
        SimulationError: There is no such policy.
    """

    def __init__(self, policy: str, dump: str | Path | None) -> None:
        if policy not in POLICIES:
            raise SimulationError(
                f"on_fault cannot be '{policy}'", hint=did_you_mean(policy, POLICIES)
            )
        self.policy = policy
        self.faults: list[Fault] = []
        self._path = None if dump is None else Path(dump)
        self._dumps = 0

    def note(self, simulation: RunningState, error: DivergenceError, time_ns: int) -> str:
        """Dump and keep what happened; returns one line that says it."""
        fresh, reason = [], ""
        for row, world in enumerate(error.worlds):
            dump = None
            if self._dumps < _MOST_DUMPS:
                try:
                    dump = self._dump(simulation, error, row, time_ns)
                except OSError as unwritten:  # the fault matters more than its recording
                    reason = f"; its recording {unwritten.filename}: {unwritten.strerror}"
            fresh.append(Fault(int(world), time_ns / 1e9, dump))
        self.faults += fresh
        where = ", ".join(f"world {f.world}: {f.dump}" for f in fresh if f.dump is not None)
        text = f"at {time_ns / 1e9:g} s {error.message}"
        if not np.isfinite(error.before).all():
            text += "; a value that is not finite had been set before the step"
        text += reason
        return f"{text}; last good states, for Replay: {where}" if where else text

    def _dump(
        self, simulation: RunningState, error: DivergenceError, row: int, time_ns: int
    ) -> Path:
        """Write the steps that broke one world as a recording of that world alone."""
        world = int(error.worlds[row])
        history = [_of_one(call, world) for call in simulation.engine.history()]
        first = header(simulation, history, error.before[row : row + 1], time_ns)
        after = time_ns + error.steps * simulation.clock.step_ns
        step = {"call": "step", "arguments": encode((error.steps,)), "time": after}
        path = self._next_path()
        write_text(path, f"{json.dumps(first)}\n{json.dumps(step)}\n")
        return path

    def _next_path(self) -> Path:
        self._dumps += 1
        if self._path is None:
            with tempfile.NamedTemporaryFile(
                prefix="gazelle-fault-", suffix=".jsonl", delete=False
            ) as file:
                return Path(file.name)
        if self._dumps == 1:
            return self._path
        return self._path.with_stem(f"{self._path.stem}-{self._dumps}")


def _of_one(call: Call, world: int) -> Call:
    """Return a call of an engine's history, reduced to one world."""
    if call.method != "set_parameter":
        return call
    kind, name, values = call.arguments
    return Call(call.method, (kind, name, values[world : world + 1]))
