"""Files saved as URDF are the same robot when loaded; what URDF cannot express is named."""

import math
import warnings
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, given, settings

from gazelle import Error, FormatError, formats
from gazelle.description import (
    Box,
    Collision,
    Contact,
    ContactSensor,
    Ellipsoid,
    Frame,
    Friction,
    Inertial,
    Joint,
    JointAxis,
    Light,
    Link,
    Material,
    Mimic,
    Model,
    Plane,
    Plugin,
    Pose,
    Sensor,
    Sphere,
    Surface,
    Visual,
    World,
)
from gazelle.errors import FormatWarning
from gazelle.formats.urdf.upright import upright
from tests.formats.strategies import robots

quiet = pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
BOX = Box((1.0, 1.0, 1.0))
ARM = JointAxis((0.0, 0.0, 1.0), -1.0, 1.0, 5.0, 2.0)


def link(name, pose=None, **parts):
    return Link(name, pose or Pose(), Inertial(), **parts)


def model(*links, **parts):
    return Model("robot", links=links, **parts)


def again(content):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return formats.load_model_string(formats.to_string(content, "urdf"))


def by_name(parts):
    return {part.name: part for part in parts}


def near(pose, other, reach):
    return pose.is_close(other, position=1e-9 * max(1.0, reach), angle=1e-9)


def near_or_upright(pose, other):
    """Return whether poses are near; a pitch of nearly a right angle may have become one."""
    return near(pose, other, 1e6) or near(upright(pose), other, 1e6)


def assert_same_robot(found, robot):
    ours, theirs = by_name(robot.links), by_name(found.links)
    assert ours.keys() == theirs.keys()
    reach = sum(math.dist(part.pose.position, (0, 0, 0)) for part in robot.links)
    for name, one in ours.items():
        other = theirs[name]
        assert near(one.pose, other.pose, reach)
        assert one.inertial.mass == other.inertial.mass
        assert near(one.inertial.pose, other.inertial.pose, 1e6)
        assert other.inertial.inertia.matrix() == pytest.approx(one.inertial.inertia.matrix())
        assert [c.geometry for c in one.collisions] == [c.geometry for c in other.collisions]
        if all(c == Collision(c.name, c.geometry, c.pose) for c in one.collisions):
            # a surface is found by names, so there they may have to change
            assert [c.name for c in one.collisions] == [c.name for c in other.collisions]
        assert [c.surface for c in one.collisions] == [c.surface for c in other.collisions]
        assert all(
            near_or_upright(a.pose, b.pose)
            for a, b in zip(one.collisions, other.collisions, strict=True)
        )
        assert (one.gravity, one.self_collide) == (other.gravity, other.self_collide)
        assert one.sensors == other.sensors
        assert one.lights == other.lights
    assert_same_joints(found, robot)
    assert near(found.pose, robot.pose, 1e6)
    assert (found.plugins, found.transmissions) == (robot.plugins, robot.transmissions)


def assert_same_joints(found, robot):
    ours, theirs = by_name(robot.joints), by_name(found.joints)
    assert ours.keys() == theirs.keys()
    for name, one in ours.items():
        other = theirs[name]
        kinds = {one.type, other.type}
        assert len(kinds) == 1 or kinds == {"revolute", "continuous"}
        assert (one.parent, one.child, one.safety) == (other.parent, other.child, other.safety)
        assert one.axes == other.axes
        assert one.physics == other.physics
        assert one.sensors == other.sensors


@pytest.mark.long
@quiet
@settings(max_examples=40, deadline=None, suppress_health_check=list(HealthCheck))
@given(robots())
def test_every_robot_is_the_same_when_loaded_again(robot):
    assert_same_robot(formats.load_model_string(formats.to_string(robot, "urdf")), robot)


