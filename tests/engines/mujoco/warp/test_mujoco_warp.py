"""MuJoCo Warp moves worlds as the MuJoCo engine does, in single precision; on a processor here."""

import importlib.util
import math
from dataclasses import replace

import gymnasium as gym
import numpy as np
import pytest
import scenes
from second_engine.ten_scenes import SCENES

import gazelle
import gazelle.envs
from gazelle.description import (
    Box,
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
from gazelle.description.surface import Bounce
from gazelle.engines import DivergenceError, make_engine
from gazelle.errors import EngineError, EngineWarning

if importlib.util.find_spec("mujoco_warp") is None:
    pytest.skip(
        "MuJoCo Warp is not here (docs/how-to/scale.md has the two commands)",
        allow_module_level=True,
    )

pytestmark = pytest.mark.filterwarnings("ignore:the engine 'mujoco-warp' finds no graphics card")

STILL = (0.0, 0.0, 0.0)
# How far single precision lets a scene come apart in 0.2 s [m or rad], and why where it is more than rounding.
TOLERANCES = {"burger": 5e-5, "four-bar": 2e-5, "tilting block": 2e-5}


def pair(world, nworld=1):
    """Return the same world on the processor and in Warp."""
    return [make_engine(name, world, nworld) for name in ("mujoco", "mujoco-warp")]


def apart(engines):
    """Return the largest difference of any joint or link [m or rad]."""
    one, other = engines
    joints = [
        np.abs(one.joints[n].position() - other.joints[n].position()).max()
        for n in one.joints.names
    ]
    links = [
        np.abs(one.links[n].placement().position - other.links[n].placement().position).max()
        for n in one.links.names
    ]
    return max([*joints, *links])


@pytest.mark.long
@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)
def test_scenes_move_alike(scene):
    engines = pair(scene.make())
    for engine in engines:
        scene.start(engine)
        engine.step(200)
    assert apart(engines) < TOLERANCES.get(scene.name, 5e-6)


@pytest.mark.parametrize(
    "shape", [Box((0.2, 0.3, 0.1)), Cylinder(0.1, 0.05)], ids=lambda s: type(s).__name__
)
@pytest.mark.parametrize("mu", [0.02, 1.0])
def test_what_tumbles_over_the_ground_comes_to_lie_alike(shape, mu):
    """Stiff friction breaks single precision just there."""
    thing = scenes.solid("t", shape, moments=(0.006, 0.004, 0.008), mu=mu)
    engines, count = pair(scenes.world(scenes.ground(mu), thing), 12), 12
    for engine in engines:
        chance = np.random.default_rng(0)
        turn = chance.normal(size=(count, 4))
        place = np.column_stack([np.zeros((count, 2)), chance.uniform(0.2, 0.3, count)])
        engine.models["t"].set_placement(place, turn)
        fast = chance.uniform(-3.0, 3.0, (count, 3)) - (0.0, 0.0, 3.0)
        engine.models["t"].set_motion(fast, chance.uniform(-10.0, 10.0, (count, 3)))
        engine.step(150)
    assert apart(engines) < 2e-4


@pytest.mark.long
def test_worlds_have_states_and_resets_of_their_own():
    engines = pair(scenes.world(scenes.ground(0.4), scenes.box(mu=0.4, pose=Pose(z=0.1))), 3)
    for engine in engines:
        engine.models["box"].set_motion([(1.0, 0.0, 0.0), (0.0, 0.5, 0.0), (0.0, 0.0, 2.0)], STILL)
        engine.step(60)
        engine.reset(np.array([1]))
        engine.links["box::link"].set_wrench((0.0, 6.0, 0.0), STILL, np.array([0]))
        engine.step(60)
    assert apart(engines) < 5e-6
    position = engines[1].links["box::link"].placement().position
    assert position[0, 0] > 0.08
    assert position[1] == pytest.approx((0.0, 0.0, 0.1), abs=1e-4)
    assert position[2, 2] > 0.2


@pytest.mark.long
def test_what_is_thrown_bounces_as_high():
    rubber = Surface(Friction(0.5, 0.5), bounce=Bounce(0.8, 0.01))
    ball = scenes.with_surface(scenes.ball(pose=Pose(z=0.4)), rubber)
    engines = pair(scenes.world(scenes.with_surface(scenes.ground(), rubber), ball))
    heights = []
    for engine in engines:
        engine.step(300)
        tops = []
        for _ in range(20):
            engine.step(20)
            tops.append(engine.links["ball::link"].placement().position[0, 2])
        heights.append(max(tops))
    assert heights[0] > 0.25
    assert heights[1] == pytest.approx(heights[0], abs=1e-3)


