"""Friction that differs by direction and turns with its body, against closed forms."""

import math
from dataclasses import replace

import numpy as np
import pytest
import scenes

from gazelle.description import (
    Box,
    Capsule,
    Collision,
    Friction,
    Inertia,
    Inertial,
    Link,
    Model,
    Pose,
    Sphere,
    Surface,
    World,
)
from gazelle.engines import make_engine

G = 9.8
SLOPE = 0.3


def rubbing(mu, mu2, fdir1=(0.0, 0.0, 0.0)):
    return Surface(Friction(mu, mu2, fdir1=fdir1))


def one_link(name, *collisions, pose=None):
    inertial = Inertial(1.0, inertia=Inertia(0.05, 0.05, 0.05))
    return Model(
        name, pose=pose or Pose(), links=(Link("link", inertial=inertial, collisions=collisions),)
    )


def on_a_slope(heading):
    down = (G * math.sin(SLOPE) * math.cos(heading), G * math.sin(SLOPE) * math.sin(heading))
    return (*down, -G * math.cos(SLOPE))


def slide(world, nworld=1, yaws=(0.0,)):
    """Return a model's place after a second, and its speed then, by world."""
    engine = make_engine("mujoco", world, nworld=nworld)
    for index, yaw in enumerate(yaws):
        place = engine.models["box"].placement()
        turn = (0.0, 0.0, math.sin(yaw / 2.0), math.cos(yaw / 2.0))
        engine.models["box"].set_placement(place.position[index], turn, np.array([index]))
    engine.step(1000)
    return engine.models["box"].placement().position[:, :2], engine.links[
        "box::link"
    ].motion().linear


BLOCK = [(Box((0.4, 0.4, 0.05)), Pose())]
FEET = [(Sphere(0.025), Pose(x, y)) for x, y in ((0.3, 0.0), (-0.2, 0.25), (-0.2, -0.25))]
RUNNERS = [(Capsule(0.025, 0.3), Pose(y=y, pitch=math.pi / 2.0)) for y in (-0.2, 0.2)]


@pytest.mark.parametrize("shapes", [BLOCK, FEET, RUNNERS])
@pytest.mark.parametrize("fdir1", [(1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 2.0, 0.0)])
def test_a_body_slides_only_across_its_fdir1_however_it_stands(shapes, fdir1):
    """It speeds up by the part of gravity that is across, in each world by its own yaw."""
    parts = []
    for index, (shape, pose) in enumerate(shapes):
        own = tuple((pose.matrix()[:3, :3].T @ np.array(fdir1)).tolist())
        parts.append(Collision(f"c{index}", shape, pose=pose, surface=rubbing(1.0, 0.0, own)))
    body = one_link("box", *parts, pose=Pose(z=0.025))
    yaws = np.array([0.0, 0.4, 1.3, -0.9])
    world = scenes.world(scenes.ground(10.0), body, gravity=on_a_slope(0.2))
    moved, speed = slide(world, 4, yaws)
    heading = math.atan2(fdir1[1], fdir1[0]) + math.pi / 2.0 + yaws
    across = np.stack((np.cos(heading), np.sin(heading)), axis=1)
    pull = G * math.sin(SLOPE) * np.cos(heading - 0.2)
    np.testing.assert_allclose((speed[:, :2] * across).sum(axis=1), pull, rtol=0.01, atol=0.01)
    along = moved[:, 0] * across[:, 1] - moved[:, 1] * across[:, 0]
    assert np.abs(along).max() < 0.005
    np.testing.assert_allclose((moved * across).sum(axis=1), pull / 2.0, rtol=0.02, atol=0.005)


