"""A simulation's whole state as bytes, and back."""

from __future__ import annotations

import io
import json
import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.bounded_npz import BROKEN, open_npz
from gazelle.description import World
from gazelle.errors import Error, SimulationError
from gazelle.simulation.encoding import decode, encode
from gazelle.simulation.ports import TwistInput
from gazelle.simulation.robot import Robot, RobotHost

_FORMAT = 4

# What reading an archive may raise that is none, or broken.
# Of a snapshot, unpacked [bytes].
MAX_BYTES = 1 << 36

_HINT = "restore into a simulation with the same world, models, engine and number of worlds"


def snapshot(simulation: RobotHost) -> bytes:
    """Return the state of physics, clock, commands, plugins, sensors and noise."""
    arrays = _gather(simulation)
    index = [(name, value.dtype.str, value.shape) for name, value in arrays.items()]
    # Each array of an archive costs 0.1 ms to write and to read, and there are a hundred.
    data = b"".join(value.tobytes() for value in arrays.values())
    buffer = io.BytesIO()
    np.savez(
        buffer,
        allow_pickle=False,
        index=np.frombuffer(json.dumps(index).encode(), np.uint8),
        data=np.frombuffer(data, np.uint8),
    )
    return buffer.getvalue()


def _gather(simulation: RobotHost) -> dict[str, NDArray[Any]]:
    """Return all contents of a snapshot, by key."""
    arrays: dict[str, NDArray[np.generic]] = {"engine": simulation.engine.snapshot()}
    for key, part in _parts(simulation).items():
        for name, value in part.state().items():
            arrays[f"{key}|{name}"] = np.asarray(value)
    for robot in simulation.robots.values():
        for name, port in _held(robot).items():
            arrays[f"input|{robot.name}|{name}"] = np.concatenate((port.linear, port.angular), 1)
    header = {
        "format": _FORMAT,
        "time": simulation.clock.now_ns,
        "names": _names(simulation),
        "due": [entry.schedule.count if entry.schedule else 0 for entry in simulation.plugins],
    }
    header |= {
        "seed": simulation.seed,
        "history": encode(simulation.engine.history()),
        "laws": encode(_laws_of(simulation.engine.world)),
        "loads": encode(simulation.applied_wrenches.state()),
        "parameters": encode(simulation.parameters.state()),
    }
    arrays["header"] = np.frombuffer(json.dumps(header).encode(), dtype=np.uint8)
    return arrays


def restore(simulation: RobotHost, data: bytes) -> None:
    """Restore what ``snapshot`` returned.

    Raises:
        SimulationError: The bytes are no snapshot, or one of another simulation; nothing is
            changed.
    """
    arrays = _read(data)
    header = _header_of(arrays, simulation)
    before = _gather(simulation)
    try:
        _put_back(simulation, header, arrays)
    except (ArithmeticError, AttributeError, Error, LookupError, TypeError, ValueError) as error:
        _put_back(simulation, json.loads(before["header"].tobytes()), before)
        raise SimulationError(
            f"the snapshot cannot be restored: {type(error).__name__}: {error}", hint=_HINT
        ) from error


def _header_of(arrays: Mapping[str, NDArray[Any]], simulation: RobotHost) -> dict[str, Any]:
    """Return the header of a snapshot of this simulation.

    Raises:
        SimulationError: There is none, or it is of another simulation.
    """
    if not {"header", "engine"} <= arrays.keys():
        raise SimulationError("these bytes are not a snapshot: they lack a header")
    try:
        header = json.loads(arrays["header"].tobytes())
    except ValueError:
        header = None
    if not isinstance(header, dict) or header.get("format") != _FORMAT:
        raise SimulationError(f"these bytes are not a snapshot of the form {_FORMAT}")
    if header.get("names") != _names(simulation):
        raise SimulationError("the snapshot is of other models than those that run", hint=_HINT)
    rows = arrays["engine"].shape[:1]
    if rows != (simulation.nworld,):
        raise SimulationError(
            f"the snapshot is of {rows[0] if rows else 'no'} worlds, {simulation.nworld} run",
            hint=_HINT,
        )
    return header