@pytest.mark.long
def test_friction_by_direction_and_spins():
    grain = Surface(Friction(0.1, 0.8, (1.0, 0.0, 0.0)))
    sled = scenes.with_surface(scenes.box("sled", (0.4, 0.4, 0.1), pose=Pose(z=0.05)), grain)
    tumbler = scenes.solid("t", Sphere(0.1), moments=(0.01, 0.02, 0.028), pose=Pose(x=3, z=5))
    engines = pair(scenes.world(scenes.ground(1.0), sled, tumbler))
    for engine in engines:
        engine.models["sled"].set_motion((1.0, 1.0, 0.0), STILL)
        engine.models["t"].set_motion(STILL, (0.1, 8.0, 0.1))
        engine.step(200)
    spins = [engine.links["t::link"].motion().angular for engine in engines]
    assert spins[1] == pytest.approx(spins[0], abs=1e-3)
    assert apart(engines) < 5e-5


@pytest.mark.long
def test_motors_have_their_largest_effort():
    wheel = Link("w", inertial=Inertial(1.0, inertia=Inertia(0.01, 0.01, 0.02)))
    joint = Joint(
        "j", "continuous", "world", "w", axes=(JointAxis((0.0, 0.0, 1.0), friction=0.01),)
    )
    engines = pair(scenes.world(Model("m", links=(wheel,), joints=(joint,))), 2)
    for engine in engines:
        engine.add_motor("m::j", 0.4)
        engine.joints["m::j"].set_motor_velocity((0.5, 50.0))
        engine.step(100)
    speeds = [engine.joints["m::j"].velocity()[:, 0] for engine in engines]
    assert speeds[1] == pytest.approx(speeds[0], rel=1e-5)
    assert speeds[1] == pytest.approx((0.5, (0.4 - 0.01) / 0.02 * 0.1), rel=1e-3)


def test_models_come_and_go():
    engines = pair(scenes.world(scenes.ground(0.5), scenes.box(pose=Pose(z=0.1), mu=0.5)), 2)
    for engine in engines:
        engine.models["box"].set_motion((1.0, 0.0, 0.0), STILL)
        engine.step(20)
        engine.spawn(scenes.ball(pose=Pose(x=1.0, z=0.3), mu=0.5))
        engine.step(20)
        engine.delete("box")
        engine.step(20)
    assert engines[1].links.names == ("ground_plane::link", "ball::link")
    assert apart(engines) < 5e-6


def test_rays_meet_the_same():
    rod = scenes.solid("rod", Cylinder(0.1, 0.6), pose=Pose(x=-1.0, y=0.4, z=0.5), static=True)
    egg = scenes.ball("egg", pose=Pose(x=0.5, y=-1.2, z=0.5))
    engines = pair(scenes.world(*scenes.square(), rod, egg, scenes.box("eye", pose=Pose(z=0.4))), 2)
    angles = np.linspace(0.0, 2.0 * math.pi, 90, endpoint=False)
    along = np.stack([np.cos(angles), np.sin(angles), 0.2 * np.sin(3 * angles)], axis=1)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    found = []
    for engine in engines:
        place = np.array([(0.0, 0.0, 0.4), (0.3, -0.2, 0.4)])
        engine.models["eye"].set_placement(place, (0.0, 0.0, 0.0, 1.0))
        found.append(engine.links["eye::link"].cast_rays(np.zeros((90, 3)), along, ignore_own=True))
    one, other = (each.distance for each in found)
    assert np.isfinite(one).sum() > 80
    assert (np.isfinite(one) == np.isfinite(other)).all()
    assert other[np.isfinite(one)] == pytest.approx(one[np.isfinite(one)], abs=1e-5)
    few = (
        engines[1]
        .links["eye::link"]
        .cast_rays(np.zeros((90, 3)), along, np.array([1]), ignore_own=True)
    )
    assert np.array_equal(few.distance, other[1:])


def test_masses_and_gravity_differ_between_worlds():
    engines = pair(scenes.world(scenes.box()), 2)
    for engine in engines:
        engine.set_parameter("gravity", "", [(0.0, 0.0, -9.8), (0.0, 0.0, -1.6)])
        engine.set_parameter("link_mass", "box::link", [(1.0,), (2.0,)])
        engine.links["box::link"].set_wrench((4.0, 0.0, 0.0), STILL)
        engine.step(50)
    assert apart(engines) < 5e-6


