"""The ring of stage 3 turns as fast as the published node turns its loose ring, friction and all."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from gazelle import Simulation, formats

PUSH = 0.5  # what the node sets [rad/s]
OWN = "turtlebot3_stage_3"
PUBLISHED = "ROBOTIS-GIT__turtlebot3_simulations/turtlebot3_gazebo/worlds/turtlebot3_stage_3.world"


def loose(world):
    """Return a world whose ring no plugin moves."""
    models = tuple(dataclasses.replace(model, plugins=()) for model in world.models)
    return dataclasses.replace(world, models=models)


def pushed(world, tick, seconds=20.0):
    """Return the mean rate of a ring [rad/s] that a node pushes every tick [s]."""
    with Simulation(loose(world), time_step=0.001) as simulation:
        ring = simulation.robots["obstacle"]
        simulation.run(0.5)
        total = 0.0
        for _ in range(round(seconds / tick)):
            place = ring.placement()
            ring.set_pose(place.position, place.quaternion)
            ring.set_twist((0, 0, 0), (0, 0, PUSH))
            before = float(ring.yaw[0])
            simulation.run(tick)
            total += math.remainder(float(ring.yaw[0]) - before, 2 * math.pi)
        assert np.abs(ring.position).max() < 0.05
        return total / (round(seconds / tick) * tick)


def scripted():
    """Return the rate of the bundled ring in the planar engine [rad/s]."""
    with Simulation(OWN, engine="planar", time_step=0.02) as simulation:
        simulation.run(10.0)
        return float(simulation.robots["obstacle"].yaw[0]) / 10.0


@pytest.mark.long
def test_the_ring_turns_as_fast_as_a_loose_one_that_is_pushed_every_tenth_of_a_second():
    # A node sleeps for 0.1 s of wall time and then waits for a message: 0.10 to 0.11 s.
    slow, fast = pushed(formats.load(OWN), 0.11), pushed(formats.load(OWN), 0.1)
    assert 0.95 * slow < scripted() < 1.05 * fast


def test_the_pushed_ring_turns_as_far_as_friction_lets_it():
    """Coulomb: it stops within PUSH² I / (2 mu m g r), in a tenth of a second; a pyramid of
    friction, as Gazebo's, is up to sqrt 2 stronger."""
    torque = 1.0 * 1.0 * 9.8 * math.hypot(0.6, 0.6)
    most = PUSH**2 * 1.0 / (2.0 * torque) / 0.1
    assert most / math.sqrt(2.0) < pushed(formats.load(OWN), 0.1) < 1.01 * most


@pytest.mark.long
@pytest.mark.corpus
def test_the_published_world_has_the_same_ring(corpus, monkeypatch):
    file = corpus / PUBLISHED
    monkeypatch.setenv("GAZEBO_MODEL_PATH", str(file.parents[1] / "models"))
    assert pushed(formats.load(file), 0.1) == pytest.approx(
        pushed(formats.load(OWN), 0.1), rel=0.01
    )
