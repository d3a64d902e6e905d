"""The tricycle: one wheel drives and steers, two count."""

import math

import numpy as np
import pytest
from models import plugin, simulate

from gazelle.errors import PluginWarning

TAGS = {
    "steeringJoint": "steering",
    "actuatedWheelJoint": "front",
    "encoderWheelLeftJoint": "left",
    "encoderWheelRightJoint": "right",
    "actuatedWheelDiameter": "0.2",
    "encoderWheelDiameter": "0.2",
    "encoderWheelSeparation": "0.4",
    "wheelTorque": "10",
    "publishWheelTF": "true",
    "publishWheelJointState": "true",
}


def tricycle(**tags):
    """Return a tricycle: front wheel at x = 0.5, rear axle at the origin."""
    wheels = []
    for name, parent, x, y in (
        ("left", "body", 0, 0.2),
        ("right", "body", 0, -0.2),
        ("front", "fork", 0.5, 0),
    ):
        wheels.append(
            f"""<link name="{name}_wheel"><pose>{x} {y} 0.1 -1.5707963 0 0</pose><inertial>
            <mass>0.5</mass><inertia><ixx>0.002</ixx><iyy>0.002</iyy><izz>0.002</izz></inertia>
            </inertial><collision name="c"><geometry><cylinder><radius>0.1</radius>
            <length>0.03</length></cylinder></geometry></collision></link>
            <joint name="{name}" type="revolute"><parent>{parent}</parent>
            <child>{name}_wheel</child><axis><xyz>0 0 1</xyz></axis></joint>"""
        )
    drive = plugin("libgazebo_ros_tricycle_drive.so", **{**TAGS, **tags})
    return f"""<model name="base"><link name="body"><pose>0.2 0 0.25 0 0 0</pose><inertial>
    <mass>4</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>
    <link name="fork"><pose>0.5 0 0.2 0 0 0</pose><inertial><mass>0.3</mass><inertia>
    <ixx>0.002</ixx><iyy>0.002</iyy><izz>0.002</izz></inertia></inertial></link>
    <joint name="steering" type="revolute"><parent>body</parent><child>fork</child><axis>
    <xyz>0 0 1</xyz></axis></joint>{"".join(wheels)}{drive}</model>"""


def test_it_goes_straight_as_fast_as_its_wheel_is_told():
    with simulate(tricycle(), nworld=2) as sim:
        robot = sim.robots["base"]
        robot.inputs["cmd_vel"].send(linear=[0.3, -0.2])
        sim.run(seconds=2.0)
        assert robot.motion().linear[:, 0] == pytest.approx([0.3, -0.2], rel=0.03)
        assert robot.position[:, 1] == pytest.approx(0.0, abs=0.01)


def test_it_turns_about_the_point_that_its_angle_gives():
    with simulate(tricycle(odometrySource="encoder")) as sim:
        robot = sim.robots["base"]
        robot.inputs["cmd_vel"].send(linear=0.3, angular=0.4)
        sim.run(seconds=2.0)
        # The wheel rolls at v: the base turns at v sin(angle) / wheelbase.
        assert robot.twist.angular[2] == pytest.approx(0.3 * math.sin(0.4) / 0.5, rel=0.05)
        counted = robot.outputs["odom"].last
        assert counted.angular[0, 2] == pytest.approx(0.3 * math.sin(0.4) / 0.5, rel=0.05)
        assert counted.linear[0, 0] == pytest.approx(0.3 * math.cos(0.4), rel=0.05)
        assert counted.pose_variance[0] == 1e-5


def test_its_angle_stops_at_a_quarter_turn():
    with simulate(tricycle()) as sim:
        robot = sim.robots["base"]
        robot.inputs["cmd_vel"].send(angular=3.0)
        sim.run(seconds=0.1)
        assert robot.joints["steering"].position == pytest.approx(math.pi / 2, abs=0.01)


def test_with_a_steering_speed_it_gets_there_evenly():
    with simulate(tricycle(steeringSpeed="0.5")) as sim:
        robot = sim.robots["base"]
        robot.inputs["cmd_vel"].send(angular=0.4)
        sim.run(seconds=0.4)
        assert robot.joints["steering"].position == pytest.approx(0.2, abs=0.03)
        sim.run(seconds=1.0)
        assert robot.joints["steering"].position == pytest.approx(0.4, abs=0.015)


def test_it_speeds_up_no_faster_than_it_may():
    with simulate(tricycle(wheelAcceleration="1.0")) as sim:
        robot = sim.robots["base"]
        robot.inputs["cmd_vel"].send(linear=0.3)
        sim.run(seconds=1.0)
        assert robot.joints["front"].velocity == pytest.approx(1.0, abs=0.2)


def test_its_topics_and_frames():
    with simulate(tricycle()) as sim:
        outputs = sim.robots["base"].outputs
        assert outputs["odom"].topic == "/base/odom"
        assert outputs["odom"].last.child_frame == "base_link"
        states = outputs["joint_states"].last
        assert states.names == ("steering", "front", "left", "right")
        assert states.position.shape == states.velocity.shape == states.effort.shape == (1, 4)


def test_wheel_frames_hang_on_the_links_that_bear_them():
    with simulate(tricycle()) as sim:
        frames = sim.robots["base"].outputs["wheel_tf"].last.transforms
        assert (frames[0].frame, frames[0].child_frame) == ("body", "fork")
        assert frames[1].frame == "fork"
        assert len(frames) == 4


def test_a_reset_and_a_snapshot_keep_its_odometry_true():
    with simulate(tricycle(odometrySource="encoder")) as sim:
        robot = sim.robots["base"]
        robot.inputs["cmd_vel"].send(linear=0.3)
        sim.run(seconds=0.5)
        state = sim.snapshot()
        sim.run(seconds=0.5)
        expected = robot.outputs["odom"].last.position.copy()
        sim.restore(state)
        sim.run(seconds=0.5)
        assert robot.outputs["odom"].last.position == pytest.approx(expected, abs=1e-9)
        sim.reset()
        assert np.all(robot.outputs["odom"].last.position == 0.0)


def test_an_unknown_source_of_odometry_is_refused():
    with pytest.raises(PluginWarning, match="odometrySource"):
        simulate(tricycle(odometrySource="gps"))
