"""Hector's sensors: IMU, GPS, magnetometer, barometer, and how they err."""

import math

import numpy as np
import pytest
from models import block, plugin, simulate

from gazelle.errors import PluginWarning
from gazelle.simulation.values import Bias, GeoReference, MagneticValue


def cube(filename, nworld=1, *, gravity=False, **tags):
    model = block(plugin=plugin(filename, bodyName="core", **tags), gravity=gravity)
    return simulate(model, ground=False, nworld=nworld)


IMU = "libhector_gazebo_ros_imu.so"


def test_an_imu_measures_turning_and_gravity_in_its_body():
    with cube(IMU, accelOffset="0.1 0.2 0.3", rateOffset="0.5") as sim:
        robot = sim.robots["cube"]
        robot.set_twist((0.0, 0.0, 0.0), (0.0, 0.0, 0.3))
        sim.step()
        reading = robot.outputs["imu"].last.reading
        assert reading.angular_velocity[0] == pytest.approx([0.5, 0.5, 0.8], abs=1e-6)
        assert reading.linear_acceleration[0] == pytest.approx([0.1, 0.2, 10.1], abs=0.02)
        assert robot.outputs["imu"].topic == "/imu"
        assert robot.outputs["imu/bias"].last.angular_velocity[0] == pytest.approx([0.5] * 3)


def test_an_imus_noise_and_variance_are_those_of_its_file():
    with cube(IMU, nworld=400, gaussianNoise="0.05", yawGaussianNoise="0.02") as sim:
        value = sim.robots["cube"].outputs["imu"].last
        assert value.reading.angular_velocity.std() == pytest.approx(0.05, rel=0.1)
        assert value.rate_variance == pytest.approx([0.0025] * 3)
        level = (0.05 / 9.8) ** 2
        assert value.orientation_variance == pytest.approx([level, level, 4e-4], rel=1e-3)


def test_biases_of_an_imu_mislead_its_orientation():
    tags = {"accelOffset": "0.98 0 0", "yawOffset": "0.2", "rateOffset": "0.1 0 0"}
    with cube(IMU, nworld=2, rateGaussianNoise="0.3", **tags) as sim:
        robot = sim.robots["cube"]
        wrong = robot.outputs["imu/bias"].last
        # What seems to pull to x looks like a pitch down of a tenth, and the heading is off.
        pitched = math.atan(0.05)
        assert wrong.orientation[0] == pytest.approx(
            [
                math.sin(0.1) * math.sin(pitched),
                -math.cos(0.1) * math.sin(pitched),
                math.sin(0.1) * math.cos(pitched),
                math.cos(0.1) * math.cos(pitched),
            ],
            abs=1e-6,
        )
        # Biases have no noise.
        assert wrong.angular_velocity == pytest.approx(np.tile([0.1, 0.0, 0.0], (2, 1)))
        turned = robot.outputs["imu"].last.reading.orientation
        assert turned == pytest.approx(wrong.orientation)


def test_without_gravity_an_imu_does_not_know_what_is_level():
    with cube(IMU, accelOffset="1 0 0", accelGaussianNoise="0.1") as sim:
        sim.physics.gravity = (0.0, 0.0, 0.0)
        value = sim.robots["cube"].outputs["imu"].last
        assert value.orientation_variance == pytest.approx([-1.0, -1.0, 0.0])
        assert value.reading.orientation[0] == pytest.approx([0.0, 0.0, 0.0, 1.0])


def test_an_imus_bias_is_set_and_calibrated_away():
    with cube(IMU, nworld=2) as sim:
        robot = sim.robots["cube"]
        robot.services["imu/set_rate_bias"].call(Bias((0.1, 0.0, 0.0)), np.array([1]))
        robot.services["imu/set_accel_bias"].call(Bias((0.0, 1.0, 0.0)))
        reading = robot.outputs["imu"].last.reading
        assert reading.angular_velocity[:, 0] == pytest.approx([0.0, 0.1])
        assert reading.linear_acceleration[:, 1] == pytest.approx([1.0, 1.0])
        robot.services["imu/calibrate"].call(None)
        assert robot.outputs["imu"].last.reading.angular_velocity == pytest.approx(0.0)
        assert robot.services["imu/calibrate"].topic == "/imu/calibrate"
        sim.reset()
        assert robot.outputs["imu"].last.reading.linear_acceleration[:, 1] == pytest.approx(0.0)


