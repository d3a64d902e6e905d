"""Sensor blocks mean the same in the description and in the file."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.builders import (
    BuildError,
    add_sensor,
    camera,
    contact_sensor,
    depth_camera,
    gps,
    imu,
    lidar,
    plugin,
)
from gazelle.builders.elements import element, group, text_of
from gazelle.description import Pose
from gazelle.formats import load_model_string, xml
from gazelle.formats.write.xml import fragment
from gazelle.sensors import Gps

URDF = """<robot name="r"><link name="base"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"""

EVERY = [
    camera(noise=0.01, topic="eye", pose=Pose(0.1, 0.2, 0.3, 0.4, 0.5, 0.6)),
    depth_camera(topic="depth"),
    lidar(noise=0.01, topic="scan", frame="scan_link", rows=16, min_elevation=-0.3,
          max_elevation=0.3, resolution=0.01, quantized=True),
    imu(rate_noise=0.001, accel_noise=0.01, rate_bias=0.002, accel_bias=0.02, topic="imu"),
    gps(horizontal_noise=1.5, vertical_noise=3.0, velocity_noise=0.1),
    contact_sensor("base_collision"),
]  # fmt: skip


@pytest.mark.parametrize("sensor", EVERY, ids=lambda s: s.name)
def test_a_sensor_written_into_a_file_is_the_same(sensor):
    model = load_model_string(add_sensor(URDF, "base", sensor))
    assert model.links[0].sensors == (sensor,)


def test_a_lidar_has_the_figures_asked_for():
    found = lidar(samples=24, min_angle=0.0, max_angle=6.28, range_max=3.5, noise=0.01).lidar
    assert (found.horizontal.samples, found.vertical.samples) == (24, 1)
    assert (found.horizontal.min_angle, found.horizontal.max_angle) == (0.0, 6.28)
    assert (found.range_min, found.range_max) == (0.12, 3.5)
    assert (found.noise.type, found.noise.stddev) == ("gaussian", 0.01)


def test_a_camera_has_the_figures_asked_for():
    (found,) = camera(width=320, height=200, horizontal_fov=1.2, near=0.2, far=9.0).cameras
    assert (found.width, found.height, found.format) == (320, 200, "R8G8B8")
    assert (found.horizontal_fov, found.near, found.far) == (1.2, 0.2, 9.0)
    assert depth_camera().type == "depth"


def test_an_imu_has_the_noise_asked_for():
    found = imu(rate_noise=0.1, rate_bias=0.3, accel_noise=0.2).imu
    assert [noise.stddev for noise in found.angular_velocity] == [0.1] * 3
    assert [noise.bias_stddev for noise in found.angular_velocity] == [0.3] * 3
    assert [noise.stddev for noise in found.linear_acceleration] == [0.2] * 3
    assert imu().imu.angular_velocity[0].type == "none"


def test_gps_noise_is_in_metres_as_gazebo_reads_it():
    found = Gps.read(gps(horizontal_noise=1.5, vertical_noise=3.0).settings)
    assert (found.horizontal.stddev, found.vertical.stddev) == (1.5, 3.0)


def test_a_topic_brings_gazebos_plugin():
    assert lidar().plugins == ()
    (found,) = lidar(topic="scan", frame="base_scan").plugins
    assert found.filename == "libgazebo_ros_laser.so"
    assert found.parameters.get("topicName", "") == "scan"
    assert found.parameters.get("frameName", "") == "base_scan"


@pytest.mark.parametrize(
    "make",
    [
        lambda: lidar(""),
        lambda: lidar(update_rate=0.0),
        lambda: lidar(samples=0),
        lambda: lidar(range_min=2.0, range_max=1.0),
        lambda: lidar(noise=-1.0),
        lambda: lidar(min_angle=1.0, max_angle=0.0),
        lambda: lidar(range_max=math.inf),
        lambda: camera(horizontal_fov=4.0),
        lambda: camera(width=1.5),
        lambda: camera(far=0.0),
        lambda: imu(rate_noise=math.nan),
        lambda: contact_sensor(""),
    ],
)
def test_impossible_sensors_are_refused(make):
    with pytest.raises(BuildError):
        make()


def test_a_plugin_has_its_tags():
    found = plugin("drive", "libgazebo_ros_diff_drive.so", wheelSeparation=0.3, publishTf=True)
    assert found.parameters.get("wheelSeparation", 0.0) == 0.3
    assert found.parameters.get("publishTf", default=False) is True


@given(st.text("<>&\"'ab cé", max_size=20), st.floats(allow_nan=False, allow_infinity=False))
def test_elements_come_back_from_their_text(text, number):
    node = element("a", None, element("b", text.strip()), group("c", d=number),
                   attributes={"e": text})  # fmt: skip
    again = xml.parse(fragment(node, "  "), name="test")
    assert again.attributes["e"] == text
    assert again.find("b").text == text.strip()
    assert again.find("c").require("d", float) == number


def test_values_are_written_as_files_have_them():
    assert text_of(value=True) == "true"
    assert text_of(3) == "3"
    assert text_of(3.0) == "3"
    assert text_of((1.0, 0.5)) == "1 0.5"
    assert text_of(Pose(1.0, yaw=0.5)) == "1 0 0 0 0 0.5"
    with pytest.raises(BuildError, match="not a number"):
        text_of(math.nan)


poses = st.floats(-3.0, 3.0)


@settings(max_examples=40, deadline=None)
@given(poses, poses, poses, poses, st.floats(-1.5, 1.5), poses)
def test_a_sensor_stands_where_it_is_put(x, y, z, roll, pitch, yaw):
    pose = Pose(x, y, z, roll, pitch, yaw)
    assert imu(pose=pose).pose.is_close(pose, position=1e-12, angle=1e-7)
