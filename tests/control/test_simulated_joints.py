"""``libgazebo_ros_control.so``: joints of a simulation under controllers."""

from __future__ import annotations

import math
import sys
import threading
import types

import numpy as np
import pytest

from gazelle.control import EFFORT, POSITION, VELOCITY, Controller, register
from gazelle.control.values import JointTargets
from gazelle.errors import ControlWarning, PluginWarning
from gazelle.simulation.joint_hardware import JointHardware
from gazelle.simulation.values import EmergencyStop
from tests.control.arms import JOINTS, arm

LIMIT = '<limit lower="-3" upper="3" effort="60" velocity="4"/>'


def group(robot, kind, name="group"):
    """Run a forwarding controller of all joints; return its command."""
    of = f"{kind.lower()}_controllers/JointGroup{kind}Controller"
    robot.controllers.load(name, {"type": of, "joints": JOINTS})
    robot.controllers.start(name)
    return lambda *values: robot.controllers[name].inputs["command"].send(JointTargets(values))


def efforts(robot):
    engine = robot.simulation.engine
    return [float(engine.joints[robot.joints[name].name].effort()[0, 0]) for name in JOINTS]


def positions(robot):
    return [robot.joints[name].position for name in JOINTS]


def test_efforts_act_as_forces_and_within_limits():
    sim, robot = arm("Effort")
    command = group(robot, "Effort")
    command(math.inf, 7.0)
    sim.step(2)
    assert efforts(robot) == [60.0, 7.0]
    hardware = robot.controllers.hardware
    sim.step()
    assert hardware.states.effort.tolist() == [[60.0, 7.0]]


@pytest.mark.parametrize("kind", ["Position", "Velocity"])
def test_positions_and_velocities_are_held_against_gravity(kind):
    sim, robot = arm(kind)
    command = group(robot, kind)
    command(0.5, -0.8)
    sim.run(1.0)
    if kind == "Velocity":
        assert positions(robot) == pytest.approx([0.5, -0.8], abs=0.01)
        command(0.0, 0.0)
        sim.run(1.0)
        assert positions(robot) == pytest.approx([0.5, -0.8], abs=0.01)
    else:
        assert positions(robot) == pytest.approx([0.5, -0.8], abs=1e-3)
        assert [robot.joints[name].velocity for name in JOINTS] == pytest.approx([0, 0], abs=0.05)


@pytest.mark.parametrize("kind", ["Position", "Velocity"])
def test_gains_bring_joints_there_by_effort(kind):
    sim, robot = arm(kind)
    gains = {"p": 400.0, "i": 200.0, "d": 30.0, "i_clamp": 100.0}
    if kind == "Velocity":
        gains = {"p": 100.0, "i": 200.0, "i_clamp": 100.0}
    robot.settings["pid_gains"].send(dict.fromkeys(JOINTS, gains))
    command = group(robot, kind)
    command(0.4, -0.3)
    sim.run(3.0 if kind == "Position" else 1.0)
    assert positions(robot) == pytest.approx([0.4, -0.3], abs=0.05)
    # The shoulder bears both rods: 2 kg at 0.5 m, and the elbow and 1 kg at 0.5 m beyond it.
    weight = 9.8 * (2 * 0.5 * math.sin(0.4) + math.sin(0.4) + 0.5 * math.sin(0.1))
    if kind == "Position":
        assert efforts(robot)[0] == pytest.approx(weight, rel=0.05)


@pytest.mark.parametrize("kind", ["Position", "Velocity", "Effort"])
def test_no_step_is_faster_or_stronger_than_limits_allow(kind):
    sim, robot = arm(kind)
    command = group(robot, kind)
    rng = np.random.default_rng(4)
    before = positions(robot)
    for _ in range(60):
        command(*rng.uniform(-1e3, 1e3, 2))
        sim.step(7)
        now = positions(robot)
        if kind != "Effort":
            moved = np.abs(np.subtract(now, before)) / 0.007
            assert (moved <= [4.0 + 0.05, 6.0 + 0.05]).all()
        assert (np.abs(efforts(robot)) <= [60.0, 30.0]).all()
        assert abs(now[0]) <= 3.0 + 0.01
        before = now


def test_parameters_override_the_limits_of_the_file():
    sim, robot = arm("Velocity")
    given = {"shoulder": {"has_velocity_limits": True, "max_velocity": 0.25}}
    robot.settings["joint_limits"].send(given)
    command = group(robot, "Velocity")
    command(9.0, 0.0)
    sim.run(1.0)
    assert positions(robot)[0] == pytest.approx(0.25, abs=0.01)
    with pytest.warns(ControlWarning, match="changed after controllers were loaded"):
        robot.settings["joint_limits"].send({})