@quiet
@pytest.mark.parametrize("name", ["turtlebot3_burger", "turtlebot3_waffle", "turtlebot3_waffle_pi"])
def test_bundled_robots_are_the_same(name):
    robot = formats.load_model(name)
    found = formats.load_model_string(formats.to_string(robot, "urdf"))
    ours, theirs = by_name(robot.links), by_name(found.links)
    assert ours.keys() == theirs.keys()
    assert {frame.name for frame in robot.frames} <= {frame.name for frame in found.frames}
    assert_same_joints(found, robot)
    for name, one in ours.items():
        other = theirs[name]
        assert one.inertial == other.inertial
        assert one.sensors == other.sensors

        def key(part):
            return (part.pose.position, part.pose.quaternion, repr(part.geometry))

        assert [(c.geometry, c.surface) for c in sorted(one.collisions, key=key)] == [
            (c.geometry, c.surface) for c in sorted(other.collisions, key=key)
        ]
        assert [v.material for v in one.visuals] == [v.material for v in other.visuals]


def test_link_frames_move_to_their_joints_and_nothing_else_moves():
    body = link("body", Pose(0, 0, 1), collisions=(Collision("body_collision", BOX, Pose(0.1)),))
    arm = link("arm", Pose(1, 0, 1, yaw=0.5), collisions=(Collision("arm_collision", BOX),))
    hinge = Joint("hinge", "revolute", "body", "arm", Pose(0, 0.2, 0, roll=1.0), (ARM,))
    robot = model(body, arm, joints=(hinge,), frames=(Frame("tip", "arm", Pose(z=2)),))
    with pytest.warns(FormatWarning, match="frame of a link at its joint"):
        text = formats.to_string(robot, "urdf")
    found = formats.load_model_string(text)
    assert found.links[1].pose.is_close(arm.pose * hinge.pose)
    assert found.joints[0].pose == Pose()
    for one, other in zip(robot.links, found.links, strict=True):
        assert (one.pose * one.inertial.pose).is_close(other.pose * other.inertial.pose)
        assert (one.pose * one.collisions[0].pose).is_close(other.pose * other.collisions[0].pose)
    assert (found.links[1].pose * found.frames[0].pose).is_close(arm.pose * Pose(z=2))


def test_collisions_of_one_link_keep_their_own_surfaces():
    slippery = Surface(Friction(0.1, 0.1), Contact(kp=1e6, kd=10.0))
    parts = tuple(
        Collision(f"body_collision_{n}" if n else "body_collision", Sphere(1.0 + n), surface=s)
        for n, s in enumerate([Surface(), slippery, Surface(), slippery])
    )
    found = again(model(link("body", collisions=parts))).links[0]
    assert {(c.geometry, c.surface) for c in found.collisions} == {
        (c.geometry, c.surface) for c in parts
    }
    assert found.inertial == Inertial()


def test_a_contact_sensor_still_watches_its_collision():
    for name in ("body_collision", "body_bumper", "bumper"):
        contact = Sensor("touch", "contact", contact=ContactSensor((name,)))
        parts = (Collision("body_first", BOX), Collision(name, Sphere(1.0)))
        found = again(model(link("body", collisions=parts, sensors=(contact,)))).links[0]
        assert found.sensors[0].contact.collisions == (found.collisions[1].name,)


def test_materials_stay():
    plain = Material((1.0, 0.0, 0.0, 1.0), (1.0, 0.0, 0.0, 1.0))
    full = Material((0.1,) * 4, (0.2,) * 4, (0.3,) * 4, (0.4,) * 4, "Own/Paint", ("a", "b"))
    for material in (plain, full, None):
        body = link("body", visuals=(Visual("body_visual", BOX, material=material),))
        assert again(model(body)).links[0].visuals[0].material == material


