"""Robots that drive in the first step of a run start as they do with small steps."""

import pytest

from gazelle import assets, formats
from gazelle.simulation import Simulation

SPEED = 0.2  # [m/s]


def driven(name, step, contacts):
    """Return how far a robot is after 0.4 s of a command given before the first step [m]."""
    world = formats.load(assets.world("empty"))
    with Simulation(world, "mujoco", time_step=step) as sim:
        sim.physics.contacts = contacts
        robot = sim.spawn(assets.robot(name))
        robot.inputs["cmd_vel"].send(linear=SPEED)
        sim.run(0.4)
        return robot.position[0, 0]


@pytest.mark.parametrize("contacts", ["fast", "exact"])
@pytest.mark.parametrize("name", ["kobuki", "turtlebot3_burger", "turtlebot3_waffle"])
@pytest.mark.parametrize("step", [0.005, 0.02])
def test_wheels_grip_from_the_first_step_on(step, name, contacts):
    # A step or two pass until the weight presses.
    late = driven(name, 0.001, contacts) - driven(name, step, contacts)
    assert abs(late) < SPEED * (0.002 + 2.2 * step)
