"""Watching for an owner of the state that waits for others."""

from __future__ import annotations

import contextlib
import threading
import time

import pytest

from gazelle.errors import SimulationError
from gazelle.simulation.deadlocks import BlockedOwner


def spin(done):
    while not done:
        pass


def without_lines(done):
    """Spin in instructions without a line, as the compiler makes some."""
    code = spin.__code__
    nowhere = b"\xff" * (len(code.co_code) // 16 + 1)  # each: eight units without a location
    type(spin)(code.replace(co_linetable=nowhere), {})(done)


def without_file(done):
    """Spin in code without a file, as `exec` makes it."""
    exec(compile("while not done: pass", "<made>", "exec"), {"done": done})


@contextlib.contextmanager
def running(work, done, end):
    thread = threading.Thread(target=work, args=(done,))
    thread.start()
    try:
        yield thread.ident
    finally:
        end()
        thread.join()


def watch_for_ever(watch, owner):
    while True:
        watch.check(owner)


@pytest.mark.parametrize("work", [spin, without_lines, without_file])
def test_an_owner_that_works_is_not_taken_for_one_that_waits(work, monkeypatch):
    monkeypatch.setattr("gazelle.simulation.deadlocks._PATIENCE", 60.0)
    done = []
    with running(work, done, lambda: done.append(True)) as owner:
        watch = BlockedOwner()
        for _ in range(100):
            watch.check(owner)
            time.sleep(0.0001)


def test_an_owner_that_waits_is_told_of(monkeypatch):
    monkeypatch.setattr("gazelle.simulation.deadlocks._PATIENCE", 0.0)
    done = threading.Event()
    with running(threading.Event.wait, done, done.set) as owner:
        watch = BlockedOwner()
        with pytest.raises(SimulationError, match="waits for another thread"):
            watch_for_ever(watch, owner)


def test_an_owner_that_has_ended_is_not_waited_for():
    BlockedOwner().check(0)