@pytest.mark.long
def test_drift_begins_somewhere_and_a_snapshot_keeps_it():
    with cube(IMU, nworld=400, rateDrift="0.5", rateDriftFrequency="1.0", updateRate="50") as sim:
        output = sim.robots["cube"].outputs["imu"]
        heard = []
        output.subscribe(heard.append)
        sim.step()
        first = heard[0].reading.angular_velocity
        assert first.std() == pytest.approx(0.5, rel=0.1)
        sim.run(seconds=2.0)
        assert len(heard) == pytest.approx(100, abs=1)
        rates = heard[-1].reading.angular_velocity
        # Taken up: interval sqrt(2 f) drift / sqrt(1 - exp(-2 f interval)); left of the beginning:
        # drift exp(-f time).
        taken = 0.02 * math.sqrt(2.0) * 0.5 / math.sqrt(1.0 - math.exp(-0.04))
        left = 0.5 * math.exp(-2.0)
        assert rates.std() == pytest.approx(math.hypot(taken, left), rel=0.1)
        state = sim.snapshot()
        sim.run(seconds=0.1)
        expected = heard[-1].reading.angular_velocity
        sim.restore(state)
        sim.run(seconds=0.1)
        assert heard[-1].reading.angular_velocity == pytest.approx(expected)
        sim.reset()
        sim.step()
        assert heard[-1].reading.angular_velocity == pytest.approx(first)


