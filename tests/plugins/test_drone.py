"""SJTU's quadrotor: what ``libplugin_drone.so`` makes of velocities, places, take-offs and landings."""

from __future__ import annotations

import numpy as np
import pytest
from models import block, plugin, simulate

import gazelle_ros as ros
from gazelle.bridges.conversions import ConversionContext, encoder_of
from gazelle.engines import Motion, Placement
from gazelle.plugins.drone import Drone, FlightPhase
from gazelle.plugins.filtered_pid import FilteredGains, FilteredPids
from gazelle.rotations import roll_pitch_yaw
from gazelle.simulation.values import Trigger

# As the original's own model has them.
TAGS = {
    "bodyName": "core",
    "rollpitchProportionalGain": 10.0,
    "rollpitchDifferentialGain": 5.0,
    "rollpitchLimit": 0.5,
    "yawProportionalGain": 2.0,
    "velocityXYProportionalGain": 5.0,
    "velocityXYDifferentialGain": 2.3,
    "velocityXYLimit": 2,
    "positionXYProportionalGain": 1.1,
    "positionXYDifferentialGain": 0.0,
    "positionZProportionalGain": 1.0,
    "positionZDifferentialGain": 0.2,
    "maxForce": 30,
}
NOISE = {"motionSmallNoise": 0.05, "motionDriftNoise": 0.03, "motionDriftNoiseTime": 5.0}


def flight(nworld=1, *, flying=True, ground=False, **tags):
    """Return a block under the plugin, in the air, and the plugin itself."""
    model = block(plugin=plugin("libplugin_drone.so", **{**TAGS, **tags}))
    sim = simulate(model, nworld=nworld, ground=ground, time_step=0.005)
    drone = next(each.plugin for each in sim.plugins if isinstance(each.plugin, Drone))
    if flying:
        drone.fly()
    return sim, sim.robots["cube"], drone


def test_topics_are_the_originals():
    sim, robot, _ = flight()
    with sim:
        assert {name: port.topic for name, port in robot.inputs.items()} == {
            "cmd_vel": "/cmd_vel",
            "takeoff": "/drone/takeoff",
            "land": "/drone/land",
            "posctrl": "/drone/posctrl",
            "vel_mode": "/drone/vel_mode",
        }
        assert {name: port.topic for name, port in robot.outputs.items()} == {
            f"gt_{name}": f"/drone/gt_{name}" for name in ("pose", "vel", "acc")
        }


def test_controllers_without_tags_have_the_originals_gains():
    assert FilteredGains() == FilteredGains(5.0, 1.0, 0.0, 0.0, -1.0)


def test_a_filtered_command_comes_in_with_its_time_constant():
    gains = FilteredGains(proportional=1.0, differential=0.0, time_constant=0.5)
    pids, acting = FilteredPids(gains, 1, 1), np.array([True])
    for _ in range(500):
        asked = pids.update(np.ones((1, 1)), np.zeros((1, 1)), 0.0, 0.001, acting)
    assert asked[0, 0] == pytest.approx(1.0 - np.exp(-1.0), abs=1e-3)


def test_a_controller_that_rests_forgets_nothing_and_learns_nothing():
    pids = FilteredPids(FilteredGains(integral=1.0), 2, 1)
    one, nought = np.ones((2, 1)), np.zeros((2, 1))
    pids.update(one, nought, 0.0, 0.1, np.array([True, False]))
    assert pids.state()["sum"].ravel().tolist() == pytest.approx([0.1, 0.0])


def test_it_rests_until_it_is_told_to_take_off():
    sim, robot, drone = flight(flying=False, ground=True)
    with sim:
        sim.run(0.2)
        robot.inputs["cmd_vel"].send(linear=np.array([[0.0, 0.0, 1.0]]))
        sim.run(0.2)
        assert robot.pose.z == pytest.approx(0.1, abs=1e-3)
        assert drone.phase.tolist() == [FlightPhase.LANDED]


