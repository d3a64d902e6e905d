"""Wheels stand on the middle of their treads, and shapes askew by rounding are straight."""

import math
from dataclasses import replace

import mujoco
import numpy as np
import pytest
import scenes

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
    Surface,
)
from gazelle.engines import make_engine
from gazelle.engines.laws import with_profile

MODELS = ("cone_model", "pyramid_model")
TRACK, RADIUS = scenes.CART_TRACK, scenes.CART_RADIUS


def drive(model, left, right, seconds, friction, step=0.001):
    """Return the place of a cart, and the angle it has turned."""
    world = scenes.world(scenes.ground(), model, step=step)
    ode = replace(world.profile.ode, friction_model=friction)
    engine = make_engine("mujoco", with_profile(world, replace(world.profile, ode=ode)))
    for side, speed in (("left", left), ("right", right)):
        engine.add_motor(f"cart::{side}_joint", 50.0)
        engine.joints[f"cart::{side}_joint"].set_motor_velocity(speed)
    turned, before = 0.0, 0.0
    for _ in range(round(seconds / 0.1)):
        engine.step(round(0.1 / step))
        x, y, z, w = engine.links["cart::base"].placement().quaternion[0]
        yaw = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
        turned += math.remainder(yaw - before, 2.0 * math.pi)
        before = yaw
    return engine.links["cart::base"].placement().position[0], turned


@pytest.mark.parametrize("friction", MODELS)
@pytest.mark.parametrize(("width", "mu"), [(0.02, 0.3), (0.1, 0.3), (0.1, 1.0), (0.2, 0.5)])
@pytest.mark.parametrize("step", [0.001, 0.005])
def test_a_cart_on_wheels_of_any_width_goes_straight(width, mu, friction, step):
    """Its wheels slip as it sets off; axles turned by 1.57 stand on one edge each."""
    where, turned = drive(scenes.cart(width, mu), 5.0, 5.0, 4.0, friction, step)
    assert where[0] > 1.7
    assert abs(turned) < 1e-3
    assert abs(where[1]) < 2e-3


@pytest.mark.parametrize("friction", MODELS)
@pytest.mark.parametrize("mu", [0.5, 1.0, 100.0, 1e5])
@pytest.mark.parametrize("width", [0.02, 0.1, 0.2])
def test_a_cart_on_wheels_of_any_width_turns_in_place_as_kinematics_say(width, mu, friction):
    rate, seconds = 1.0, 5.0
    speed = rate * TRACK / 2.0 / RADIUS
    # On axles at right angles, so that the wheels bear with both edges.
    level = scenes.cart(width, mu, roll=-math.pi / 2.0, drag=0.1)
    _, turned = drive(level, speed, -speed, seconds, friction)
    # The wheels turn about z, which points to the left of the cart.
    assert abs(turned) == pytest.approx(rate * seconds, rel=0.01)


def contacts_of(engine, part):
    """Return places and depths of the contacts of shapes with a word in their names."""
    model, data = engine.running.batch.model, engine.running.batch.get_data(0)
    mujoco.mj_forward(model, data)
    names = [model.geom(geom).name for geom in range(model.ngeom)]
    touching = [c for c in data.contact if any(part in names[geom] for geom in c.geom)]
    return [c.pos.copy() for c in touching], [c.dist for c in touching]


@pytest.mark.parametrize("friction", MODELS)
@pytest.mark.parametrize("width", [0.02, 0.1, 0.2])
@pytest.mark.parametrize("roll", [-math.pi / 2.0, -1.57, 1.5715])
def test_a_level_wheel_has_one_contact(width, roll, friction):
    """Both edges say the same from the middle, and the solver would pay for it."""
    world = scenes.world(scenes.ground(), scenes.cart(width, roll=roll))
    ode = replace(world.profile.ode, friction_model=friction)
    engine = make_engine("mujoco", with_profile(world, replace(world.profile, ode=ode)))
    engine.step(200)
    for side, y in (("left", TRACK / 2.0), ("right", -TRACK / 2.0)):
        ((place,), (depth,)) = contacts_of(engine, side)
        higher = width / 2.0 * abs(math.cos(roll))  # an edge is, than the middle
        assert place[1] == pytest.approx(y, abs=1e-6 + 1.1 * width / 2.0 * higher / 1e-3)
        assert -1e-4 < depth < 1e-4


