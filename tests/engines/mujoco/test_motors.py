"""Velocity motors: they hold what their effort allows, whatever hangs on them."""

import math

import numpy as np
import pytest
import scenes
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.description import (
    Box,
    Collision,
    Cylinder,
    Friction,
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    Link,
    Model,
    Pose,
    Sphere,
    Surface,
)
from gazelle.engines import make_engine
from gazelle.engines.laws import with_profile
from gazelle.errors import EngineError

G = 9.8
STEPS = [0.0005, 0.001, 0.002, 0.005]
SHAPES = [None, Sphere(0.05), Box((3.0, 3.0, 3.0))]


def arm(mass=5.0, reach=1.0, shape=None, *, moment=0.01, kind="revolute", gravity=G, **options):
    """Return a mass out on a joint along y; level at zero, and weight turns it forward."""
    step, more = options.pop("step", 0.001), options.pop("more", ())
    shapes = () if shape is None else (Collision("c", shape),)
    inertial = Inertial(mass, Pose(x=reach), Inertia(moment, moment, moment))
    along = (0.0, 0.0, 1.0) if kind == "prismatic" else (0.0, 1.0, 0.0)
    axes = (JointAxis(xyz=along, **options), *more)
    joint = Joint("j", kind, "world", "arm", axes=axes)
    model = Model("m", links=(Link("arm", inertial=inertial, collisions=shapes),), joints=(joint,))
    return scenes.world(model, step=step, gravity=(0.0, 0.0, -gravity))


def speeds(engine, joint, count):
    """Return the velocity after each of so many steps, shape (count, axes)."""
    found = []
    for _ in range(count):
        engine.step()
        found.append(engine.joints[joint].velocity()[0])
    return np.array(found)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("step", STEPS)
def test_it_holds_still_under_a_load_whatever_the_shape_of_the_link(shape, step):
    engine = make_engine("mujoco", arm(shape=shape, step=step))
    engine.add_motor("m::j", 1000.0)
    assert np.abs(speeds(engine, "m::j", 200)).max() < 1e-6
    assert abs(engine.joints["m::j"].position()[0, 0]) < 1e-9


@pytest.mark.parametrize("kind", ["revolute", "continuous", "prismatic"])
@pytest.mark.parametrize("step", STEPS)
def test_it_turns_a_load_all_the_way_round_at_its_velocity(kind, step):
    engine = make_engine("mujoco", arm(kind=kind, step=step))
    engine.add_motor("m::j", 1000.0)
    engine.joints["m::j"].set_motor_velocity(2.0)
    engine.step(math.ceil(0.2 / step))
    assert np.abs(speeds(engine, "m::j", round(4.0 / step)) - 2.0).max() < 1e-6


@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
@pytest.mark.parametrize("effort", [0.5, 3.0, 200.0])
@pytest.mark.parametrize("step", [0.0005, 0.005])
def test_what_it_cannot_reach_at_once_it_approaches_at_its_effort(kind, effort, step):
    engine = make_engine("mujoco", arm(kind=kind, gravity=0.0, step=step))
    moved = 5.0 if kind == "prismatic" else 5.0 + 0.01
    engine.add_motor("m::j", effort)
    engine.joints["m::j"].set_motor_velocity(-1e4)
    found = speeds(engine, "m::j", 100)[:, 0]
    expected = -effort / moved * step * np.arange(1, 101)
    np.testing.assert_allclose(found, expected, rtol=1e-9)


@pytest.mark.parametrize("step", STEPS)
def test_a_load_beyond_its_effort_falls_by_the_rest(step):
    engine = make_engine("mujoco", arm(kind="prismatic", step=step))
    engine.add_motor("m::j", 5.0 * G - 1.0)
    found = speeds(engine, "m::j", 50)[:, 0]
    np.testing.assert_allclose(found, -0.2 * step * np.arange(1, 51), rtol=1e-9)


