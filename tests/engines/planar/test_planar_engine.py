"""The planar engine keeps the Engine protocol, and agrees with the engine in three dimensions."""

import math

import numpy as np
import pytest
import scenes

from gazelle import assets
from gazelle.description import (
    Box,
    Collision,
    Cylinder,
    Lidar,
    Link,
    Mesh,
    Model,
    Polyline,
    Pose,
    Scan,
    Sensor,
    Sphere,
)
from gazelle.engines import make_engine
from gazelle.errors import EngineError
from gazelle.rotations import from_yaw, yaw_of
from gazelle.simulation import Simulation


def still(name, shape, pose):
    return Model(
        name, pose=pose, static=True, links=(Link("link", collisions=(Collision("c", shape),)),)
    )


def scanner_model(z=0.3, samples=90):
    lidar = Lidar(Scan(samples, 1.0, -math.pi, math.pi - 2 * math.pi / samples), range_max=20.0)
    link = Link(
        "base",
        collisions=(Collision("c", Cylinder(0.1, 0.2), Pose(z=0.1)),),
        sensors=(Sensor("eye", "ray", Pose(z=z), lidar=lidar),),
    )
    return Model("scanner", links=(link,))


def rays(samples=90, z=0.3, begin=0.0):
    angles = -math.pi + 2 * math.pi / samples * np.arange(samples)
    along = np.stack((np.cos(angles), np.sin(angles), np.zeros(samples)), axis=1)
    return begin * along + (0.0, 0.0, z), along


def both(world, nworld=1):
    return [make_engine(name, world, nworld) for name in ("mujoco", "planar")]


def ring_mesh(tmp_path):
    """Return a leaning pyramid as a mesh in a file."""
    corners = "v 0.5 0.5 0\nv -0.5 0.5 0\nv -0.5 -0.5 0\nv 0.5 -0.5 0\nv 0.1 0.2 1\n"
    faces = "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 4 3 2\nf 4 2 1\n"
    path = tmp_path / "pyramid.obj"
    path.write_text(corners + faces)
    return Mesh("pyramid.obj", path)


def test_scans_agree_with_mujoco_whatever_the_shape(tmp_path):
    things = [
        still("box", Box((1.0, 0.5, 1.0)), Pose(2.0, 0.3, 0.5, yaw=0.4)),
        still("leaning", Box((0.3, 0.4, 1.5)), Pose(-2.0, 0.5, 0.4, roll=0.3, pitch=0.5)),
        still("pillar", Cylinder(0.3, 2.0), Pose(0.5, 2.0, 1.0)),
        still("lying", Cylinder(0.4, 1.0), Pose(0.3, -2.0, 0.3, roll=1.5, yaw=0.2)),
        still("ball", Sphere(0.6), Pose(-1.5, -1.8, 0.1)),
        still("mesh", ring_mesh(tmp_path), Pose(-0.6, 1.9, 0.0, yaw=0.3)),
        still(
            "notch",
            Polyline((((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.3), (0.0, 1.0)),), 1.0),
            Pose(1.8, -1.9),
        ),
        still("low", Box((1.0, 1.0, 0.1)), Pose(1.0, 0.0, 0.05)),
    ]
    origins, along = rays()
    deep, flat = both(scenes.world(*things, scanner_model()))
    for pose in ((0.0, 0.0, 0.0), (0.4, 0.3, 1.0), (-0.3, -0.8, -2.0)):
        for engine in (deep, flat):
            engine.models["scanner"].set_placement((*pose[:2], 0.0), from_yaw(np.array(pose[2])))
        a, b = (e.links["scanner::base"].cast_rays(origins, along) for e in (deep, flat))
        with np.errstate(invalid="ignore"):
            off = np.abs(a.distance - b.distance)
        both_inf = np.isinf(a.distance) & np.isinf(b.distance)
        assert (both_inf | (off < 0.01)).mean() >= 1.0 - 2 / 90  # rays that graze an edge
        assert not b.from_inside.any()


