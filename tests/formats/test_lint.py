"""The judgement of an experienced engineer, rule by rule."""

import dataclasses

import pytest
import scenes

from gazelle import assets, formats
from gazelle.description import (
    Box,
    Camera,
    Collision,
    Contact,
    Cylinder,
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    JointPhysics,
    Link,
    Mesh,
    Mimic,
    Model,
    Physics,
    Plugin,
    Pose,
    Sensor,
    Source,
    Sphere,
    Surface,
    World,
)
from gazelle.formats.lint import lint

HERE = Source("robot.sdf", 7, "here")


def rules(world):
    return [finding.rule for finding in lint(world)]


def world_of(link, *joints, links=(), step=0.001, **options):
    model = Model("m", links=(link, *links), joints=joints, source=HERE, **options)
    return World(models=(scenes.ground(), model), physics=(Physics(max_step_size=step),))


def solid(shape, mass, *moments, **options):
    inertial = Inertial(mass, inertia=Inertia(*moments), source=HERE)
    return Link("l", inertial=inertial, collisions=(Collision("c", shape, **options),), source=HERE)


GOOD = solid(Box((0.2, 0.2, 0.2)), 1.0, 0.0067, 0.0067, 0.0067)


def test_a_sound_body_is_left_alone():
    assert rules(world_of(GOOD)) == []


@pytest.mark.parametrize(
    ("link", "rule"),
    [
        (Link("l", collisions=GOOD.collisions), "no-inertial"),
        (solid(Box((1, 1, 1)), 1.0, 0.1, 0.1, 0.5), "inertia-triangle"),
        (solid(Sphere(0.1), 1.0, 4.0, 4.0, 4.0), "inertia-off"),
        (solid(Cylinder(0.03, 0.02), 0.03, 1e-9, 1e-9, 1e-9), "inertia-off"),
        (dataclasses.replace(GOOD, collisions=()), "falls"),
    ],
)
def test_bad_masses_and_unsupported_bodies_are_found(link, rule):
    assert rules(world_of(link)) == [rule]


def test_a_finding_has_place_reason_and_advice():
    finding = lint(world_of(solid(Sphere(0.1), 1.0, 4.0, 4.0, 4.0)))[0]
    assert finding.source == HERE
    assert "1,000 times" in finding.message
    assert finding.why
    assert "units" in finding.hint


def test_static_and_scripted_models_need_no_inertia():
    bare = Link("l", collisions=GOOD.collisions)
    assert rules(world_of(bare, static=True)) == []
    script = Plugin("motion", "libgazelle_scripted_motion.so")
    assert rules(world_of(bare, plugins=(script,))) == []


def test_a_contact_too_stiff_for_the_step_says_what_would_do():
    soft = Surface(contact=Contact(kp=1e6))
    link = solid(Box((0.2, 0.2, 0.2)), 1.0, 0.0067, 0.0067, 0.0067, surface=soft)
    assert rules(world_of(link, step=0.01)) == ["stiff-contact"]
    assert rules(world_of(link, step=0.001)) == []


def other(name="b"):
    return dataclasses.replace(GOOD, name=name)


@pytest.mark.parametrize(
    ("joint", "expected"),
    [
        (Joint("j", "revolute", "l", "bb", axes=(JointAxis(),)), ["joint-link"]),
        (Joint("j", "prismatic", "l", "b", axes=(JointAxis(),)), ["no-limits"]),
        (
            Joint("j", "revolute", "l", "b", axes=(JointAxis(lower=1, upper=-1),)),
            ["limits-crossed"],
        ),
        (Joint("j", "revolute", "l", "b", axes=(JointAxis(effort=0.0),)), ["no-effort"]),
        (
            Joint("j", "revolute", "l", "b", axes=(JointAxis(damping=-0.1, friction=-1.0),)),
            ["negative-damping", "negative-damping"],
        ),
        (Joint("j", "ball", "l", "b", physics=JointPhysics(fudge_factor=0.1)), ["ode-terms"]),
        (Joint("j", "ball", "l", "b", physics=JointPhysics(stop_cfm=0.1)), []),
        (Joint("j", "revolute", "l", "b", axes=(JointAxis(velocity=0.0),)), ["no-velocity"]),
        (
            Joint("j", "revolute", "l", "b", axes=(JointAxis(mimic=Mimic("jj")),)),
            ["mimic-leader"],
        ),
        (Joint("j", "revolute", "l", "b", axes=(JointAxis(mimic=Mimic("j")),)), ["mimic-cycle"]),
        (Joint("j", "revolute", "l", "b", axes=(JointAxis(),)), []),
    ],
)
def test_joints_are_judged(joint, expected):
    assert rules(world_of(GOOD, joint, links=(other(),))) == expected


def test_masses_far_apart_on_one_joint_are_found():
    tiny = solid(Sphere(0.05), 1e-5, 1e-8, 1e-8, 1e-8)
    joint = Joint("j", "revolute", "l", "b", axes=(JointAxis(),))
    heavy = world_of(GOOD, joint, links=(dataclasses.replace(tiny, name="b"),))
    assert rules(heavy) == ["mass-ratio"]


def sensing(sensor, shape=None, **pose):
    collision = Collision("c", shape or Box((0.2, 0.2, 0.2)), Pose(**pose))
    return dataclasses.replace(GOOD, sensors=(sensor,), collisions=(collision,))


