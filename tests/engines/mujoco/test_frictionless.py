"""Surfaces without friction: robots on them stay calm, and things slide for ever."""

from dataclasses import replace

import numpy as np
import pytest
import scenes

from gazelle.description import Collision, Pose, Sphere
from gazelle.engines import make_engine
from gazelle.engines.laws import with_profile

MODELS = ("pyramid_model", "cone_model")


def on_casters(mu):
    """Return a cart with a caster at each corner, more than can bear at once."""
    made = scenes.cart(0.04, mu=1.0)
    balls = tuple(
        Collision(f"caster{i}", Sphere(0.02), Pose(x, y, 0.02), scenes.rubber(mu))
        for i, (x, y) in enumerate(((-0.3, 0.2), (-0.3, -0.2), (0.3, 0.2), (0.3, -0.2)))
    )
    return replace(made, links=(replace(made.links[0], collisions=balls), *made.links[1:]))


def engine_of(*models, step=0.001, friction="pyramid_model", nworld=1):
    world = scenes.world(scenes.ground(), *models, step=step)
    ode = replace(world.profile.ode, friction_model=friction)
    return make_engine("mujoco", with_profile(world, replace(world.profile, ode=ode)), nworld)


@pytest.mark.parametrize("friction", MODELS)
@pytest.mark.parametrize("step", [0.001, 0.005])
@pytest.mark.parametrize("mu", [0.0, 1e-9, 1e-6, 1e-4, 1e-3, 0.01])
def test_a_robot_on_slippery_casters_drives_calmly(mu, step, friction):
    engine = engine_of(on_casters(mu), step=step, friction=friction)
    for side in ("left", "right"):
        engine.add_motor(f"cart::{side}_joint", 50.0)
        engine.joints[f"cart::{side}_joint"].set_motor_velocity(5.0)
    highest = 0.0
    for _ in range(60):
        engine.step(round(0.05 / step))
        highest = max(highest, abs(engine.links["cart::base"].placement().position[0, 2]))
    assert highest < 0.003
    where = engine.links["cart::base"].placement().position[0]
    assert where[0] > 1.4
    assert abs(where[1]) < 1e-3


@pytest.mark.parametrize("friction", MODELS)
def test_what_slides_without_friction_slides_for_ever(friction):
    engine = engine_of(scenes.box(mu=0.0, pose=Pose(z=0.1)), friction=friction)
    engine.step(200)
    engine.models["box"].set_motion((2.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    start = engine.models["box"].placement().position[0].copy()
    engine.step(5000)
    np.testing.assert_allclose(
        engine.models["box"].placement().position[0] - start, (10.0, 5.0, 0.0), atol=1e-4
    )


@pytest.mark.parametrize("friction", MODELS)
def test_each_world_may_have_friction_where_the_file_has_none_and_none_where_it_has(friction):
    boxes = [
        scenes.box(name, mu=mu, pose=Pose(y=y, z=0.1))
        for name, mu, y in (("ice", 0.0, 0.0), ("wood", 0.5, 1.0))
    ]
    engine = engine_of(*boxes, friction=friction, nworld=2)
    for name, values in (("ice", [[0.0], [0.5]]), ("wood", [[0.5], [0.0]])):
        engine.set_parameter("collision_friction", f"{name}::link::c", np.array(values))
    engine.step(200)
    for name in ("ice", "wood"):
        engine.models[name].set_motion((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    engine.step(1000)
    speeds = {n: engine.links[f"{n}::link"].motion().linear[:, 0] for n in ("ice", "wood")}
    np.testing.assert_allclose(speeds["ice"], (1.0, 0.0), atol=1e-3)
    np.testing.assert_allclose(speeds["wood"], (0.0, 1.0), atol=1e-3)
