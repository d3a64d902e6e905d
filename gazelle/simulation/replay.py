"""Run a recording again, and check that it does the same to the bit."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

from gazelle.description import Link, Model, World
from gazelle.engines import CHANGES, DivergenceError
from gazelle.errors import EngineError, FormatError, SimulationError
from gazelle.formats.limits import refuse_special
from gazelle.simulation.encoding import decode, encode
from gazelle.simulation.recording import FORMAT, VERSION, state_hash
from gazelle.simulation.simulation import Simulation
from gazelle_ros.base.closing import Closeable
from gazelle_ros.base.path_texts import shortened

# What values of a wrong kind or shape raise, wherever they are used.
_DAMAGE = (ArithmeticError, AttributeError, EngineError, LookupError, TypeError, ValueError)


class Replay(Closeable):
    """A recorded run, done again step by step.

    ``simulation`` is the run: look at its robots, read its sensors, render it. It has no
    plugins, since what they did is in the recording. Its sensors have the recorded seed, and
    measure on request.

    Args:
        path: The recording.
        threads: Native threads; all processors if None.

    Attributes:
        simulation: Simulation.

    Raises:
        SimulationError: The file is not a recording, a damaged one, or one of another version.
    """

    def __init__(self, path: str | Path, *, threads: int | None = None) -> None:
        self.path = Path(path)
        lines = _read(self.path)
        first = lines[0]
        version = first.get("version")
        if first.get("format") != FORMAT or not isinstance(version, int):
            raise SimulationError("this is not a recording of a run", file=str(path))
        if version != VERSION:
            raise SimulationError(
                f"this recording has version {version}, this Gazelle reads version {VERSION}",
                file=str(path),
                hint="read it with the Gazelle that wrote it",
            )
        self._events = lines[1:]
        self._next = 0
        try:
            self.simulation = _begin(first, threads)
        except _DAMAGE as error:
            raise self._damaged(error) from error

    @property
    def done(self) -> bool:
        """True if there are no more events."""
        return self._next >= len(self._events)

    def step(self, most: int | None = None) -> bool:
        """Advance to the end of the next recorded run of steps; False when there is none.

        Args:
            most: Advance by at most this number of its steps; the state is compared at its end.

        Raises:
            SimulationError: The state is not the recorded one, or the recording is damaged.
            DivergenceError: A world diverged where the recorded run did not continue.
        """
        while not self.done:
            event = self._events[self._next]
            if most is not None and self._step_into(event, most):
                return True
            self._next += 1
            try:
                name, time_ns = str(event["call"]), int(event["time"])
                try:
                    self._do(event)
                finally:
                    self.simulation.clock.now_ns = time_ns
            except DivergenceError as error:
                if event.get("diverged") != [int(world) for world in error.worlds]:
                    raise
            except _DAMAGE as error:
                raise self._damaged(error) from error
            if name == "step":
                self._check(event)
                return True
        return False

    def run(self) -> int:
        """Advance to the end; returns the number of runs of steps made."""
        count = 0
        while self.step():
            count += 1
        return count

    def _step_into(self, event: dict[str, Any], most: int) -> bool:
        """Make the first of a run of steps; False if there are no more."""
        try:
            count = decode(event["arguments"])[0] if event["call"] == "step" else 0
        except _DAMAGE as error:
            raise self._damaged(error) from error
        if count <= most or "diverged" in event:
            return False
        self.simulation.engine.step(most)
        self.simulation.clock.advance(most)
        self._events[self._next] = {**event, "arguments": encode((count - most,))}
        return True

    def _do(self, event: dict[str, Any]) -> None:
        name, arguments = event["call"], decode(event["arguments"])
        simulation, engine = self.simulation, self.simulation.engine
        if name == "spawn":
            simulation.spawn(_bare(arguments[0]))
        elif name == "delete":
            simulation.delete(arguments[0])
        elif name not in CHANGES:
            raise ValueError(f"there is no change '{name}'")
        else:
            options = decode(event["options"]) if "options" in event else {}
            getattr(engine, name)(*arguments, **options)
            simulation.clock.set_step(engine.time_step)

    def _check(self, event: dict[str, Any]) -> None:
        found = state_hash(self.simulation.engine.peek())
        if "hash" in event and found != event["hash"]:
            raise SimulationError(
                f"at {self.simulation.time:g} s the state is not the recorded one "
                f"({found}, not {event['hash']})",
                file=str(self.path),
                hint="the same version of MuJoCo and the same mesh files give the same bits",
            )

    def _damaged(self, error: Exception) -> SimulationError:
        text = f"the recording is damaged: {type(error).__name__}: {str(error).splitlines()[0]}"
        return SimulationError(text, file=str(self.path), line=self._next + 1)

    def close(self) -> None:
        """Free the engine."""
        self.simulation.close()


def _begin(first: dict[str, Any], threads: int | None) -> Simulation:
    """Create the simulation that a recording starts from, by its first line."""
    state = decode(first["state"])
    simulation = Simulation(
        _without_plugins(decode(first["world"])),
        first["engine"],
        nworld=len(state),
        seed=first["seed"],
        threads=threads,
    )
    simulation.engine.adopt(decode(first["history"]))
    simulation.engine.restore(state)
    simulation.clock.now_ns = int(first["time"])
    return simulation


def _read(path: Path) -> list[dict[str, Any]]:
    lines: list[dict[str, Any]] = []
    try:
        refuse_special(path)
        texts = path.read_text(encoding="utf-8", errors="replace").splitlines()
    except FormatError as error:
        raise SimulationError(error.message, file=shortened(str(path))) from error
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise SimulationError(f"it cannot be read: {reason}", file=shortened(str(path))) from error
    for number, text in enumerate(texts, 1):
        try:
            line = json.loads(text)
        except ValueError:
            if lines and number < len(texts):
                raise SimulationError(
                    "the recording is damaged: this line is not valid JSON",
                    file=str(path),
                    line=number,
                ) from None
            break  # cut off
        lines.append(line if isinstance(line, dict) else {})
    if not lines:
        raise SimulationError("this is not a recording of a run", file=str(path))
    return lines


def _without_plugins(world: World) -> World:
    return replace(world, plugins=(), models=tuple(_bare(model) for model in world.models))


def _bare(model: Model) -> Model:
    """Return a model without plugins."""
    return replace(
        model,
        plugins=(),
        links=tuple(_bare_link(link) for link in model.links),
        models=tuple(_bare(nested) for nested in model.models),
    )


def _bare_link(link: Link) -> Link:
    return replace(link, sensors=tuple(replace(each, plugins=()) for each in link.sensors))