def test_a_lidar_inside_its_own_collision_is_found():
    scanner = dataclasses.replace(scenes.lidar(), pose=Pose())
    inside = sensing(scanner, Cylinder(0.3, 0.1))
    assert rules(world_of(inside)) == ["lidar-inside"]
    covered = sensing(scanner, Cylinder(0.1, 0.3))
    assert "lidar-inside" not in rules(world_of(covered))  # nearer than the smallest range


def test_a_lidar_inside_its_own_mesh_is_found(tmp_path):
    import trimesh

    trimesh.creation.icosphere(radius=0.3).export(tmp_path / "ball.stl")
    half = trimesh.creation.icosphere(radius=0.3).slice_plane((0.1, 0, 0), (-1, 0, 0))
    half.export(tmp_path / "open.stl")
    for name, expected in {"ball.stl": ["lidar-inside"], "open.stl": []}.items():
        link = sensing(
            dataclasses.replace(scenes.lidar(), pose=Pose()), Mesh(name, tmp_path / name)
        )
        assert rules(world_of(link)) == expected, name
    above = sensing(
        dataclasses.replace(scenes.lidar(), pose=Pose(z=0.4)), Mesh(name, tmp_path / name)
    )
    assert rules(world_of(above)) == []


def test_sensors_that_can_see_nothing_are_found():
    blind = scenes.lidar(range_min=1.0, range_max=0.5)
    assert "lidar-range" in rules(world_of(sensing(dataclasses.replace(blind, pose=Pose(z=1)))))
    camera = Sensor("c", "camera", cameras=(Camera(near=1.0, far=0.5, horizontal_fov=60.0),))
    assert rules(world_of(sensing(camera))) == ["camera-clip", "camera-fov"]


def test_plugins_that_name_missing_joints_are_found():
    plugin = scenes.drive_plugin(leftJoint="wheel_left_jnt")
    model = dataclasses.replace(scenes.burger(), plugins=(plugin,))
    found = [f for f in lint(World(models=(model,))) if f.rule == "plugin-joint"]
    assert len(found) == 1
    assert found[0].hint == "did you mean 'wheel_left_joint'?"


@pytest.mark.parametrize("legacy", [None, "true", "false"])
def test_a_left_wheel_on_the_right_is_found(legacy):
    """<legacyMode> of ROS Kinetic exchanged the wheels; since Melodic it has no effect."""
    given = {} if legacy is None else {"legacyMode": legacy}
    burger = scenes.burger()
    swapped = scenes.drive_plugin(
        leftJoint="wheel_right_joint", rightJoint="wheel_left_joint", **given
    )
    for plugin, expected in ((scenes.drive_plugin(**given), 0), (swapped, 1)):
        model = dataclasses.replace(burger, plugins=(plugin,))
        found = [f for f in lint(World(models=(model,))) if f.rule == "wheels-swapped"]
        assert len(found) == expected
        assert all("legacyMode" in f.hint for f in found)


def test_a_robot_that_drives_backwards_has_its_left_on_the_other_side():
    def turned(joint):
        axes = tuple(dataclasses.replace(axis, xyz=(0.0, 0.0, -1.0)) for axis in joint.axes)
        return dataclasses.replace(joint, axes=axes)

    burger = scenes.burger()
    model = dataclasses.replace(burger, joints=tuple(map(turned, burger.joints)))
    assert "wheels-swapped" in rules(World(models=(model,)))
    plugin = scenes.drive_plugin(leftJoint="wheel_right_joint", rightJoint="wheel_left_joint")
    model = dataclasses.replace(model, plugins=(plugin,))
    assert "wheels-swapped" not in rules(World(models=(model,)))


@pytest.mark.parametrize("moments", [(1.0, 0.1, 0.1), (0.0, 0.1, 0.1), (9.0, 9.0, 9.0)])
@pytest.mark.parametrize("lines", ["", "\n"])
def test_one_link_has_one_finding_on_its_inertia(tmp_path, moments, lines):
    ixx, iyy, izz = moments
    file = tmp_path / "robot.urdf"
    file.write_text(
        f"<robot name='r'><link name='l'><inertial>{lines}<mass value='1'/>{lines}"
        f"<inertia ixx='{ixx}' iyy='{iyy}' izz='{izz}' ixy='0' ixz='0' iyz='0'/></inertial>"
        "<collision><geometry><box size='.1 .1 .1'/></geometry></collision></link></robot>"
    )
    assert len(formats.check(file)) == 1


def test_heavy_collision_meshes_are_found(tmp_path):
    import trimesh

    file = tmp_path / "ball.stl"
    trimesh.creation.icosphere(subdivisions=6).export(file)
    mesh = Mesh("ball.stl", file)
    link = dataclasses.replace(GOOD, collisions=(Collision("c", mesh),))
    assert rules(world_of(link)) == ["heavy-mesh"]


def test_a_coarse_step_and_equal_names_are_found():
    world = world_of(GOOD, step=0.1)
    twice = dataclasses.replace(world, models=(*world.models, world.models[1]))
    assert rules(twice) == ["coarse-step", "duplicate-name"]


PUBLISHED_INERTIAS = {"kobuki", "monoped"}
"""Robots whose makers publish inertias that their shapes cannot have; ours have the same."""


@pytest.mark.parametrize("name", [*assets.worlds(), *assets.robots(), *assets.models()])
def test_what_is_bundled_passes(name):
    found = {problem.rule for problem in formats.check(name)}
    assert found == ({"inertia-off"} if name in PUBLISHED_INERTIAS else set())