def test_rays_that_begin_inside_something_say_so():
    origins, along = rays(begin=0.28)
    world = scenes.world(still("pillar", Cylinder(0.5, 2.0), Pose(0.2)), scanner_model())
    a, b = (e.links["scanner::base"].cast_rays(origins, along) for e in both(world))
    assert (a.from_inside == b.from_inside).all()
    assert b.from_inside.any()
    assert a.distance == pytest.approx(b.distance, abs=1e-3)


@pytest.mark.parametrize(
    ("origins", "along"),
    [
        (np.zeros((1, 3)), np.array([[0.6, 0.0, 0.8]])),
        (np.array([[0.0, 0.0, 0.4]]), np.array([[0.0, 0.0, -1.0]])),
        (np.array([[0.0, 0.0, 0.2], [0.0, 0.0, 0.3]]), np.array([[1.0, 0.0, 0.0]] * 2)),
    ],
    ids=["leaning", "down", "two heights"],
)
@pytest.mark.parametrize("link", ["scanner::base", "pillar::link"])  # which has no body
def test_rays_that_are_not_level_are_refused_and_change_nothing(link, origins, along):
    world = scenes.world(still("pillar", Cylinder(0.5, 2.0), Pose(2.0)), scanner_model())
    engine = make_engine("planar", world)
    fleet, revision = engine.fleet, engine.revision
    with pytest.raises(EngineError, match="level plane"):
        engine.links[link].cast_rays(origins, along)
    assert engine.fleet is fleet
    assert engine.revision == revision


def drive(engine, world, command, pose=None, seconds=5.0):
    sim = Simulation(world, engine)
    start = Pose(x=-0.7) if world.endswith("4") else Pose(x=-1.0, y=-0.5)
    robot = sim.spawn(assets.robot("turtlebot3_burger"), name="burger", pose=start)
    sim.run(0.5)
    robot.inputs["cmd_vel"].send(linear=command[0], angular=command[1])
    sim.run(1.0)  # a robot with mass slips while it speeds up
    if pose is not None:
        sim.engine.models["burger"].set_placement(pose.position, pose.quaternion)
    begin = robot.placement()
    sim.run(seconds)
    return sim, robot, begin


@pytest.mark.parametrize(
    ("world", "command"),
    [
        ("turtlebot3_stage_1", (0.22, 0.0)),
        ("turtlebot3_stage_1", (0.2, 0.1)),
        ("turtlebot3_stage_1", (0.15, -0.1)),
        ("turtlebot3_stage_4", (0.12, 0.03)),
    ],
)
def test_a_burger_drives_and_sees_as_in_three_dimensions(world, command):
    deep, there, begin = drive("mujoco", world, command)
    flat, here, _ = drive("planar", world, command, begin)
    with deep, flat:
        gone = command[0] * 5.0
        assert np.hypot(*(there.position - here.position)[0, :2]) < 0.01 * gone
        place = there.placement()
        flat.engine.models["burger"].set_placement(place.position, place.quaternion)
        sensor = next(s for s in there.sensors.values() if s.description.lidar is not None)
        seen = here.sensors[sensor.description.name].measure()[0]
        true = sensor.measure()[0]
        agree = (np.isinf(seen) & np.isinf(true)) | (np.abs(seen - true) <= 0.01)
        assert agree.mean() > 0.99  # a ray that grazes an edge may pass it


def test_wheels_turn_and_odometry_adds_up():
    sim = Simulation(scenes.world(scenes.ground(), scenes.burger()), "planar", nworld=3)
    robot = sim.robots["burger"]
    robot.inputs["cmd_vel"].send(linear=0.2, angular=0.0)
    sim.run(5.0)
    assert robot.position[:, 0] == pytest.approx([1.0] * 3, abs=0.03)  # it speeds up at 1 m/s²
    wheel = next(iter(robot.joints.values()))
    assert wheel.position == pytest.approx(1.0 / 0.033, rel=0.03)
    motion = robot.motion()
    assert motion.linear[:, 0] == pytest.approx([0.2] * 3)


