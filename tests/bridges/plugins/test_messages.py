"""Messages and answers of plugins, as a client on the graph sees them."""

from __future__ import annotations

import math
import struct

import pytest
from kobuki_model import kobuki
from models import block, plugin
from plugin_graph import first, running, send, wait

from gazelle_ros import load_message

RAYS = """<sensor name="eye" type="ray"><pose>0.2 0 0 0 0 0</pose><update_rate>50</update_rate>
<ray><scan><horizontal><samples>3</samples><min_angle>-0.2</min_angle><max_angle>0.2</max_angle>
</horizontal><vertical><samples>2</samples><min_angle>-0.1</min_angle><max_angle>0.1</max_angle>
</vertical></scan><range><min>0.05</min><max>2</max></range></ray>{plugin}</sensor>"""
WALL = """<model name="wall"><static>1</static><pose>1.1 0 0.5 0 0 0</pose><link name="l">
<collision name="c"><geometry><box><size>0.2 4 2</size></box></geometry></collision></link></model>"""
ARM = """<model name="arm"><pose>0 3 0 0 0 0</pose><link name="stand"><inertial><mass>1</mass>
</inertial></link><joint name="fix" type="fixed"><parent>world</parent><child>stand</child></joint>
<link name="tip"><gravity>0</gravity><inertial><mass>1</mass><inertia><ixx>0.5</ixx><iyy>0.5</iyy>
<izz>0.5</izz></inertia></inertial></link><joint name="elbow" type="revolute">
<parent>stand</parent><child>tip</child><axis><xyz>0 0 1</xyz></axis></joint>{plugin}</model>"""

GROUND = "<include><uri>model://ground_plane</uri></include>"
LIFT = """<model name="lift"><link name="car"><inertial><mass>500</mass></inertial></link>
<link name="door"><gravity>0</gravity><inertial><mass>5</mass></inertial></link>
<joint name="up" type="prismatic"><parent>world</parent><child>car</child><axis><xyz>0 0 1</xyz>
<limit><lower>0</lower><upper>9</upper></limit></axis></joint>
<joint name="side" type="prismatic"><parent>car</parent><child>door</child><axis><xyz>0 1 0</xyz>
<limit><lower>0</lower><upper>1</upper></limit></axis></joint>
<plugin name="p" filename="libgazebo_ros_elevator.so"><lift_joint>lift::up</lift_joint>
<door_joint>lift::side</door_joint></plugin></model>"""


def cube(filename, **tags):
    return block(plugin=plugin(filename, bodyName="core", **tags), gravity=False)


def test_a_velodynes_cloud_has_its_fields_and_rings():
    tags = plugin("libgazebo_ros_velodyne_laser.so", topicName="/points", frameName="velo")
    with running(block(RAYS.format(plugin=tags), gravity=False), WALL) as graph:
        cloud = first(graph, "/points", "sensor_msgs/PointCloud2")
    layout = [(f.name, f.offset, f.datatype, f.count) for f in cloud.fields]
    assert layout == [
        ("x", 0, 7, 1),
        ("y", 4, 7, 1),
        ("z", 8, 7, 1),
        ("intensity", 12, 7, 1),
        ("ring", 16, 4, 1),
        ("time", 18, 7, 1),
    ]
    assert (cloud.header.frame_id, cloud.height, cloud.width) == ("velo", 1, 6)
    assert (cloud.point_step, cloud.row_step, cloud.is_dense) == (22, 132, True)
    points = list(struct.iter_unpack("<ffffHf", bytes(cloud.data)))
    assert [point[4] for point in points] == [0, 0, 0, 1, 1, 1]
    assert all(point[0] == pytest.approx(0.8, abs=1e-5) for point in points)


def test_a_block_lasers_cloud_has_its_intensities():
    tags = plugin("libgazebo_ros_block_laser.so", topicName="cloud", frameName="eye")
    with running(block(RAYS.format(plugin=tags), gravity=False), WALL) as graph:
        cloud = first(graph, "/cloud", "sensor_msgs/PointCloud")
    assert len(cloud.points) == 6
    assert cloud.points[0].x == pytest.approx(0.8, abs=1e-5)
    assert cloud.channels[0].name == "intensities"
    assert list(cloud.channels[0].values) == [0.0] * 6


