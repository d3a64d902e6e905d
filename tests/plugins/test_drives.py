"""Drives on wheels, and the base that slides."""

import numpy as np
import pytest
from models import base, block, plugin, simulate

from gazelle.errors import PluginWarning

SKID = plugin(
    "libgazebo_ros_skid_steer_drive.so",
    leftFrontJoint="joint0",
    rightFrontJoint="joint1",
    leftRearJoint="joint2",
    rightRearJoint="joint3",
    wheelSeparation="0.4",
    wheelDiameter="0.2",
    torque="20",
    broadcastTF="true",
)
MULTI = plugin(
    "libdiffdrive_plugin_multi_wheel.so",
    leftJoints="joint0 joint2",
    rightJoints="joint1 joint3",
    wheelSeparation="0.4",
    wheelDiameter="0.2",
    torque="20",
)


@pytest.mark.parametrize("drive", [SKID, MULTI])
def test_a_base_on_four_wheels_goes_straight_as_fast_as_it_is_told(drive):
    with simulate(base(drive)) as sim:
        robot = sim.robots["base"]
        robot.inputs["cmd_vel"].send(linear=0.3)
        sim.run(seconds=3.0)
        assert robot.twist.linear[0] == pytest.approx(0.3, rel=0.03)
        assert robot.pose.y == pytest.approx(0.0, abs=0.02)
        assert robot.joints["joint0"].velocity == pytest.approx(3.0, rel=0.05)


@pytest.mark.parametrize("drive", [SKID, MULTI])
def test_it_turns_by_the_difference_of_its_sides(drive):
    with simulate(base(drive)) as sim:
        robot = sim.robots["base"]
        robot.inputs["cmd_vel"].send(angular=1.0)
        sim.run(seconds=2.0)
        left, right = robot.joints["joint0"].velocity, robot.joints["joint1"].velocity
        assert right == pytest.approx(1.0 * 0.2 / 0.1, rel=0.1)
        assert left == pytest.approx(-right, rel=0.1)
        assert robot.twist.angular[2] > 0.1


@pytest.mark.long
def test_worlds_are_driven_each_by_its_own_command():
    with simulate(base(SKID), nworld=2) as sim:
        robot = sim.robots["base"]
        robot.inputs["cmd_vel"].send(linear=[0.3, -0.3])
        sim.run(seconds=1.0)
        ahead, back = robot.position[:, 0]
        assert ahead > 0.15
        assert back < -0.15


@pytest.mark.parametrize(
    ("filename", "torque", "tags"),
    [
        ("libgazebo_ros_diff_drive.so", 5.0, {"leftJoint": "joint0", "rightJoint": "joint1"}),
        (
            "libdiffdrive_plugin_multi_wheel.so",
            5.0,
            {"leftJoints": "joint0 joint2", "rightJoints": "joint1 joint3"},
        ),
        (
            "libdiffdrive_plugin_6w.so",
            10.0,
            {
                f"{place}{side}Joint": f"joint{number}"
                for place in ("front", "mid", "rear")
                for number, side in enumerate(("Left", "Right"))
            },
        ),
    ],
)
def test_motors_have_the_torque_of_the_original_unless_told_otherwise(filename, torque, tags):
    for given in ({}, {"torque": "3", "wheelTorque": "3"}):
        with simulate(base(plugin(filename, **tags, **given))) as sim:
            engine = sim.engine
            efforts = [engine.parameter("motor_effort", f"base::joint{i}")[0, 0] for i in (0, 1)]
            assert efforts == [3.0 if given else torque] * 2


def test_the_skid_drives_odometry_has_the_variances_of_its_file():
    tags = SKID.replace("<torque>", "<covariance_x>0.5</covariance_x><torque>")
    with simulate(base(tags)) as sim:
        outputs = sim.robots["base"].outputs
        odometry = outputs["odom"].last
        assert odometry.pose_variance == (0.5, 0.0001, 1e12, 1e12, 1e12, 0.01)
        assert (odometry.frame, odometry.child_frame) == ("odom", "base_footprint")
        assert outputs["odom"].topic == "/odom"
        assert outputs["odom_tf"].last.transforms[0].child_frame == "base_footprint"


def test_after_a_reset_the_wheels_stand_still_and_obey_again():
    with simulate(base(SKID)) as sim:
        robot = sim.robots["base"]
        robot.inputs["cmd_vel"].send(linear=0.3)
        sim.run(seconds=1.0)
        sim.reset()
        sim.run(seconds=0.5)
        assert robot.pose.x == pytest.approx(0.0, abs=5e-3)
        robot.inputs["cmd_vel"].send(linear=0.3)
        sim.run(seconds=1.0)
        assert robot.pose.x > 0.15


def test_a_snapshot_goes_on_as_the_run_did():
    with simulate(base(SKID)) as sim:
        robot = sim.robots["base"]
        robot.inputs["cmd_vel"].send(linear=0.3, angular=0.2)
        sim.run(seconds=0.5)
        state = sim.snapshot()
        sim.run(seconds=0.5)
        expected = robot.position
        sim.restore(state)
        robot.inputs["cmd_vel"].send(linear=0.3, angular=0.2)
        sim.run(seconds=0.5)
        assert np.allclose(robot.position, expected, atol=1e-9)


def test_a_wheel_of_no_size_is_refused():
    with pytest.raises(PluginWarning, match="must be positive"):
        simulate(base(SKID.replace("<wheelDiameter>0.2", "<wheelDiameter>0")))


def test_a_joint_that_is_not_there_is_named():
    with pytest.raises(PluginWarning, match="jointX"):
        simulate(base(SKID.replace("joint3", "jointX")))


SLIDE = plugin("libgazebo_ros_planar_move.so", odometryRate="10", robotBaseFrame="core")


def test_the_sliding_base_goes_forward_sideways_and_round():
    with simulate(block(plugin=SLIDE), ground=False) as sim:
        robot = sim.robots["cube"]
        robot.inputs["cmd_vel"].send(linear=[[0.5, 0.2, 0.0]], angular=[[0.0, 0.0, 0.0]])
        sim.run(seconds=1.0)
        assert (robot.pose.x, robot.pose.y) == pytest.approx((0.5, 0.2), abs=2e-3)
        assert robot.pose.z == pytest.approx(0.5, abs=0.01)
        robot.inputs["cmd_vel"].send(angular=1.0)
        sim.run(seconds=1.0)
        assert robot.pose.yaw == pytest.approx(1.0, abs=5e-3)


def test_the_sliding_base_publishes_at_its_rate():
    with simulate(block(plugin=SLIDE)) as sim:
        heard = []
        sim.robots["cube"].outputs["odom"].subscribe(heard.append)
        sim.run(seconds=2.0)
        assert len(heard) == pytest.approx(20, abs=1)
        assert heard[-1].child_frame == "core"


def test_the_sliding_base_stops_when_nobody_commands_it_any_more():
    tags = SLIDE.replace("</plugin>", "<cmdTimeout>0.3</cmdTimeout></plugin>")
    with simulate(block(plugin=tags), ground=False) as sim:
        robot = sim.robots["cube"]
        robot.inputs["cmd_vel"].send(linear=0.5)
        sim.run(seconds=2.0)
        assert robot.pose.x == pytest.approx(0.15, abs=0.01)
