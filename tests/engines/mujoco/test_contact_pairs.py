"""Bouncing and springy contacts against closed-form mechanics."""

import dataclasses
import math

import numpy as np
import pytest
import scenes

from gazelle.description import (
    Bounce,
    Box,
    Collision,
    Contact,
    Friction,
    Link,
    Model,
    Pose,
    Surface,
)
from gazelle.engines import make_engine
from gazelle.rotations import rotate

G = 9.8


def with_surface(model, surface):
    link = model.links[0]
    collisions = tuple(dataclasses.replace(c, surface=surface) for c in link.collisions)
    return dataclasses.replace(model, links=(dataclasses.replace(link, collisions=collisions),))


def bouncy(e, threshold=0.01):
    return Surface(bounce=Bounce(e, threshold))


def drop(
    e_ball, e_ground, height=1.0, *, step=0.001, threshold=0.01, mass=1.0, size=0.1, box=False
):
    """Return the height of the bottom of a ball, or a flat box, at the top of its first bounce."""
    start = Pose(z=size + height, yaw=0.3)
    if box:
        body = scenes.box("ball", size=(2.0 * size,) * 3, mass=mass, pose=start)
    else:
        body = scenes.ball(radius=size, mass=mass, pose=start)
    body = with_surface(body, bouncy(e_ball, threshold))
    floor = with_surface(scenes.ground(), bouncy(e_ground, threshold))
    engine = make_engine("mujoco", scenes.world(floor, body, step=step))
    fall = math.sqrt(2.0 * height / G) / step
    engine.step(round(0.95 * fall))
    heights = []
    for _ in range(round((0.1 + 1.9 * min(e_ball, e_ground)) * fall)):
        engine.step()
        heights.append(engine.models["ball"].placement().position[0, 2] - size)
    low = int(np.argmin(heights[: round(0.07 * fall) + 1]))
    return max(heights[low:])


@pytest.mark.parametrize("box", [False, True])
@pytest.mark.parametrize("step", [0.0005, 0.001, 0.002])
@pytest.mark.parametrize("e", [0.1, 0.2, 0.3, 0.5, 0.65, 0.8, 0.95])
def test_every_body_bounces_to_e_squared_of_its_height(e, step, box):
    heights = np.geomspace(0.1, 5.0, 7)
    errors = [drop(e, e, h, step=step, box=box) / (e * e * h) - 1.0 for h in heights.tolist()]
    assert np.abs(errors).max() < 0.01


@pytest.mark.parametrize("e", [0.1, 0.3, 0.95])
@pytest.mark.parametrize("height", [0.1, 1.0, 5.0])
def test_a_bounce_seen_ahead_is_as_high(e, height):
    """A small fast body, whose contacts are looked for on its way."""
    reached = drop(e, e, height, step=0.002, size=0.004)
    assert reached == pytest.approx(e * e * height, rel=0.01)


@pytest.mark.parametrize("mass", [0.01, 100.0])
def test_a_bounce_does_not_depend_on_mass(mass):
    assert drop(0.6, 0.7, mass=mass) == pytest.approx(0.36, rel=0.01)


@pytest.mark.parametrize("e", [0.2, 0.7])
def test_a_corner_that_strikes_parts_at_e_times_its_speed(e):
    """A box that falls on a corner: what is left of its speed there, along the normal."""
    tilt = Pose(z=1.2, roll=0.5, pitch=0.4)
    box = with_surface(
        scenes.box("box", pose=tilt), Surface(Friction(0.0, 0.0), bounce=Bounce(e, 0.01))
    )
    floor = with_surface(scenes.ground(), bouncy(e))
    engine = make_engine("mujoco", scenes.world(floor, box))
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * 0.1
    lowest = corners[np.argmin((corners @ tilt.matrix()[:3, :3].T)[:, 2])]

    struck, parted = 0.0, -1.0
    while parted <= 0.0:
        arm = rotate(engine.models["box"].placement().quaternion[0], lowest)
        struck = speed_of(engine, arm)
        engine.step()
        parted = speed_of(engine, arm)
    assert parted == pytest.approx(-e * struck, abs=0.05)