def test_a_robot_stops_at_a_wall():
    wall = still("wall", Box((0.1, 2.0, 1.0)), Pose(0.5, 0.0, 0.5))
    sim = Simulation(scenes.world(scenes.ground(), wall, scenes.burger()), "planar")
    robot = sim.robots["burger"]
    robot.inputs["cmd_vel"].send(linear=0.2, angular=0.0)
    sim.run(5.0)
    x = robot.position[0, 0]
    assert 0.3 < x < 0.45
    assert np.abs(robot.motion().linear).max() == 0.0
    engine = sim.engine
    assert engine.fleet.stalled[0, engine.bodies["burger"]]


def test_links_follow_their_joints():
    deep, flat = both(scenes.world(scenes.ground(), scenes.burger()), 2)
    joint = deep.joints.names[0]
    turned = np.array([[0.3], [1.2]])
    for engine in (deep, flat):
        engine.models["burger"].set_placement((1.0, 2.0, 0.0), from_yaw(np.array([0.3, 0.9])))
        engine.joints[joint].set_position(turned)
    for link in deep.links.names:
        a, b = deep.links[link].placement(), flat.links[link].placement()
        assert a.position == pytest.approx(b.position, abs=1e-9)
        same = np.abs((a.quaternion * b.quaternion).sum(axis=1))
        assert same == pytest.approx([1.0, 1.0], abs=1e-9)


def test_a_snapshot_brings_everything_back():
    engine = make_engine("planar", scenes.world(scenes.ground(), scenes.burger()), 3)
    for joint in engine.joints.names:
        engine.add_motor(joint, 1.0)
        engine.joints[joint].set_motor_velocity(np.array([3.0, 4.0, 5.0]))
    engine.step(100)
    saved = engine.snapshot()
    engine.step(250)
    after = engine.snapshot()
    engine.restore(saved)
    engine.step(250)
    assert (engine.snapshot() == after).all()
    other = make_engine("planar", engine.world, 3)
    other.adopt(engine.history())
    other.restore(saved)
    other.step(250)
    assert (other.snapshot() == after).all()
    with pytest.raises(EngineError, match="saved state"):
        engine.restore(saved[:, 1:])


def test_models_come_and_go_and_the_others_stay():
    engine = make_engine("planar", scenes.world(scenes.ground(), scenes.burger()), 2)
    engine.models["burger"].set_placement((1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), np.array([1]))
    engine.spawn(scenes.box("crate", pose=Pose(3.0, 0.0, 0.1)))
    assert engine.models["burger"].placement().position[:, 0] == pytest.approx([0.0, 1.0])
    engine.models["crate"].set_motion((0.0, 0.5, 0.0), (0.0, 0.0, 0.0))
    engine.step(1000)
    assert engine.models["crate"].placement().position[0] == pytest.approx([3.0, 0.5, 0.1])
    with pytest.raises(EngineError, match="already"):
        engine.spawn(scenes.box("crate"))
    engine.delete("crate")
    with pytest.raises(EngineError, match="no model"):
        engine.models["crate"].placement()
    engine.reset()
    assert engine.models["burger"].placement().position[1] == pytest.approx([0.0, 0.0, 0.0])


def test_a_static_model_can_be_placed_and_is_seen_there():
    world = scenes.world(still("pillar", Cylinder(0.2, 1.0), Pose(2.0, 0.0, 0.5)), scanner_model())
    engine = make_engine("planar", world, 2)
    engine.models["pillar"].set_placement((1.0, 0.0, 0.5), from_yaw(np.array(0.2)), np.array([1]))
    hits = engine.links["scanner::base"].cast_rays(*rays(1, 0.3))
    forward = engine.links["scanner::base"].cast_rays(
        np.array([[0.0, 0.0, 0.3]]), np.array([[1.0, 0, 0]])
    )
    assert np.isinf(hits.distance).all()
    assert forward.distance[:, 0] == pytest.approx([1.8, 0.8])
    assert yaw_of(engine.models["pillar"].placement().quaternion) == pytest.approx([0.0, 0.2])


def test_what_needs_forces_is_refused_with_a_hint():
    engine = make_engine("planar", scenes.world(scenes.ground(), scenes.burger()))
    joint, link = engine.joints.names[0], engine.links.names[1]
    for work in (
        lambda: engine.joints[joint].set_effort(1.0),
        lambda: engine.links[link].set_wrench(np.zeros(3), np.zeros(3)),
        lambda: engine.contacts([["a"]]).named(),
        lambda: engine.attach(link, link),
        lambda: engine.set_parameter("link_mass", link, 1.0),
    ):
        with pytest.raises(EngineError, match="engine mujoco"):
            work()
    with pytest.raises(EngineError, match="did you mean"):
        engine.links[link + "x"].placement()


