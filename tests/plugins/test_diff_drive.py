"""The differential drive against its rules."""

import numpy as np
import pytest
import scenes

from gazelle.errors import PluginWarning, SimulationError
from gazelle.plugins.odometry import TrueOdometry
from gazelle.simulation import Simulation


def drive(**tags):
    sim = Simulation(scenes.world(scenes.ground(), scenes.burger(**tags)))
    return sim, sim.robots["burger"]


def test_wheels_turn_at_the_commanded_speeds():
    sim, robot = drive()
    robot.inputs["cmd_vel"].send(linear=0.15, angular=0.5)
    sim.run(1.0)
    left, right = (robot.joints[f"wheel_{s}_joint"].velocity * 0.033 for s in ("left", "right"))
    assert left == pytest.approx(0.15 - 0.5 * 0.08, rel=1e-3)
    assert right == pytest.approx(0.15 + 0.5 * 0.08, rel=1e-3)


def test_the_last_command_holds_for_ever():
    sim, robot = drive()
    robot.inputs["cmd_vel"].send(linear=0.1)
    sim.run(5.0)
    assert robot.twist.linear[0] == pytest.approx(0.1, rel=0.05)


def test_the_ramp_limits_the_wheel_acceleration():
    sim, robot = drive(wheelAcceleration=0.5, updateRate=100)
    robot.inputs["cmd_vel"].send(linear=0.2)
    sim.run(0.2)
    speed = robot.joints["wheel_left_joint"].velocity * 0.033
    assert speed == pytest.approx(0.5 * 0.2, abs=0.011)


def test_world_odometry_is_the_true_pose_and_the_twist_is_in_the_base_frame():
    sim, robot = drive()
    robot.inputs["cmd_vel"].send(linear=0.1, angular=0.8)
    sim.run(2.0)
    odometry = robot.outputs["odom"].last
    assert (odometry.frame, odometry.child_frame) == ("odom", "base_footprint")
    np.testing.assert_array_equal(odometry.position, robot.position)
    assert odometry.linear[0, 0] == pytest.approx(0.1, rel=0.1)
    assert odometry.angular[0, 2] == pytest.approx(0.8, rel=0.1)


def test_encoder_odometry_adds_up_the_wheels_and_never_reports_backwards():
    sim, robot = drive(odometrySource="encoder")
    robot.inputs["cmd_vel"].send(linear=-0.2, angular=0.0)
    sim.run(2.0)
    odometry = robot.outputs["odom"].last
    assert odometry.position[0, 0] == pytest.approx(-0.2 * 1.9, abs=0.02)
    assert odometry.linear[0, 0] == pytest.approx(0.2, rel=0.05)
    sim.reset()
    np.testing.assert_array_equal(robot.outputs["odom"].last.position, 0.0)


def test_odometry_is_published_at_the_update_rate_and_only_when_heard():
    sim, robot = drive(updateRate=30)
    seen = []
    robot.outputs["odom"].subscribe(lambda value: seen.append(value.stamp))
    sim.run(1.0)
    assert len(seen) == 30
    assert robot.outputs["joint_states"].last.names == ("wheel_right_joint", "wheel_left_joint")


@pytest.mark.parametrize(
    ("tags", "message"),
    [
        ({"wheelSeparation": 0}, "must be positive"),
        ({"wheelDiameter": "wide"}, "expected a number in <wheelDiameter>"),
        ({"odometrySource": "gps"}, "world or encoder, not 'gps'"),
        ({"rightJoint": "nothing"}, "moving joint"),
    ],
)
def test_wrong_tags_leave_it_out(tags, message):
    with pytest.raises(PluginWarning, match=message):
        drive(**tags)


def test_a_command_that_is_not_finite_is_refused():
    _, robot = drive()
    with pytest.raises(SimulationError, match="not finite"):
        robot.inputs["cmd_vel"].send(linear=np.nan)


def test_the_topic_and_the_frame_are_one_computation_and_say_the_same(monkeypatch):
    _, robot = drive(updateRate=100)
    computed, heard, framed = [], [], []
    compute = TrueOdometry.of
    monkeypatch.setattr(TrueOdometry, "of", lambda *a: computed.append(1) or compute(*a))
    robot.outputs["odom"].subscribe(heard.append)
    end = robot.outputs["odom_tf"].subscribe(framed.append)
    robot.simulation.run(0.1)
    assert len(heard) == len(framed) == len(computed) == 10
    for odometry, frames in zip(heard, framed, strict=True):
        assert frames.stamp == odometry.stamp
        np.testing.assert_array_equal(frames.transforms[0].position, odometry.position)
    assert robot.outputs["odom_tf"].last is framed[-1]
    end()
    robot.set_pose((1.0, 0.0, 0.0))
    assert robot.outputs["odom_tf"].last.transforms[0].position[0, 0] == 1.0