def test_a_runner_leads_a_turning_body_in_a_circle():
    """Held across its runner and free along it, a body goes where its runner points."""
    feet = [(0.2, 0.2), (0.2, -0.2), (-0.2, 0.2), (-0.2, -0.2)]
    smooth = [
        Collision(f"f{i}", Sphere(0.05), Pose(x, y), surface=rubbing(0.0, 0.0))
        for i, (x, y) in enumerate(feet)
    ]
    runner = Collision("runner", Sphere(0.05), surface=rubbing(5.0, 0.0, (0.0, 1.0, 0.0)))
    sleigh = one_link("box", runner, *smooth, pose=Pose(z=0.05))
    engine = make_engine("mujoco", scenes.world(scenes.ground(), sleigh))
    engine.step(100)
    start = engine.models["box"].placement().position[0].copy()
    speed, turning = 0.5, 1.2
    engine.models["box"].set_motion((speed, 0.0, 0.0), (0.0, 0.0, turning))
    for half_seconds in range(1, 9):
        engine.step(500)
        angle = turning * 0.5 * half_seconds
        where = engine.models["box"].placement().position[0] - start
        circle = speed / turning * np.array([math.sin(angle), 1.0 - math.cos(angle)])
        np.testing.assert_allclose(where[:2], circle, atol=0.012)
    motion = engine.links["box::link"].motion()
    assert np.linalg.norm(motion.linear[0]) == pytest.approx(speed, rel=0.02)


def test_a_direction_oblique_to_the_world_holds_on_what_never_moves():
    floor = scenes.ground()
    link = floor.links[0]
    grooved = rubbing(1.0, 0.0, (math.cos(0.7), math.sin(0.7), 0.0))
    collision = replace(link.collisions[0], surface=grooved)
    floor = replace(floor, links=(replace(link, collisions=(collision,)),))
    block = scenes.box("box", size=(0.4, 0.4, 0.05), mu=10.0, pose=Pose(z=0.025))
    moved, _ = slide(scenes.world(floor, block, gravity=on_a_slope(0.2)))
    heading = 0.7 + math.pi / 2.0
    pull = G * math.sin(SLOPE) * math.cos(heading - 0.2)
    expected = pull / 2.0 * np.array([math.cos(heading), math.sin(heading)])
    np.testing.assert_allclose(moved[0], expected, atol=0.01)


def test_without_fdir1_the_first_direction_on_a_wall_is_level():
    """ODE's choice by the normal: on a wall ``mu`` acts along the horizontal."""
    slab = Collision("c", Box((0.2, 4.0, 4.0)), surface=scenes.rubber(10.0))
    wall = Model("wall", static=True, links=(Link("link", collisions=(slab,)),))
    block = one_link(
        "box", Collision("c", Box((0.1, 0.3, 0.3)), surface=rubbing(1.0, 0.0)), pose=Pose(x=0.15)
    )
    for sideways, moves in (((0.0, 3.0), False), ((3.0, 0.0), True)):
        gravity = (-G, sideways[1], sideways[0])
        engine = make_engine("mujoco", scenes.world(wall, block, gravity=gravity))
        engine.step(1000)
        far = np.abs(engine.models["box"].placement().position[0, 1:]).max()
        assert far == pytest.approx(1.5, rel=0.02) if moves else far < 0.005


def test_many_bodies_rub_each_along_its_own_direction():
    """So many that MuJoCo keeps Jacobians without zeros."""
    yaws = np.linspace(0.0, math.pi, 14)
    blocks = [
        scenes.solid(f"b{i}", Box((0.4, 0.4, 0.05)), pose=Pose(float(3 * i), 0.0, 0.025, yaw=yaw))
        for i, yaw in enumerate(yaws.tolist())
    ]
    surface = rubbing(1.0, 0.0, (1.0, 0.0, 0.0))
    models = [
        replace(
            m,
            links=(
                replace(
                    m.links[0], collisions=(replace(m.links[0].collisions[0], surface=surface),)
                ),
            ),
        )
        for m in blocks
    ]
    world: World = scenes.world(scenes.ground(10.0), *models, gravity=on_a_slope(0.2))
    engine = make_engine("mujoco", world)
    engine.step(1000)
    for index, yaw in enumerate(yaws):
        speed = engine.links[f"b{index}::link"].motion().linear[0, :2]
        heading = yaw + math.pi / 2.0
        across = np.array([math.cos(heading), math.sin(heading)])
        pull = G * math.sin(SLOPE) * math.cos(heading - 0.2)
        np.testing.assert_allclose(speed, pull * across, atol=0.02)
