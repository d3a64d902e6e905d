"""Point clouds from lidars, and Hector's sonar."""

import numpy as np
import pytest
from models import block, plugin, simulate

from gazelle.errors import PluginWarning

RAYS = """<sensor name="eye" type="ray"><pose>0.2 0 0 0 0 0</pose><update_rate>20</update_rate>
<ray><scan><horizontal><samples>5</samples><min_angle>-0.4</min_angle><max_angle>0.4</max_angle>
</horizontal><vertical><samples>3</samples><min_angle>-0.1</min_angle><max_angle>0.1</max_angle>
</vertical></scan><range><min>0.05</min><max>{most}</max></range></ray>{plugin}</sensor>"""
WALL = """<model name="wall"><static>1</static><pose>1.1 0 0.5 0 0 0</pose><link name="l">
<collision name="c"><geometry><box><size>0.2 4 2</size></box></geometry></collision></link></model>"""


def watching(filename, most=2.0, nworld=1, **tags):
    rays = RAYS.format(plugin=plugin(filename, **tags), most=most)
    return simulate(block(rays, gravity=False), WALL, ground=False, nworld=nworld)


VELODYNES = ["libgazebo_ros_velodyne_laser.so", "libgazebo_ros_velodyne_gpu_laser.so"]


@pytest.mark.parametrize("filename", VELODYNES)
def test_a_velodynes_points_lie_on_what_it_sees(filename):
    with watching(filename, nworld=2, topicName="/points", frameName="velo") as sim:
        output = sim.robots["cube"].outputs["points"]
        value = output.last
        assert (output.topic, output.frame) == ("/points", "velo")
        assert value.kept.all()
        # The wall is 0.8 m before the sensor, in the sensor's own frame.
        assert value.points[..., 0] == pytest.approx(0.8, abs=1e-6)
        assert value.points.shape == (2, 15, 3)
        assert value.rings.tolist() == [0] * 5 + [1] * 5 + [2] * 5
        assert value.points[0, :5, 2] == pytest.approx(value.points[0, 0, 2], abs=0.01)
        assert value.points[0, 0, 1] < 0.0 < value.points[0, 4, 1]


def test_a_velodyne_leaves_out_what_it_does_not_see_and_what_the_file_says():
    with watching(VELODYNES[0], most=0.82) as sim:
        assert sim.robots["cube"].outputs["points"].last.kept.sum() == 5
    with watching(VELODYNES[0], max_range="0.85") as sim:
        assert sim.robots["cube"].outputs["points"].last.kept.sum() == 9
    with watching(VELODYNES[0], min_intensity="5") as sim:
        assert not sim.robots["cube"].outputs["points"].last.kept.any()


def test_a_block_laser_tells_all_rays():
    with watching("libgazebo_ros_block_laser.so", most=0.82, topicName="cloud") as sim:
        output = sim.robots["cube"].outputs["cloud"]
        value = output.last
        assert output.topic == "/cloud"
        assert value.kept.all()
        assert (value.intensities == 0.0).all()
        length = np.linalg.norm(value.points[0], axis=1)
        assert length.max() == pytest.approx(0.82)


def test_a_block_lasers_noise_spares_what_is_out_of_reach():
    with watching(
        "libgazebo_ros_block_laser.so", most=0.82, nworld=300, gaussianNoise="0.02"
    ) as sim:
        points = sim.robots["cube"].outputs["world"].last.points
        assert np.linalg.norm(points[:, 0], axis=1) == pytest.approx(0.82)
        assert points[:, 7].std(axis=0) == pytest.approx([0.02] * 3, rel=0.15)


def test_a_block_lasers_own_rate_has_no_effect():
    with watching("libgazebo_ros_block_laser.so", updateRate="5") as sim:
        heard = []
        sim.robots["cube"].outputs["world"].subscribe(heard.append)
        sim.run(seconds=1.0)
        assert len(heard) == pytest.approx(20, abs=1)


def test_points_come_at_the_sensors_rate():
    with watching(VELODYNES[0]) as sim:
        heard = []
        sim.robots["cube"].outputs["points"].subscribe(heard.append)
        sim.run(seconds=1.0)
        assert len(heard) == pytest.approx(20, abs=1)


def test_a_sonar_gives_the_nearest_and_its_field_of_view():
    with watching("libhector_gazebo_ros_sonar.so", offset="0.1") as sim:
        output = sim.robots["cube"].outputs["sonar"]
        value = output.last
        assert (output.topic, output.frame) == ("/sonar", "/sonar_link")
        assert value.distance[0] == pytest.approx(0.9, abs=1e-6)
        assert value.field_of_view == pytest.approx(0.2)
        assert value.ultrasound
        heard = []
        output.subscribe(heard.append)
        sim.run(seconds=1.0)
        assert len(heard) == pytest.approx(10, abs=1)


def test_a_sonar_that_sees_nothing_gives_its_reach():
    with watching("libhector_gazebo_ros_sonar.so", most=0.5, gaussianNoise="0.01") as sim:
        assert sim.robots["cube"].outputs["sonar"].last.distance[0] == 0.5


@pytest.mark.parametrize(
    ("filename", "on", "wanted"),
    [
        ("libgazebo_ros_laser.so", "imu", "ray or gpu_ray"),
        (VELODYNES[0], "imu", "ray or gpu_ray"),
        ("libgazebo_ros_block_laser.so", "contact", "ray or gpu_ray"),
        ("libgazebo_ros_range.so", "imu", "ray or gpu_ray"),
        ("libhector_gazebo_ros_sonar.so", "imu", "ray or gpu_ray"),
        ("libgazebo_ros_imu_sensor.so", "contact", "imu"),
        ("libgazebo_ros_bumper.so", "imu", "contact"),
    ],
)
def test_a_plugin_of_another_kind_of_sensor_is_named(filename, on, wanted):
    sensor = f'<sensor name="s" type="{on}">{plugin(filename)}</sensor>'
    text = f"needs a sensor of type {wanted}; 'cube::core::s' is of type '{on}'"
    with pytest.warns(PluginWarning, match=text):
        sim = simulate(block(sensor), ground=False)
    with sim:
        sim.run(seconds=0.1)
        assert not sim.robots["cube"].outputs
