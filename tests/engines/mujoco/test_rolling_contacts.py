"""Rolling contacts are softer, and resting ones as stiff as ever."""

import math
from dataclasses import replace

import mujoco
import numpy as np
import pytest
import scenes
from grips import MARGIN_OF_TWO, SHAPES, creep, gripper

from gazelle import assets
from gazelle.description import Inertia, Inertial, Joint, JointAxis, Link, Pose
from gazelle.engines import make_engine
from gazelle.engines.laws import with_profile
from gazelle.formats import load

ROBOTS = ("turtlebot3_burger", "turtlebot3_waffle", "courier")


def driven(name, step, left, right, slope=0.0):
    """Return a robot on a cone that has driven for a second, and the name of its model."""
    robot = load(assets.robot(name)).models[0]
    gravity = (-9.8 * math.sin(slope), 0.0, -9.8 * math.cos(slope))
    world = scenes.world(scenes.ground(), robot, step=step, gravity=gravity)
    engine = make_engine("mujoco", with_profile(world, replace(world.profile, contacts="exact")))
    for side, speed in (("left", left), ("right", right)):
        (joint,) = (each for each in engine.joints.names if "wheel" in each and side in each)
        engine.add_motor(joint, 10.0)
        engine.joints[joint].set_motor_velocity(speed)
    engine.step(round(1.0 / step))
    return engine, robot.name


@pytest.mark.parametrize("speeds", [(6.0, 6.0), (6.0, 4.0), (-3.0, 3.0)])
@pytest.mark.parametrize("step", [0.001, 0.005, 0.02])
@pytest.mark.parametrize("robot", ROBOTS)
def test_the_solver_finds_the_forces_below_a_robot_that_drives_at_once(robot, step, speeds):
    engine, _ = driven(robot, step, *speeds)
    model, data = engine.running.batch.model, engine.running.batch.get_data(0)
    searched, steps = 0, 200
    for _ in range(steps):
        mujoco.mj_step(model, data)
        searched += sum(each.neval for each in data.solver[: int(data.solver_niter[0])])
    assert searched / steps < 12.0  # a wheel that pulls against another takes 40 to 150


@pytest.mark.parametrize("mu", [0.1, 0.4, 1.0])
@pytest.mark.parametrize("robot", ROBOTS)
def test_wheels_that_start_at_once_rub_by_coulombs_law_beside_loose_things(robot, mu):
    """MuJoCo's solver has rows of its own for each of several islands of contacts."""
    path = []
    for loose in (
        (),
        (scenes.box(pose=Pose(1.0, 2.0, 0.1)), scenes.box("b", pose=Pose(2.0, 2.0, 0.1))),
    ):
        model = load(assets.robot(robot)).models[0]
        world = scenes.world(scenes.ground(mu), model, *loose)
        engine = make_engine(
            "mujoco", with_profile(world, replace(world.profile, contacts="exact"))
        )
        wheels = [each for each in engine.joints.names if "wheel" in each]
        for wheel in wheels:
            engine.add_motor(wheel, 10.0)
        engine.step(200)
        for wheel in wheels:
            engine.joints[wheel].set_motor_velocity(30.0)
        path.append(_rubbed(engine))
    (alone, _), (ray_offset, islands) = path
    assert islands > 0
    assert ray_offset == pytest.approx(alone, abs=1e-9)


def _rubbed(engine):
    """Return the first body's place after steps with limited friction, and islands."""
    compiled, data, force = (
        engine.running.batch.model,
        engine.running.batch.get_data(0),
        np.zeros(6),
    )
    for _ in range(40):
        mujoco.mj_step(compiled, data)
        for index, contact in enumerate(data.contact):
            mujoco.mj_contactForce(compiled, data, index, force)
            most = contact.friction[0] * force[0]
            assert math.hypot(force[1], force[2]) <= most * (1.0 + 1e-9) + 1e-9
    return data.qpos[:7].copy(), data.nisland


@pytest.mark.parametrize("robot", ["turtlebot3_burger", "turtlebot3_waffle"])
def test_the_wheels_of_a_robot_that_drives_do_not_pull_against_each_other(robot):
    engine, name = driven(robot, 0.001, 6.0, 4.0)
    model, data = engine.running.batch.model, engine.running.batch.get_data(0)
    mujoco.mj_step(model, data)
    x, y, z, w = engine.models[name].placement().quaternion[0]
    yaw = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    aside, force, found = np.array([-math.sin(yaw), math.cos(yaw), 0.0]), np.zeros(6), []
    for index, contact in enumerate(data.contact):
        if "wheel" in model.geom(contact.geom2).name:
            mujoco.mj_contactForce(model, data, index, force)
            found.append(aside @ (contact.frame.reshape(3, 3).T @ force[:3]))
    # Friction could be 0.5 N on each.
    assert len(found) >= 2
    assert np.abs(found).sum() - abs(sum(found)) < 0.05


@pytest.mark.parametrize("step", [0.001, 0.005])
@pytest.mark.parametrize("robot", ["turtlebot3_burger", "courier"])
def test_a_robot_that_has_stopped_stays(robot, step):
    engine, name = driven(robot, step, 3.0, 3.0, slope=0.05)
    for joint in engine.joints.names:
        if "wheel" in joint:
            engine.joints[joint].set_motor_velocity(0.0)
    engine.step(round(1.0 / step))
    assert creep(engine, name, 5.0) < 0.005


@pytest.mark.parametrize("step", [0.001, 0.005])
@pytest.mark.parametrize("shape", SHAPES)
def test_what_is_gripped_stays_in_a_hand_that_turns(shape, step):
    """Both turn: nothing rolls."""
    hand = gripper()
    post = Link("post", inertial=Inertial(1.0, inertia=Inertia(0.01, 0.01, 0.01)))
    turning = Joint("turn", "revolute", "post", "base", axes=(JointAxis((0.0, 0.0, 1.0)),))
    stand = Joint("stand", "fixed", "world", "post")
    hand = replace(hand, links=(post, *hand.links), joints=(stand, turning, *hand.joints[1:]))
    moment = 0.4 * 0.5 * 0.025**2
    thing = scenes.solid("thing", SHAPES[shape], mass=0.5, moments=(moment,) * 3, mu=0.8)
    thing = replace(thing, pose=Pose(z=0.5))
    engine = make_engine("mujoco", scenes.world(hand, thing, step=step))
    for side in ("left", "right"):
        engine.joints[f"g::{side}_joint"].set_effort(1.5 * MARGIN_OF_TWO)
    engine.step(round(0.5 / step))
    engine.add_motor("g::turn", 100.0)
    engine.joints["g::turn"].set_motor_velocity(1.0)
    engine.step(round(1.0 / step))
    before = engine.models["thing"].placement().position[0].copy()
    engine.step(round(2.0 * math.pi / step))
    after = engine.models["thing"].placement().position[0]
    assert abs(after[2] - before[2]) < 1e-5
    # A whole turn is not quite a number of steps.
    assert abs(np.linalg.norm(after[:2]) - np.linalg.norm(before[:2])) < 1e-4