def test_hectors_imu_says_how_sure_it_is_and_takes_a_bias():
    with running(cube("libhector_gazebo_ros_imu.so", rateGaussianNoise="0.01")) as graph:
        imu = first(graph, "/imu", "sensor_msgs/Imu")
        assert imu.angular_velocity_covariance[0] == pytest.approx(1e-4)
        assert imu.linear_acceleration_covariance[8] == 0.0
        assert imu.header.frame_id == "core"
        vector = load_message("geometry_msgs/Vector3")(0.0, 3.0, 0.0)
        graph.client.call("/imu/set_accel_bias", "hector_gazebo_plugins/SetBias", bias=vector)
        graph.client.call("/imu/calibrate", "std_srvs/Empty")
        heard = graph.client.listen("/imu/bias", "sensor_msgs/Imu")
        wait(lambda: heard and heard[-1].linear_acceleration.y > 2.9)


def test_hectors_gps_tells_its_fix_and_takes_another_reference():
    with running(cube("libhector_gazebo_ros_gps.so", drift="2", status="1")) as graph:
        fix = first(graph, "/fix", "sensor_msgs/NavSatFix")
        assert (fix.status.status, fix.status.service) == (1, 0)
        assert fix.latitude == pytest.approx(49.9, abs=1e-3)
        assert (fix.position_covariance[0], fix.position_covariance_type) == (4.0, 2)
        place = load_message("geographic_msgs/GeoPose")()
        place.position.latitude, place.position.longitude = 10.0, 20.0
        graph.client.call(
            "/fix/set_reference_geopose",
            "hector_gazebo_plugins/SetReferenceGeoPose",
            geo_pose=place,
        )
        heard = graph.client.listen("/fix", "sensor_msgs/NavSatFix")
        wait(lambda: heard and abs(heard[-1].latitude - 10.0) < 1e-3)
        speed = first(graph, "/fix_velocity", "geometry_msgs/Vector3Stamped")
        assert speed.vector.x == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(
    ("flag", "kind", "field"),
    [
        ("false", "geometry_msgs/Vector3Stamped", "vector"),
        ("true", "sensor_msgs/MagneticField", "magnetic_field"),
    ],
)
def test_the_magnetic_field_comes_as_either_message(flag, kind, field):
    with running(cube("libhector_gazebo_ros_magnetic.so", useMagneticFieldMsgs=flag)) as graph:
        message = first(graph, "/magnetic", kind)
    assert getattr(message, field).x == pytest.approx(0.5)


def test_a_barometers_height_is_a_point():
    with running(cube("libhector_gazebo_ros_baro.so")) as graph:
        message = first(graph, "/pressure_height", "geometry_msgs/PointStamped")
    assert message.point.z == pytest.approx(0.5)


def test_an_altimeter_tells_altitude_and_pressure_in_hectors_message():
    with running(cube("libhector_gazebo_ros_baro.so", elevation="10", frameId="/air")) as graph:
        message = first(graph, "/altimeter", "hector_uav_msgs/Altimeter")
    assert message.altitude == pytest.approx(10.5)
    assert (message.qnh, message.header.frame_id) == (1013.25, "/air")
    assert 1011.0 < message.pressure < 1013.25


def test_a_sonar_tells_its_range_in_the_frame_as_it_is_written():
    tags = plugin("libhector_gazebo_ros_sonar.so", topicName="height")
    parameters = {"/tf_prefix": "r1"}
    with running(
        block(RAYS.format(plugin=tags), gravity=False), WALL, parameters=parameters
    ) as graph:
        message = first(graph, "/height", "sensor_msgs/Range")
    assert message.range == pytest.approx(0.8 / math.cos(0.1), abs=1e-5)
    assert (message.header.frame_id, message.radiation_type) == ("/sonar_link", 0)
    assert message.field_of_view == pytest.approx(0.2)


