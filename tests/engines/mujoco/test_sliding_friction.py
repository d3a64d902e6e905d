"""Sliding bodies stay down, upright and on course, and stop by Coulomb's friction.

Semi-implicit Euler moves a body by the velocity at the end of each step: what slows down falls
short of the closed form by half a step, v h / 2, and what speeds up gains as much. That much, and
no more, is left out of the errors here.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
import scenes

from gazelle.description import (
    Bounce,
    Box,
    Capsule,
    Collision,
    Cylinder,
    Joint,
    JointAxis,
    Link,
    Model,
    Pose,
)
from gazelle.engines import make_engine
from gazelle.engines.laws import with_profile

G = 9.8
STEPS = (0.0005, 0.001, 0.002, 0.004, 0.005)
MODELS = ("cone_model", "pyramid_model")
HEADINGS = np.array([0.0, 0.3, math.pi / 4.0, 2.0])
SIZE = (0.2, 0.2, 0.1)


def make(model, step, *models, gravity=(0.0, 0.0, -G), nworld=1, threads=None):
    world = scenes.world(scenes.ground(), *models, step=step, gravity=gravity)
    ode = replace(world.profile.ode, friction_model=model)
    world = with_profile(world, replace(world.profile, ode=ode))
    return make_engine("mujoco", world, nworld, threads=threads)


def watch(engine, name, seconds):
    """Return distance, largest rise, largest lean, in every world."""
    start = engine.models[name].placement().position.copy()
    rise, lean = np.zeros(len(start)), np.zeros(len(start))
    for _ in range(round(seconds / engine.time_step / 5) + 1):
        engine.step(5)
        place = engine.models[name].placement()
        rise = np.maximum(rise, place.position[:, 2] - start[:, 2])
        lean = np.maximum(lean, 2.0 * np.hypot(*place.quaternion[:, :2].T))
    return place.position - start, rise, lean


def throw(engine, name, speed, headings):
    zero = np.zeros_like(headings)
    velocity = speed * np.stack((np.cos(headings), np.sin(headings), zero), axis=1)
    engine.models[name].set_motion(velocity, np.zeros((len(headings), 3)))


@pytest.mark.parametrize("mu", [0.1, 0.5, 1.0, 1.5])
@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("model", MODELS)
def test_a_thrown_box_slides_flat_and_stops_where_it_should(model, step, mu):
    box = scenes.box("box", SIZE, mu=mu, pose=Pose(z=0.05, yaw=0.2))
    engine = make(model, step, box, nworld=4, threads=1)
    engine.step(round(0.3 / step))
    speed = 4.0 if mu > 0.3 else 2.0
    throw(engine, "box", speed, HEADINGS)
    way, rise, lean = watch(engine, "box", speed / (mu * G) + 0.2)
    assert rise.max() < 1e-4
    assert lean.max() < 0.002
    far = speed**2 / (2.0 * mu * G)
    assert np.hypot(*way[:, :2].T) + speed * step / 2.0 == pytest.approx(far, rel=0.005)
    aside = way[:, 1] * np.cos(HEADINGS) - way[:, 0] * np.sin(HEADINGS)
    assert np.abs(aside).max() < 0.002 * far


@pytest.mark.parametrize("mu", [0.3, 0.6, 1.5])
@pytest.mark.parametrize(("model", "step"), [(m, h) for m in MODELS for h in (0.001, 0.004)])
@pytest.mark.parametrize("steepness", [1.1, 1.5])
def test_a_box_slides_down_a_slope_as_fast_as_it_should(model, step, mu, steepness):
    angle, seconds = steepness * math.atan(mu), 1.5
    gravity = (G * math.sin(angle), 0.0, -G * math.cos(angle))
    box = scenes.box("box", SIZE, mu=mu, pose=Pose(z=0.05, yaw=0.4))
    engine = make(model, step, box, gravity=gravity)
    way, rise, lean = watch(engine, "box", seconds)
    pull = G * (math.sin(angle) - mu * math.cos(angle))
    seconds = round(seconds / step / 5 + 1) * 5 * step
    far = pull * seconds**2 / 2.0
    assert rise[0] < 1e-4
    assert lean[0] < 0.002
    assert way[0, 0] == pytest.approx(far * (1.0 + step / seconds), rel=0.01)


def slope_of(kind, across, pitch):
    """Return tilted ground, and a place on its surface without round numbers."""
    pose = Pose(x=3.7, z=1.1, yaw=across) * Pose(pitch=pitch)
    if kind == "plane":
        return replace(scenes.ground(), pose=pose), pose
    block = scenes.box("slope", (20.0, 20.0, 1.0), mu=100.0, pose=pose * Pose(z=-0.5), static=True)
    return block, pose


@pytest.mark.parametrize(("mu", "steepness"), [(0.1, 1.1), (0.6, 1.1), (1.5, 1.1), (1.5, 1.5)])
@pytest.mark.parametrize("step", [0.0005, 0.002, 0.005])
@pytest.mark.parametrize("model", MODELS)
def test_a_box_put_on_tilted_ground_slides_from_its_first_step_on(model, step, mu, steepness):
    angle, seconds = steepness * math.atan(mu), 1.5
    for kind, across, turned in (("plane", 0.0, 0.4), ("plane", 0.7, 1.1), ("block", 0.7, 0.4)):
        ground, place = slope_of(kind, across, angle)
        box = scenes.box("box", SIZE, mu=mu, pose=place * Pose(z=0.05, yaw=turned))
        world = scenes.world(ground, box, step=step)
        ode = replace(world.profile.ode, friction_model=model)
        engine = make_engine("mujoco", with_profile(world, replace(world.profile, ode=ode)), 1)
        start, rise = engine.models["box"].placement().position[0].copy(), 0.0
        for _ in range(round(seconds / step / 5)):
            engine.step(5)
            way = place.matrix()[:3, :3].T @ (engine.models["box"].placement().position[0] - start)
            rise = max(rise, way[2])
        pull = G * (math.sin(angle) - mu * math.cos(angle))
        far = pull * seconds**2 / 2.0 * (1.0 + step / seconds)
        assert rise < 1e-4
        assert way[0] == pytest.approx(far, rel=0.01)
        assert abs(way[1]) < 2e-4 * (1.0 + far)


def resting(kind, mu, place):
    """Return a free body that stands on a surface, in its frame."""
    if kind == "capsule":
        shape, high, moments = Capsule(0.05, 0.4), 0.05, (0.02, 0.02, 0.00125)
        return scenes.solid(
            "m", shape, moments=moments, mu=mu, pose=place * Pose(z=high, pitch=math.pi / 2.0)
        )
    if kind == "cylinder":
        shape, high, moments = Cylinder(0.1, 0.06), 0.03, (0.0028, 0.0028, 0.005)
        return scenes.solid("m", shape, moments=moments, mu=mu, pose=place * Pose(z=high))
    size = {"box": SIZE, "rod": (1.0, 0.05, 0.05), "crumb": (0.02, 0.03, 0.01)}[kind]
    return scenes.box("m", size, mu=mu, pose=place * Pose(z=size[2] / 2.0, yaw=0.4))


@pytest.mark.parametrize("steepness", [1.005, 1.01, 1.2])
@pytest.mark.parametrize("mu", [0.1, 0.3, 1.0])
@pytest.mark.parametrize("step", [0.001, 0.005])
@pytest.mark.parametrize(
    ("model", "kind"),
    [(m, k) for m in MODELS for k in ("box", "rod", "crumb", "capsule")]
    + [("cone_model", "cylinder")],
)
def test_what_just_slides_has_all_of_its_friction(model, kind, step, mu, steepness):
    """A slope 0.5 % above the threshold tells 0.01 % of the friction, of which 0.3 % went.

    Compared with semi-implicit Euler's own a h² n (n + 1) / 2, so that integration is no error. What
    is left is the first step or two, in which a cone holds.
    """
    angle, count = math.atan(steepness * mu), round(2.0 / step)
    ground, place = slope_of("block", 0.7, angle)
    world = scenes.world(ground, resting(kind, mu, place), step=step)
    ode = replace(world.profile.ode, friction_model=model)
    engine = make_engine("mujoco", with_profile(world, replace(world.profile, ode=ode)), 1)
    start = engine.models["m"].placement().position[0].copy()
    engine.step(count)
    way = place.matrix()[:3, :3].T @ (engine.models["m"].placement().position[0] - start)
    pull = G * (math.sin(angle) - mu * math.cos(angle))
    assert way[0] == pytest.approx(pull * step**2 * count * (count + 1) / 2.0, rel=0.02)
    assert np.abs(way[1:]).max() < 1e-4


@pytest.mark.parametrize("speed", [0.001, 0.005, 0.02])
@pytest.mark.parametrize("mu", [0.3, 1.0])
@pytest.mark.parametrize("step", [0.001, 0.005])
@pytest.mark.parametrize("model", MODELS)
def test_what_is_pushed_slowly_rubs_with_all_of_its_friction(model, step, mu, speed):
    """It lost up to half of it: what rises by mu times its slip comes off the ground for a while."""
    shape = Collision("c", Box((0.1, 0.1, 0.02)), surface=scenes.rubber(0.0))
    links = (Link("f", pose=Pose(x=-0.15, z=0.03), collisions=(shape,)),)
    slide = Joint("j", "prismatic", "world", "f", axes=(JointAxis((1.0, 0.0, 0.0)),))
    pusher = Model("p", links=links, joints=(slide,))
    engine = make(model, step, pusher, scenes.box("box", SIZE, mu=mu, pose=Pose(z=0.05)))
    engine.add_motor("p::j", 100.0)
    engine.joints["p::j"].set_motor_velocity(speed)
    engine.step(round(0.5 / step))
    forces = []
    for _ in range(round(0.2 / step)):
        engine.step()
        forces.append(float(np.abs(engine.contacts([["p::f::c"]]).named().force[:, 0].sum())))
    assert np.mean(forces) == pytest.approx(mu * G, rel=0.005)


@pytest.mark.parametrize("mu", [0.1, 0.6, 1.5])
@pytest.mark.parametrize(("model", "step"), [(m, h) for m in MODELS for h in (0.001, 0.005)])
def test_a_spinning_disc_stays_down_and_stops_where_it_should(model, step, mu):
    radius, height, spin = 0.1, 0.04, 20.0
    moment = radius**2 / 2.0
    shape = Cylinder(radius, height)
    moments = (moment / 2.0 + height**2 / 12.0,) * 2 + (moment,)
    disc = scenes.solid("disc", shape, moments=moments, mu=mu, pose=Pose(z=height / 2.0))
    engine = make(model, step, disc)
    engine.step(round(0.3 / step))
    engine.models["disc"].set_motion((0.0, 0.0, 0.0), (0.0, 0.0, spin))
    turned, highest, start = 0.0, 0.0, engine.models["disc"].placement().position[0, 2]
    slowing = mu * G * radius / moment  # all that presses presses at the rim
    for _ in range(round((spin / slowing + 0.2) / step)):
        engine.step()
        turned += engine.links["disc::link"].motion().angular[0, 2] * step
        highest = max(highest, engine.models["disc"].placement().position[0, 2] - start)
    assert highest < 2e-4
    far = spin**2 / (2.0 * slowing)
    assert turned == pytest.approx(far - spin * step / 2.0, rel=0.02)
    assert np.abs(engine.models["disc"].placement().position[0, :2]).max() < 1e-4


@pytest.mark.parametrize(("model", "step"), [(m, h) for m in MODELS for h in (0.001, 0.005)])
def test_a_thrown_ball_comes_to_roll_without_hopping(model, step):
    engine = make(model, step, scenes.ball(mu=0.4, pose=Pose(z=0.1)), nworld=4, threads=1)
    engine.step(round(0.3 / step))
    throw(engine, "ball", 3.0, HEADINGS)
    _, rise, _ = watch(engine, "ball", 2.0 / 7.0 * 3.0 / (0.4 * G) + 0.1)
    motion = engine.links["ball::link"].motion().linear
    assert np.hypot(*motion[:, :2].T) == pytest.approx(3.0 * 5.0 / 7.0, rel=0.005)
    assert rise.max() < 1e-4


@pytest.mark.parametrize("model", MODELS)
def test_what_lands_in_a_slide_loses_mu_times_its_fall(model):
    mu, fall, speed = 0.6, 0.05, 3.0
    box = scenes.box("box", SIZE, mu=mu, pose=Pose(z=0.05 + fall))
    engine = make(model, 0.001, box, nworld=4, threads=1)
    throw(engine, "box", speed, HEADINGS)
    engine.step(round(math.sqrt(2.0 * fall / G) / 0.001) + 10)
    down = engine.models["box"].placement().position.copy()
    _, rise, lean = watch(engine, "box", speed / (mu * G))
    assert (down[:, 2] + rise).max() < 0.05 + 1e-4
    assert lean.max() < 0.002
    sink = math.sqrt(2.0 * G * fall)
    far = speed * sink / G + (speed - mu * sink) ** 2 / (2.0 * mu * G)
    way = engine.models["box"].placement().position
    assert np.hypot(*way[:, :2].T) == pytest.approx(far, rel=0.01)
    assert np.abs(down[:, 2] - 0.05).max() < 5e-4


@pytest.mark.parametrize("count", [2, 40])
def test_many_boxes_slide_as_one(count):
    """Forty have a sparse Jacobian; every second one carries another that goes with it."""
    mu, speed = 0.5, 2.0
    boxes = [scenes.box(f"b{i}", SIZE, mu=mu, pose=Pose(y=0.5 * i, z=0.05)) for i in range(count)]
    riders = [
        scenes.box(f"r{i}", SIZE, mu=1.0, pose=Pose(y=0.5 * i, z=0.15)) for i in range(0, count, 2)
    ]
    engine = make("cone_model", 0.001, *boxes, *riders)
    engine.step(200)
    for model in (*boxes, *riders):
        engine.models[model.name].set_motion((speed, 0.0, 0.0), (0.0, 0.0, 0.0))
    before = {
        m.name: engine.models[m.name].placement().position[0].copy() for m in (*boxes, *riders)
    }
    engine.step(round(speed / (mu * G) / 0.001) + 200)
    for model in (*boxes, *riders):
        way = engine.models[model.name].placement().position[0] - before[model.name]
        assert way[0] == pytest.approx(speed**2 / (2.0 * mu * G), rel=0.01), model.name
        assert np.abs(way[1:]).max() < 1e-3, model.name


def test_a_tall_box_tips_over_where_it_must():
    """Pushed by friction below its centre: it stays up for mu < width / height and falls above."""
    for mu, falls in ((0.3, False), (0.8, True)):
        box = scenes.box("box", (0.1, 0.1, 0.2), mu=mu, pose=Pose(z=0.1))
        engine = make("cone_model", 0.001, box)
        engine.step(200)
        throw(engine, "box", 3.0, np.zeros(1))
        _, _, lean = watch(engine, "box", 1.5)
        assert (lean[0] > 1.0) == falls


def test_a_slide_has_the_same_bits_at_any_number_of_threads_and_worlds():
    states = []
    for model in MODELS:
        for nworld, threads in ((1, 1), (8, 1), (8, 3)):
            shape = Cylinder(0.1, 0.05)
            disc = scenes.solid("disc", shape, mu=0.4, pose=Pose(x=0.5, z=0.2, roll=0.5))
            box = scenes.box("box", SIZE, mu=0.7, pose=Pose(z=0.05))
            engine = make(model, 0.002, box, disc, nworld=nworld, threads=threads)
            engine.models["box"].set_motion((2.0, 0.4, 0.0), (0.0, 0.0, 3.0))
            engine.models["disc"].set_motion((1.0, 0.4, 0.0), (0.0, 0.0, 30.0))
            engine.step(500)
            states.append(engine.snapshot()[-1])
    for state in (states[1], states[2]):
        np.testing.assert_array_equal(states[0], state)
    for state in (states[4], states[5]):
        np.testing.assert_array_equal(states[3], state)


def test_a_bounce_aslant_keeps_its_height():
    """Friction that stops the slip in the impact takes nothing off the bounce."""
    ball = scenes.ball(pose=Pose(z=0.5))
    surface = replace(ball.links[0].collisions[0].surface, bounce=Bounce(0.8, 0.01))
    ball, floor = (scenes.with_surface(each, surface) for each in (ball, scenes.ground()))
    engine = make_engine("mujoco", scenes.world(floor, ball), 2)
    engine.models["ball"].set_motion(np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]), np.zeros((2, 3)))
    engine.step(300)
    heights = np.zeros(2)
    for _ in range(400):
        engine.step()
        heights = np.maximum(heights, engine.models["ball"].placement().position[:, 2] - 0.1)
    assert heights == pytest.approx(0.4 * 0.64, rel=0.02)