def test_it_acts_beside_the_friction_of_the_joint():
    """Friction takes its part of the effort, on the way up and when the motor is too weak."""
    engine = make_engine("mujoco", arm(gravity=0.0, friction=1.0))
    engine.add_motor("m::j", 3.0)
    engine.joints["m::j"].set_motor_velocity(1e3)
    found = speeds(engine, "m::j", 100)[:, 0]
    np.testing.assert_allclose(found, (3.0 - 1.0) / 5.01 * 0.001 * np.arange(1, 101), rtol=1e-6)
    engine.joints["m::j"].set_motor_velocity(0.02)
    engine.step(100)
    assert np.abs(speeds(engine, "m::j", 50) - 0.02).max() < 1e-6
    weak = make_engine("mujoco", arm(gravity=0.0, friction=1.0))
    weak.add_motor("m::j", 0.9)
    weak.joints["m::j"].set_motor_velocity(1e3)
    weak.step(500)
    assert abs(weak.joints["m::j"].velocity()[0, 0]) < 1e-6


@pytest.mark.parametrize("damping", [0.1, 1.0, 30.0])
def test_it_holds_its_velocity_against_damping(damping):
    engine = make_engine("mujoco", arm(damping=damping))
    engine.add_motor("m::j", 1000.0)
    engine.joints["m::j"].set_motor_velocity(-1.5)
    engine.step(100)
    assert np.abs(speeds(engine, "m::j", 500) + 1.5).max() < 1e-6


@settings(max_examples=30, deadline=None, derandomize=True)
@given(
    mass=st.floats(1e-3, 1e3),
    reach=st.floats(0.0, 2.0),
    gyration=st.floats(0.01, 1.0),
    target=st.floats(-20.0, 20.0),
    strength=st.floats(1.1, 1e4),
    step=st.sampled_from(STEPS),
)
def test_any_load_that_it_can_carry_moves_at_its_velocity(
    mass, reach, gyration, target, strength, step
):
    moment = mass * gyration**2
    engine = make_engine("mujoco", arm(mass, reach, moment=moment, step=step))
    load = mass * G * reach
    start = (moment + mass * reach**2) * abs(target) / step
    engine.add_motor("m::j", strength * (load + start) + 1e-9)
    engine.joints["m::j"].set_motor_velocity(target)
    engine.step(5)
    assert np.abs(speeds(engine, "m::j", 100) - target).max() < 1e-6 * max(1.0, abs(target))


# -- several axes ------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["universal", "revolute2"])
def test_a_joint_of_two_axes_has_a_motor_on_each(kind):
    second = JointAxis(xyz=(0.0, 0.0, 1.0))
    engine = make_engine("mujoco", arm(kind=kind, more=(second,), reach=0.3), 2)
    engine.add_motor("m::j", (1000.0, 1000.0))
    engine.joints["m::j"].set_motor_velocity([[1.0, -2.0], [0.0, 0.5]])
    engine.step(2)
    for _ in range(300):
        engine.step()
        np.testing.assert_allclose(
            engine.joints["m::j"].velocity(), [[1.0, -2.0], [0.0, 0.5]], atol=1e-6
        )
    engine.joints["m::j"].set_motor_velocity(0.25)
    engine.step(3)
    np.testing.assert_allclose(engine.joints["m::j"].velocity(), 0.25, atol=1e-6)
    assert engine.parameter("motor_effort", "m::j").tolist() == [[1000.0, 1000.0]] * 2


def test_an_axis_whose_motor_is_off_moves_freely():
    second = JointAxis(xyz=(0.0, 0.0, 1.0))
    world = arm(kind="universal", more=(second,), reach=0.5, gravity=0.0)
    engine = make_engine("mujoco", world)
    engine.joints["m::j"].set_velocity((0.0, 1.0))
    engine.add_motor("m::j", (1000.0, 0.0))
    engine.step(500)
    assert engine.joints["m::j"].velocity()[0] == pytest.approx((0.0, 1.0), abs=1e-6)


def test_a_screw_is_moved_by_the_motor_of_its_turn():
    inertial = Inertial(2.0, Pose(), Inertia(0.01, 0.01, 0.01))
    joint = Joint("j", "screw", "world", "nut", axes=(JointAxis(),), thread_pitch=-50.0)
    model = Model("m", links=(Link("nut", inertial=inertial),), joints=(joint,))
    engine = make_engine("mujoco", scenes.world(model))
    engine.add_motor("m::j", 100.0)
    engine.joints["m::j"].set_motor_velocity(3.0)
    engine.step(1000)
    turn, rise = engine.joints["m::j"].velocity()[0]
    assert turn == pytest.approx(3.0, abs=1e-6)
    assert rise == pytest.approx(3.0 / 50.0, rel=1e-3)