@pytest.mark.parametrize("name", ["mujoco", "planar"])
def test_refused_places_change_nothing(name):
    engine = make_engine(name, scenes.world(scenes.ground(), scenes.burger()), 2)
    engine.step(3)
    before = engine.snapshot()
    refused = [([-1], [0.0]), ([before.size], [0.0]), ([0], [math.nan]), ([0], [0.0, 1.0])]
    calls = [lambda p=p, v=v: engine.write_state(p, np.array(v)) for p, v in refused]
    if name == "planar":
        engine.command(np.ones((2, 1, 3)))
        before = engine.snapshot()
        for which, poses in [([2], [[0.0, 0.0, 0.0]]), ([0], [[math.nan, 0.0, 0.0]]), ([0], [1.0])]:
            calls.append(lambda w=which, p=poses: engine.place_bodies(w, p))
    for call in calls:
        with pytest.raises(EngineError):
            call()
        assert (engine.snapshot() == before).all()
    engine.close()


@pytest.mark.parametrize("tilt", [0.0, 0.3])
def test_the_pose_in_one_world_is_to_the_bit_that_among_many(tilt):
    box = scenes.box(pose=Pose(0.1, 0.2, 0.1, roll=tilt, yaw=0.7))
    engine, single = (make_engine("planar", scenes.world(box), n) for n in (5, 1))
    row, alone = engine.models["box"], single.models["box"]
    yaw = np.array([-3.1, -0.4, 0.0, 1e-9, 2.9])
    row.set_placement(np.column_stack((yaw, 2 * yaw, yaw)), from_yaw(yaw))
    many = row.placement()
    for world in range(5):
        one, several = row.placement(np.array([world])), engine.models["box",]
        assert row.pose(world) == one.first()
        assert several.placement(np.array([world])).quaternion.tobytes() == one.quaternion.tobytes()
        assert one.position.tobytes() == many.position[world].tobytes()
        assert one.quaternion.tobytes() == many.quaternion[world].tobytes()
        alone.set_placement(many.position[world], many.quaternion[world])
        assert alone.placement().quaternion.shape == (1, 4)
        np.testing.assert_allclose(alone.placement().quaternion[0], many.quaternion[world])


def test_a_world_that_there_is_not_has_no_pose():
    row = make_engine("planar", scenes.world(scenes.box()), 2).models["box"]
    for worlds in ([2], [0, -3]):
        with pytest.raises(IndexError):
            row.placement(np.array(worlds))
    with pytest.raises(IndexError):
        row.pose(2)


@pytest.mark.parametrize("change", ["set_ground_motion", "set_motion"])
def test_velocities_turn_with_the_model_and_are_refused_for_other_worlds(change):
    yaw = np.array([0.5, -2.5, 3.0])
    with Simulation(scenes.world(scenes.burger()), "planar", nworld=3, threads=1) as sim:
        robot = sim.robots["burger"]
        robot.set_pose((0.0, 0.0, 0.0), yaw=yaw)
        model, wheels = sim.engine.models["burger"], sim.engine.snapshot()
        more = (np.zeros(3),) if change == "set_motion" else ()
        with pytest.raises(EngineError, match="are not for 3 worlds"):
            getattr(model, change)(np.zeros((2, 3)), *more)
        assert (sim.engine.snapshot() == wheels).all()
        getattr(model, change)((0.3, 0.2, 0.0), *more, np.array([2, 0]))
        linear, _ = model.twist(None)
    turned = np.stack(
        (0.3 * np.cos(yaw) - 0.2 * np.sin(yaw), 0.3 * np.sin(yaw) + 0.2 * np.cos(yaw))
    )
    wanted = np.stack((np.full(3, 0.3), np.full(3, 0.2))) if change == "set_motion" else turned
    wanted[:, 1] = 0.0
    np.testing.assert_allclose(linear[:, :2], wanted.T, atol=1e-12)