def test_what_is_no_wheel_or_leans_keeps_all_of_its_contacts():
    drum = scenes.solid("drum", Cylinder(0.1, 0.1), pose=Pose(z=0.1, roll=math.pi / 2.0))
    engine = make_engine("mujoco", scenes.world(scenes.ground(), drum))
    engine.step(100)
    assert len(contacts_of(engine, "drum")[0]) == 2  # both ends of what lies loose
    steep = scenes.cart(0.1, roll=-math.pi / 2.0 + 0.05)
    engine = make_engine("mujoco", scenes.world(scenes.ground(), steep))
    engine.step(1)
    for side, y in (("left", TRACK / 2.0), ("right", -TRACK / 2.0)):
        places, _ = contacts_of(engine, side)
        assert all(abs(place[1] - y) > 0.04 for place in places)  # on an edge


def test_a_roller_alone_stands_and_what_leans_stands_on_its_edge():
    """The middle bears as long as the edges are level; then the lower one does."""
    for lean, falls in ((0.0, False), (0.05, False), (0.6, True)):
        axle = Link("axle", inertial=Inertial(0.2, inertia=Inertia(0.001, 0.001, 0.001)))
        drum = Link(
            "drum",
            inertial=Inertial(2.0, inertia=Inertia(0.01, 0.01, 0.01)),
            collisions=(Collision("c", Cylinder(0.1, 0.1)),),
        )
        joint = Joint("turns", "continuous", "axle", "drum", axes=(JointAxis(),))
        height = 0.1 * math.cos(lean) + 0.05 * math.sin(lean)
        pose = Pose(z=height + 1e-4, roll=math.pi / 2.0 + lean)
        model = Model("roller", links=(axle, drum), joints=(joint,), pose=pose)
        engine = make_engine("mujoco", scenes.world(scenes.ground(), model))
        engine.step(2000)
        x, y, _, _ = engine.links["roller::axle"].placement().quaternion[0]
        level = abs(1.0 - 2.0 * (x * x + y * y))
        assert (level > 0.5) == falls, lean


def test_a_caster_that_is_askew_by_rounding_brakes_in_the_middle():
    block = Collision("caster", Box((0.03, 0.03, 0.04)), Pose(-0.3, 0.0, 0.015, roll=-1.57))
    where, turned = drive(scenes.cart(0.02, 0.3, caster=block), 5.0, 5.0, 4.0, "cone_model")
    assert abs(turned) < 1e-3
    assert abs(where[1]) < 2e-3


@pytest.mark.parametrize(
    ("size", "turn", "straight"),
    [
        ((0.1, 0.2, 0.1), Pose(roll=1.57), True),
        ((0.1, 0.2, 0.1), Pose(roll=-1.57, yaw=1.5708), True),
        ((0.1, 0.1, 0.1), Pose(pitch=3.1416), True),
        ((0.1, 0.2, 0.1), Pose(roll=1.56), False),
        ((4.0, 0.2, 0.1), Pose(yaw=1.57), False),
        ((0.1, 0.2, 0.1), Pose(), True),
        ((0.1, 0.2, 0.1), Pose(roll=0.3), False),
    ],
)
def test_only_what_is_askew_by_rounding_is_put_straight(size, turn, straight):
    shape = Collision("c", Box(size), turn)
    link = Link("l", inertial=Inertial(1.0, inertia=Inertia(1, 1, 1)), collisions=(shape,))
    engine = make_engine("mujoco", scenes.world(Model("m", links=(link,))))
    axes = np.zeros(9)
    mujoco.mju_quat2Mat(axes, engine.running.batch.model.geom_quat[0])
    off = np.abs(axes - np.rint(axes)).max()
    assert (off < 1e-12) == straight
    if not straight:
        wanted = turn.matrix()[:3, :3]
        np.testing.assert_allclose(axes.reshape(3, 3), wanted, atol=1e-12)
    np.testing.assert_array_equal(engine.links["m::l"].placement().quaternion[0], [0, 0, 0, 1])


