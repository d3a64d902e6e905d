"""Bodies held by friction stay in place: in a grip, on a slope, in a stack, parked."""

import math
from dataclasses import replace

import numpy as np
import pytest
import scenes
from grips import MARGIN_OF_TWO, MASS, MU, SHAPES, creep, gripper

from gazelle import assets
from gazelle.description import Pose
from gazelle.engines import make_engine
from gazelle.engines.laws import with_profile
from gazelle.errors import EngineError
from gazelle.formats import load

G = 9.8


def held(shape, force, step, contacts=None):
    """Return an engine with a gripped object, held for half a second."""
    moment = 0.4 * MASS * 0.025**2
    thing = scenes.solid("thing", shape, mass=MASS, moments=(moment,) * 3, mu=MU, pose=Pose(z=0.5))
    world = scenes.world(gripper(), thing, step=step)
    engine = make_engine("mujoco", with_profile(world, replace(world.profile, contacts=contacts)))
    engine.joints["g::left_joint"].set_effort(force)
    engine.joints["g::right_joint"].set_effort(force)
    engine.step(round(0.5 / step))
    return engine


@pytest.mark.parametrize("force", [MARGIN_OF_TWO, 10.0, 40.0])
@pytest.mark.parametrize("step", [0.0005, 0.001, 0.002, 0.004, 0.005])
@pytest.mark.parametrize("shape", SHAPES)
def test_what_is_gripped_does_not_creep(shape, step, force):
    assert creep(held(SHAPES[shape], force, step), "thing", 5.0) < 0.05


@pytest.mark.slow
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("step", [0.001, 0.005])
def test_what_is_gripped_is_there_after_ten_minutes(shape, step):
    engine = held(SHAPES[shape], MARGIN_OF_TWO, step)
    start = engine.models["thing"].placement().position[0].copy()
    engine.step(round(600.0 / step))
    assert np.abs(engine.models["thing"].placement().position[0] - start).max() < 2e-4


def test_a_grip_that_is_too_weak_lets_go():
    engine = held(SHAPES["box"], 0.4 * MARGIN_OF_TWO, 0.001)
    engine.step(500)
    assert engine.models["thing"].placement().position[0, 2] < 0.4


@pytest.mark.parametrize("step", [0.001, 0.005])
@pytest.mark.parametrize("contacts", [None, "exact"])
@pytest.mark.parametrize("mu", [0.1, 0.6, 1.5])
def test_a_box_on_a_slope_stays(mu, contacts, step):
    angle = 0.8 * math.atan(mu)
    gravity = (G * math.sin(angle), 0.0, -G * math.cos(angle))
    box = scenes.box("box", (0.2, 0.2, 0.1), mu=mu, pose=Pose(z=0.05, yaw=0.3))
    world = scenes.world(scenes.ground(), box, step=step, gravity=gravity)
    engine = make_engine("mujoco", with_profile(world, replace(world.profile, contacts=contacts)))
    engine.step(round(0.5 / step))
    assert creep(engine, "box", 5.0) < 0.01


@pytest.mark.parametrize("step", [0.001, 0.005])
def test_a_stack_of_boxes_stays(step):
    boxes = [
        scenes.box(
            f"b{i}", (0.2, 0.2, 0.1), mu=0.6, pose=Pose(x=0.005 * (-1) ** i, z=0.05 + 0.1 * i)
        )
        for i in range(10)
    ]
    engine = make_engine("mujoco", scenes.world(scenes.ground(), *boxes, step=step))
    engine.step(round(2.0 / step))
    assert max(creep(engine, f"b{i}", 1.0) for i in range(10)) < 0.05


@pytest.mark.parametrize("yaw", [0.0, 0.8, math.pi / 2.0])
@pytest.mark.parametrize(
    ("contacts", "step", "most"),
    [(None, 0.001, 0.1), (None, 0.005, 0.5), ("fast", 0.005, 0.5), ("exact", 0.001, 0.001)],
)
def test_a_parked_burger_stays(contacts, step, most, yaw):
    robot = load(assets.robot("turtlebot3_burger")).models[0]
    robot = replace(robot, pose=Pose(yaw=yaw))
    gravity = (-G * math.sin(0.05), 0.0, -G * math.cos(0.05))
    world = scenes.world(scenes.ground(), robot, step=step, gravity=gravity)
    engine = make_engine("mujoco", with_profile(world, replace(world.profile, contacts=contacts)))
    for side in ("left", "right"):
        engine.add_motor(f"{robot.name}::wheel_{side}_joint", 10.0)
    engine.step(round(1.0 / step))
    assert creep(engine, robot.name, 5.0) < most


def test_contacts_of_another_name_are_refused():
    world = scenes.world(scenes.ground(), scenes.box())
    with pytest.raises(EngineError, match=r"there are no contacts 'exakt'.*exact"):
        make_engine("mujoco", with_profile(world, replace(world.profile, contacts="exakt")))