def test_joints_that_turn_are_counted_round_and_round():
    sim, robot = arm("Velocity")
    command = group(robot, "Velocity")
    command(0.0, 6.0)
    sim.run(3.0)
    sim.step()
    turned = robot.controllers.hardware.states.position[0, 1]
    assert turned == pytest.approx(18.0, abs=0.3)


def test_the_first_reading_unwinds_to_the_nearest_equal_angle():
    """DefaultRobotHWSim counts from 1.0, so a joint at -3 reads -3 + 2 pi."""
    sim, robot = arm("Velocity", replace={LIMIT: LIMIT.replace('"-3"', '"-3.1"')})
    command = group(robot, "Velocity")
    robot.joints["shoulder"].position = -3.0
    hardware = robot.controllers.hardware
    hardware.reset(None)
    command(0.0, 0.0)
    sim.step(2)
    assert hardware.states.position[0, 0] == pytest.approx(2 * math.pi - 3.0, abs=1e-3)


def test_an_emergency_stop_takes_the_power_and_controllers_begin_anew():
    stop = "<robotNamespace>/arm</robotNamespace><eStopTopic>/e_stop</eStopTopic>"
    for kind in ("Effort", "Position", "Velocity"):
        sim, robot = arm(kind, replace={"<robotNamespace>/arm</robotNamespace>": stop})
        assert robot.inputs["emergency_stop"].topic == "/e_stop"
        command = group(robot, kind)
        command(0.5, 0.5)
        sim.run(0.1)
        robot.inputs["emergency_stop"].send(EmergencyStop(True))
        sim.step(2)
        there = positions(robot)
        command(2.0, 2.0)
        if kind == "Effort":
            assert efforts(robot) == [0.0, 0.0]
            assert robot.controllers["group"].hardware.interfaces[EFFORT].commands["effort"].any()
        else:
            sim.run(0.2)
            assert positions(robot) == pytest.approx(there, abs=0.01)
        robot.inputs["emergency_stop"].send(EmergencyStop(False))
        sim.step(3)
        there = positions(robot)
        sim.run(0.2)
        if kind != "Effort":  # held where it was let go
            assert positions(robot) == pytest.approx(there, abs=0.01)


class Counting(Controller):
    """Notes the times of its updates."""

    def init(self, parameters):
        self.seen = []
        self.started = []

    def starting(self, time):
        self.started.append(time)

    def update(self, time, period):
        self.seen.append((self.now_ns, period))


register("tests/Counting", Counting)


def test_controllers_act_at_the_control_period():
    period = "<robotNamespace>/arm</robotNamespace><controlPeriod>0.003</controlPeriod>"
    sim, robot = arm("Effort", replace={"<robotNamespace>/arm</robotNamespace>": period})
    counting = robot.controllers.load("c", {"type": "tests/Counting"})
    robot.controllers.start("c")
    sim.step(7)
    assert counting.seen == [(0, 0.003), (3_000_000, 0.003), (6_000_000, 0.003)]
    sim.reset()
    counting.seen.clear()
    sim.step(1)
    assert counting.seen == [(0, 0.003)]  # one period, not all the time before


def test_a_control_period_below_the_step_warns():
    period = "<robotNamespace>/arm</robotNamespace><controlPeriod>0.0001</controlPeriod>"
    with pytest.warns(ControlWarning, match="shorter than the physics step of 0.001 s"):
        sim, robot = arm("Effort", replace={"<robotNamespace>/arm</robotNamespace>": period})
    counting = robot.controllers.load("c", {"type": "tests/Counting"})
    robot.controllers.start("c")
    sim.step(3)
    assert [period for _, period in counting.seen[1:]] == [0.001, 0.001]


def test_several_robots_and_namespaces_have_managers_of_their_own():
    sim, one = arm("Effort")
    spaces = {"<robotNamespace>/arm</robotNamespace>": ""}
    from gazelle import formats
    from tests.control.arms import arm_text

    model = formats.load_model_string(arm_text("Velocity", replace=spaces))
    two = sim.spawn(model, name="second")
    assert (list(one.managers), list(two.managers)) == (["/arm"], ["/second"])
    first, second = group(one, "Effort"), group(two, "Velocity")
    first(0.0, 0.0)
    second(0.7, 0.0)
    sim.run(1.0)
    assert positions(one) == pytest.approx([0.0, 0.0], abs=1e-6)
    assert positions(two) == pytest.approx([0.7, 0.0], abs=0.02)
    sim.delete("second")
    sim.run(0.1)