def test_what_worlds_cannot_have_of_their_own_is_refused():
    world = scenes.world(scenes.ground(0.5), scenes.box(mu=0.5, pose=Pose(z=0.1)))
    engine = make_engine("mujoco-warp", world, 2)
    engine.set_parameter("collision_friction", "box::link::c", 0.3)  # of all: it can
    engine.step(2)
    engine.set_parameter("collision_friction", "box::link::c", [(0.3,), (0.9,)])
    with pytest.raises(EngineError, match=r"collision_friction.*mujoco-warp"):
        engine.step(2)


def test_friction_is_a_cone_whatever_is_asked_for():
    world = scenes.world(scenes.ground(), scenes.box())
    asked = replace(world, physics=(replace(world.profile, contacts="fast"),))
    with pytest.warns(EngineWarning, match="a cone only"):
        make_engine("mujoco-warp", asked)


def test_contacts_seen_ahead_are_refused_or_missed_aloud():
    world = scenes.world(scenes.ground(), scenes.ball(radius=0.005, pose=Pose(z=1.0)))
    with pytest.warns(EngineWarning, match="computes no speculative contacts"):
        make_engine("mujoco-warp", world)
    asked = replace(world, physics=(replace(world.profile, speculative_contacts=True),))
    with pytest.raises(EngineError, match=r"'speculative_contacts'.*engine='mujoco'"):
        make_engine("mujoco-warp", asked)


def test_a_world_that_breaks_down_is_reset_and_named():
    engine = make_engine("mujoco-warp", scenes.world(scenes.box()), 2)
    engine.links["box::link"].set_wrench((math.inf, 0.0, 0.0), STILL, np.array([1]))
    with pytest.raises(DivergenceError, match="1 of 2 worlds") as caught:
        engine.step(3)
    assert caught.value.worlds.tolist() == [1]
    assert np.isfinite(engine.snapshot()).all()


@pytest.mark.long
def test_more_contacts_than_there_was_room_for():
    boxes = [scenes.box(f"b{i}", mu=0.5, pose=Pose(x=0.5 * i, z=0.1)) for i in range(12)]
    engines = pair(scenes.world(scenes.ground(0.5), *boxes))
    for engine in engines:
        engine.step(20)
    assert apart(engines) < 5e-6


def test_joints_on_the_device_through_dlpack():
    engine = make_engine("mujoco-warp", SCENES[1].make(), 2)
    engine.joints["m::elbow"].set_position([(0.3,), (0.4,)])
    engine.step(5)
    for kind in ("position", "velocity"):
        there = np.from_dlpack(engine.on_device(kind, "m::elbow"))
        assert there.dtype == np.float32
        assert np.array_equal(there, getattr(engine.joints["m::elbow"], kind)())
    with pytest.raises(EngineError, match="did you mean 'velocity'"):
        engine.on_device("velocities", "m::elbow")


@pytest.mark.long
def test_a_robot_drives_and_scans_alike():
    runs = []
    for name in ("mujoco", "mujoco-warp"):
        with gazelle.Simulation(
            scenes.world(scenes.ground(1.0), *scenes.square()), engine=name
        ) as sim:
            robot = sim.spawn(scenes.burger())
            robot.inputs["cmd_vel"].send(linear=0.2, angular=0.5)
            sim.run(0.45)
            runs.append((robot.pose, robot.sensors["lds"].read().ranges))
    (one, seen), (other, scanned) = runs
    assert one.x > 0.05
    assert other.position == pytest.approx(one.position, abs=2e-4)
    assert other.yaw == pytest.approx(one.yaw, abs=2e-3)
    assert scanned == pytest.approx(seen, abs=2e-3)


def test_a_task_goes_on_alike():
    make = {"num_envs": 2, "vectorization_mode": "vector_entry_point"}
    envs = [
        gym.make_vec("gazelle/CartPoleStayUp-v0", engine=name, **make)
        for name in ("mujoco", "mujoco-warp")
    ]
    first = [env.reset(seed=3)[0] for env in envs]
    assert first[1] == pytest.approx(first[0], abs=1e-6)
    chance = np.random.default_rng(1)
    for _ in range(12):
        actions = chance.integers(0, envs[0].single_action_space.n, 2)
        steps = [env.step(actions) for env in envs]
        assert steps[1][0] == pytest.approx(steps[0][0], abs=1e-3)
        for one, other in zip(steps[0][1:4], steps[1][1:4], strict=True):
            assert np.array_equal(one, other)
    for env in envs:
        env.close()