def test_the_errors_of_hectors_sensors_are_changed_while_they_run():
    with running(cube("libhector_gazebo_ros_gps.so")) as graph:
        double = load_message("dynamic_reconfigure/DoubleParameter")
        flag = load_message("dynamic_reconfigure/BoolParameter")
        config = load_message("dynamic_reconfigure/Config")
        kind = "dynamic_reconfigure/Reconfigure"
        ask = config(doubles=[double("offset", 3.0)])
        graph.client.call("/fix/position/set_parameters", kind, config=ask)
        ask = config(bools=[flag("STATUS_GBAS_FIX", True)])
        graph.client.call("/fix/status/set_parameters", kind, config=ask)
        heard = graph.client.listen("/fix", "sensor_msgs/NavSatFix")
        wait(lambda: heard and abs(heard[-1].altitude - 3.5) < 1e-3)
        assert heard[-1].status.status == 2
        assert graph.client.node.get_param("/fix/position/offset") == 3.0


def test_a_servo_turns_to_the_orientation_of_a_message():
    tags = plugin("libhector_servo_plugin.so", firstServoName="elbow", firstServoAxis="0 1 0")
    arm = ARM.replace("0 0 1</xyz>", "0 1 0</xyz>").replace('"stand"', '"base_link"')
    arm = arm.replace(">stand<", ">base_link<")
    with running(arm.format(plugin=tags)) as graph:
        message = load_message("geometry_msgs/QuaternionStamped")()
        message.quaternion.y, message.quaternion.w = math.sin(0.2), math.cos(0.2)
        fields = {"header": message.header, "quaternion": message.quaternion}
        message.header.frame_id = "base_link"
        send(graph, "/drive", "geometry_msgs/QuaternionStamped", **fields)
        wait(lambda: abs(graph.sim.robots["arm"].joints["elbow"].position - 0.4) < 1e-2)
        assert first(graph, "/joint_states", "sensor_msgs/JointState").name == ["elbow"]


def test_a_reset_is_told_once_and_nothing_else_is():
    with running(block(plugin=plugin("libhector_gazebo_reset_plugin.so"))) as graph:
        heard = graph.client.listen("/syscommand", "std_msgs/String")
        wait(lambda: graph.sim.robots["cube"].outputs["syscommand"].has_subscribers)
        graph.client.call("pause_physics", "std_srvs/Empty")
        graph.client.call("/gazelle/step", "gazelle_msgs/Step", steps=3)
        graph.client.call("reset_simulation", "std_srvs/Empty")
        wait(lambda: heard)
        graph.client.call("/gazelle/step", "gazelle_msgs/Step", steps=3)
        assert [message.data for message in heard] == ["reset"]


def test_a_wrench_pushes():
    with running(cube("libgazebo_ros_force.so", topicName="push")) as graph:
        force = load_message("geometry_msgs/Vector3")(5.0, 0.0, 0.0)
        send(graph, "/push", "geometry_msgs/Wrench", force=force)
        robot = graph.sim.robots["cube"]
        wait(lambda: robot.pose.x > 0.05)


def test_joint_paths_come_by_topic_and_by_service():
    with running(ARM.format(plugin=plugin("libgazebo_ros_joint_pose_trajectory.so"))) as graph:
        point = load_message("trajectory_msgs/JointTrajectoryPoint")(positions=[0.4])
        path = {"joint_names": ["elbow"], "points": [point]}
        send(graph, "/set_joint_trajectory", "trajectory_msgs/JointTrajectory", **path)
        elbow = graph.sim.robots["arm"].joints["elbow"]
        wait(lambda: abs(elbow.position - 0.4) < 1e-3)
        point.positions = [-0.6]
        answer = graph.client.call(
            "/set_joint_trajectory",
            "gazebo_msgs/SetJointTrajectory",
            model_name="arm",
            joint_trajectory=load_message("trajectory_msgs/JointTrajectory")(**path),
        )
        assert answer.success
        wait(lambda: abs(elbow.position + 0.6) < 1e-3)


