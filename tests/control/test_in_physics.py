"""Controllers judged by the physics: forces within limits, bases on the ground, grips that hold."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import gazelle
from gazelle import formats
from gazelle.control import GoalState
from gazelle.control.values import (
    BaseTwist,
    GripperGoal,
    JointTargets,
    JointTrajectory,
    TrajectoryGoal,
    TrajectoryPoint,
)
from gazelle.description import World
from tests.control.arms import JOINTS, arm

VARIANCE = [0.001] * 6
STRENGTH = np.array([60.0, 30.0])

numbers = st.floats(-1e4, 1e4)
gains = st.fixed_dictionaries(
    {"p": st.floats(0, 1e4), "i": st.floats(0, 1e3), "d": st.floats(0, 50), "i_clamp": st.just(1e3)}
)


@pytest.mark.long
@settings(max_examples=15, deadline=None)
@given(gains, st.lists(st.tuples(numbers, numbers), min_size=1, max_size=4), st.booleans())
def test_no_physics_step_is_stronger_than_limits_allow(pid, targets, within):
    """Whatever gains and targets are, and wherever controllers are brought."""
    sim, robot = arm("Effort", nworld=2)
    sim.controls_in_step = within
    own = {name: {"pid": pid} for name in JOINTS}
    of = "effort_controllers/JointGroupPositionController"
    robot.controllers.load("arm", {"type": of, "joints": JOINTS, **own})
    robot.controllers.start("arm")
    for target in targets:
        robot.controllers["arm"].inputs["command"].send(JointTargets(target), [1])
        for _ in range(12):
            sim.step()
            acting = [sim.engine.joints[robot.joints[name].name].effort() for name in JOINTS]
            assert (np.abs(np.concatenate(acting, axis=1)) <= STRENGTH).all()


def base_text(spread=0.4, radius=0.1):
    wheels = "".join(
        f'<link name="{side}"><inertial><mass value="0.5"/><inertia ixx="0.002" iyy="0.002" izz="0.003" '
        f'ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry><cylinder radius="{radius}" '
        f'length="0.04"/></geometry></collision></link><joint name="{side}_wheel" type="continuous">'
        f'<parent link="base"/><child link="{side}"/><origin xyz="0 {y} {radius}" rpy="{-math.pi / 2} 0 0"/>'
        '<axis xyz="0 0 1"/><limit effort="20" velocity="50"/></joint>'
        f'<transmission name="t_{side}"><type>transmission_interface/SimpleTransmission</type>'
        f'<joint name="{side}_wheel"><hardwareInterface>hardware_interface/VelocityJointInterface'
        f'</hardwareInterface></joint><actuator name="m_{side}"/></transmission>'
        for side, y in (("left", spread / 2), ("right", -spread / 2))
    )
    return (
        '<robot name="base"><link name="base"><inertial><origin xyz="-0.05 0 0.1"/><mass value="5"/>'
        '<inertia ixx="0.1" iyy="0.1" izz="0.15" ixy="0" ixz="0" iyz="0"/></inertial>'
        '<collision name="caster"><origin xyz="-0.2 0 0.05"/><geometry><sphere radius="0.05"/></geometry>'
        f"</collision></link>{wheels}"
        '<gazebo reference="base"><mu1>0</mu1><mu2>0</mu2></gazebo>'
        '<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo></robot>'
    )


def driving(nworld=1, **more):
    sim = gazelle.Simulation("empty", nworld=nworld)
    robot = sim.spawn(formats.load_model_string(base_text()))
    robot.controllers.load(
        "base",
        {
            "type": "diff_drive_controller/DiffDriveController",
            "left_wheel": "left_wheel",
            "right_wheel": "right_wheel",
            "pose_covariance_diagonal": VARIANCE,
            "twist_covariance_diagonal": VARIANCE,
            "cmd_vel_timeout": 100.0,
            **more,
        },
    )
    robot.controllers.start("base")
    sim.run(0.3)
    return sim, robot


@pytest.mark.parametrize(("forward", "turning"), [(0.4, 0.0), (0.4, 0.5), (0.0, 0.8), (-0.3, -0.4)])
def test_a_base_on_the_ground_is_where_its_odometry_says(forward, turning):
    """Tolerances are those of diff_drive_controller's own suite: 0.01 m, 0.02 m/s, 0.03 rad."""
    limits = {
        "linear": {"x": {"has_acceleration_limits": True, "max_acceleration": 1.0}},
        "angular": {"z": {"has_acceleration_limits": True, "max_acceleration": 2.0}},
    }
    sim, robot = driving(**limits)
    start = sim.engine.models[robot.name].planar_pose()[0]
    port = robot.controllers["base"].inputs["cmd_vel"]
    port.send(BaseTwist((forward, 0.0, 0.0), (0.0, 0.0, turning)))
    sim.run(2.0)
    said = robot.controllers["base"].outputs["odom"].last
    assert said.linear[0, 0] == pytest.approx(forward, abs=0.02)
    assert said.angular[0, 2] == pytest.approx(turning, abs=0.02)
    port.send(BaseTwist((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)))
    sim.run(1.0)
    said = robot.controllers["base"].outputs["odom"].last
    x, y, heading = sim.engine.models[robot.name].planar_pose()[0] - start
    assert said.position[0, :2] == pytest.approx([x, y], abs=0.01)
    qz, qw = said.quaternion[0, 2:]
    assert math.remainder(2.0 * math.atan2(qz, qw) - heading, math.tau) == pytest.approx(
        0.0, abs=0.03
    )


