"""After a reset sensors are as in a new simulation, and those of other worlds as they were."""

from __future__ import annotations

import numpy as np
import pytest
import scenes

from gazelle import Simulation


def simulation(engine, nworld=1, seed=7):
    world = scenes.world(scenes.ground(), *scenes.square())
    sim = Simulation(world, engine=engine, nworld=nworld, seed=seed)
    sim.spawn(scenes.burger(stddev=0.02, samples=8), name="r1")
    return sim


def drive(sim, seconds):
    sim.robots["r1"].inputs["cmd_vel"].send(linear=0.15, angular=0.4)
    sim.run(seconds=seconds)


def sensor(sim):
    return next(iter(sim.robots["r1"].sensors.values()))


@pytest.mark.parametrize("engine", ["mujoco", "planar"])
@pytest.mark.parametrize("seconds", [0.0, 0.11, 0.37, 0.4, 1.03])
def test_the_first_reading_after_a_reset_is_that_of_a_new_simulation(engine, seconds):
    with simulation(engine) as used, simulation(engine) as new:
        for _ in range(3):  # read at odd times, so that it has a rhythm and noise is drawn
            drive(used, 0.13)
            sensor(used).read()
        used.reset(seed=7)
        assert not sensor(used).awake
        for sim in (used, new):
            drive(sim, seconds)
        for _ in range(3):
            one, other = sensor(used).read(), sensor(new).read()
            np.testing.assert_array_equal(one.ranges, other.ranges)
            assert one.stamp == other.stamp
            for sim in (used, new):
                drive(sim, 0.07)


@pytest.mark.parametrize("engine", ["mujoco", "planar"])
def test_a_reset_of_some_worlds_leaves_the_readings_of_the_others(engine):
    with simulation(engine, 3) as sim, simulation(engine, 3) as quiet:
        for each in (sim, quiet):
            drive(each, 0.3)
            sensor(each).read()
            drive(each, 0.05)
        sim.reset(worlds=[1])
        for _ in range(4):
            mine, theirs = sensor(sim).latest().copy(), sensor(quiet).latest().copy()
            np.testing.assert_array_equal(mine[[0, 2]], theirs[[0, 2]])
            assert (mine[1] != theirs[1]).any()
            for each in (sim, quiet):
                drive(each, 0.09)


def test_a_reading_due_after_a_reset_survives_a_snapshot():
    with simulation("planar", 2) as sim:
        drive(sim, 0.3)
        sensor(sim).read()
        drive(sim, 0.03)
        sim.reset(worlds=[1])
        saved = sim.snapshot()
        first = sensor(sim).latest().copy()
        sim.restore(saved)
        np.testing.assert_array_equal(sensor(sim).latest(), first)
