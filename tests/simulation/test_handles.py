"""Handles of models, links and joints."""

import math

import numpy as np
import pytest
import scenes

from gazelle.description import Pose
from gazelle.errors import SimulationError
from gazelle.rotations import from_yaw, yaw_of
from gazelle.simulation import Simulation


@pytest.fixture
def sim():
    with Simulation(scenes.world(scenes.ground(), scenes.box(pose=Pose(z=0.1))), nworld=2) as made:
        yield made


@pytest.mark.parametrize("who", ["robot", "link"])
def test_robots_and_links_read_headings_and_quaternions_alike(sim, who):
    robot = sim.robots["box"]
    thing = robot if who == "robot" else robot.links["link"]
    thing.set_pose((0.0, 0.0, 0.1), yaw=[0.4, -0.7])
    np.testing.assert_allclose(yaw_of(robot.quaternion), [0.4, -0.7])
    thing.set_pose((0.0, 0.0, 0.1), from_yaw(np.array(1.1)), worlds=np.array([1]))
    np.testing.assert_allclose(yaw_of(robot.quaternion), [0.4, 1.1])
    thing.set_pose((1.0, 0.0, 0.1))
    np.testing.assert_allclose(robot.yaw, 0.0)
    with pytest.raises(SimulationError, match="not both"):
        thing.set_pose((0.0, 0.0, 0.1), (0, 0, 0, 1), yaw=0.3)


def test_friction_of_single_worlds_counts_above_ten():
    """Gravity leans so far that a coefficient of 14.3 is needed to stay."""
    slab = scenes.box(size=(0.6, 0.6, 0.02), pose=Pose(z=0.01), mu=50.0)
    world = scenes.world(scenes.ground(mu=100.0), slab)
    with Simulation(world, nworld=3) as sim:
        sim.run(seconds=0.2)
        sim.engine.set_parameter("collision_friction", "box::link::c", [[12.0], [20.0], [60.0]])
        lean = math.radians(86.0)
        sim.physics.set(gravity=(9.8 * math.sin(lean), 0.0, -9.8 * math.cos(lean)))
        sim.run(seconds=0.3)
        moved = sim.robots["box"].position[:, 0]
    assert moved[0] > 0.02
    np.testing.assert_allclose(moved[1:], 0.0, atol=0.01)