def test_a_take_off_ends_after_half_a_second_and_the_drone_hovers():
    sim, robot, drone = flight(flying=False, ground=True)
    with sim:
        sim.run(0.1)
        robot.inputs["takeoff"].send(Trigger())
        sim.run(0.45)
        assert drone.phase.tolist() == [FlightPhase.TAKING_OFF]
        sim.run(0.1)
        assert drone.phase.tolist() == [FlightPhase.FLYING]
        sim.run(1.5)
        height = robot.pose.z
        assert height > 0.5
        sim.run(0.5)
        assert robot.pose.z == pytest.approx(height, abs=0.1)
        robot.inputs["land"].send(Trigger())
        sim.run(1.1)
        assert drone.phase.tolist() == [FlightPhase.LANDED]
        sim.run(0.6)
        assert robot.pose.z == pytest.approx(0.1, abs=0.01)


def test_what_flies_cannot_take_off_and_what_stands_cannot_land():
    sim, robot, drone = flight(2)
    with sim:
        drone.reset(np.array([1]))
        robot.inputs["takeoff"].send(Trigger(), np.array([0]))
        robot.inputs["land"].send(Trigger(), np.array([1]))
        assert drone.phase.tolist() == [FlightPhase.FLYING, FlightPhase.LANDED]


@pytest.mark.parametrize("velocity", [(0.5, 0.0), (0.0, -0.5), (3.0, 0.0)])
def test_it_reaches_the_velocity_it_is_told_in_its_own_heading(velocity):
    sim, robot, _ = flight()
    with sim:
        robot.set_pose((0.0, 0.0, 5.0), yaw=np.pi / 2.0)
        robot.inputs["cmd_vel"].send(np.array([[*velocity, 0.0]]))
        sim.run(3.0)
        ahead, aside = np.clip(velocity, -2.0, 2.0)  # the limit of the tags
        assert robot.motion().linear[0, :2] == pytest.approx([-aside, ahead], abs=0.08)


def test_its_velocity_upwards_settles_as_a_first_order_lag():
    """5 (wanted - v) - a, of the step before: half of the former on average, so 0.4 s."""
    sim, robot, _ = flight()
    with sim:
        robot.inputs["cmd_vel"].send(np.array([[0.0, 0.0, 0.3]]))
        start = robot.pose.z
        sim.run(2.0)
        assert robot.pose.z - start == pytest.approx(0.3 * (2.0 - 0.4), abs=0.06)


def test_it_turns_at_the_rate_that_it_is_told():
    sim, robot, _ = flight(yawDifferentialGain=0.0)
    with sim:
        robot.inputs["cmd_vel"].send(0.0, 0.4)
        sim.run(2.0)
        # A torque of 2 (0.4 - rate) on an inertia of one: a lag of half a second.
        assert robot.motion().angular[0, 2] == pytest.approx(0.4 * (1 - np.exp(-4.0)), abs=5e-3)


def test_it_flies_to_a_place():
    sim, robot, _ = flight()
    with sim:
        robot.inputs["posctrl"].send(True)
        robot.inputs["cmd_vel"].send(np.array([[0.2, -0.4, 1.0]]))
        sim.run(4.0)
        assert robot.placement().position[0] == pytest.approx([0.2, -0.4, 1.0], abs=0.1)


def test_told_a_place_it_does_not_take_off():
    sim, robot, drone = flight(flying=False, ground=True)
    with sim:
        robot.inputs["posctrl"].send(True)
        robot.inputs["takeoff"].send(Trigger())
        sim.run(0.4)
        assert drone.phase.tolist() == [FlightPhase.TAKING_OFF]
        assert robot.pose.z < 0.4


def test_while_it_takes_off_it_tilts_as_it_is_told():
    sim, robot, _ = flight(flying=False)
    with sim:
        robot.inputs["takeoff"].send(Trigger())
        robot.inputs["cmd_vel"].send(0.0, np.array([[0.2, 0.0, 0.0]]))
        sim.run(0.45)
        roll = roll_pitch_yaw(robot.placement().quaternion)[0, 0]
        assert 0.05 < roll < 0.2


def test_thrust_is_at_most_the_largest_force():
    sim, robot, _ = flight(maxForce=5.0)
    with sim:
        sim.run(0.5)  # 1 kg
        assert robot.motion().linear[0, 2] < 0.5 * -(9.8 - 5.0) + 0.01


def test_commands_come_with_noise_within_its_bounds_and_its_drift_stays():
    sim, robot, _ = flight(64, **NOISE | {"motionDriftNoiseTime": 0.05})
    with sim:
        port = robot.inputs["cmd_vel"]
        seen = []
        for _ in range(9):
            port.send(np.zeros((64, 3)), 0.0)
            seen.append(np.column_stack((port.linear[:, 2], port.angular)))
            assert not port.linear[:, :2].any()
            sim.run(0.01)
        early, late = np.abs(seen[:6]), np.abs(seen[7:])
        assert early.max() < 0.05  # no drift yet
        assert early.max() > 0.049
        assert 0.05 < late.max() < 0.08


