"""Duration of a reset where learning needs it most."""

import time

import pytest

from gazelle.description import Pose
from gazelle.simulation import Simulation


@pytest.mark.parametrize("stage", [1, 2, 3, 4])
def test_a_stage_with_a_robot_resets_in_under_a_millisecond(stage):
    with Simulation(f"turtlebot3_stage_{stage}") as sim:
        sim.spawn("turtlebot3_burger", pose=Pose(-0.7))
        for robot in sim.robots.values():
            for sensor in robot.sensors.values():
                sensor.read()
        spent = []
        for _ in range(25):
            sim.run(seconds=0.01)
            before = time.process_time()
            sim.reset()
            spent.append(time.process_time() - before)
        assert min(spent) < 1e-3
        assert sim.time == 0.0
