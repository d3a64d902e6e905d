"""A controller that starts holds the joints where they are then, however they came there."""

from __future__ import annotations

import numpy as np
import pytest

import gazelle
from gazelle import formats
from gazelle.control.values import JointTrajectory, TrajectoryPoint
from gazelle.description import World
from gazelle.simulation.values import EmergencyStop
from tests.control.arms import JOINTS, arm_text
from tests.control.test_in_physics import FINGER, GRIPPER, base_text

FREE = World("w", gravity=(0.0, 0.0, 0.0))
PID = {"p": 300.0, "i": 5.0, "d": 30.0, "i_clamp": 10.0}
EACH = dict.fromkeys(JOINTS, PID)

# Interface, gains of the robot's side, controllers by name; all of both joints.
CASES = {
    "position": ("Position", None, {
        name: {"type": "position_controllers/JointPositionController", "joint": name} for name in JOINTS}),
    "positions": ("Position", None, {
        "c": {"type": "position_controllers/JointGroupPositionController", "joints": JOINTS}}),
    "positions by gains": ("Position", EACH, {
        "c": {"type": "position_controllers/JointGroupPositionController", "joints": JOINTS}}),
    "position trajectory": ("Position", None, {
        "c": {"type": "position_controllers/JointTrajectoryController", "joints": JOINTS}}),
    "position trajectory by gains": ("Position", EACH, {
        "c": {"type": "position_controllers/JointTrajectoryController", "joints": JOINTS}}),
    "position gripper": ("Position", None, {
        name: {"type": "position_controllers/GripperActionController", "joint": name} for name in JOINTS}),
    "position by velocity": ("Velocity", None, {
        name: {"type": "velocity_controllers/JointPositionController", "joint": name,
               "pid": {"p": 10.0}} for name in JOINTS}),
    "velocity trajectory": ("Velocity", None, {
        "c": {"type": "velocity_controllers/JointTrajectoryController", "joints": JOINTS,
              "gains": {name: {"p": 10.0} for name in JOINTS}}}),
    "velocities": ("Velocity", None, {
        "c": {"type": "velocity_controllers/JointGroupVelocityController", "joints": JOINTS}}),
    "position by effort": ("Effort", None, {
        name: {"type": "effort_controllers/JointPositionController", "joint": name,
               "pid": PID} for name in JOINTS}),
    "positions by effort": ("Effort", None, {
        "c": {"type": "effort_controllers/JointGroupPositionController", "joints": JOINTS,
              **{name: {"pid": PID} for name in JOINTS}}}),
    "effort trajectory": ("Effort", None, {
        "c": {"type": "effort_controllers/JointTrajectoryController", "joints": JOINTS, "gains": EACH}}),
    "effort gripper": ("Effort", None, {
        name: {"type": "effort_controllers/GripperActionController", "joint": name, "max_effort": 30.0,
               "gains": {name: PID}} for name in JOINTS}),
}  # fmt: skip

THERE = np.array([[0.5, -0.8], [-0.7, 1.1]])


def armed(case):
    """Return two worlds with the arm, controllers loaded and not started."""
    interface, gains, controllers = CASES[case]
    sim = gazelle.Simulation(FREE, nworld=2)
    robot = sim.spawn(formats.load_model_string(arm_text(interface)))
    if gains:
        robot.settings["pid_gains"].send(gains)
    for name, parameters in controllers.items():
        robot.controllers.load(name, parameters)
    return sim, robot, [*controllers]


def where(robot):
    return np.concatenate([robot.joints[name].positions() for name in JOINTS], axis=1)


def holds(sim, robot, there, steps=40):
    """Check that the joints stay there, from the first step on."""
    for count in (1, 1, steps):
        sim.step(count)
        assert where(robot) == pytest.approx(there, abs=1e-6)


@pytest.mark.parametrize("before", [0, 3])
@pytest.mark.parametrize("case", CASES)
def test_it_holds_where_joints_were_put_since_the_last_step(case, before):
    sim, robot, names = armed(case)
    sim.step(before)
    robot.set_configuration(JOINTS, THERE)
    robot.controllers.start(*names)
    holds(sim, robot, THERE)


@pytest.mark.parametrize("case", CASES)
def test_one_that_ran_before_remembers_nothing_of_where_joints_were(case):
    sim, robot, names = armed(case)
    robot.controllers.start(*names)
    sim.step(3)
    robot.controllers.stop(*names)
    for column, name in enumerate(JOINTS):
        robot.joints[name].set_position(THERE[:, column, None])
        robot.joints[name].velocity = 0.0
    robot.controllers.start(*names)
    holds(sim, robot, THERE)


@pytest.mark.parametrize("case", CASES)
def test_after_a_snapshot_and_after_a_reset_of_some_worlds(case):
    sim, robot, names = armed(case)
    robot.set_configuration(JOINTS, THERE)
    kept = sim.snapshot()
    sim.step(3)
    sim.restore(kept)
    robot.controllers.start(*names)
    holds(sim, robot, THERE)
    robot.controllers.stop(*names)
    sim.reset([1])
    robot.set_configuration(JOINTS, -THERE[1], [1])
    robot.controllers.start(*names)
    holds(sim, robot, THERE * [[1.0], [-1.0]])