GRIPPER = """<robot name="gripper"><link name="world"/>
<link name="palm"><inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0"
iyz="0"/></inertial></link>
<joint name="stand" type="fixed"><parent link="world"/><child link="palm"/><origin xyz="0 0 0.5"/></joint>
{fingers}
<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo></robot>"""

FINGER = """<link name="{name}"><inertial><mass value="0.1"/><inertia ixx="1e-4" iyy="1e-4" izz="1e-4"
ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry><box size="0.01 0.03 0.06"/></geometry></collision></link>
<joint name="{name}_slide" type="prismatic"><parent link="palm"/><child link="{name}"/>
<origin xyz="{at} 0 -0.1"/><axis xyz="{axis} 0 0"/><limit lower="0" upper="0.04" effort="30" velocity="0.2"/>
<dynamics damping="5"/></joint>
<transmission name="t_{name}"><type>transmission_interface/SimpleTransmission</type><joint name="{name}_slide">
<hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint><actuator name="m_{name}"/>
</transmission><gazebo reference="{name}"><mu1>1</mu1><mu2>1</mu2></gazebo>"""

CUBE = """<sdf version="1.6"><model name="cube"><pose>0 0 0.4 0 0 0</pose><link name="body"><inertial>
<mass>0.2</mass><inertia><ixx>5e-5</ixx><iyy>5e-5</iyy><izz>5e-5</izz></inertia></inertial><collision name="c">
<geometry><box><size>0.04 0.04 0.04</size></box></geometry></collision></link></model></sdf>"""


def gripping():
    fingers = FINGER.format(name="left", at="-0.045", axis="1")
    fingers += FINGER.format(name="right", at="0.045", axis="-1")
    sim = gazelle.Simulation(World("lab"))
    robot = sim.spawn(formats.load_model_string(GRIPPER.format(fingers=fingers)))
    cube = sim.spawn(formats.load_model_string(CUBE))
    robot.joints["left_slide"].position = robot.joints["right_slide"].position = 0.0199
    for side in ("left", "right"):
        given = {
            "type": "effort_controllers/GripperActionController",
            "joint": f"{side}_slide",
            "gains": {f"{side}_slide": {"p": 2000.0, "d": 20.0}},
            "max_effort": 10.0,
            "stall_timeout": 0.2,
        }
        robot.controllers.load(side, given)
    robot.controllers.start("left", "right")
    goals = [
        robot.controllers[side].actions["gripper_cmd"].send(GripperGoal(0.03, 10.0))
        for side in ("left", "right")
    ]
    return sim, cube, goals


def slip_after(seconds):
    sim, cube, goals = gripping()
    sim.run(1.0)
    before = cube.pose.position
    sim.run(seconds)
    assert all(goal.done for goal in goals)
    return float(np.linalg.norm(np.subtract(cube.pose.position, before))), cube.pose.z


def test_a_gripper_holds_a_cube():
    slip, height = slip_after(3.0)
    assert slip < 1e-3
    assert height > 0.38