def _put_back(
    simulation: RobotHost, header: dict[str, Any], saved: Mapping[str, NDArray[Any]]
) -> None:
    arrays = {key: value for key, value in saved.items() if key not in ("header", "engine")}
    _restore_engine(simulation, header, saved["engine"])
    simulation.clock.now_ns = int(header["time"])
    simulation.seed = header["seed"]
    simulation.applied_wrenches.restore(decode(header["loads"]))
    simulation.parameters.restore(decode(header["parameters"]))
    simulation.loop.release()
    for entry, count in zip(simulation.plugins, header["due"], strict=True):
        if entry.schedule is not None:
            entry.schedule.count = count
    grouped: dict[str, dict[str, NDArray[np.generic]]] = {}
    for key, value in arrays.items():
        group, _, name = key.rpartition("|")
        grouped.setdefault(group, {})[name] = value
    for key, part in _parts(simulation).items():
        part.restore(grouped.get(key, {}))
    for robot in simulation.robots.values():
        for name, port in _held(robot).items():
            both: Any = grouped[f"input|{robot.name}"][name]
            port.linear[:], port.angular[:] = both[:, :3], both[:, 3:]


def _held(robot: Robot) -> dict[str, TwistInput]:
    """Return the ports that hold a command; other commands are in the states of their plugins."""
    return {name: port for name, port in robot.inputs.items() if isinstance(port, TwistInput)}


def _restore_engine(simulation: RobotHost, header: dict[str, Any], state: Any) -> None:
    """Restore laws, motors, attachments and parameters, then the state."""
    engine = simulation.engine
    laws = decode(header["laws"])
    if _plain(_laws_of(engine.world)) != header["laws"]:
        world = engine.world
        engine.update_world(replace(laws, plugins=world.plugins, content=world.content))
        simulation.clock.set_step(engine.time_step)
    if _plain(engine.history()) != header["history"]:
        engine.adopt(decode(header["history"]))
    engine.restore(state)


def _parts(simulation: RobotHost) -> Mapping[str, Any]:
    """Return everything besides the engine that has a state, by a unique key."""
    parts: dict[str, Any] = {}
    for entry in simulation.plugins:
        key = f"plugin|{entry.owner}|{entry.name}"
        twins = sum(name == key or name.startswith(f"{key}#") for name in parts)
        parts[f"{key}#{twins}" if twins else key] = entry
    for robot in simulation.robots.values():
        for unit in robot.sensors.values():
            parts[f"sensor|{unit.name}"] = unit
    return parts


def _names(simulation: RobotHost) -> list[str]:
    return [*simulation.engine.links.names, *sorted(_parts(simulation))]


def _laws_of(world: World) -> World:
    """Return a world without its contents."""
    return replace(world, models=(), plugins=(), content=None)


def _plain(value: Any) -> Any:
    """Return a value as it comes back from JSON."""
    return json.loads(json.dumps(encode(value)))


def _read(data: bytes) -> dict[str, NDArray[Any]]:
    if not isinstance(data, bytes | bytearray | memoryview):
        raise SimulationError(f"a snapshot is bytes, not {type(data).__name__}")
    try:
        with open_npz(io.BytesIO(data), MAX_BYTES) as archive:
            index = json.loads(archive["index"].tobytes())
            return _arrays_of(archive["data"].tobytes(), index)
    except BROKEN:
        raise SimulationError("these bytes are not a snapshot, or a damaged one") from None


def _arrays_of(data: bytes, index: list[tuple[str, str, list[int]]]) -> dict[str, NDArray[Any]]:
    """Return the arrays stored one after the other, by name.

    Raises:
        ValueError: They have another size.
    """
    arrays, at = {}, 0
    for name, kind, shape in index:
        dtype, count = np.dtype(kind), math.prod(shape)
        arrays[name] = np.frombuffer(data, dtype, count, at).reshape(shape).copy()
        at += count * dtype.itemsize
    if at != len(data):
        raise ValueError(f"{at} bytes of {len(data)} are known")
    return arrays