def test_a_joint_with_limits_is_held_in_the_turn_it_is_in():
    """One that goes beyond half a turn is not taken for the equal angle that is nearer to where it was."""
    wide = {'lower="-3" upper="3"': 'lower="-6.2" upper="6.2"'}
    for interface, kind in (("Position", "position"), ("Effort", "effort")):
        sim = gazelle.Simulation(FREE)
        robot = sim.spawn(formats.load_model_string(arm_text(interface, replace=wide)))
        given = {"type": f"{kind}_controllers/JointTrajectoryController", "joints": JOINTS}
        robot.controllers.load("c", given | {"gains": EACH})
        robot.set_configuration(JOINTS, [4.5, 0.3])
        robot.controllers.start("c")
        holds(sim, robot, np.array([[4.5, 0.3]]))
        assert robot.controllers.hardware.states.position[0] == pytest.approx([4.5, 0.3])


@pytest.mark.parametrize("interface", ["Position", "Velocity", "Effort"])
def test_arms_that_no_file_lets_be_controlled(interface):
    """Each joint has every interface there; the one a controller claims is taken when it starts."""
    text = arm_text(interface)
    text = text[: text.index("<transmission")] + "</robot>"
    sim = gazelle.Simulation(FREE)
    robot = sim.spawn(formats.load_model_string(text))
    given = {"type": f"{interface.lower()}_controllers/JointTrajectoryController", "joints": JOINTS}
    robot.controllers.load("c", given | {"gains": EACH})
    robot.set_configuration(JOINTS, THERE[0])
    robot.controllers.start("c")
    holds(sim, robot, THERE[:1])


def test_a_parallel_gripper_stays_as_wide_as_it_was_opened():
    fingers = FINGER.format(name="l", at="-0.045", axis="1")
    fingers += FINGER.format(name="r", at="0.045", axis="-1")
    sim = gazelle.Simulation(FREE)
    robot = sim.spawn(formats.load_model_string(GRIPPER.format(fingers=fingers)))
    given = {"type": "robot_controllers/ParallelGripperController"}
    given |= {f"{side}_gripper_joint": f"{side}_slide" for side in "lr"}
    robot.controllers.load("g", given)
    robot.set_configuration(["l_slide", "r_slide"], [0.03, 0.03])
    robot.controllers.start("g")
    sim.run(0.2)
    assert robot.joints["l_slide"].position == pytest.approx(0.03, abs=1e-6)
    assert robot.joints["r_slide"].position == pytest.approx(0.03, abs=1e-6)


def test_a_base_does_not_count_wheels_that_were_turned_before_it_started():
    sim = gazelle.Simulation("empty")
    robot = sim.spawn(formats.load_model_string(base_text()))
    given = {"left_wheel": "left_wheel", "right_wheel": "right_wheel", "cmd_vel_timeout": 0.1}
    variances = {f"{name}_covariance_diagonal": [0.001] * 6 for name in ("pose", "twist")}
    given |= {"type": "diff_drive_controller/DiffDriveController", **variances}
    robot.controllers.load("base", given)
    sim.step(5)
    robot.set_configuration(["left_wheel", "right_wheel"], [0.9, -1.3])
    robot.controllers.start("base")
    sim.run(0.3)
    assert robot.controllers["base"].outputs["odom"].last.position[0] == pytest.approx(0, abs=1e-3)


def test_an_emergency_stop_holds_where_joints_were_put():
    sim = gazelle.Simulation(FREE)
    stop = "<robotNamespace>/arm</robotNamespace><eStopTopic>/e_stop</eStopTopic>"
    text = arm_text("Position", replace={"<robotNamespace>/arm</robotNamespace>": stop})
    robot = sim.spawn(formats.load_model_string(text))
    robot.controllers.load("c", CASES["positions"][2]["c"])
    robot.controllers.start("c")
    sim.step(3)
    robot.set_configuration(JOINTS, THERE[0])
    robot.inputs["emergency_stop"].send(EmergencyStop(True))
    holds(sim, robot, THERE[:1])


def test_a_controller_that_starts_after_a_long_rest_sees_no_long_period_and_no_old_time():
    """Where nothing was to be done nothing was updated: that is not its first period, nor the time."""
    sim, robot, names = armed("effort trajectory")
    sim.run(2.0)
    published = []
    robot.controllers.start(*names)
    controller = robot.controllers["c"]
    assert controller.now_ns == 2_000_000_000
    controller.outputs["state"].subscribe(lambda state: published.append(state.stamp))
    points = (TrajectoryPoint(1.0, (0.3, 0.4)),)
    sim.step()
    controller.inputs["command"].send(JointTrajectory(tuple(JOINTS), points))
    sim.run(0.1)
    assert controller._uptime == pytest.approx(0.101, abs=1e-6)
    assert len(published) == 4
    assert np.diff(published) == pytest.approx(20_000_000, abs=1_000_001)
