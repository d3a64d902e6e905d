"""Every joint against kinematics or mechanics."""

import math

import numpy as np
import pytest
import scenes

from gazelle import formats
from gazelle.description import (
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    Link,
    Mimic,
    Model,
    Pose,
    Source,
)
from gazelle.engines import make_engine
from gazelle.errors import EngineError, EngineWarning

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def mass(m=1.0, moment=0.01, **pose):
    return Inertial(m, Pose(**pose), Inertia(moment, moment, moment))


def link(name, **pose):
    return Link(name, pose=Pose(**pose), inertial=mass())


def joint(name, kind, parent, child, *axes, **options):
    return Joint(name, kind, parent, child, axes=tuple(JointAxis(a) for a in axes), **options)


def engine_of(*joints, links=("a", "b"), gravity=(0.0, 0.0, 0.0), poses=None, nworld=1):
    parts = tuple(link(n, **(poses or {}).get(n, {})) for n in links)
    model = Model("m", links=parts, joints=(Joint("hold", "fixed", "world", links[0]), *joints))
    return make_engine("mujoco", scenes.world(model, gravity=gravity), nworld)


def relative(engine, child="b"):
    place = engine.links[f"m::{child}"].placement()
    return Pose.from_quaternion(place.position[0], place.quaternion[0])


@pytest.mark.parametrize("kind", ["revolute", "continuous"])
def test_a_hinge_turns_about_its_axis_through_its_own_frame(kind):
    frame = Pose(x=0.5, roll=math.pi / 2)
    engine = engine_of(joint("j", kind, "a", "b", Z, pose=frame))
    engine.joints["m::j"].set_position(0.7)
    expected = frame * Pose(yaw=0.7) * frame.inverse()
    assert relative(engine).is_close(expected)


def test_a_prismatic_joint_slides_along_its_axis():
    engine = engine_of(joint("j", "prismatic", "a", "b", Y))
    engine.joints["m::j"].set_position(0.3)
    assert relative(engine).is_close(Pose(y=0.3))


def test_a_ball_joint_turns_freely_and_stays_in_place():
    engine = engine_of(joint("j", "ball", "a", "b", pose=Pose(z=0.2)))
    engine.joints["m::j"].set_velocity([1.0, 2.0, 0.5])
    engine.step(500)
    anchor = relative(engine).apply((0.0, 0.0, 0.2))
    assert anchor == pytest.approx((0.0, 0.0, 0.2), abs=1e-6)
    assert relative(engine).rpy != pytest.approx((0.0, 0.0, 0.0), abs=0.1)


def test_a_ball_joint_is_read_and_put_as_a_quaternion_x_y_z_w():
    engine = engine_of(joint("j", "ball", "a", "b", pose=Pose(z=0.2)), nworld=2)
    np.testing.assert_array_equal(engine.joints["m::j"].position(), [[0, 0, 0, 1]] * 2)
    turn = Pose(roll=0.3, pitch=-0.5, yaw=1.1)
    engine.joints["m::j"].set_position(3.0 * np.array(turn.quaternion), np.array([1]))
    np.testing.assert_allclose(engine.joints["m::j"].position()[1], turn.quaternion)
    place = engine.links["m::b"].placement()
    np.testing.assert_allclose(place.quaternion, [(0, 0, 0, 1), turn.quaternion], atol=1e-12)


def test_a_joint_is_put_no_further_than_its_limits_in_each_world():
    axis = JointAxis(X, lower=-1.0, upper=1.0)
    engine = engine_of(Joint("j", "revolute", "a", "b", axes=(axis,)), nworld=3)
    engine.set_parameter("joint_upper", "m::j", [[1.0], [2.0], [np.inf]])
    engine.joints["m::j"].set_position(5.0)
    np.testing.assert_array_equal(engine.joints["m::j"].position()[:, 0], [1.0, 2.0, 5.0])
    engine.joints["m::j"].set_position([[-7.0]], np.array([1]))
    np.testing.assert_array_equal(engine.joints["m::j"].position()[:, 0], [1.0, -1.0, 5.0])
    engine.step(100)
    np.testing.assert_allclose(engine.joints["m::j"].velocity(), 0.0, atol=1e-6)


