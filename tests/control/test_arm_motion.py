"""Arms in a simulation move as the closed forms of their controllers say."""

from __future__ import annotations

import math

import numpy as np
import pytest

import gazelle
from gazelle import formats
from gazelle.control import GoalState
from gazelle.control.values import JointTarget, JointTrajectory, TrajectoryGoal, TrajectoryPoint
from gazelle.description import World
from tests.control.arms import JOINTS, arm

TURNTABLE = """<robot name="turntable"><link name="world"/><link name="disc"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="{inertia}" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="axle" type="continuous"><parent link="world"/><child link="disc"/><axis xyz="0 0 1"/>
<limit effort="1e6" velocity="1e6"/></joint>
<transmission name="t"><type>transmission_interface/SimpleTransmission</type><joint name="axle">
<hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
<actuator name="m"/></transmission>
<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo></robot>"""


def turntable(inertia=1.0, nworld=1):
    model = formats.load_model_string(TURNTABLE.format(inertia=inertia))
    sim = gazelle.Simulation(World("w"), nworld=nworld)
    return sim, sim.spawn(model)


@pytest.mark.parametrize(("p", "d", "inertia"), [(100.0, 10.0, 1.0), (400.0, 12.0, 2.0)])
def test_a_step_is_answered_as_by_a_mass_a_spring_and_a_damper(p, d, inertia):
    """(d s + p) / (J s² + d s + p): the derivative acts on the error, and so on the step too."""
    sim, robot = turntable(inertia)
    kind = "effort_controllers/JointPositionController"
    robot.controllers.load("c", {"type": kind, "joint": "axle", "pid": {"p": p, "d": d}})
    robot.controllers.start("c")
    sim.step(2)
    robot.controllers["c"].inputs["command"].send(JointTarget(0.2))
    start, found = sim.time, []
    for _ in range(100):
        sim.step(10)
        found.append((sim.time - start, robot.joints["axle"].position / 0.2))
    time, answer = np.array(found).T
    fall, turn = d / (2 * inertia), math.sqrt(p / inertia - (d / (2 * inertia)) ** 2)
    wave = np.cos(turn * time) - fall / turn * np.sin(turn * time)
    wanted = 1.0 - np.exp(-fall * time) * wave
    assert np.abs(answer - wanted).max() < 0.02
    assert answer.max() == pytest.approx(wanted.max(), rel=0.01)  # overshoot


def test_a_velocity_by_pid_rises_exponentially():
    sim, robot = turntable()
    kind = "effort_controllers/JointVelocityController"
    robot.controllers.load("c", {"type": kind, "joint": "axle", "pid": {"p": 5.0}})
    robot.controllers.start("c")
    robot.controllers["c"].inputs["command"].send(JointTarget(2.0))
    sim.run(0.4)
    wanted = 2.0 * (1.0 - math.exp(-5.0 * 0.4))
    assert robot.joints["axle"].velocity == pytest.approx(wanted, rel=0.01)


GAINS = {
    "Effort": {"p": 900.0, "i": 500.0, "d": 90.0, "i_clamp": 60.0},
    "Velocity": {"p": 20.0},
    "Position": {},
}


@pytest.mark.long
@pytest.mark.parametrize("kind", ["Effort", "Position", "Velocity"])
def test_a_trajectory_is_followed_within_its_tolerances(kind):
    sim, robot = arm(kind, nworld=2)
    bounds = {"trajectory": 0.05, "goal": 0.01}
    robot.controllers.load(
        "arm",
        {
            "type": f"{kind.lower()}_controllers/JointTrajectoryController",
            "joints": JOINTS,
            "gains": dict.fromkeys(JOINTS, GAINS[kind]),
            "velocity_ff": dict.fromkeys(JOINTS, 1.0 if kind == "Velocity" else 0.0),
            "constraints": {**dict.fromkeys(JOINTS, bounds), "goal_time": 1.0},
        },
    )
    robot.controllers.start("arm")
    points = [(1.5, (0.8, -0.6)), (3.0, (-0.4, 0.9)), (4.0, (0.0, 0.0))]
    trajectory = JointTrajectory(
        tuple(JOINTS), tuple(TrajectoryPoint(t, p, (0.0, 0.0), (0.0, 0.0)) for t, p in points)
    )
    follow = robot.controllers["arm"].actions["follow_joint_trajectory"]
    goal = follow.send(TrajectoryGoal(trajectory), np.array([1]))
    sim.run(1.5)
    at = [robot.joints[name].positions()[:, 0] for name in JOINTS]
    assert np.array(at)[:, 1] == pytest.approx([0.8, -0.6], abs=0.03)
    assert np.array(at)[:, 0] == pytest.approx([0.0, 0.0], abs=0.03)  # the other world holds
    sim.run(3.6)
    assert (goal.state, goal.text) == (GoalState.SUCCEEDED, "")
    sim.reset()
    assert robot.controllers.state_of("arm") == "running"


def test_a_weak_arm_violates_its_path_tolerance():
    sim, robot = arm("Effort")
    weak = {"p": 5.0, "d": 1.0}
    robot.controllers.load(
        "arm",
        {
            "type": "effort_controllers/JointTrajectoryController",
            "joints": JOINTS,
            "gains": dict.fromkeys(JOINTS, weak),
            "constraints": {"shoulder": {"trajectory": 0.1}},
        },
    )
    robot.controllers.start("arm")
    trajectory = JointTrajectory(None, (TrajectoryPoint(0.5, (1.0, 0.0)),))
    goal = (
        robot.controllers["arm"].actions["follow_joint_trajectory"].send(TrajectoryGoal(trajectory))
    )
    sim.run(1.0)
    assert goal.state == GoalState.ABORTED
    assert goal.result.error_string.startswith("shoulder path error 0.1")