def test_two_plugins_of_one_robot_have_managers_of_their_own():
    again = """</plugin><plugin name="other" filename="libgazebo_ros_control.so">
      <robotNamespace>/other</robotNamespace></plugin><plugin name="x" filename="libgazebo_ros_api_plugin.so">"""
    _, robot = arm("Effort", replace={"</plugin>": again + "</plugin>"})
    assert list(robot.managers) == ["/arm", "/other"]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('<joint name="elbow">\n', '<joint name="elbwo">\n', "elbwo"),
        ("EffortJointInterface</h", "GravityJointInterface</h", "no interface"),
        ("</robotNamespace>", "</robotNamespace><robotSimType>a/B</robotSimType>", "robotSimType"),
    ],
)
def test_what_cannot_be_leaves_the_plugin_out(old, new, said):
    with pytest.warns(PluginWarning, match=said):
        _, robot = (
            arm("Effort", replace={old: new})
            if old != "EffortJointInterface</h"
            else arm("Gravity")
        )
    assert robot.managers == {}


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('<transmission name="elbow_transmission">', "<transmission>", "has no name"),
        (
            '<actuator name="elbow_motor">\n      <mechanicalReduction>2</mechanicalReduction>\n    </actuator>',
            "",
            "no <actuator>",
        ),
        ('<joint name="elbow">\n', '<joint name="shoulder"/><joint name="elbow">\n', "2 joints"),
    ],
)
def test_a_bad_transmission_is_left_out_alone(old, new, said):
    with pytest.warns(ControlWarning, match=said):
        _, robot = arm("Effort", replace={old: new})
    assert robot.controllers.hardware.interfaces[EFFORT].resources == ("shoulder",)


def test_the_interface_may_be_the_actuators_as_in_old_files():
    old = """<joint name="elbow">
      <hardwareInterface>INTERFACEJointInterface</hardwareInterface>
    </joint>
    <actuator name="elbow_motor">"""
    new = """<joint name="elbow"/>
    <actuator name="elbow_motor"><hardwareInterface>EffortJointInterface</hardwareInterface>"""
    _, robot = arm("Effort", replace={old: new})
    assert robot.controllers.hardware.interfaces[EFFORT].resources == tuple(JOINTS)


def test_a_robot_side_of_ones_own_is_named_by_its_type():
    class Half(JointHardware):
        """Half of each effort is lost."""

        def write(self, time, period):
            self.interfaces[EFFORT].commands["effort"] *= 0.5
            super().write(time, period)

    module = types.ModuleType("my_hardware")
    module.Half = Half
    sys.modules["my_hardware"] = module
    try:
        kind = "</robotNamespace><robotSimType>my_hardware/Half</robotSimType>"
        sim, robot = arm("Effort", replace={"</robotNamespace>": kind})
    finally:
        del sys.modules["my_hardware"]
    group(robot, "Effort")(8.0, 2.0)
    sim.step()
    assert efforts(robot) == [4.0, 1.0]


def test_a_robot_without_the_plugin_is_controlled_from_python_through_any_interface():
    sim, robot = arm("Effort", replace={"libgazebo_ros_control.so": "libgazebo_ros_api_plugin.so"})
    robot.controllers.load(
        "e", {"type": "effort_controllers/JointGroupEffortController", "joints": JOINTS}
    )
    command = group(robot, "Velocity", "v")
    command(0.5, 0.0)
    sim.run(1.0)
    assert positions(robot) == pytest.approx([0.5, 0.0], abs=0.01)
    robot.controllers.switch(start=["e"], stop=["v"])
    sim.run(1.0)  # it swings now
    assert abs(positions(robot)[0] - 0.5) > 0.1
    hold = group(robot, "Position", "p") if robot.controllers.stop("e") is None else None
    there = positions(robot)
    sim.run(0.3)
    assert positions(robot) == pytest.approx(there, abs=0.02)
    assert hold is not None
    assert {POSITION, VELOCITY, EFFORT} < set(robot.controllers.hardware.interfaces)


@pytest.mark.parametrize("kind", ["Effort", "Position", "Velocity"])
def test_a_snapshot_goes_on_to_the_bit_and_a_reset_holds_still(kind):
    sim, robot = arm(kind, nworld=2)
    if kind == "Position":
        robot.settings["pid_gains"].send({"elbow": {"p": 50.0, "i": 1.0, "d": 5.0, "i_clamp": 3}})
    command = group(robot, kind)
    robot.controllers["group"].inputs["command"].send(JointTargets([0.2, 0.1]), np.array([1]))
    sim.run(0.2)
    kept = sim.snapshot()
    sim.run(0.2)
    wanted = sim.state_hash()
    sim.run(0.2)
    sim.restore(kept)
    sim.run(0.2)
    assert sim.state_hash() == wanted
    sim.reset(np.array([1]))
    sim.run(0.2)
    assert robot.joints["shoulder"].positions()[1, 0] == pytest.approx(0.0, abs=1e-3)
    assert command is not None