def test_a_screw_without_thread_is_an_error_with_its_place():
    source = Source("robot.sdf", 7, "joint[j]")
    screw = joint("j", "screw", "a", "b", Z, thread_pitch=0.0, source=source)
    with pytest.raises(EngineError, match=r"robot\.sdf:7.*thread pitch of 0"):
        engine_of(screw)


@pytest.mark.parametrize("kind", ["universal", "revolute2"])
def test_two_axes_turn_one_after_the_other(kind):
    engine = engine_of(joint("j", kind, "a", "b", X, Y))
    engine.joints["m::j"].set_position([0.4, -0.9])
    assert relative(engine).is_close(Pose(roll=0.4) * Pose(pitch=-0.9))


def test_a_screw_advances_by_its_pitch_left_handed():
    engine = engine_of(joint("j", "screw", "a", "b", Z, thread_pitch=10.0))
    engine.joints["m::j"].set_effort([0.05, 0.0])
    engine.step(1500)
    angle, distance = engine.joints["m::j"].position()[0]
    assert abs(angle) > 1.0
    assert distance == pytest.approx(-angle / 10.0, abs=1e-4)


def test_a_screw_under_gravity_turns_as_energy_says():
    pitch, moment = 40.0, 0.01
    engine = engine_of(joint("j", "screw", "a", "b", Z, thread_pitch=pitch), gravity=(0, 0, -9.8))
    engine.step(1000)
    angle = engine.joints["m::j"].position()[0, 0]
    # m g = (m + I p²) z'' along the axis
    fallen = 0.5 * 9.8 / (1.0 + moment * pitch**2)
    assert angle / pitch == pytest.approx(fallen, rel=0.01)


def test_a_planar_joint_leaves_three_motions():
    engine = engine_of(joint("j", "planar", "a", "b", Z))
    engine.joints["m::j"].set_position([0.2, -0.3, 0.5])
    place = relative(engine)
    assert math.hypot(place.x, place.y) == pytest.approx(math.hypot(0.2, 0.3))
    assert place.z == pytest.approx(0.0)
    assert place.yaw == pytest.approx(0.5)


def test_a_floating_joint_between_links_leaves_them_free_as_in_gazebo():
    above = joint("k", "revolute", "b", "c", Z)
    with pytest.warns(EngineWarning, match="'m::j' is floating and left out: 'b' is a free link"):
        engine = engine_of(
            joint("j", "floating", "a", "b"),
            above,
            links=("a", "b", "c"),
            poses={"b": {"z": 2.0}, "c": {"z": 3.0}},
            gravity=(0.0, 0.0, -10.0),
        )
    engine.step(100)
    time = 100 * engine.time_step
    for name, z in {"b": 2.0, "c": 3.0}.items():
        assert relative(engine, name).z == pytest.approx(
            z - 5.0 * time**2, abs=6.0 * time * engine.time_step
        )
    assert relative(engine, "a").z == 0.0


def test_a_gearbox_turns_its_driven_wheel_the_other_way():
    engine = engine_of(
        joint("in", "revolute", "a", "b", X),
        joint("out", "revolute", "a", "c", X),
        joint("gear", "gearbox", "b", "c", X, X, gearbox_ratio=3.0, gearbox_reference_body="a"),
        links=("a", "b", "c"),
    )
    engine.joints["m::in"].set_effort(0.05)
    engine.step(2000)
    driving, driven = (
        engine.joints["m::in"].position()[0, 0],
        engine.joints["m::out"].position()[0, 0],
    )
    assert abs(driving) > 0.5
    assert driven == pytest.approx(-3.0 * driving, rel=1e-3)


@pytest.mark.parametrize(("parent", "child", "missing"), [("d", "c", "d"), ("b", "d", "d")])
def test_a_gearbox_on_a_link_without_a_hinge_is_left_out_and_told(parent, child, missing):
    with pytest.warns(EngineWarning, match=f"gearbox 'm::gear' needs .* turns 'm::{missing}'"):
        engine = engine_of(
            joint("in", "revolute", "a", "b", X),
            joint("out", "revolute", "a", "c", X),
            joint("gear", "gearbox", parent, child, X, X, gearbox_reference_body="a"),
            links=("a", "b", "c", "d"),
        )
    engine.joints["m::in"].set_effort(0.05)
    engine.step(100)
    assert abs(engine.joints["m::in"].position()[0, 0]) > 1e-4
    assert engine.joints["m::out"].position()[0, 0] == pytest.approx(0.0, abs=1e-9)