def test_joints_without_axes_and_efforts_that_cannot_be_are_refused():
    ball = Joint("j", "ball", "world", "arm")
    inertial = Inertial(1.0, Pose(x=0.1), Inertia(0.1, 0.1, 0.1))
    model = Model("m", links=(Link("arm", inertial=inertial),), joints=(ball,))
    engine = make_engine("mujoco", scenes.world(model))
    with pytest.raises(EngineError, match="has no axis for a motor"):
        engine.add_motor("m::j", 1.0)
    engine = make_engine("mujoco", arm())
    for effort in (-1.0, math.nan, math.inf):
        with pytest.raises(EngineError, match="must be finite and not negative"):
            engine.add_motor("m::j", effort)
    with pytest.raises(EngineError, match="has 1 axes, not 2"):
        engine.add_motor("m::j", (1.0, 2.0))
    with pytest.raises(EngineError, match="there is no joint 'm::k'"):
        engine.add_motor("m::k", 1.0)
    with pytest.raises(EngineError, match="no motor on joint"):
        engine.joints["m::j"].set_motor_velocity(1.0)
    engine.add_motor("m::j", 1.0)
    with pytest.raises(EngineError, match="has motors"):
        engine.make_kinematic("m")


# -- in the middle of a run --------------------------------------------------------------


def test_effort_and_velocity_change_while_it_runs():
    engine = make_engine("mujoco", arm(gravity=0.0))
    engine.add_motor("m::j", 1e4)
    engine.joints["m::j"].set_motor_velocity(1.0)
    engine.step(5)
    engine.add_motor("m::j", 5.01)
    engine.joints["m::j"].set_motor_velocity(2.0)
    assert speeds(engine, "m::j", 100)[-1, 0] == pytest.approx(1.1, abs=1e-6)
    engine.set_parameter("motor_effort", "m::j", [0.0])
    assert speeds(engine, "m::j", 100)[-1, 0] == pytest.approx(1.1, abs=1e-6)
    engine.set_parameter("motor_effort", "m::j", [1e4])
    assert speeds(engine, "m::j", 3)[-1, 0] == pytest.approx(2.0, abs=1e-6)


def test_each_world_has_its_velocity_and_its_effort_whatever_the_others_do():
    worlds, effort = 4, np.array([[0.0], [1.0], [10.0], [1000.0]])
    many = make_engine("mujoco", arm(), worlds, threads=2)
    many.add_motor("m::j", 1.0)
    many.set_parameter("motor_effort", "m::j", effort)
    many.set_parameter("link_mass", "m::arm", [[1.0], [2.0], [3.0], [4.0]])
    many.joints["m::j"].set_motor_velocity(np.arange(4.0))
    many.step(300)
    for i in range(worlds):
        one = make_engine("mujoco", arm())
        one.add_motor("m::j", 1.0)
        one.set_parameter("motor_effort", "m::j", effort[i])
        one.set_parameter("link_mass", "m::arm", [i + 1.0])
        one.joints["m::j"].set_motor_velocity(float(i))
        one.step(300)
        assert one.joints["m::j"].velocity()[0] == many.joints["m::j"].velocity()[i]
    assert many.joints["m::j"].velocity()[3, 0] == pytest.approx(3.0, abs=1e-6)


def test_a_snapshot_goes_on_to_the_same_bits_and_a_reset_lets_it_stand():
    engine = make_engine("mujoco", arm(), 2)
    engine.add_motor("m::j", 60.0)
    engine.joints["m::j"].set_motor_velocity([1.0, 30.0])
    engine.step(57)
    state = engine.snapshot()
    engine.step(100)
    expected = engine.snapshot()
    engine.restore(state)
    engine.step(100)
    np.testing.assert_array_equal(engine.snapshot(), expected)
    twin = make_engine("mujoco", arm(), 2)
    twin.adopt(engine.history())
    twin.restore(state)
    twin.step(100)
    np.testing.assert_array_equal(twin.snapshot(), expected)
    engine.reset()
    engine.step(100)
    assert np.abs(engine.joints["m::j"].velocity()).max() < 1e-6