@pytest.mark.slow
def test_a_gripper_holds_a_cube_for_a_minute():
    slip, height = slip_after(60.0)
    assert slip < 1e-3
    assert height > 0.38


@pytest.mark.parametrize("name", ["turtlebot3_burger", "turtlebot3_waffle", "courier"])
def test_reading_the_manager_of_a_robot_without_one_changes_nothing(name):
    ends = []
    for read in (False, True):
        sim = gazelle.Simulation("empty", nworld=2)
        robot = sim.spawn(name)
        robot.inputs["cmd_vel"].send(linear=0.2, angular=0.3)
        sim.run(0.2)
        if read:
            assert robot.controllers.loaded == []
        sim.run(0.5)
        ends.append(sim.engine.snapshot())
    assert np.array_equal(*ends)


SIX = tuple(f"axis_{number}" for number in range(1, 7))
ARM_GAINS = (
    {"p": 3000.0, "i": 2000.0, "d": 120.0, "i_clamp": 60.0},
    {"p": 4000.0, "i": 3000.0, "d": 160.0, "i_clamp": 120.0},
    {"p": 2500.0, "i": 2000.0, "d": 80.0, "i_clamp": 80.0},
    {"p": 400.0, "i": 300.0, "d": 8.0, "i_clamp": 20.0},
    {"p": 400.0, "i": 300.0, "d": 8.0, "i_clamp": 20.0},
    {"p": 100.0, "i": 50.0, "d": 2.0, "i_clamp": 5.0},
)


def six_axis_text():
    """Return an arm with the axes of most industrial ones: z, y, y, x, y, x."""
    parts = ['<robot name="six_axis"><link name="world"/>']
    parent, reach = "world", (0.4, 0.1, 0.45, 0.2, 0.25, 0.1)
    for number, (name, axis) in enumerate(
        zip(SIX, ("0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0"), strict=True)
    ):
        mass, size = 6.0 - number, 0.02 * (6 - number)
        parts.append(
            f'<link name="part_{number}"><inertial><origin xyz="0 0 0.1"/><mass value="{mass}"/>'
            f'<inertia ixx="{size}" iyy="{size}" izz="{size}" ixy="0" ixz="0" iyz="0"/></inertial></link>'
            f'<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="part_{number}"/>'
            f'<origin xyz="0 0 {reach[number]}"/><axis xyz="{axis}"/>'
            '<limit lower="-3" upper="3" effort="300" velocity="3"/></joint>'
            f'<transmission name="drive_{number}"><type>transmission_interface/SimpleTransmission</type>'
            f'<joint name="{name}"><hardwareInterface>hardware_interface/EffortJointInterface'
            f'</hardwareInterface></joint><actuator name="motor_{number}"/></transmission>'
        )
        parent = f"part_{number}"
    plugin = '<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo></robot>'
    return "".join([*parts, plugin])


def test_an_arm_of_six_axes_follows_a_trajectory_within_the_tolerances_of_its_file():
    sim = gazelle.Simulation(World("lab"), nworld=2)
    robot = sim.spawn(formats.load_model_string(six_axis_text()))
    bounds = {"trajectory": 0.05, "goal": 0.01}
    robot.controllers.load(
        "arm",
        {
            "type": "effort_controllers/JointTrajectoryController",
            "joints": list(SIX),
            "gains": dict(zip(SIX, ARM_GAINS, strict=True)),
            "constraints": {
                "goal_time": 0.5,
                "stopped_velocity_tolerance": 0.05,
                **dict.fromkeys(SIX, bounds),
            },
        },
    )
    robot.controllers.start("arm")
    sim.run(0.2)
    still, there, on = np.zeros(6), np.array([0.6, 0.5, -0.7, 0.4, 0.5, -0.8]), -0.3 * np.ones(6)
    points = tuple(
        TrajectoryPoint(
            time=t, positions=tuple(at), velocities=tuple(still), accelerations=tuple(still)
        )
        for t, at in ((1.5, there), (3.0, on), (4.0, still))
    )
    goal = TrajectoryGoal(JointTrajectory(SIX, points))
    sent = robot.controllers["arm"].actions["follow_joint_trajectory"].send(goal)
    sim.run(5.0)
    assert sent.states.tolist() == [GoalState.SUCCEEDED] * 2, sent.text
    assert [robot.joints[name].position for name in SIX] == pytest.approx(list(still), abs=0.02)