def test_a_mimic_follows_its_leader():
    follower = JointAxis(X, mimic=Mimic("lead", multiplier=-2.0, offset=0.1, reference=0.05))
    engine = engine_of(
        joint("lead", "revolute", "a", "b", X),
        Joint("follow", "revolute", "a", "c", axes=(follower,)),
        links=("a", "b", "c"),
    )
    engine.joints["m::lead"].set_effort(0.05)
    engine.step(2000)
    lead, follow = (
        engine.joints["m::lead"].position()[0, 0],
        engine.joints["m::follow"].position()[0, 0],
    )
    assert abs(lead) > 0.5
    assert follow == pytest.approx(0.1 - 2.0 * (lead - 0.05), abs=2e-3)


@pytest.mark.parametrize(
    ("leader", "axis", "message"),
    [
        ("leed", 0, "robot.sdf:5: .*mimics 'm::leed'.*did you mean 'm::lead'"),
        ("follow", 0, "robot.sdf:5: .*mimics 'm::follow', which is no other joint"),
        ("lead", 1, "robot.sdf:5: .*axis 1 of 'm::lead', which has 1"),
    ],
)
def test_a_mimic_with_nothing_to_follow_is_an_error_with_its_place(leader, axis, message):
    axes = (JointAxis(X, mimic=Mimic(leader, axis)),)
    source = Source("robot.sdf", 5, "joint")
    follow = Joint("follow", "revolute", "a", "c", axes=axes, source=source)
    with pytest.raises(EngineError, match=message):
        engine_of(joint("lead", "revolute", "a", "b", X), follow, links=("a", "b", "c"))


def test_joints_that_mimic_each_other_are_an_error_with_its_place():
    source = Source("robot.sdf", 5, "joint")
    joints = [
        Joint(a, "revolute", "a", b, axes=(JointAxis(X, mimic=Mimic(c)),), source=source)
        for a, b, c in (("j", "b", "k"), ("k", "c", "j"))
    ]
    with pytest.raises(EngineError, match=r"robot.sdf:5: .*itself: m::j -> m::k -> m::j"):
        engine_of(*joints, links=("a", "b", "c"))


def four_bar(closing):
    """Return a parallelogram in the xz plane: ground a, cranks b and d, coupler c."""
    links = (
        Link("a", inertial=mass()),
        Link("b", inertial=mass(z=0.1)),
        Link("c", pose=Pose(z=0.2), inertial=mass(x=0.15)),
        Link("d", pose=Pose(x=0.3), inertial=mass(z=0.1)),
    )
    joints = (
        Joint("hold", "fixed", "world", "a"),
        joint("ab", "revolute", "a", "b", Y),
        joint("bc", "revolute", "b", "c", Y),
        joint("ad", "revolute", "a", "d", Y),
        joint("dc", closing, "d", "c", Y, pose=Pose(x=0.3)),
    )
    return Model("bar", links=links, joints=joints)


@pytest.mark.parametrize("closing", ["revolute", "continuous"])
def test_a_four_bar_linkage_stays_a_parallelogram(closing):
    engine = make_engine("mujoco", scenes.world(four_bar(closing)))
    engine.joints["bar::ab"].set_effort(0.3)
    for _ in range(40):
        engine.step(50)
        cranks = [engine.joints[f"bar::{j}"].position()[0, 0] for j in ("ab", "ad")]
        assert cranks[0] == pytest.approx(cranks[1], abs=0.01)
        c = engine.links["bar::c"].placement()
        coupler = Pose.from_quaternion(c.position[0], c.quaternion[0])
        assert abs(coupler.pitch) < 0.02
    assert abs(cranks[0]) > 0.1


