"""It does not matter how many steps are made at once: n steps are n times one step, to the bit."""

import pytest

import gazelle
from gazelle import Pose
from gazelle.description import Physics, World

PIECES = ([120], [1] * 120, [7] * 17 + [1], [40] * 3)


def final_hash(engine, world, pieces, prepare):
    with gazelle.Simulation(world, engine, nworld=2, threads=1) as sim:
        prepare(sim)
        for count in pieces:
            sim.engine.step(count)
        return sim.state_hash()


def burger(sim):
    """Place the burger with its caster a little in the ground."""
    sim.spawn("turtlebot3_burger", name="r", pose=Pose(x=-2.0, y=-0.5))
    sim.robots["r"].inputs["cmd_vel"].send(0.2, 0.7)
    sim.step(1)


def efforts(sim):
    sim.spawn("turtlebot3_burger", name="r")
    sim.robots["r"].joints["wheel_left_joint"].effort = 0.02


def slip(sim):
    sim.spawn("turtlebot3_burger", name="r")
    for side in ("left", "right"):
        sim.engine.set_parameter("wheel_slip", f"r::wheel_{side}_link", [0.5, 0.1])
    sim.robots["r"].inputs["cmd_vel"].send(0.3, 0.5)
    sim.step(1)


def deep(sim):
    """Reset one of two worlds in the middle of penetration recovery."""
    sim.spawn("turtlebot3_burger", name="r", pose=Pose(z=-0.05))
    sim.step(3)
    sim.reset([1])


def gust(sim):
    burger(sim)
    sim.physics.wind = (3.0, 0.0, 0.0)


@pytest.mark.parametrize("prepare", [burger, efforts, slip, deep, gust])
@pytest.mark.parametrize("world", ["empty", "turtlebot3_world"])
def test_steps_of_mujoco(world, prepare):
    assert len({final_hash("mujoco", world, pieces, prepare) for pieces in PIECES}) == 1


def test_steps_of_much_that_lies_loose():
    assert len({final_hash("mujoco", "rubble", pieces, lambda _: None) for pieces in PIECES}) == 1


@pytest.mark.parametrize("world", ["empty", "turtlebot3_world"])
def test_steps_of_the_plane(world):
    assert len({final_hash("planar", world, pieces, burger) for pieces in PIECES}) == 1


@pytest.mark.parametrize("integrator", ["euler", "rk4"])
def test_steps_of_integrators(integrator):
    world = World("w", physics=(Physics(integrator=integrator),))
    hashes = {final_hash("mujoco", world, pieces, deep) for pieces in PIECES}
    assert len(hashes) == 1
