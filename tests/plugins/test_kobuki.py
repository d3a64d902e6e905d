"""The Kobuki base: wheels, gyro, cliffs and bumps."""

import numpy as np
import pytest
from kobuki_model import kobuki
from models import simulate

from gazelle.errors import PluginWarning
from gazelle.simulation.values import MotorPower, Trigger

WALL = """<model name="wall"><static>1</static><pose>{x} {y} 0.1 0 0 0</pose><link name="l">
<collision name="c"><geometry><box><size>{size} 0.2</size></box></geometry></collision></link>
</model>"""


def test_it_drives_until_its_command_is_too_old():
    with simulate(kobuki()) as sim:
        robot = sim.robots["base"]
        assert robot.inputs["cmd_vel"].topic == "/mobile_base/commands/velocity"
        robot.inputs["cmd_vel"].send(linear=0.3)
        sim.run(seconds=0.5)
        assert robot.twist.linear[0] == pytest.approx(0.3, rel=0.05)
        sim.run(seconds=0.8)
        assert robot.twist.linear[0] == pytest.approx(0.0, abs=0.01)


@pytest.mark.long
def test_its_heading_comes_from_the_gyro():
    with simulate(kobuki(), nworld=2) as sim:
        robot = sim.robots["base"]
        robot.inputs["cmd_vel"].send(angular=[0.8, -0.8])
        sim.run(seconds=0.5)
        odometry = robot.outputs["odom"].last
        yaw = 2.0 * np.arctan2(odometry.quaternion[:, 2], odometry.quaternion[:, 3])
        assert yaw == pytest.approx(robot.yaw, abs=0.02)
        assert yaw[0] > 0.2 > -0.2 > yaw[1]
        assert odometry.pose_variance == (0.1, 0.1, 1e6, 1e6, 1e6, 0.05)
        assert robot.outputs["odom_tf"].last.transforms[0].child_frame == "base_footprint"
        assert robot.outputs["joint_states"].last.names == ("joint0", "joint1")
        assert robot.outputs["imu_data"].topic == "/mobile_base/sensors/imu_data"


@pytest.mark.long
def test_without_power_it_stands():
    with simulate(kobuki(), nworld=2) as sim:
        robot = sim.robots["base"]
        robot.inputs["motor_power"].send(MotorPower(on=False), np.array([0]))
        robot.inputs["cmd_vel"].send(linear=0.3)
        sim.run(seconds=0.5)
        assert robot.motion().linear[:, 0] == pytest.approx([0.0, 0.3], abs=0.02)
        assert robot.outputs["odom"].last.position[1, 0] == pytest.approx(0.15, abs=0.03)
        robot.inputs["reset_odometry"].send(Trigger())
        assert (robot.outputs["odom"].last.position == 0.0).all()


@pytest.mark.long
def test_it_tells_of_cliffs_when_they_come_and_go():
    with simulate(kobuki()) as sim:
        robot = sim.robots["base"]
        heard = []
        robot.outputs["cliff_center"].subscribe(heard.append)
        sim.run(seconds=0.2)
        assert heard == []
        robot.set_pose((0.0, 0.0, 0.5))
        sim.run(seconds=0.05)
        assert [bool(each.deep[0]) for each in heard] == [True]
        assert heard[0].place == 1
        sim.run(seconds=1.0)
        assert [bool(each.deep[0]) for each in heard] == [True, False]


@pytest.mark.long
@pytest.mark.parametrize(
    ("place", "x", "y", "size"),
    [("center", 0.5, 0.0, "0.1 0.1"), ("left", 0.3, 0.15, "0.06 0.02")],
)
def test_it_tells_where_it_is_touched(place, x, y, size):
    with simulate(kobuki(), WALL.format(x=x, y=y, size=size)) as sim:
        robot = sim.robots["base"]
        heard = {name: [] for name in ("left", "center", "right")}
        for name, values in heard.items():
            robot.outputs[f"bumper_{name}"].subscribe(values.append)
        for _ in range(4):
            robot.inputs["cmd_vel"].send(linear=0.4)
            sim.run(seconds=0.3)
        pressed = {name for name, values in heard.items() if any(v.pressed[0] for v in values)}
        assert place in pressed
        assert "right" not in pressed


def test_its_core_sensors_are_published_fifty_times_a_second():
    with simulate(kobuki(), WALL.format(x=0.42, y=0.0, size="0.1 0.1"), nworld=2) as sim:
        robot = sim.robots["base"]
        heard = []
        robot.outputs["core"].subscribe(heard.append)
        robot.inputs["cmd_vel"].send(linear=[0.3, 0.0])
        sim.run(seconds=0.5)
        assert np.diff([each.stamp for each in heard]).tolist() == [20_000_000] * (len(heard) - 1)
        assert len(heard) in {25, 26}
        last = heard[-1]
        # Wheels with a friction of 1 jam it at the wall, and how firmly it touches is up to rounding.
        pressed = np.any([each.pressed for each in heard], axis=0)
        assert pressed.tolist() == [[False, True, False], [False] * 3]
        assert not last.deep.any()
        assert (last.floor > 0).all()
        states = robot.outputs["joint_states"].last
        assert last.angles == pytest.approx(states.position, abs=0.1)
        robot.set_pose((0.0, 0.0, 0.6), worlds=[1])
        sim.run(seconds=0.03)
        assert heard[-1].deep.tolist() == [[False] * 3, [True] * 3]
        sim.reset()
        heard.clear()
        sim.run(seconds=0.05)
        assert [each.stamp for each in heard[-2:]] == [20_000_000, 40_000_000]


def test_a_snapshot_goes_on_as_the_run_did_and_a_reset_starts_over():
    with simulate(kobuki()) as sim:
        robot = sim.robots["base"]
        robot.inputs["cmd_vel"].send(linear=0.3)
        sim.run(seconds=0.2)
        state = sim.snapshot()
        sim.run(seconds=0.3)
        expected = robot.outputs["odom"].last.position
        sim.restore(state)
        sim.run(seconds=0.3)
        assert robot.outputs["odom"].last.position == pytest.approx(expected, abs=1e-9)
        sim.reset()
        assert (robot.outputs["odom"].last.position == 0.0).all()


def test_what_it_lacks_is_named():
    with pytest.raises(PluginWarning, match="wheel_separation"):
        simulate(kobuki(wheel_separation=""))
    with pytest.raises(PluginWarning, match="bumper_name"):
        simulate(kobuki(bumper_name="imu"))


def test_a_parameter_puts_the_bases_own_topics_elsewhere():
    with simulate(kobuki()) as sim:
        robot = sim.robots["base"]
        assert robot.settings["base_prefix"].name == "/base_prefix"
        robot.settings["base_prefix"].send("base")
        topics = {port.topic for port in (*robot.inputs.values(), *robot.outputs.values())}
    assert topics == {
        "/base/commands/velocity",
        "/base/commands/motor_power",
        "/base/commands/reset_odometry",
        "/base/sensors/core",
        "/base/sensors/imu_data",
        "/base/events/cliff",
        "/base/events/bumper",
        "/joint_states",
        "/odom",
        "/tf",
    }