def test_a_ring_of_free_links_is_opened_at_its_first_link_and_held_together():
    corners = [(0.0, 0.0), (0.4, 0.0), (0.4, 0.4), (0.0, 0.4)]
    links = tuple(link(f"l{i}", x=x, y=y) for i, (x, y) in enumerate(corners))
    joints = tuple(
        joint(f"j{i}", "revolute", f"l{i - 1}" if i else "l3", f"l{i}", Z) for i in range(4)
    )
    model = Model("m", links=links, joints=joints)
    engine = make_engine("mujoco", scenes.world(model, gravity=(0, 0, 0)))
    engine.joints["m::j1"].set_effort(0.02)
    engine.step(1000)
    l0, l3 = relative(engine, "l0"), relative(engine, "l3")
    assert abs(engine.joints["m::j1"].position()[0, 0]) > 0.05
    assert (l3.inverse() * l0).position == pytest.approx((0.0, -0.4, 0.0), abs=2e-3)


def test_a_second_slide_between_two_links_leaves_the_first_free():
    engine = engine_of(joint("j1", "prismatic", "a", "b", X), joint("j2", "prismatic", "a", "b", X))
    engine.joints["m::j1"].set_effort(0.5)
    engine.step(1000)
    apart = relative(engine).x
    assert apart == pytest.approx(engine.joints["m::j1"].position()[0, 0])
    assert apart == pytest.approx(0.5 * 0.5, rel=0.02)  # one kilogram, and a hundredth


def test_damping_slows_a_hinge_as_an_exponential():
    axis = JointAxis(X, damping=0.02)
    engine = engine_of(Joint("j", "continuous", "a", "b", axes=(axis,)))
    engine.joints["m::j"].set_velocity(5.0)
    engine.step(500)
    expected = 5.0 * math.exp(-0.02 / 0.01 * 0.5)
    assert engine.joints["m::j"].velocity()[0, 0] == pytest.approx(expected, rel=0.01)


def test_an_armature_resists_acceleration_alone():
    axis = JointAxis(X, armature=0.03)
    engine = engine_of(Joint("j", "continuous", "a", "b", axes=(axis,)))
    engine.joints["m::j"].set_effort(0.02)
    engine.step(500)
    expected = 0.02 / (0.01 + 0.03) * 0.5  # as far as effort and inertia say
    assert engine.joints["m::j"].velocity()[0, 0] == pytest.approx(expected, rel=1e-3)
    engine.joints["m::j"].set_effort(0.0)
    engine.step(500)
    assert engine.joints["m::j"].velocity()[0, 0] == pytest.approx(expected, rel=1e-3)


def test_friction_stops_a_hinge_evenly():
    axis = JointAxis(X, friction=0.02)
    engine = engine_of(Joint("j", "continuous", "a", "b", axes=(axis,)))
    engine.joints["m::j"].set_velocity(5.0)
    engine.step(1000)
    assert engine.joints["m::j"].velocity()[0, 0] == pytest.approx(
        5.0 - 0.02 / 0.01 * 1.0, rel=0.02
    )
    engine.step(3000)
    assert engine.joints["m::j"].velocity()[0, 0] == pytest.approx(0.0, abs=1e-6)


def test_a_spring_swings_at_its_frequency():
    axis = JointAxis(X, spring_stiffness=1.0, spring_reference=0.3)
    engine = engine_of(Joint("j", "revolute", "a", "b", axes=(axis,)))
    half_period = math.pi * math.sqrt(0.01 / 1.0)
    engine.step(round(half_period / 0.001))
    assert engine.joints["m::j"].position()[0, 0] == pytest.approx(0.6, rel=0.02)
    assert np.isfinite(engine.snapshot()).all()


@pytest.mark.parametrize("kind", ["revolute", "prismatic", "ball", "universal"])
def test_a_joint_may_have_the_name_of_the_root_link(kind):
    axes = {"ball": ""}.get(kind, "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>")
    links = "".join(
        f"<link name='{name}'><inertial><mass>1</mass></inertial></link>" for name in "abc"
    )
    world = formats.load_string(
        f"<sdf version='1.6'><world name='w'><model name='m'>{links}<joint name='a' type='{kind}'>"
        f"<parent>a</parent><child>b</child>{axes}</joint></model></world></sdf>"
    )
    engine = make_engine("mujoco", world)
    engine.step(3)
    found = engine.links[("m::a", "m::c")].placement().position[0, :, 2]
    np.testing.assert_allclose(found, found[0], atol=1e-12)
    assert -1e-4 < found[0] < 0.0