def speed_of(engine, arm):
    """Return the upward speed of a point of the box."""
    motion = engine.links["box::link"].motion()
    return float((motion.linear[0] + np.cross(motion.angular[0], arm))[2])


def test_what_bounces_also_comes_to_rest_and_stays_up():
    box = with_surface(scenes.box(pose=Pose(z=0.4)), bouncy(0.5))
    floor = with_surface(scenes.ground(), bouncy(0.5))
    engine = make_engine("mujoco", scenes.world(floor, box))
    engine.step(60_000)
    assert engine.models["box"].placement().position[0, 2] == pytest.approx(0.1, abs=5e-4)
    assert np.abs(engine.models["box"].placement().position[0, :2]).max() < 1e-3
    assert np.linalg.norm(engine.links["box::link"].motion().linear) < 1e-4


def test_two_balls_part_at_e_times_the_speed_they_met_with():
    heavy = with_surface(scenes.ball("heavy", mass=3.0, pose=Pose(x=-0.3)), bouncy(0.7))
    light = with_surface(scenes.ball("light", mass=1.0, pose=Pose(x=0.3)), bouncy(0.7))
    engine = make_engine("mujoco", scenes.world(heavy, light, gravity=(0.0, 0.0, 0.0)))
    engine.models["heavy"].set_motion((2.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    engine.models["light"].set_motion((-1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    engine.step(1000)
    heavy, light = (engine.links[f"{n}::link"].motion().linear[0, 0] for n in ("heavy", "light"))
    assert light - heavy == pytest.approx(0.7 * 3.0, rel=1e-3)
    assert 3.0 * heavy + light == pytest.approx(5.0, rel=1e-9)


def test_what_rubs_does_not_bounce_back_sideways():
    ball = with_surface(scenes.ball(pose=Pose(z=0.5)), bouncy(0.9))
    floor = with_surface(scenes.ground(), bouncy(0.9))
    engine = make_engine("mujoco", scenes.world(floor, ball))
    engine.models["ball"].set_motion((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    engine.step(400)
    motion = engine.links["ball::link"].motion()
    assert motion.linear[0, 2] > 1.0  # it has bounced
    # Friction brings it to roll: 5/7 of its speed.
    assert motion.linear[0, 0] == pytest.approx(5.0 / 7.0, rel=0.02)


def test_the_smaller_coefficient_counts():
    assert drop(0.9, 0.5) == pytest.approx(0.25, rel=0.01)
    assert drop(0.9, 0.0) < 0.01


def test_a_threshold_above_all_speeds_means_no_bounce_as_in_most_files():
    assert drop(0.9, 0.9, threshold=100000.0) < 0.01


@pytest.mark.parametrize("mu", [0.0, 0.1, 0.6, 1.0])
@pytest.mark.parametrize(("kp", "mass"), [(1000.0, 1.0), (5000.0, 10.0), (300.0, 2.0)])
def test_a_body_sinks_m_g_over_kp_into_a_spring(kp, mass, mu):
    soft = Surface(Friction(mu, mu), Contact(kp=kp, kd=2.0 * math.sqrt(kp * mass)))
    ball = with_surface(scenes.ball(radius=0.3, mass=mass, pose=Pose(z=0.3)), soft)
    engine = make_engine("mujoco", scenes.world(scenes.ground(mu=10.0), ball))
    engine.step(6000)
    depth = 0.3 - engine.models["ball"].placement().position[0, 2]
    assert depth == pytest.approx(mass * G / kp, rel=0.05)


def test_a_springy_body_swings_at_its_frequency():
    kp, mass = 2000.0, 1.0
    soft = Surface(Friction(0.0, 0.0), Contact(kp=kp, kd=1.0))
    start = 0.3 - 1.6 * mass * G / kp
    ball = with_surface(scenes.ball(radius=0.3, mass=mass, pose=Pose(z=start)), soft)
    engine = make_engine("mujoco", scenes.world(scenes.ground(), ball))
    heights = []
    for _ in range(1500):
        engine.step()
        heights.append(engine.models["ball"].placement().position[0, 2])
    level = 0.3 - mass * G / kp
    ups = [i for i in range(1, 1500) if heights[i - 1] < level <= heights[i]]
    period = (ups[5] - ups[0]) / 5 * 0.001
    assert period == pytest.approx(2 * math.pi * math.sqrt(mass / kp), rel=0.05)


@pytest.mark.parametrize("mu", [0.1, 0.5, 1.0])
@pytest.mark.parametrize(("kp", "kd", "step"), [(2000.0, 90.0, 0.001), (5e5, 10.0, 0.00025)])
def test_friction_on_a_spring_is_as_rigid_as_elsewhere(kp, kd, step, mu):
    soft = Surface(Friction(mu, mu), Contact(kp=kp, kd=kd))
    block = with_surface(scenes.box(size=(0.4, 0.4, 0.1), pose=Pose(z=0.05)), soft)
    engine = make_engine("mujoco", scenes.world(scenes.ground(), block, step=step))
    engine.step(round(0.5 / step))
    start = engine.models["box"].placement().position[0, 0]
    engine.links["box::link"].set_wrench((0.8 * mu * G, 0.0, 0.0), (0.0, 0.0, 0.0))
    engine.step(round(0.5 / step))
    held = engine.models["box"].placement().position[0, 0]
    assert held - start < 0.002
    engine.links["box::link"].set_wrench((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    engine.models["box"].set_motion((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    engine.step(round(1.5 / step))
    slid = engine.models["box"].placement().position[0, 0] - held
    assert slid == pytest.approx(1.0 / (2.0 * mu * G), rel=0.03)


def test_stiffness_of_files_like_turtlebot3_is_as_good_as_rigid():
    stiff = Surface(Friction(0.1, 0.1), Contact(kp=500000.0, kd=10.0))
    ball = with_surface(scenes.ball(pose=Pose(z=0.1)), stiff)
    engine = make_engine("mujoco", scenes.world(scenes.ground(), ball, step=0.01))
    engine.step(500)
    # At 10 ms what is rigid gives way by 0.8 mm, with the square of the step.
    assert engine.models["ball"].placement().position[0, 2] == pytest.approx(0.1, abs=1e-3)


@pytest.mark.parametrize(
    ("mask", "other"), [(0x02, 0x03), (0x80000000, 0xFFFF0000), (0x10000, 0xFFFF0000)]
)
@pytest.mark.parametrize("e", [0.0, 0.5])
def test_bitmasks_of_32_bits_decide_who_touches(mask, other, e):
    def stack(mask):
        upper = Surface(contact=Contact(collide_bitmask=mask), bounce=Bounce(e, 0.01))
        lower = Surface(contact=Contact(collide_bitmask=other), bounce=Bounce(e, 0.01))
        slab = Link("l", collisions=(Collision("c", Box((1, 1, 0.2)), surface=lower),))
        box = with_surface(scenes.box(pose=Pose(z=0.25)), upper)
        engine = make_engine("mujoco", scenes.world(Model("slab", static=True, links=(slab,)), box))
        engine.step(1500)
        return engine.models["box"].placement().position[0, 2]

    assert stack(mask) == pytest.approx(0.2, abs=5e-3)
    assert stack(0x04) < -1.0


@pytest.mark.parametrize("kp", [1e4, 3e4, 1e5, 1e6])
def test_springs_give_back_no_more_than_an_impact_put_in(kp):
    """Four corners at 34 m/s: together they are four times as stiff."""
    soft = Surface(Friction(0.5, 0.5), Contact(kp=kp, kd=1.0))
    block = with_surface(scenes.box(size=(0.4, 0.4, 0.1), pose=Pose(z=60.0)), soft)
    engine = make_engine("mujoco", scenes.world(scenes.ground(), block))
    engine.step(3600)
    heights = []
    for _ in range(1000):
        engine.step(8)
        heights.append(engine.models["box"].placement().position[0, 2])
    assert max(heights) < 60.0
