"""For how long the physics is stepped at once: longer while nobody asks for anything."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

import gazelle
from gazelle.description import World
from gazelle.native.fair_lock import Turn
from gazelle.simulation import step_loop

STEP_S = 0.0004  # what a step takes, by a clock of the test


@pytest.fixture
def sim(monkeypatch):
    """Return a simulation, and its numbers of steps at once."""
    sim, clock = gazelle.Simulation(World("w")), SimpleNamespace(now=100.0)
    ticking = SimpleNamespace(perf_counter=lambda: clock.now, process_time=lambda: clock.now)
    monkeypatch.setattr(step_loop, "time", ticking)
    before, pieces, asked = sim.engine.step, [], []

    def step(count=1, systems=(), now_ns=0):
        clock.now += count * STEP_S
        pieces.append(count)
        sim.lock.waiting.extend(asked)
        asked.clear()
        before(count)

    monkeypatch.setattr(sim.engine, "step", step)
    sim.pieces, sim.wall, sim.asked = pieces, clock, asked
    return sim


def test_pieces_grow_while_nobody_asks_for_anything(sim):
    sim.step(1000)
    assert 0.005 < max(sim.pieces) * STEP_S <= 0.02


def test_who_asked_lately_waits_three_milliseconds_at_most(sim):
    sim.step(1000)
    sim.pieces.clear()
    sim.asked.append(Turn(0, lambda: None))
    sim.step(1000)
    assert not sim.lock.waiting
    assert max(sim.pieces[1:]) * STEP_S <= 0.003
    sim.wall.now += 2.0
    sim.step(1000)
    assert max(sim.pieces) * STEP_S > 0.005


def test_what_other_programs_take_makes_pieces_no_shorter(sim, monkeypatch):
    ticking = SimpleNamespace(
        perf_counter=lambda: 20.0 * sim.wall.now, process_time=lambda: sim.wall.now
    )
    monkeypatch.setattr(step_loop, "time", ticking)
    sim.step(1000)
    assert max(sim.pieces) * STEP_S > 0.005