@pytest.mark.long
@pytest.mark.parametrize("kind", ["Effort", "Position", "Velocity"])
def test_worlds_do_not_depend_on_each_other(kind):
    def run(nworld, world):
        sim, robot = arm(kind, nworld=nworld)
        group(robot, kind)(0.0, 0.0)
        port = robot.controllers["group"].inputs["command"]
        for i in range(nworld):
            port.send(JointTargets([0.3 * (i + 1 + world), -0.1]), np.array([i]))
        sim.run(0.3)
        return [sim.state_hash([i]) for i in range(nworld)]

    assert run(3, 0) == [run(1, world)[0] for world in range(3)]


def test_efforts_from_python_act_while_nothing_controls_the_joint():
    sim, robot = arm("Effort")
    robot.joints["shoulder"].effort = 3.0
    sim.run(0.05)
    assert efforts(robot) == [3.0, 0.0]
    assert robot.joints["shoulder"].velocity > 0.0
    robot.controllers.load("c", {"type": "tests/Counting"})
    robot.controllers.start("c")
    sim.run(0.05)
    assert efforts(robot) == [3.0, 0.0]
    group(robot, "Effort")(1.0, 0.0)
    sim.run(0.05)
    robot.controllers.stop("group")
    sim.run(0.05)
    assert efforts(robot) == [1.0, 0.0]  # the last command stays


def test_clients_switch_while_the_simulation_runs_and_is_reset():
    sim, robot = arm("Effort", nworld=2)
    manager, faults = robot.controllers, []
    for name, joint in (("a", "shoulder"), ("b", "shoulder"), ("c", "elbow"), ("d", "elbow")):
        gains = {joint: {"p": 300.0, "d": 30.0}}
        of = "effort_controllers/JointTrajectoryController"
        manager.load(name, {"type": of, "joints": [joint], "gains": gains})
    manager.start("a", "c")

    def client(first, second):
        try:
            for _ in range(150):
                manager.switch(start=[second], stop=[first])
                manager.switch(start=[first], stop=[second])
        except Exception as error:  # noqa: BLE001  the test tells of any
            faults.append(error)

    threads = [threading.Thread(target=client, args=pair) for pair in (("a", "b"), ("c", "d"))]
    for each in threads:
        each.start()
    while any(each.is_alive() for each in threads):
        sim.step(20)
        sim.reset(np.array([1]))
    for each in threads:
        each.join()
    assert faults == []
    assert {e.controller.name for e in manager.loaded if e.state == "running"} == {"a", "c"}
    sim.reset()
    sim.run(0.5)
    assert np.abs([robot.joints[name].positions() for name in JOINTS]).max() < 1e-3


SENSORS = """<gazebo reference="lower"><sensor name="tip_imu" type="imu"><update_rate>100</update_rate></sensor>
</gazebo><gazebo reference="shoulder"><provideFeedback>true</provideFeedback><sensor name="strain"
 type="force_torque"><update_rate>100</update_rate></sensor></gazebo>
</robot>"""


def test_sensors_of_the_robot_are_published_by_controllers():
    sim, robot = arm("Effort", replace={"</robot>": SENSORS})
    told = []
    for name, of, sensor in (
        ("i", "imu_sensor_controller/ImuSensorController", "tip_imu"),
        ("f", "force_torque_sensor_controller/ForceTorqueSensorController", "strain"),
    ):
        robot.controllers.load(name, {"type": of, "publish_rate": 100.0})
        robot.controllers[name].outputs[sensor].subscribe(told.append)
    robot.controllers.start("i", "f")
    sim.run(0.1)
    imu, wrench = told[-2:]
    assert (imu.frame, wrench.frame) == ("lower", "upper")
    assert imu.linear_acceleration[0] == pytest.approx([0, 0, 9.8], abs=0.01)
    assert abs(wrench.force[0, 2]) == pytest.approx(3.0 * 9.8, rel=1e-3)  # both rods hang on it


def test_motors_that_other_plugins_have_put_on_joints_go_on():
    # Many a base has both: wheels with transmissions, and a plugin that drives them.
    sim, robot = arm("Effort")
    robot.joints["elbow"].add_motor(50.0)
    robot.joints["elbow"].drive(1.5)
    loop = next(each.plugin for each in sim.plugins if hasattr(each.plugin, "take_limits"))
    loop.take_limits({"elbow": {"has_effort_limits": True, "max_effort": 1.0}})
    sim.run(0.2)
    assert robot.joints["elbow"].velocity == pytest.approx(1.5, abs=0.05)


def test_a_motor_is_switched_off_where_gains_take_its_place():
    sim, robot = arm("Velocity")
    robot.settings["pid_gains"].send({"elbow": {"p": 0.0, "i": 0.0, "d": 0.0}})
    robot.joints["elbow"].apply_effort(5.0)
    sim.run(0.1)
    assert robot.joints["elbow"].velocity > 0.2
    assert robot.joints["shoulder"].velocity == pytest.approx(0.0, abs=1e-3)
