"""Energy and momentum over ten minutes, where mechanics says that they stay."""

import math
from dataclasses import replace

import numpy as np
import pytest
import scenes

from gazelle.description import (
    Bounce,
    Box,
    Friction,
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    Link,
    Model,
    Pose,
    Surface,
)
from gazelle.engines import make_engine
from gazelle.engines.laws import with_profile
from gazelle.rotations import conjugate, rotate

G = 9.8


def pendulum():
    """Return a point of 1 kg on an arm of 0.5 m; zero is level, pi / 2 hangs."""
    inertial = Inertial(1.0, Pose(x=0.5), Inertia(0.01, 0.01, 0.01))
    axes = (JointAxis(xyz=(0.0, 1.0, 0.0)),)
    hinge = Joint("hinge", "revolute", "world", "arm", axes=axes)
    model = Model("p", links=(Link("arm", inertial=inertial),), joints=(hinge,))
    return make_engine("mujoco", scenes.world(model))


def energy_of(engine):
    angle = engine.joints["p::hinge"].position()[0, 0]
    speed = engine.joints["p::hinge"].velocity()[0, 0]
    return 0.5 * 0.26 * speed**2 + G * 0.5 * (1.0 - math.sin(angle))


@pytest.mark.slow
@pytest.mark.parametrize("swing", [0.5, 2.5])
def test_a_pendulum_keeps_its_energy_for_ten_minutes(swing):
    """To 2e-5 on the average; within a swing it ripples by half a percent."""
    engine = pendulum()
    engine.joints["p::hinge"].set_position(math.pi / 2.0 - swing)
    energies = []
    for _ in range(3000):
        engine.step(200)
        energies.append(energy_of(engine))
    first, last = np.mean(energies[:300]), np.mean(energies[-300:])
    assert last == pytest.approx(first, rel=2e-5)
    assert np.ptp(energies) < 0.005 * first


def test_a_damped_pendulum_loses_what_the_damping_takes():
    """Small swings of a hinge with damping c decay as exp(-c t / 2 I)."""
    inertial = Inertial(1.0, Pose(x=0.5), Inertia(0.01, 0.01, 0.01))
    axes = (JointAxis(xyz=(0.0, 1.0, 0.0), damping=0.26 * 0.3),)
    hinge = Joint("hinge", "revolute", "world", "arm", axes=axes)
    model = Model("p", links=(Link("arm", inertial=inertial),), joints=(hinge,))
    engine = make_engine("mujoco", scenes.world(model))
    engine.joints["p::hinge"].set_position(math.pi / 2.0 - 0.1)
    energies = []
    for _ in range(2000):
        engine.step(5)
        energies.append(energy_of(engine))
    times = 0.005 * np.arange(1, 2001)
    slope = np.polyfit(times, np.log(energies), 1)[0]
    assert slope == pytest.approx(-0.3, rel=0.02)


def momenta(engine, moments):
    place, motion = engine.models["b"].placement(), engine.links["b::link"].motion()
    spin = rotate(conjugate(place.quaternion), motion.angular)
    turning = rotate(place.quaternion, spin * moments)[0]
    return motion.linear[0], turning, 0.5 * float((spin**2 * moments).sum())


def drift(moments, minutes, integrator=None):
    """Return the largest change of momentum, and relative ones of angular momentum and energy."""
    body = scenes.solid("b", Box((0.1, 0.2, 0.3)), mass=2.0, moments=moments)
    world = scenes.world(body, gravity=(0.0, 0.0, 0.0))
    profile = replace(world.profile, integrator=integrator)
    engine = make_engine("mujoco", with_profile(world, profile))
    engine.models["b"].set_motion((1.0, 0.5, 0.0), (0.1, 3.0, 0.1))
    velocity, turning, energy = momenta(engine, np.array(moments))
    worst = np.zeros(3)
    for _ in range(6 * minutes):
        engine.step(10_000)
        now = momenta(engine, np.array(moments))
        off = np.abs(now[0] - velocity).max(), np.linalg.norm(now[1] - turning)
        worst = np.maximum(
            worst, (off[0], off[1] / np.linalg.norm(turning), abs(now[2] / energy - 1.0))
        )
    return worst


def test_a_free_ball_keeps_everything():
    linear, turning, energy = drift((0.02, 0.02, 0.02), 1)
    assert linear < 1e-12
    assert turning < 1e-12
    assert energy < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("integrator", [None, "rk4"])
def test_a_body_that_tumbles_keeps_its_energy_and_angular_momentum(integrator):
    """About the middle axis, at 3 rad/s."""
    linear, turning, energy = drift((0.01, 0.02, 0.025), 10, integrator)
    assert linear < 1e-11
    assert turning < 1e-3
    assert energy < 1e-9


def test_with_plain_euler_a_tumbling_body_drifts_as_the_page_says():
    """The gyroscopic torque is taken at the start of a step."""
    _, turning, energy = drift((0.01, 0.02, 0.025), 1, "euler")
    assert 0.002 < turning < 0.015
    assert 0.01 < energy < 0.03


@pytest.mark.slow
def test_an_elastic_ball_loses_little_of_its_height_in_ten_minutes():
    elastic = Surface(bounce=Bounce(1.0, 0.01))
    ball = scenes.with_surface(scenes.ball(pose=Pose(z=1.1)), elastic)
    floor = scenes.with_surface(scenes.ground(), elastic)
    engine = make_engine("mujoco", scenes.world(floor, ball))
    engine.step(598_000)
    heights = []
    for _ in range(1000):
        engine.step(2)
        heights.append(engine.models["ball"].placement().position[0, 2] - 0.1)
    assert 0.7 < max(heights) < 1.0


def test_two_bodies_keep_their_momentum_through_every_kind_of_contact():
    for bounce in (Bounce(), Bounce(0.6, 0.01)):
        surface = Surface(Friction(0.3, 0.3), bounce=bounce)
        bodies = [scenes.box("a", mass=3.0, pose=Pose(x=-0.3, y=0.05)), scenes.ball("b", mass=1.0)]
        models = [scenes.with_surface(body, surface) for body in bodies]
        engine = make_engine("mujoco", scenes.world(*models, gravity=(0.0, 0.0, 0.0)))
        engine.models["a"].set_motion((2.0, 0.0, 0.0), (0.0, 0.0, 1.0))
        engine.step(1000)
        a, b = (engine.links[f"{name}::link"].motion().linear[0] for name in ("a", "b"))
        assert b[0] > a[0]
        np.testing.assert_allclose(3.0 * a + b, (6.0, 0.0, 0.0), atol=1e-8)
