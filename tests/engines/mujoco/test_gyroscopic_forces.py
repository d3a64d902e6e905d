"""Spinning and swinging bodies: precession, nutation and energy against theory."""

import math
import warnings

import numpy as np
import pytest
import scenes

from gazelle.description import (
    Cylinder,
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    Link,
    Model,
    Pose,
)
from gazelle.engines import make_engine
from gazelle.engines.laws import with_profile
from gazelle.engines.mujoco.compiler.gyroscopic_forces import unbalanced_dofs
from gazelle.engines.mujoco.compiler.spec import CompilerInput, compile_world
from gazelle.errors import EngineWarning
from gazelle.rotations import rotate

G = 9.8
LEFT = "burger::wheel_left_link"


def axis_of(engine, link):
    """Return the direction of a link's z axis, shape (3,)."""
    return rotate(engine.links[link].placement().quaternion, np.array([[0.0, 0.0, 1.0]]))[0]


def top(spin, step, *, tilt=0.3, about=0.005, across=0.003, lever=0.1, mass=1.0, kind="ball"):
    """Return a top that precesses steadily, and its rate [rad/s].

    Steady precession W at a tilt of t: I1 cos t W² - I3 s W + m g l = 0, s being the spin about
    the axis of the top (Goldstein, Classical Mechanics, 5.7).
    """
    inertial = Inertial(mass, Pose(z=lever), Inertia(across, across, about))
    joints = (Joint("j", "ball", "world", "t"),) if kind == "ball" else ()
    model = Model("m", links=(Link("t", inertial=inertial),), joints=joints)
    engine = make_engine("mujoco", scenes.world(model, step=step))
    total = across + mass * lever**2
    push = (about * spin) ** 2 - 4.0 * total * math.cos(tilt) * mass * G * lever
    rate = (about * spin - math.sqrt(push)) / (2.0 * total * math.cos(tilt))
    engine.joints["m::j"].set_position((math.sin(tilt / 2.0), 0.0, 0.0, math.cos(tilt / 2.0)))
    engine.joints["m::j"].set_velocity((0.0, rate * math.sin(tilt), spin))
    return engine, rate


@pytest.mark.parametrize(
    ("spin", "step", "error"),
    [
        (100.0, 0.0005, 0.001),
        (100.0, 0.001, 0.002),
        (100.0, 0.002, 0.006),
        (60.0, 0.001, 0.001),
        (80.0, 0.003, 0.015),
        (-100.0, 0.001, 0.002),
        (240.0, 0.001, 0.01),
    ],
)
def test_a_top_precesses_as_theory_says_and_keeps_its_tilt(spin, step, error):
    engine, rate = top(abs(spin), step)
    if spin < 0.0:
        engine.joints["m::j"].set_velocity(-engine.joints["m::j"].velocity())
        rate = -rate
    turned, before = 0.0, math.atan2(*axis_of(engine, "m::t")[1::-1])
    for _ in range(round(5.0 / step / 10)):
        engine.step(10)
        x, y, z = axis_of(engine, "m::t")
        turned += (math.atan2(y, x) - before + math.pi) % (2.0 * math.pi) - math.pi
        before = math.atan2(y, x)
        assert math.acos(z) == pytest.approx(0.3, abs=0.005)
    assert turned == pytest.approx(5.0 * rate, rel=error)


@pytest.mark.parametrize(("spin", "step"), [(60.0, 0.001), (150.0, 0.001), (60.0, 0.002)])
def test_a_thrown_disc_keeps_its_wobble(spin, step):
    about, across, wobble = 0.02, 0.01, math.radians(0.57)
    disc = scenes.solid("d", Cylinder(0.2, 0.02), moments=(across, across, about), pose=Pose(z=99))
    engine = make_engine("mujoco", scenes.world(disc, step=step))
    aside = math.tan(wobble) * about * spin / across
    engine.models["d"].set_motion((3.0, 0.0, 1.0), (aside, 0.0, spin))
    momentum = np.array([across * aside, 0.0, about * spin])
    momentum /= np.linalg.norm(momentum)
    for _ in range(round(3.0 / step / 10)):
        engine.step(10)
        lean = math.degrees(math.acos(min(1.0, axis_of(engine, "d::link") @ momentum)))
        assert lean == pytest.approx(0.57, abs=0.05)


def chain(count, step=0.001, *, integrator=None, axis=(0.0, 1.0, 0.0)):
    """Return rods of 1 m and 1 kg, one hanging on the other."""
    links, joints = [], []
    for i in range(count):
        inertial = Inertial(1.0, Pose(x=0.5), Inertia(0.001, 1.0 / 12.0, 1.0 / 12.0))
        links.append(Link(f"l{i}", Pose(x=float(i)), inertial))
        axes = (JointAxis(xyz=axis if i % 2 == 0 else (0.0, 1.0, 0.0)),)
        parent = "world" if i == 0 else f"l{i - 1}"
        joints.append(Joint(f"j{i}", "revolute", parent, f"l{i}", axes=axes))
    world = scenes.world(Model("m", links=tuple(links), joints=tuple(joints)), step=step)
    profile = scenes.replace(world.profile, integrator=integrator)
    return make_engine("mujoco", with_profile(world, profile))


