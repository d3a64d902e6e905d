"""Bytes that are no snapshot are refused, and nothing changes."""

from __future__ import annotations

import io
import json
import math

import numpy as np
import pytest

import gazelle
from gazelle.errors import SimulationError


def an_archive():
    buffer = io.BytesIO()
    np.savez(buffer, numbers=np.zeros(3))
    return buffer.getvalue()


def test_bytes_that_are_no_snapshot_are_refused():
    with gazelle.Simulation("shapes") as sim:
        sim.run(0.01)
        good = sim.snapshot()
        before = sim.state_hash()
        for bad in (b"", b"hello", b"PK", good[:100], good[:-100], good[200:], an_archive()):
            with pytest.raises(SimulationError, match="not a snapshot"):
                sim.restore(bad)
        with pytest.raises(SimulationError, match="a snapshot is bytes, not str"):
            sim.restore("hello")
        assert sim.state_hash() == before
        sim.restore(good)


def parts(data):
    """Return the arrays of a snapshot by name: they lie one after the other, as an index says."""
    with np.load(io.BytesIO(data)) as archive:
        index, whole = json.loads(archive["index"].tobytes()), archive["data"].tobytes()
    arrays, at = {}, 0
    for name, kind, shape in index:
        size = np.dtype(kind).itemsize * math.prod(shape)
        arrays[name] = np.frombuffer(whole[at : at + size], kind).reshape(shape)
        at += size
    return arrays


def archive_of(index, data):
    buffer = io.BytesIO()
    np.savez(buffer, index=header(json.dumps(index)), data=np.frombuffer(data, np.uint8))
    return buffer.getvalue()


def with_member(data, name, value):
    """Return a snapshot with one of its arrays replaced, or left out."""
    arrays = parts(data)
    del arrays[name]
    if value is not None:
        arrays[name] = value
    index = [(each, array.dtype.str, array.shape) for each, array in arrays.items()]
    return archive_of(index, b"".join(array.tobytes() for array in arrays.values()))


def header(text):
    return np.frombuffer(text.encode(), dtype=np.uint8)


@pytest.fixture(scope="module")
def running():
    with gazelle.Simulation("turtlebot3_stage_1", nworld=2) as sim:
        robot = sim.spawn("turtlebot3_burger", name="b")
        robot.inputs["cmd_vel"].send(linear=[0.1, 0.2], angular=0.3)
        sim.run(0.2)
        yield sim


@pytest.mark.long
@pytest.mark.parametrize("value", [None, np.zeros(7), np.array("x")])
def test_a_snapshot_with_any_part_damaged_is_refused_and_nothing_changes(running, value):
    """But for the parts of plugins: one that cannot read its own is detached and named."""
    good = running.snapshot()
    running.run(0.1)
    now = running.snapshot()
    names = [name for name in parts(good) if not name.startswith("plugin")]
    refused = 0
    for name in names:
        try:
            running.restore(with_member(good, name, value))
        except SimulationError:
            refused += 1
            assert running.snapshot() == now, name
        else:
            running.restore(now)
    assert refused > 0.9 * len(names) if value is None else refused > 0.3 * len(names)
    running.restore(good)
    assert running.snapshot() == good


@pytest.mark.parametrize("text", ["5", "[1]", "{}", "nonsense", '{"format": 3, "names": []}'])
def test_a_snapshot_with_a_damaged_header_is_refused(running, text):
    now = running.snapshot()
    with pytest.raises(SimulationError, match="snapshot"):
        running.restore(with_member(now, "header", header(text)))
    assert running.snapshot() == now


@pytest.mark.parametrize(
    ("index", "data"),
    [
        (5, b""),
        ([5], b""),
        ([["header", "|u1", [4]]], b"{}"),
        ([["header", "|u1", [1]]], b"{}"),
        ([["header", "|u1", [-1]]], b"{}"),
        ([["header", "|O", [1]]], b"12345678"),
        ([["header", "nonsense", [1]]], b"{}"),
        ([["header", "|u1", "2"]], b"{}"),
    ],
)
def test_an_index_that_does_not_fit_is_refused(running, index, data):
    now = running.snapshot()
    with pytest.raises(SimulationError, match="not a snapshot"):
        running.restore(archive_of(index, data))
    assert running.snapshot() == now


def test_a_snapshot_of_another_number_of_worlds_is_named(running):
    with gazelle.Simulation("turtlebot3_stage_1", nworld=3) as other:
        other.spawn("turtlebot3_burger", name="b")
        with pytest.raises(SimulationError, match="of 2 worlds, 3 run"):
            other.restore(running.snapshot())