def test_the_errors_of_an_imu_can_be_tuned():
    with cube(IMU, nworld=2, rateOffset="0.1 0.2 0.3", accelGaussianNoise="0.5") as sim:
        robot = sim.robots["cube"]
        assert {name: each.topic for name, each in robot.tunings.items()} == {
            f"imu/{part}": f"/imu/{part}" for part in ("accel", "rate", "yaw")
        }
        rate = robot.tunings["imu/rate"]
        assert rate.values["offset"] == pytest.approx(0.2)
        assert rate.values["drift_frequency"] == pytest.approx(1.0 / 3600.0)
        state = sim.snapshot()
        rate.send(scale_error=0.5)
        robot.set_twist((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
        sim.step()
        rates = robot.outputs["imu"].last.reading.angular_velocity
        # The axes keep what nobody changed.
        assert rates[1] == pytest.approx([0.1, 0.2, 0.8], abs=1e-6)
        assert rate.send(offset=-50.0)["offset"] == -10.0
        assert robot.outputs["imu"].last.acceleration_variance == pytest.approx([0.25] * 3)
        robot.tunings["imu/accel"].send(gaussian_noise=0.0)
        assert robot.outputs["imu"].last.acceleration_variance == pytest.approx([0.0] * 3)
        sim.restore(state)
        assert rate.values["offset"] == pytest.approx(0.2)


GPS = "libhector_gazebo_ros_gps.so"
MAGNETIC = "libhector_gazebo_ros_magnetic.so"


def test_a_gps_counts_from_its_reference():
    with cube(GPS) as sim:
        robot = sim.robots["cube"]
        robot.set_pose((111.2, -100.0, 7.0))
        fix = robot.outputs["fix"].last
        # A degree of latitude at 49.9 north is 111.23 km, one of longitude 71.85 km.
        assert fix.latitude[0] == pytest.approx(49.9 + 0.1112 / 111.23, abs=1e-7)
        assert fix.longitude[0] == pytest.approx(8.9 + 0.1 / 71.85, abs=1e-6)
        assert fix.altitude[0] == pytest.approx(7.0)
        assert (robot.outputs["fix"].topic, robot.outputs["fix"].frame) == ("/fix", "/world")


def test_a_gps_turns_with_its_heading_and_tells_its_velocity():
    with cube(GPS, nworld=2, referenceHeading="90", velocityOffset="0 0 0.5") as sim:
        robot = sim.robots["cube"]
        robot.set_twist((1.0, 2.0, 0.0), (0.0, 0.0, 0.0))
        velocity = robot.outputs["fix_velocity"].last.values
        assert velocity[0] == pytest.approx([2.0, -1.0, 0.5], abs=1e-6)


def test_a_gps_is_given_another_reference():
    with cube(GPS, nworld=2) as sim:
        robot = sim.robots["cube"]
        service = robot.services["fix/set_reference_geopose"]
        service.call(GeoReference(10.0, 20.0, 30.0, 0.0), np.array([1]))
        fix = robot.outputs["fix"].last
        assert fix.latitude == pytest.approx([49.9, 10.0])
        assert fix.longitude == pytest.approx([8.9, 20.0])


def test_the_drift_of_a_gps_velocity_moves_its_position():
    with cube(GPS, velocityDrift="0.3", updateRate="100") as sim:
        robot = sim.robots["cube"]
        heard, speeds = [], []
        robot.outputs["fix"].subscribe(heard.append)
        robot.outputs["fix_velocity"].subscribe(speeds.append)
        sim.run(seconds=1.0)
        north = (heard[-1].latitude - heard[0].latitude)[0] * 111230.0
        # The velocity hardly drifts in a second, so that it adds up to itself.
        assert abs(speeds[0].values[0, 0]) > 1e-3
        assert north == pytest.approx(speeds[0].values[0, 0], rel=0.15)


def test_a_gps_says_of_itself_what_it_is_tuned_to():
    with cube(GPS, status="1", service="3") as sim:
        robot = sim.robots["cube"]
        status = robot.tunings["fix/status"]
        assert status.topic == "/fix/status"
        assert {name for name, on in status.values.items() if on} == {
            "STATUS_FIX",
            "STATUS_SBAS_FIX",
            "SERVICE_GPS",
            "SERVICE_GLONASS",
        }
        state = sim.snapshot()
        status.send(STATUS_GBAS_FIX=True, SERVICE_GALILEO=True)
        assert (robot.outputs["fix"].last.status, robot.outputs["fix"].last.service) == (3, 11)
        status.send(STATUS_FIX=False)
        assert robot.outputs["fix"].last.status == -1
        sim.restore(state)
        assert robot.outputs["fix"].last.status == 1
        robot.tunings["fix/position"].send(offset=2.0)
        assert robot.outputs["fix"].last.altitude[0] == pytest.approx(2.5)
        assert {"fix/position", "fix/velocity"} < set(robot.tunings)


WORLD = """<spherical_coordinates><surface_model>EARTH_WGS84</surface_model>
<latitude_deg>10</latitude_deg><longitude_deg>20</longitude_deg><elevation>30</elevation>
<heading_deg>0</heading_deg></spherical_coordinates>"""


def on_earth(filename, **tags):
    tags = {"bodyName": "core", "useWorldSphericalCoordinates": "true", **tags}
    return simulate(WORLD, block(plugin=plugin(filename, **tags), gravity=False), ground=False)


def test_a_gps_may_stand_where_the_world_does():
    with on_earth(GPS, referenceAltitude="5") as sim:
        robot = sim.robots["cube"]
        robot.set_pose((110.57, 0.0, 0.0))
        robot.set_twist((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        fix = robot.outputs["fix"].last
        # The world's x axis points east there, and tags count more.
        assert fix.latitude[0] == pytest.approx(10.0, abs=1e-7)
        assert fix.longitude[0] > 20.0005
        assert fix.altitude[0] == pytest.approx(5.0)
        velocity = robot.outputs["fix_velocity"].last.values[0]
        assert velocity == pytest.approx([0.0, -1.0, 0.0], abs=1e-9)


def test_a_magnetometer_may_take_the_worlds_heading():
    with on_earth(MAGNETIC) as sim:
        # North is along y.
        values = sim.robots["cube"].outputs["magnetic"].last.values[0]
        assert values[:2] == pytest.approx([0.0, 0.5], abs=1e-9)


def test_a_gps_publishes_four_times_a_second():
    with cube(GPS) as sim:
        heard = []
        sim.robots["cube"].outputs["fix"].subscribe(heard.append)
        sim.run(seconds=2.0)
        assert len(heard) == pytest.approx(8, abs=1)


def test_the_earths_field_is_felt_in_the_body():
    with cube(MAGNETIC, magnitude="2.0", inclination="60", offset="0 0 0.1") as sim:
        robot = sim.robots["cube"]
        down = -2.0 * math.sin(math.radians(60.0)) + 0.1
        value = robot.outputs["magnetic"].last
        assert not isinstance(value, MagneticValue)
        assert value.values[0] == pytest.approx([1.0, 0.0, down])
        robot.set_pose((0.0, 0.0, 0.5), yaw=math.pi / 2)
        assert robot.outputs["magnetic"].last.values[0] == pytest.approx([0.0, -1.0, down])
        assert robot.outputs["magnetic"].frame == "core"


def test_the_field_comes_as_the_message_that_is_asked_for():
    with cube(
        MAGNETIC, useMagneticFieldMsgs="true", declination="90", referenceHeading="90"
    ) as sim:
        output = sim.robots["cube"].outputs["magnetic"]
        assert output.kind is MagneticValue
        assert output.last.values[0, 0] == pytest.approx(0.5)


def test_a_barometer_tells_height():
    with cube("libhector_gazebo_ros_baro.so", nworld=2, offset="0.5", frameId="baro") as sim:
        robot = sim.robots["cube"]
        robot.set_pose([[0.0, 0.0, 1.0], [0.0, 0.0, 2.0]])
        output = robot.outputs["pressure_height"]
        assert output.last.values[:, 2] == pytest.approx([1.5, 2.5])
        assert output.frame == "baro"


def test_a_barometer_tells_altitude_and_pressure():
    tags = {"elevation": "100", "qnh": "1000", "altimeterTopicName": "height/air"}
    with cube("libhector_gazebo_ros_baro.so", nworld=2, gaussianNoise="0.1", **tags) as sim:
        robot = sim.robots["cube"]
        robot.set_pose([[0.0, 0.0, 0.0], [0.0, 0.0, 1000.0]])
        output = robot.outputs["height/air"]
        assert (output.topic, output.queue_size) == ("/height/air", 10)
        value = output.last
        assert value.altitude == pytest.approx([100.0, 1100.0], abs=1.0)
        # The standard atmosphere: 988.2 hPa and 876.0 hPa for 1000 hPa at the sea.
        assert value.pressure == pytest.approx([988.2, 876.0], abs=0.3)
        assert value.sea_level == 1000.0
        both = {}
        robot.outputs["pressure_height"].subscribe(lambda v: both.update(height=v))
        output.subscribe(lambda v: both.update(altitude=v))
        sim.step()
        # Both are made of one measurement.
        assert both["altitude"].altitude - 100.0 == pytest.approx(both["height"].values[:, 2])


def test_magnetometers_are_tuned_beside_their_topic():
    with cube(MAGNETIC) as sim:
        robot = sim.robots["cube"]
        robot.tunings["magnetic"].send(offset=0.25)
        assert robot.tunings["magnetic"].topic == "/magnetic"
        assert robot.outputs["magnetic"].last.values[0, 1] == pytest.approx(0.25)


def test_errors_have_one_number_or_one_an_axis():
    with pytest.raises(PluginWarning, match="accelDrift"):
        cube(IMU, accelDrift="1 2")