def test_it_goes_on_when_something_else_comes_and_goes():
    engine = make_engine("mujoco", arm())
    engine.add_motor("m::j", 1000.0)
    engine.joints["m::j"].set_motor_velocity(2.0)
    engine.step(50)
    engine.spawn(scenes.ball("ball", pose=Pose(x=9.0)))
    assert np.abs(speeds(engine, "m::j", 3) - 2.0).max() < 1e-6
    engine.delete("ball")
    assert np.abs(speeds(engine, "m::j", 3) - 2.0).max() < 1e-6


def test_looking_at_forces_changes_nothing():
    seen, unseen = (make_engine("mujoco", arm()) for _ in range(2))
    for engine in (seen, unseen):
        engine.add_motor("m::j", 1000.0)
        engine.joints["m::j"].set_motor_velocity(2.0)
    for _ in range(20):
        seen.joints["m::j"].wrench()
        seen.links["m::arm"].acceleration()
        for engine in (seen, unseen):
            engine.step()
    np.testing.assert_array_equal(seen.snapshot(), unseen.snapshot())


def test_its_effort_is_in_the_reaction_of_the_joint():
    engine = make_engine("mujoco", arm())
    engine.add_motor("m::j", 1000.0)
    engine.step(10)
    wrench = engine.joints["m::j"].wrench()
    assert wrench.torque[0] == pytest.approx((0.0, 5.0 * G, 0.0), abs=1e-5)
    assert wrench.force[0] == pytest.approx((0.0, 0.0, -5.0 * G), abs=1e-5)


def test_with_runge_kutta_too():
    world = arm()
    world = with_profile(world, scenes.replace(world.profile, integrator="rk4"))
    engine = make_engine("mujoco", world)
    engine.add_motor("m::j", 1000.0)
    engine.joints["m::j"].set_motor_velocity(2.0)
    engine.step(200)
    assert np.abs(speeds(engine, "m::j", 1000) - 2.0).max() < 1e-6
    engine = make_engine("mujoco", with_profile(arm(gravity=0.0), world.profile))
    engine.add_motor("m::j", 5.01)
    engine.joints["m::j"].set_motor_velocity(50.0)
    assert speeds(engine, "m::j", 100)[-1, 0] == pytest.approx(0.1, rel=1e-6)


# -- on wheels ---------------------------------------------------------------------------


def wheeled(*, cone, step, inertia=0.001, mass=10.0, mu=1.0, **options):
    """Return a box on four driven wheels of 0.1 m, one at each corner."""
    rubber = Surface(Friction(mu, mu))
    links = [Link("base", Pose(z=0.15), Inertial(mass, inertia=Inertia(0.3, 0.5, 0.6)))]
    joints = []
    for i, (x, y) in enumerate([(0.3, 0.2), (0.3, -0.2), (-0.3, 0.2), (-0.3, -0.2)]):
        inertial = Inertial(0.5, inertia=Inertia(inertia, inertia, inertia))
        tread = (Collision("c", Sphere(0.1), surface=rubber),)
        links.append(Link(f"w{i}", Pose(x, y, 0.1), inertial=inertial, collisions=tread))
        axes = (JointAxis(xyz=(0.0, 1.0, 0.0), **options),)
        joints.append(Joint(f"j{i}", "continuous", "base", f"w{i}", axes=axes))
    car = Model("car", links=tuple(links), joints=tuple(joints))
    world = scenes.world(scenes.ground(), car, step=step)
    ode = scenes.replace(world.profile.ode, friction_model=f"{cone}_model")
    return with_profile(world, scenes.replace(world.profile, ode=ode))


@pytest.mark.parametrize("cone", ["cone", "pyramid"])
@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("inertia", [1e-6, 1e-3])
def test_wheels_under_load_turn_at_their_velocity_and_carry_the_car(cone, step, inertia):
    engine = make_engine("mujoco", wheeled(cone=cone, step=step, inertia=inertia))
    for i in range(4):
        engine.add_motor(f"car::j{i}", 20.0)
        engine.joints[f"car::j{i}"].set_motor_velocity(5.0)
    engine.step(round(1.0 / step))
    found = np.array([speeds(engine, f"car::j{i}", 10) for i in range(4)])
    assert np.abs(found - 5.0).max() < 1e-4
    assert engine.links["car::base"].motion().linear[0, 0] == pytest.approx(0.5, rel=0.01)


