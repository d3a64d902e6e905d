"""The lift."""

import numpy as np
import pytest

import gazelle
from gazelle.errors import SimulationError


def heights(sim):
    return sim.robots["elevator"].joints["lift"].positions()[:, 0]


@pytest.mark.long
def test_it_goes_to_a_floor_opens_waits_and_closes():
    with gazelle.Simulation("elevator_ros", nworld=2) as sim:
        robot = sim.robots["elevator"]
        call = robot.inputs["elevator"]
        assert call.topic == "/elevator"
        call.send("2", np.array([1]))
        door = robot.joints["door"]
        opened = np.zeros(2)
        for _ in range(16):
            sim.run(seconds=0.5)
            opened = np.maximum(opened, door.positions()[:, 0])
        assert heights(sim) == pytest.approx([0.0, 6.0], abs=0.16)
        assert opened[1] > 0.9
        assert opened[0] < 0.1
        # Busy: the door is open, so what is asked now is lost.
        call.send("1")
        sim.run(seconds=8.0)
        assert heights(sim) == pytest.approx([3.0, 6.0], abs=0.16)
        assert door.positions()[1, 0] < 0.06


def test_a_snapshot_goes_on_and_a_reset_starts_over():
    with gazelle.Simulation("elevator_ros") as sim:
        sim.robots["elevator"].inputs["elevator"].send("1")
        sim.run(seconds=1.0)
        state = sim.snapshot()
        sim.run(seconds=1.0)
        expected = heights(sim)
        sim.restore(state)
        sim.run(seconds=1.0)
        assert heights(sim) == pytest.approx(expected, abs=1e-9)
        sim.reset()
        sim.run(seconds=1.0)
        assert heights(sim) == pytest.approx(0.0, abs=0.05)


def test_a_floor_is_a_number():
    with (
        gazelle.Simulation("elevator_ros") as sim,
        pytest.raises(SimulationError, match="attic"),
    ):
        sim.robots["elevator"].inputs["elevator"].send("attic")
