"""Controllers of single joints: forwarding, PID, grippers, and what is only published."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.control import (
    FORCE_TORQUE,
    IMU,
    ControllerManager,
    GoalState,
    SensorInterface,
)
from gazelle.control.values import GripperGoal, ImuSample, JointTarget, JointTargets, StampedWrench
from gazelle.errors import ControlError, ControlWarning
from tests.control.robots import ARM
from tests.control.stand_in import Frictionless, spin


def loaded(kind, commands, nworld=1, model=ARM, **parameters):
    manager = ControllerManager(Frictionless(commands, nworld), model=model)
    controller = manager.load("c", {"type": kind, **parameters})
    return manager, controller


def joints(manager):
    return manager.hardware.joints


@pytest.mark.parametrize("kind", ["effort", "velocity", "position"])
def test_forwarding_starts_with_nothing_or_with_where_it_is(kind):
    type_ = f"{kind}_controllers/Joint{kind.capitalize()}Controller"
    manager, controller = loaded(type_, {kind.capitalize(): ["one"]}, joint="one")
    joints(manager).position[:] = 0.7
    manager.start("c")
    spin(manager)
    assert joints(manager).position[0, 0] == 0.7
    controller.inputs["command"].send(JointTarget(2.0))
    spin(manager)
    assert controller.hardware.interfaces[controller.interfaces[0]].commands[kind][0, 0] == 2.0
    assert controller.inputs["command"].topic == "c/command"


@pytest.mark.parametrize("kind", ["effort", "velocity"])
def test_positions_by_pid_settle(kind):
    type_ = f"{kind}_controllers/JointPositionController"
    gains = {"p": 100.0, "d": 20.0} if kind == "effort" else {"p": 5.0}
    manager, controller = loaded(
        type_, {kind.capitalize(): ["one"]}, joint="one", pid={**gains, "publish_state": True}
    )
    joints(manager).position[:] = 0.5
    manager.start("c")
    told, inner = [], []
    controller.outputs["state"].subscribe(told.append)
    controller.outputs["pid/state"].subscribe(inner.append)
    spin(manager, 100)
    assert joints(manager).position[0, 0] == pytest.approx(0.5)
    controller.inputs["command"].send(JointTarget(9.0))  # above the limit of the URDF
    spin(manager, 300)
    assert joints(manager).position[0, 0] == pytest.approx(2.0, abs=1e-3)
    assert (len(told), len(inner)) == (40, 400)
    assert told[-1].set_point[0] == 2.0
    assert told[-1].p == gains["p"]
    assert inner[0].p_term[0] == pytest.approx(0.0)
    assert controller.tunings["pid"].send(p=1.0)["p"] == 1.0
    spin(manager, 10)
    assert told[-1].p == 1.0


def test_turns_go_the_way_that_limits_allow():
    type_ = "velocity_controllers/JointPositionController"
    for name, start, target, sign in (("one", 1.9, -1.9, -1), ("two", 3.0, -3.0, 1)):
        manager, controller = loaded(type_, {"Velocity": [name]}, joint=name, pid={"p": 1.0})
        joints(manager).position[:] = start
        manager.start("c")
        controller.inputs["command"].send(JointTarget(target))
        spin(manager)
        assert np.sign(joints(manager).velocity[0, 0]) == sign
    manager, controller = loaded(type_, {"Velocity": ["slide"]}, joint="slide", pid={"p": 1.0})
    manager.start("c")
    controller.inputs["command"].send(JointTarget(4.0))  # more than half a turn, but metres
    spin(manager)
    assert joints(manager).velocity[0, 0] == pytest.approx(4.0)


def test_a_group_by_pid_has_gains_of_its_own_for_each():
    type_ = "effort_controllers/JointGroupPositionController"
    gains = {"one": {"pid": {"p": 10.0}}, "two": {"pid": {"p": 20.0}}}
    manager, controller = loaded(
        type_, {"Effort": ["one", "two"]}, nworld=2, joints=["one", "two"], **gains
    )
    manager.start("c")
    controller.inputs["command"].send(JointTargets([0.1, 0.1]), np.array([1]))
    spin(manager)
    assert joints(manager).effort == pytest.approx(np.array([[0, 0], [1.0, 2.0]]))
    assert "state" not in controller.outputs
    assert list(controller.tunings) == ["one/pid", "two/pid"]
    with pytest.raises(ControlError, match="'x/two/pid/p'"):
        manager.load("x", {"type": type_, "joints": ["one", "two"], "one": {"pid": {"p": 1.0}}})


def test_velocities_by_pid_settle_and_start_at_rest():
    type_ = "effort_controllers/JointVelocityController"
    manager, controller = loaded(type_, {"Effort": ["two"]}, joint="two", pid={"p": 10.0})
    joints(manager).velocity[:] = 3.0
    manager.start("c")
    spin(manager, 200)
    assert joints(manager).velocity[0, 0] == pytest.approx(0.0, abs=1e-3)
    controller.inputs["command"].send(JointTarget(1.5))
    spin(manager, 200)
    assert joints(manager).velocity[0, 0] == pytest.approx(1.5, abs=1e-3)
    told = controller.outputs["state"].last
    assert (told.set_point[0], told.process_value[0]) == (1.5, pytest.approx(1.5, abs=1e-3))
    state = controller.state()
    controller.reset(None)
    controller.restore(state)
    spin(manager, 50)
    assert joints(manager).velocity[0, 0] == pytest.approx(1.5, abs=1e-3)


# -- grippers ------------------------------------------------------------------------------


class Blocked(Frictionless):
    """A joint that something stops at 0.4."""

    def write(self, time, period):
        super().write(time, period)
        beyond = self.joints.position > 0.4
        self.joints.position[beyond] = 0.4
        self.joints.velocity[beyond] = 0.0


def gripper(kind, hardware=Frictionless, nworld=1, **parameters):
    manager = ControllerManager(hardware({kind: ["slide"]}, nworld), model=ARM)
    given = {"joint": "slide", "gains": {"slide": {"p": 50.0, "d": 15.0}}, **parameters}
    of = f"{kind.lower()}_controllers/GripperActionController"
    controller = manager.load("c", {"type": of, **given})
    manager.start("c")
    spin(manager)
    return manager, controller


@pytest.mark.parametrize("kind", ["Effort", "Position"])
def test_a_gripper_gets_there(kind):
    manager, controller = gripper(kind)
    told = []
    goal = controller.actions["gripper_cmd"].send(GripperGoal(0.3, max_effort=20.0))
    goal.subscribe(lambda _: None, told.append)
    spin(manager, 200)
    assert goal.state == GoalState.SUCCEEDED
    assert goal.result.reached_goal
    assert goal.result.position == pytest.approx(0.3, abs=0.011)
    if kind == "Effort":
        assert told


@pytest.mark.parametrize("kind", ["Effort", "Position"])
def test_a_gripper_that_is_stopped_stalls(kind):
    manager, controller = gripper(kind, Blocked, stall_timeout=0.5)
    goal = controller.actions["gripper_cmd"].send(GripperGoal(0.8, max_effort=5.0))
    spin(manager, 40)
    assert goal.state == GoalState.ACTIVE
    spin(manager, 120)
    assert goal.state == GoalState.ABORTED
    assert (goal.result.stalled, goal.result.reached_goal) == (True, False)
    assert goal.result.position == pytest.approx(0.4)
    assert goal.result.effort == pytest.approx(5.0)


def test_no_effort_is_no_force_and_goals_replace_each_other():
    manager, controller = gripper("Effort", nworld=2)
    first = controller.actions["gripper_cmd"].send(GripperGoal(0.3))
    spin(manager, 20)
    assert not joints(manager).effort.any()
    second = controller.actions["gripper_cmd"].send(GripperGoal(0.3, 9.0), np.array([1]))
    assert first.states.tolist() == [GoalState.ACTIVE, GoalState.PREEMPTED]
    spin(manager, 30)
    first.cancel()
    assert first.states.tolist() == [GoalState.PREEMPTED, GoalState.PREEMPTED]
    spin(manager, 200)
    assert second.state == GoalState.SUCCEEDED
    manager.stop("c")
    refused = controller.actions["gripper_cmd"].send(GripperGoal(0.1, 9.0))
    assert refused.state == GoalState.REJECTED


# -- publishing -----------------------------------------------------------------------------


def states(**parameters):
    manager, controller = loaded(
        "joint_state_controller/JointStateController",
        {"Effort": ["two", "one"]},
        **{"publish_rate": 25, **parameters},
    )
    told = []
    controller.outputs["joint_states"].subscribe(told.append)
    manager.start("c")
    return manager, controller, told


def test_joint_states_come_in_order_at_their_rate():
    manager, controller, told = states()
    assert controller.outputs["joint_states"].topic == "joint_states"
    joints(manager).position[0] = [1.0, 2.0]
    spin(manager)
    assert len(told) == 1  # at the first update
    assert told[0].names == ("one", "two")
    assert told[0].position.tolist() == [[1.0, 2.0]]
    assert told[0].stamp == manager.now_ns
    spin(manager, 100)
    assert len(told) in (25, 26)
    manager, controller, told = states(joints=["two"], publish_rate=0)
    spin(manager, 100)
    assert told == []
    assert controller.outputs["joint_states"].last.names == ("two",)


def test_extra_joints_are_told_if_they_are_right():
    extra = [
        {"name": "tail", "position": 0.5},
        {"name": "whole", "position": 1},
        {"name": "one"},
        {},
    ]
    with pytest.warns(ControlWarning) as warned:
        manager, _, told = states(extra_joints=extra)
    texts = [str(each.message) for each in warned]
    assert len(texts) == 3
    assert "must be a float, as 0.0, not 1" in texts[0]
    assert "'one' exists already" in texts[1]
    assert "needs a name" in texts[2]
    spin(manager)
    assert told[0].names == ("one", "two", "tail")
    assert told[0].position[0, 2] == 0.5
    with pytest.raises(ControlError, match="publish_rate"):
        manager.load("x", {"type": "joint_state_controller/JointStateController"})


def test_sensors_are_published_below_their_names():
    manager = ControllerManager(Frictionless({"Effort": ["one"]}))
    zero = np.zeros((1, 3))
    imu = ImuSample(7, "imu_link", np.array([[0.0, 0, 0, 1]]), zero, zero)
    wrench = StampedWrench(7, "wrist", zero, zero + math.pi)
    manager.hardware.register(SensorInterface(IMU, {"imu": lambda: imu}))
    manager.hardware.register(SensorInterface(FORCE_TORQUE, {"wrist": lambda: wrench}))
    told = []
    for name, of, sensor in (
        ("i", "imu_sensor_controller/ImuSensorController", "imu"),
        ("f", "force_torque_sensor_controller/ForceTorqueSensorController", "wrist"),
    ):
        controller = manager.load(name, {"type": of, "publish_rate": 50.0})
        assert controller.outputs[sensor].topic == sensor
        controller.outputs[sensor].subscribe(told.append)
    manager.start("i", "f")
    spin(manager, 10)
    assert told.count(imu) == told.count(wrench) == 5