def test_worlds_mimics_loops_and_static_robots_are_kept():
    arm, other = link("arm", Pose(1)), link("other", Pose(1))
    joints = (
        Joint("base", "fixed", "world", "body"),
        Joint("hinge", "revolute", "body", "arm", axes=(ARM,)),
        Joint(
            "more",
            "prismatic",
            "body",
            "other",
            axes=(replace(ARM, mimic=Mimic("hinge", 0, 2.0, 1.0, 0.5)),),
        ),
        Joint("loop", "ball", "arm", "other"),
    )
    found = again(model(link("body"), arm, other, joints=joints))
    assert not found.static
    assert by_name(found.joints)["base"].parent == "world"
    assert by_name(found.joints)["loop"].type == "ball"
    assert by_name(found.joints)["more"].axes[0].mimic == Mimic("hinge", 0, 2.0, 0.0)
    assert again(model(link("body"), static=True)).static


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (World(), "holds one model"),
        (World(models=(model(link("a")), replace(model(link("a")), name="b"))), "has 2"),
        (model(link("a"), models=(model(link("b")),)), "nested"),
        (model(link("a"), link("b")), "one tree"),
        (model(link("a"), link("b"), joints=(Joint("j", "ball", "a", "b"),)), "no 'ball' joint"),
        (
            model(
                link("a"), link("b"), joints=(Joint("j", "universal", "a", "b", axes=(ARM, ARM)),)
            ),
            "no 'universal' joint",
        ),
        (
            model(
                link("a"),
                link("b"),
                joints=(Joint("j", "fixed", "a", "b"), Joint("k", "fixed", "b", "a")),
            ),
            "cycle",
        ),
    ],
)
def test_what_urdf_cannot_hold_is_an_error(content, message):
    with pytest.raises(FormatError, match=message):
        formats.to_string(content, "urdf")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (model(link("a", collisions=(Collision("c", Plane()),))), "no shape 'plane'"),
        (
            model(link("a", visuals=(Visual("v", Ellipsoid((1.0, 1.0, 1.0))),))),
            "no shape 'ellipsoid'",
        ),
        (World(models=(model(link("a")),), lights=(Light("sun"),)), "lights"),
        (World(models=(model(link("a")),), plugins=(Plugin("p", "f.so"),)), "plugins"),
        (model(link("a"), link("b"), static=True), "fixed joints hold 'b'"),
        (
            model(
                link("a"),
                link("b"),
                joints=(Joint("j", "revolute", "a", "b", axes=(replace(ARM, stiffness=1.0),)),),
            ),
            "stiffness",
        ),
    ],
)
def test_what_urdf_leaves_out_is_a_warning(content, message):
    with pytest.warns(FormatWarning, match=message):
        formats.load_model_string(formats.to_string(content, "urdf"))


@quiet
@pytest.mark.corpus
def test_robots_of_the_corpus_are_the_same(corpus):
    """Each URDF is read, written and read; then links, joints, inertias and poses agree."""
    count = 0
    for path in sorted(corpus.rglob("*.urdf")):
        try:
            robot = formats.load_model(path)
            text = formats.to_string(robot, "urdf", folder=path.parent)
        except Error:
            continue
        found = formats.load_model_string(text)
        count += 1
        assert {part.name for part in found.links} == {part.name for part in robot.links}, path
        assert_same_joints(found, robot)
        theirs = by_name(found.links)
        for one in robot.links:
            other = theirs[one.name]
            assert near(one.pose, other.pose, 10.0), path
            assert one.inertial == other.inertial, path
            assert len(one.collisions) == len(other.collisions), path
    assert count >= 15


def test_fixed_joints_of_lumped_links_keep_their_names():
    massive = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
    robot = formats.load_model_string(
        f"""<robot name="r"><link name="base">{massive}</link><link name="laser"/><link name="tip"/>
        <joint name="mount" type="fixed"><parent link="base"/><child link="laser"/></joint>
        <joint name="laser_joint" type="fixed"><parent link="laser"/><child link="tip"/></joint>
        </robot>"""
    )
    bare = replace(robot, frames=(*robot.frames, Frame("laser_", "base"), Frame("mount2", "base")))
    for _ in range(2):
        joints = {frame.name: frame.joint for frame in again(bare).frames}
        assert joints["laser"] == "mount"
        assert joints["tip"] == "laser_joint"
        assert joints["mount2"] == "mount2_joint"
        bare = again(bare)