@pytest.mark.parametrize("cone", ["cone", "pyramid"])
def test_wheels_too_weak_to_slip_push_the_car_by_their_effort(cone):
    engine = make_engine("mujoco", wheeled(cone=cone, step=0.001))
    for i in range(4):
        engine.add_motor(f"car::j{i}", 0.5)
        engine.joints[f"car::j{i}"].set_motor_velocity(50.0)
    engine.step(500)
    force, mass = 4 * 0.5 / 0.1, 12.0 + 4 * 0.001 / 0.1**2
    speed = engine.links["car::base"].motion().linear[0, 0]
    assert speed == pytest.approx(force / mass * 0.5, rel=0.005)


def ackermann(steering_shapes, step):
    """Return front wheels on knuckles that hold a steering angle, rear wheels that drive."""
    base, track, radius = 1.0, 0.6, 0.1
    grip = Surface(Friction(1.0, 1.0))
    links = [Link("body", Pose(z=0.2), Inertial(20.0, inertia=Inertia(0.7, 2.0, 2.5)))]
    joints = []

    def wheel(name, x, y, parent):
        inertial = Inertial(1.0, inertia=Inertia(0.003, 0.005, 0.003))
        shapes = (Collision("c", Cylinder(radius, 0.03), Pose(roll=math.pi / 2), surface=grip),)
        links.append(Link(name, Pose(x, y, radius), inertial=inertial, collisions=shapes))
        axes = (JointAxis(xyz=(0.0, 1.0, 0.0)),)
        joints.append(Joint(f"{name}_joint", "continuous", parent, name, axes=axes))

    for side, y in (("left", track / 2), ("right", -track / 2)):
        wheel(f"rear_{side}", 0.0, y, "body")
        inertial = Inertial(0.3, inertia=Inertia(0.001, 0.001, 0.001))
        shapes = (Collision("c", Box((0.05, 0.05, 0.05))),) if steering_shapes else ()
        knuckle = Link(f"{side}_knuckle", Pose(base, y, radius), inertial, shapes)
        links.append(knuckle)
        axes = (JointAxis(xyz=(0.0, 0.0, 1.0)),)
        joints.append(Joint(f"{side}_steer", "revolute", "body", knuckle.name, axes=axes))
        wheel(f"front_{side}", base, y, knuckle.name)
    car = Model("car", links=tuple(links), joints=tuple(joints))
    return scenes.world(scenes.ground(), car, step=step), base, track, radius


@pytest.mark.parametrize("shapes", [False, True])
@pytest.mark.parametrize("step", [0.001, 0.002])
def test_a_car_turns_as_its_steering_says_with_knuckles_of_any_shape(shapes, step):
    world, base, track, radius = ackermann(shapes, step)
    engine = make_engine("mujoco", world)
    wanted = 1.5  # radius of the turn at the middle of the rear axle
    for side, sign in (("left", -1.0), ("right", 1.0)):
        joint = f"car::{side}_steer"
        engine.joints[joint].set_position(math.atan2(base, wanted + sign * track / 2))
        engine.add_motor(joint, 50.0)
        rear = f"car::rear_{side}_joint"
        engine.add_motor(rear, 10.0)
        engine.joints[rear].set_motor_velocity(0.5 / radius * (1.0 + sign * track / 2 / wanted))
    engine.step(round(1.0 / step))
    before = engine.joints["car::left_steer"].position()[0, 0]
    speed, turning = [], []
    for _ in range(100):
        engine.step(round(0.02 / step))
        motion = engine.links["car::body"].motion()
        speed.append(np.hypot(*motion.linear[0, :2]))
        turning.append(motion.angular[0, 2])
    assert np.mean(speed) / np.mean(turning) == pytest.approx(wanted, rel=0.03)
    assert engine.joints["car::left_steer"].position()[0, 0] == pytest.approx(before, abs=1e-6)
