"""Accuracy of the burger's drive, against kinematics, with the errors stated.

The driver of a wheeled robot asks for speeds; what the wheels make of it is limited by
contact. The bounds below are the measured errors, rounded up.
"""

import numpy as np
import pytest
import scenes

from gazelle import assets
from gazelle.engines import make_engine
from gazelle.formats import load
from gazelle.simulation import Simulation


def drive(step, linear, angular, seconds, model=None):
    """Return the pose after driving from rest, and the total angle turned."""
    world = scenes.world(scenes.ground(), scenes.burger(), step=step)
    with Simulation(world) as sim:
        sim.physics.friction_model = model
        robot = sim.robots["burger"]
        sim.run(0.5)
        start = robot.position[0]
        robot.inputs["cmd_vel"].send(linear=linear, angular=angular)
        turned, before = 0.0, robot.yaw[0]
        for _ in range(round(seconds * 10)):
            sim.run(0.1)
            turned += np.angle(np.exp(1j * (robot.yaw[0] - before)))
            before = robot.yaw[0]
        return robot.position[0] - start, turned


MODELS = ("pyramid_model", "cone_model")


@pytest.mark.long
@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize(("step", "short"), [(0.001, 0.001), (0.005, 0.004), (0.02, 0.012)])
def test_ten_metres_straight(step, short, model):
    speed = 0.2
    ramp = speed**2 / (2 * 1.0)  # lost while speeding up at 1 m/s²
    moved, _ = drive(step, speed, 0.0, (10.0 + ramp) / speed, model)
    assert moved[0] == pytest.approx(10.0, rel=short)
    assert abs(moved[1]) < 0.002


@pytest.mark.long
@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize(("step", "short"), [(0.001, 1e-4), (0.005, 5e-4), (0.02, 0.006)])
def test_ten_turns_on_the_spot(step, short, model):
    rate, seconds = 1.0, 62.9
    ramp = (rate * 0.08) ** 2 / 2 / 0.08
    moved, turned = drive(step, 0.0, rate, seconds, model)
    assert turned == pytest.approx(rate * seconds - ramp, rel=short)
    assert np.linalg.norm(moved[:2]) < 0.003


@pytest.mark.parametrize(("name", "separation"), [("burger", 0.16), ("waffle", 0.287)])
@pytest.mark.parametrize("step", [0.0005, 0.001, 0.004])
def test_a_robot_from_its_files_turns_as_its_wheels_say_at_every_step(name, separation, step):
    # The files give the wheels a stiffness, which is felt by the waffle from 1 ms down.
    robot = load(assets.robot(f"turtlebot3_{name}")).models[0]
    engine = make_engine("mujoco", scenes.world(scenes.ground(), robot, step=step))
    for side, speed in (("left", 6.0), ("right", 4.0)):
        joint = f"{robot.name}::wheel_{side}_joint"
        engine.add_motor(joint, 10.0)
        engine.joints[joint].set_motor_velocity(speed)
    engine.step(round(1.0 / step))
    before = engine.models[robot.name].placement().quaternion[0]
    engine.step(round(2.0 / step))
    after = engine.models[robot.name].placement().quaternion[0]
    turned = 2.0 * (np.arctan2(after[2], after[3]) - np.arctan2(before[2], before[3]))
    assert turned == pytest.approx(2.0 * (4.0 - 6.0) * 0.033 / separation, rel=0.02)
