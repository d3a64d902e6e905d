"""Plugins that publish poses, joints, inertia, touch, range and force."""

import math

import numpy as np
import pytest
from models import block, plugin, simulate

P3D = plugin("libgazebo_ros_p3d.so", bodyName="core", topicName="truth", updateRate="50")
ARM = """<model name="arm"><link name="base"><inertial><mass>1</mass></inertial></link>
<joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
<link name="tip"><pose>0.5 0 0 0 0 0</pose><gravity>{gravity}</gravity><inertial><mass>2</mass>
<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>
<joint name="elbow" type="{kind}"><parent>base</parent><child>tip</child>
<pose>-0.5 0 0 0 0 0</pose><axis><xyz>0 0 1</xyz></axis></joint>{plugin}</model>"""
RAYS = """<sensor name="eye" type="ray"><pose>0.2 0 0 0 0 0</pose><update_rate>20</update_rate><ray><scan><horizontal>
<samples>5</samples><min_angle>-0.2</min_angle><max_angle>0.2</max_angle></horizontal></scan>
<range><min>0.05</min><max>2</max></range></ray>{plugin}</sensor>"""
WALL = """<model name="wall"><static>1</static><pose>1.1 0 0.5 0 0 0</pose><link name="l">
<collision name="c"><geometry><box><size>0.2 4 1</size></box></geometry></collision></link></model>"""


def test_the_true_pose_comes_at_its_rate_with_its_names():
    with simulate(block(plugin=P3D, gravity=False), ground=False) as sim:
        robot = sim.robots["cube"]
        heard = []
        robot.outputs["truth"].subscribe(heard.append)
        robot.set_twist((0.5, 0.0, 0.0), (0.0, 0.0, 0.3))
        sim.run(seconds=1.0)
        assert len(heard) == pytest.approx(50, abs=1)
        last = heard[-1]
        assert (last.frame, last.child_frame) == ("world", "core")
        assert last.position[0, 0] == pytest.approx(0.5, abs=0.02)
        assert last.linear[0] == pytest.approx([0.5, 0.0, 0.0], abs=1e-6)
        assert robot.outputs["truth"].topic == "/truth"


def test_the_true_pose_has_its_offset_and_noise():
    tags = P3D.replace(
        "</plugin>", "<xyzOffset>1 2 3</xyzOffset><gaussianNoise>0.1</gaussianNoise></plugin>"
    )
    with simulate(block(plugin=tags, gravity=False), nworld=200, ground=False) as sim:
        odometry = sim.robots["cube"].outputs["truth"].last
        assert np.allclose(odometry.position, [1.0, 2.0, 3.5])
        assert odometry.linear.std() == pytest.approx(0.1, rel=0.15)
        assert odometry.pose_variance == pytest.approx((0.01,) * 6)


def test_the_pose_is_seen_from_another_body():
    tags = plugin("libgazebo_ros_p3d.so", bodyName="tip", topicName="truth", frameName="base")
    arm = ARM.format(gravity=0, kind="revolute", plugin=tags)
    with simulate(arm, ground=False) as sim:
        sim.robots["arm"].joints["elbow"].position = math.pi / 2
        odometry = sim.robots["arm"].outputs["truth"].last
        assert odometry.position[0] == pytest.approx([0.0, 0.5, 0.0], abs=1e-9)


def test_joints_are_published_with_positions_and_velocities():
    tags = plugin("libgazebo_ros_joint_state_publisher.so", jointName=" elbow ", updateRate="25")
    with simulate(ARM.format(gravity=0, kind="revolute", plugin=tags), ground=False) as sim:
        robot = sim.robots["arm"]
        heard = []
        robot.outputs["joint_states"].subscribe(heard.append)
        robot.joints["elbow"].velocity = 0.8
        sim.run(seconds=1.0)
        assert len(heard) == pytest.approx(25, abs=1)
        assert heard[-1].names == ("elbow",)
        assert heard[-1].velocity[0, 0] == pytest.approx(0.8, rel=1e-3)
        assert robot.outputs["joint_states"].topic == "/arm/joint_states"


