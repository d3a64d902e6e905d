"""Rangers of many robots of a Stage file, measured at once: the bits of each alone."""

import numpy as np
import pytest

import gazelle
from gazelle.stage import stage_of

WORLD = """
interval_sim 100
define near ranger ( sensor ( range [ 0 4 ] fov 180 samples 37 {noise} ) )
define far ranger ( sensor ( range [ 0 9 ] fov 90 samples 11 ) )
define robot position ( size [ 0.3 0.3 0.3 ] near ( pose [ 0.1 0 -0.1 0 ] ) )
define other position ( size [ 0.3 0.3 0.3 ] near () far () )
robot ( name "r0" pose [ 0 0 0 0 ] )
other ( name "r1" pose [ 1 1 0 90 ] )
robot ( name "r2" pose [ 2 0 0 180 ] )
model ( size [ 0.2 6 1 ] pose [ 4 0 0 0 ] )
"""


@pytest.fixture(params=["", "noise [ 0.01 0.02 0 ]"])
def yard(request, tmp_path):
    """Return a function that starts the world, with its sensors awake."""
    file = tmp_path / "yard.world"
    file.write_text(WORLD.format(noise=request.param))

    def start(*, together=True):
        sim = gazelle.Simulation(file, engine="planar", nworld=2, seed=5)
        for unit in units(sim):
            if not together:
                unit.system = lambda: None
            unit.latest()
        return sim

    return start


def units(sim):
    return [unit for each in sim.robots.values() for unit in each.sensors.values()]


def told(sim):
    return [(each.read(1).stamp, each.latest().tobytes()) for each in units(sim)]


def lived(sim):
    """Run while one is heard, and a robot comes and goes."""
    found, heard = [], []
    for robot in ("r0", "r1", "r2"):
        sim.robots[robot].inputs["cmd_vel"].send(0.3, 0.2)
    sim.step(3)
    found.append(told(sim))
    end = units(sim)[1].subscribe(lambda unit: heard.append(unit.latest().tobytes()))
    sim.step(2)
    end()
    found.append(told(sim))
    sim.delete("r1")
    sim.step(2)
    found.append(told(sim))
    sim.reset(worlds=[1])
    return [*found, told(sim), heard]


def test_together_they_measure_what_each_measures_alone(yard):
    with yard() as one, yard(together=False) as other:
        assert lived(one) == lived(other)


def test_a_reading_is_the_scan_of_its_robot_and_stays_as_it_is(yard):
    with yard() as sim:
        sim.step(2)
        seen, reach = stage_of(sim).scan_of("r2"), 4.0
        reading = sim.robots["r2"].sensors["ranger:0"].read().ranges
        assert np.array_equal(np.minimum(reading, reach), seen)
        assert np.isinf(reading[seen == reach]).all()
        kept = reading.copy()
        sim.robots["r2"].set_pose((0.0, 0.0, 0.0), yaw=0.0)
        sim.step(3)
        assert np.array_equal(reading, kept)
        assert not np.array_equal(sim.robots["r2"].sensors["ranger:0"].read().ranges, kept)