def test_links_held_by_fixed_joints_are_straight_with_what_carries_them():
    shape = Collision("c", Box((0.1, 0.1, 0.2)))
    base = Link("base", inertial=Inertial(1.0, inertia=Inertia(1, 1, 1)))
    arm = replace(base, name="arm", pose=Pose(x=0.2, roll=1.57), collisions=(shape,))
    joint = Joint("j", "fixed", "base", "arm")
    world = scenes.world(Model("m", links=(base, arm), joints=(joint,)))
    engine = make_engine("mujoco", world)
    data = mujoco.MjData(engine.running.batch.model)
    mujoco.mj_forward(engine.running.batch.model, data)
    axes = data.geom_xmat[0]
    np.testing.assert_allclose(axes, np.rint(axes), atol=1e-12)
    # The link itself is where the file has it.
    x, _, _, w = engine.links["m::arm"].placement().quaternion[0]
    assert 2.0 * math.atan2(x, w) == pytest.approx(1.57, abs=1e-12)


def skid_steer(friction, width=0.1):
    """Return four driven wheels on fixed axles, at (0.2, 0.25) m from the middle."""
    base = Link("base", inertial=Inertial(10.0, Pose(z=0.1), Inertia(0.2, 0.3, 0.4)))
    surface = Surface(friction)

    def wheel(name, x, y):
        shape = Collision("c", Cylinder(RADIUS, width), surface=surface)
        pose = Pose(x, y, RADIUS, roll=-math.pi / 2.0)
        inertial = Inertial(0.5, inertia=Inertia(0.003, 0.003, 0.005))
        return Link(name, pose=pose, inertial=inertial, collisions=(shape,))

    wheels = [wheel(f"w{i}", x, y) for i, (x, y) in enumerate(CORNERS)]
    joints = tuple(
        Joint(f"w{i}_joint", "continuous", "base", f"w{i}", axes=(JointAxis(),)) for i in range(4)
    )
    return Model("cart", links=(base, *wheels), joints=joints)


CORNERS = ((0.2, 0.25), (-0.2, 0.25), (0.2, -0.25), (-0.2, -0.25))
ALONG_THE_AXLE = (0.0, 0.0, 1.0)


@pytest.mark.parametrize(
    ("friction", "share"),
    [
        (Friction(0.3, 0.3), 0.25**2 / (0.2**2 + 0.25**2)),
        (Friction(1.0, 1.0), 0.25**2 / (0.2**2 + 0.25**2)),
        (Friction(0.05, 1.0, fdir1=ALONG_THE_AXLE), 1.0),
        (Friction(0.5, 100.0, fdir1=ALONG_THE_AXLE), 1.0),
        (Friction(1e5, 1e5, fdir1=ALONG_THE_AXLE), 0.0),
        (Friction(100.0, 100.0), 0.0),
    ],
)
def test_a_skid_steer_turns_by_what_its_friction_leaves(friction, share):
    """Alike in both directions, the wheels' slips balance at b² / (a² + b²) of what is asked."""
    rate, seconds = 0.5, 5.0
    engine = make_engine("mujoco", scenes.world(scenes.ground(1e5), skid_steer(friction)))
    for i, (_, y) in enumerate(CORNERS):
        engine.add_motor(f"cart::w{i}_joint", 100.0)
        engine.joints[f"cart::w{i}_joint"].set_motor_velocity(-rate * y / RADIUS)
    engine.step(500)
    turned, before = 0.0, None
    for _ in range(round(seconds / 0.1)):
        engine.step(100)
        x, y, z, w = engine.links["cart::base"].placement().quaternion[0]
        yaw = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
        if before is not None:
            turned += math.remainder(yaw - before, 2.0 * math.pi)
        before = yaw
    asked = rate * (seconds - 0.1)
    assert abs(turned) == pytest.approx(share * asked, rel=0.01, abs=0.002 * asked)
    assert abs(engine.links["cart::base"].placement().position[0, 2]) < 1e-3