@pytest.mark.long
def test_an_imu_sensor_at_rest_feels_gravity_and_says_its_variance():
    tags = plugin(
        "libgazebo_ros_imu_sensor.so",
        topicName="imu",
        frameName="core",
        updateRateHZ="40",
        gaussianNoise="0.02",
    )
    sensor = f'<sensor name="imu" type="imu">{tags}</sensor>'
    with simulate(block(sensor).replace("0 0 0.5", "0 0 0.1"), nworld=100) as sim:
        output = sim.robots["cube"].outputs["imu"]
        heard = []
        output.subscribe(heard.append)
        sim.run(seconds=1.0)
        assert len(heard) == pytest.approx(40, abs=1)
        assert heard[-1].linear_acceleration[:, 2].mean() == pytest.approx(9.8, abs=0.05)
        assert heard[-1].linear_acceleration[:, 0].std() == pytest.approx(0.02, rel=0.3)
        assert heard[-1].variance == pytest.approx(4e-4)
        assert (output.topic, output.frame) == ("/cube/imu", "core")


def test_a_bumper_tells_what_touches_and_how_hard():
    sensor = (
        '<sensor name="touch" type="contact"><update_rate>50</update_rate><contact>'
        "<collision>hull</collision></contact>"
        + plugin("libgazebo_ros_bumper.so", bumperTopicName="touch")
        + "</sensor>"
    )
    with simulate(block(sensor)) as sim:
        heard = []
        sim.robots["cube"].outputs["touch"].subscribe(heard.append)
        sim.run(seconds=0.1)
        assert len(heard[-1].contacts[0]) == 0
        sim.run(seconds=2.0)
        contacts = heard[-1].contacts[0]
        assert set(contacts.collisions) == {"cube::core::hull"}
        assert all(other.startswith("ground_plane::") for other in contacts.others)
        assert contacts.force[:, 2].sum() == pytest.approx(9.8, rel=0.02)


def test_a_range_finder_gives_the_shortest_of_its_rays():
    tags = plugin("libgazebo_ros_range.so", topicName="sonar", frameName="eye", fov="0.4")
    with simulate(block(RAYS.format(plugin=tags), gravity=False), WALL, ground=False) as sim:
        robot = sim.robots["cube"]
        value = robot.outputs["sonar"].last
        assert value.distance[0] == pytest.approx(0.8, abs=1e-6)
        assert (value.least, value.most, value.field_of_view) == (0.05, 2.0, 0.4)
        assert value.ultrasound
        robot.set_pose((0.0, 0.0, 5.0))
        assert robot.outputs["sonar"].last.distance[0] == pytest.approx(2.0)


@pytest.mark.parametrize("kind", ["fixed", "revolute"])
def test_a_force_torque_sensor_bears_the_weight_of_what_hangs_on_it(kind):
    tags = plugin("libgazebo_ros_ft_sensor.so", jointName="elbow", topicName="ft")
    with simulate(ARM.format(gravity=1, kind=kind, plugin=tags), ground=False) as sim:
        sim.step(10)
        output = sim.robots["arm"].outputs["ft"]
        value = output.last
        # The parent holds the child up; the lever is half a metre.
        assert value.force[0] == pytest.approx([0.0, 0.0, 2 * 9.8], abs=0.05)
        assert abs(value.torque[0, 1]) == pytest.approx(0.5 * 2 * 9.8, rel=0.01)
        assert output.frame == "tip"


def test_what_nobody_hears_is_not_computed():
    with simulate(block(plugin=P3D)) as sim:
        entry = sim.plugins[0]
        assert not entry.needs_system
        end = sim.robots["cube"].outputs["truth"].subscribe(lambda value: None)
        assert entry.needs_system
        end()
        assert not entry.needs_system
