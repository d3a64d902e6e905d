"""The bundled arm of six axes moves and grips under the controllers of its package."""

from __future__ import annotations

import numpy as np
import pytest
import yaml

import gazelle
from gazelle import assets, formats
from gazelle.control import GoalState
from gazelle.control.values import GripperGoal, JointTrajectory, TrajectoryGoal, TrajectoryPoint

AXES = tuple(f"axis_{number}" for number in range(1, 7))
# Half as wide as the gripper opens; it lies in the palm of the upright arm.
CUBE = """<sdf version="1.6"><model name="cube"><pose>0 0 1.37 0 0 0</pose><link name="body"><inertial>
<mass>0.1</mass><inertia><ixx>3e-5</ixx><iyy>3e-5</iyy><izz>3e-5</izz></inertia></inertial><collision name="c">
<geometry><box><size>0.04 0.04 0.06</size></box></geometry></collision></link></model></sdf>"""


def arm6(nworld=1):
    """Return the arm in an empty world, with its controllers running."""
    sim = gazelle.Simulation("empty", nworld=nworld)
    robot = sim.spawn("arm6")
    file = assets.root() / "arm6_control" / "config" / "arm6_control.yaml"
    for name, parameters in yaml.safe_load(file.read_text(encoding="utf-8")).items():
        robot.controllers.load(name, parameters)
        robot.controllers.start(name)
    return sim, robot


def follow(robot, *points):
    """Send a trajectory of times and positions, at rest in each of them."""
    still = (0.0,) * 6
    trajectory = JointTrajectory(
        AXES, tuple(TrajectoryPoint(time, tuple(there), still, still) for time, there in points)
    )
    action = robot.controllers["arm_controller"].actions["follow_joint_trajectory"]
    return action.send(TrajectoryGoal(trajectory))


def grip(robot, position, effort=30.0):
    action = robot.controllers["gripper_controller"].actions["gripper_cmd"]
    return action.send(GripperGoal(position, effort))


def fingers(robot):
    return [robot.joints[f"{name}_joint"].position for name in ("finger", "other_finger")]


def test_a_trajectory_is_followed_within_the_tolerances_of_its_file():
    sim, robot = arm6(nworld=2)
    there = np.array([1.0, 0.7, 0.9, -0.8, 1.0, -1.5])
    goal = follow(robot, (2.0, there), (4.0, -0.5 * there), (5.0, np.zeros(6)))
    sim.run(2.0)
    assert [robot.joints[name].position for name in AXES] == pytest.approx(list(there), abs=0.02)
    sim.run(3.5)
    assert goal.states.tolist() == [GoalState.SUCCEEDED] * 2, goal.text


def test_the_gripper_opens_and_closes_both_fingers():
    sim, robot = arm6()
    for position in (0.04, 0.01, 0.025):
        goal = grip(robot, position)
        sim.run(1.0)
        assert goal.state == GoalState.SUCCEEDED
        assert goal.result.reached_goal
        assert fingers(robot) == pytest.approx([position] * 2, abs=0.003)


@pytest.mark.long
def test_it_carries_a_cube_upside_down():
    sim, robot = arm6()
    grip(robot, 0.035)
    sim.run(1.0)
    cube = sim.spawn(formats.load_model_string(CUBE))
    sim.run(0.3)
    goal = grip(robot, 0.01)
    sim.run(1.0)
    assert goal.result.stalled
    assert fingers(robot) == pytest.approx([0.02] * 2, abs=0.002)
    flange = robot.links["flange_link"]
    before = flange.pose.inverse() * cube.pose
    # Over the shoulder, so that the gripper points at the floor.
    moved = follow(robot, (2.0, (0.8, 0.6, 1.2, 0.0, 1.3, 0.5)))
    sim.run(4.0)
    assert moved.state == GoalState.SUCCEEDED, moved.text
    assert cube.pose.z < flange.pose.z - 0.08
    after = flange.pose.inverse() * cube.pose
    assert after.position == pytest.approx(before.position, abs=0.004)  # it slides as it swings
    sim.run(3.0)
    held = flange.pose.inverse() * cube.pose
    assert held.position == pytest.approx(after.position, abs=1e-5)