def test_noise_of_a_world_does_not_depend_on_others():
    def heard(nworld, row):
        sim, robot, _ = flight(nworld, **NOISE)
        with sim:
            robot.inputs["cmd_vel"].send(np.zeros((nworld, 3)), 0.0)
            return robot.inputs["cmd_vel"].linear[row].copy()

    np.testing.assert_array_equal(heard(2, 1), heard(5, 1))
    assert (heard(2, 0) != heard(2, 1)).any()


def test_reset_and_snapshots_give_the_same_flight_again():
    sim, robot, drone = flight(2, **NOISE)
    with sim:

        def fly():
            for speed in (0.5, -0.5):
                robot.inputs["cmd_vel"].send(np.array([[speed, 0.0, 0.2]] * 2), 0.1)
                sim.run(0.2)
            return robot.placement().position

        first = fly()
        kept = sim.snapshot()
        after = fly()
        sim.restore(kept)
        np.testing.assert_array_equal(fly(), after)
        sim.reset()
        assert drone.phase.tolist() == [FlightPhase.LANDED] * 2
        drone.fly()
        np.testing.assert_array_equal(fly(), first)


def test_it_tells_the_truth_of_its_pose_and_its_velocity_turned():
    sim, robot, _ = flight()
    with sim:
        poses, speeds = [], []
        robot.outputs["gt_pose"].subscribe(poses.append)
        robot.outputs["gt_vel"].subscribe(speeds.append)
        robot.set_pose((0.0, 0.0, 2.0), yaw=np.pi / 2.0)
        robot.set_twist((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        sim.step()
        assert poses[0].position[0] == pytest.approx([0.0, 0.0, 2.0])
        assert speeds[0].linear[0] == pytest.approx([0.0, 1.0, 0.0], abs=1e-6)
        assert not speeds[0].angular.any()


def test_poses_and_velocities_become_messages_without_stamps():
    place = Placement(np.array([[1.0, 2.0, 3.0]]), np.array([[0.0, 0.0, 1.0, 0.0]]))
    motion = Motion(np.array([[4.0, 5.0, 6.0]]), np.zeros((1, 3)))
    view = ConversionContext("", 0, lambda _stamp: None)
    for value, kind in ((place, "geometry_msgs/Pose"), (motion, "geometry_msgs/Twist")):
        encoder = encoder_of(type(value))
        assert encoder.message == kind
        message = ros.load_message(kind)()
        encoder.fill(message, value, view)
        told = message.position if value is place else message.linear
        wanted = value.position if value is place else value.linear
        assert (told.x, told.y, told.z) == tuple(wanted[0])


SENSORS = """<sensor name="eye" type="sonar"><pose>0.5 0 0.3 0 1.5707963 3.14159265</pose>
<update_rate>100</update_rate><sonar><min>0</min><max>5</max><radius>1.34</radius></sonar>
<plugin name="s" filename="libplugin_ros_sonar.so"/></sensor>
<sensor name="turns" type="imu"><update_rate>100</update_rate>
<plugin name="i" filename="libplugin_ros_imu.so"/></sensor>"""
WALL = """<model name="wall"><static>1</static><link name="l"><collision name="c">
<pose>3 0 0 0 0 0</pose><geometry><box><size>1 8 8</size></box></geometry></collision></link></model>"""


def test_its_sensors_publish_what_they_measure():
    model = block(SENSORS, plugin("libplugin_drone.so", **TAGS))
    with simulate(model, WALL, ground=False) as sim:
        robot = sim.robots["cube"]
        heard = {"sonar": [], "imu": []}
        for name, values in heard.items():
            robot.outputs[name].subscribe(values.append)
            assert robot.outputs[name].topic == f"/drone/{name}"
            assert robot.outputs[name].frame == "drone_link"
        sim.run(0.05)
        assert heard["sonar"][0].distance[0] == pytest.approx(2.0, abs=1e-6)
        assert (heard["sonar"][0].least, heard["sonar"][0].most) == (0.0, 5.0)
        assert len(heard["imu"]) == len(heard["sonar"])