def test_links_are_attached_by_the_service_of_its_own_package():
    other = block(gravity=False).replace('"cube"', '"other"').replace("0 0 0.5", "1 0 0.5")
    with running(block(gravity=False), other, plugin("libgazebo_ros_link_attacher.so")) as graph:
        names = {
            "model_name_1": "cube",
            "link_name_1": "core",
            "model_name_2": "other",
            "link_name_2": "core",
        }
        kind = "gazebo_ros_link_attacher/Attach"
        assert not graph.client.call("/link_attacher_node/detach", kind, **names).ok
        assert graph.client.call("/link_attacher_node/attach", kind, **names).ok
        assert graph.client.call("/link_attacher_node/detach", kind, **names).ok
        fixed = {"model_name": "cube", "link_name": "core", "set_static": True}
        kind = "gazebo_ros_link_attacher/SetStatic"
        assert graph.client.call("/link_attacher_node/setstatic", kind, **fixed).ok


def test_a_cup_is_switched_by_empty_services_and_tells_whether_it_holds():
    with running(cube("libgazebo_ros_vacuum_gripper.so", topicName="grasping")) as graph:
        graph.client.call("/on", "std_srvs/Empty")
        assert first(graph, "/grasping", "std_msgs/Bool").data is False
        assert graph.client.call("/off", "std_srvs/Empty") is not None


def test_a_hand_follows_a_frame_of_tf_and_tells_where_it_is():
    tags = plugin("libgazebo_ros_hand_of_god.so", linkName="core")
    with running(block(plugin=tags)) as graph:
        stamped = load_message("geometry_msgs/TransformStamped")(child_frame_id="hog_desired")
        stamped.header.frame_id = "world"
        stamped.transform.translation.z = 2.0
        stamped.transform.rotation.w = 1.0
        send(graph, "/tf", "tf2_msgs/TFMessage", transforms=[stamped])
        wait(lambda: graph.sim.robots["cube"].pose.z > 1.9)
        heard = graph.client.listen("/tf", "tf2_msgs/TFMessage")
        wait(lambda: any(t.child_frame_id == "hog_actual" for m in heard for t in m.transforms))


def test_a_kobuki_hears_and_tells_in_its_own_messages():
    with running(kobuki(), GROUND) as graph:
        robot = graph.sim.robots["base"]
        cliffs = graph.client.listen("/mobile_base/events/cliff", "kobuki_msgs/CliffEvent")
        wait(lambda: robot.outputs["cliff_center"].has_subscribers)
        robot.set_pose((0.0, 0.0, 0.6))
        wait(lambda: any((event.sensor, event.state) == (1, 1) for event in cliffs))
        assert all(event.bottom > 0 for event in cliffs)
        core = first(graph, "/mobile_base/sensors/core", "kobuki_msgs/SensorState")
        assert core.time_stamp == core.header.stamp.to_nsec() // 1_000_000 % 65536
        assert (core.charger, core.wheel_drop, len(core.bottom)) == (core.DISCHARGING, 0, 3)
        send(graph, "/mobile_base/commands/motor_power", "kobuki_msgs/MotorPower", state=0)
        send(graph, "/mobile_base/commands/reset_odometry", "std_msgs/Empty")
        odometry = first(graph, "/odom", "nav_msgs/Odometry")
        assert odometry.pose.covariance[35] == 0.05
        assert first(graph, "/mobile_base/sensors/imu_data", "sensor_msgs/Imu")
        states = first(graph, "/joint_states", "sensor_msgs/JointState")
        assert (states.header.frame_id, list(states.name)) == ("base_link", ["joint0", "joint1"])


def test_a_kobuki_tells_of_bumps():
    wall = WALL.replace("1.1 0 0.5", "0.42 0 0.1").replace("0.2 4 2", "0.2 0.1 0.2")
    with running(kobuki(velocity_command_timeout="100"), wall, GROUND) as graph:
        bumps = graph.client.listen("/mobile_base/events/bumper", "kobuki_msgs/BumperEvent")
        wait(lambda: graph.sim.robots["base"].outputs["bumper_center"].has_subscribers)
        ahead = load_message("geometry_msgs/Vector3")(0.3, 0.0, 0.0)
        send(graph, "/mobile_base/commands/velocity", "geometry_msgs/Twist", linear=ahead)
        wait(lambda: any((event.bumper, event.state) == (1, 1) for event in bumps))


def test_a_lift_is_called_by_a_string():
    with running(LIFT) as graph:
        send(graph, "/elevator", "std_msgs/String", data="1")
        wait(lambda: graph.sim.robots["lift"].joints["up"].position > 2.8)