def energy_of(engine, count):
    total = 0.0
    for i in range(count):
        name = f"m::l{i}"
        centre, place = engine.links[name].centre()[0], engine.links[name].placement()
        motion = engine.links[name].motion()
        spin = motion.angular[0]
        speed = motion.linear[0] + np.cross(spin, centre - place.position[0])
        local = rotate(place.quaternion * (-1.0, -1.0, -1.0, 1.0), spin[None])[0]
        total += 0.5 * speed @ speed + G * centre[2]
        total += 0.5 * local @ (np.array([0.001, 1.0 / 12.0, 1.0 / 12.0]) * local)
    return total


@pytest.mark.long
@pytest.mark.parametrize(("count", "axis"), [(2, (0.0, 1.0, 0.0)), (2, (0.0, 0.0, 1.0))])
def test_a_double_pendulum_keeps_its_energy(count, axis):
    """On the average of ten seconds; swings ripple by a few per cent."""

    def drift(integrator):
        engine = chain(count, integrator=integrator, axis=axis)
        engine.joints["m::j1"].set_position(-1.0)
        engine.joints["m::j0"].set_velocity(3.0)
        found = []
        for _ in range(600):
            engine.step(50)
            found.append(energy_of(engine, count))
        return abs(np.mean(found[-200:]) - np.mean(found[:200]))

    assert drift(None) < 0.05
    assert drift("euler") > 10.0 * drift(None)


def test_a_loose_body_tumbles_alike_beside_joints_and_alone():
    """One law is of all bodies and one of loose ones: never both."""
    found = []
    for others in (
        (),
        (Model("m", links=chain(2).world.models[0].links, joints=chain(2).world.models[0].joints),),
    ):
        body = scenes.solid(
            "b", Cylinder(0.1, 0.3), moments=(0.01, 0.02, 0.025), pose=Pose(5, 0, 9)
        )
        engine = make_engine("mujoco", scenes.world(body, *others))
        engine.models["b"].set_motion((0.0, 0.0, 5.0), (0.1, 20.0, 0.1))
        engine.step(800)
        found.append(engine.links["b::link"].motion().angular[0])
    np.testing.assert_allclose(found[0], found[1], rtol=1e-3, atol=1e-3)


def test_bits_do_not_depend_on_threads_or_worlds():
    spins = np.array([10.0, 60.0, 90.0, 120.0])
    many = [make_engine("mujoco", top(100.0, 0.001)[0].world, 4, threads=n) for n in (1, 2)]
    for engine in many:
        engine.joints["m::j"].set_velocity([[0.3, 0.1, spin] for spin in spins])
        engine.step(300)
    np.testing.assert_array_equal(many[0].snapshot(), many[1].snapshot())
    for i, spin in enumerate(spins):
        one = make_engine("mujoco", many[0].world)
        one.joints["m::j"].set_velocity((0.3, 0.1, spin))
        one.step(300)
        np.testing.assert_array_equal(one.snapshot()[0], many[0].snapshot()[i])


def test_a_step_too_long_for_a_spin_is_told_once():
    engine, _ = top(100.0, 0.005)
    with pytest.warns(EngineWarning, match=r"0.25 rad .*joint 'm::j' moved at") as told:
        engine.step(10)
    engine.step(10)
    assert len(told) == 1
    disc = scenes.solid("d", Cylinder(0.2, 0.02), moments=(0.01, 0.01, 0.02), pose=Pose(z=99.0))
    engine = make_engine("mujoco", scenes.world(disc))
    engine.models["d"].set_motion((0.0, 0.0, 0.0), (1.0, 0.0, 400.0))
    with pytest.warns(EngineWarning, match="link 'd::link' moved at"):
        engine.step()


def test_balanced_wheels_may_turn_as_fast_as_they_like():
    engine = make_engine("mujoco", scenes.world(scenes.ground(), scenes.burger()))
    engine.add_motor("burger::wheel_left_joint", 1.0)
    engine.joints["burger::wheel_left_joint"].set_motor_velocity(2000.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        engine.step(200)


def test_what_turns_about_changing_axes_is_found():
    def found(*models):
        return tuple(
            len(each)
            for each in unbalanced_dofs(
                compile_world(CompilerInput(scenes.world(*models), 0.001)).model
            )
        )

    assert found(scenes.burger()) == (0, 3)
    assert found(chain(1).world.models[0]) == (0, 0)
    assert found(chain(2).world.models[0]) == (2, 0)
    tyred = CompilerInput(scenes.world(scenes.burger()), 0.001, slip_links=frozenset({LEFT}))
    hinges, _ = unbalanced_dofs(compile_world(tyred).model)
    assert len(hinges) == 1  # how fast the tyre slips on its wheel
    assert found(scenes.box()) == (0, 0)
    assert found(top(100.0, 0.001)[0].world.models[0]) == (0, 3)
