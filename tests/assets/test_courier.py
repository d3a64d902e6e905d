"""The bundled courier: what it carries, and that its laser is not in its own way."""

from __future__ import annotations

import numpy as np
import pytest
import xacro
from lxml import etree

import gazelle
from gazelle import assets
from gazelle.description import Pose
from gazelle.formats import load_model


def expand(**arguments):
    text = xacro.process_file(str(assets.robot("courier")), mappings=arguments).toxml()
    return etree.fromstring(text.encode())


def test_it_has_a_laser_of_270_degrees_and_a_camera_on_request():
    laser = expand().find("gazebo[@reference='laser_link']/sensor")
    angles = [float(laser.findtext(f"ray/scan/horizontal/{end}_angle")) for end in ("min", "max")]
    assert np.degrees(angles) == pytest.approx([-135.0, 135.0])
    assert laser.findtext("plugin/topicName") == "scan"
    assert expand().find(".//sensor[@type='camera']") is None
    assert expand(camera="true").find(".//sensor[@type='camera']") is not None


def test_its_way_finding_can_be_left_out():
    name = "libgazelle_go_to_goal.so"
    assert expand().xpath(f".//plugin[@filename='{name}']")
    assert not expand(go_to_goal="false").xpath(f".//plugin[@filename='{name}']")


def test_under_ros_control_its_wheels_are_driven_by_nothing_else():
    robot = expand(ros_control="true")
    plugins = set(robot.xpath("gazebo/plugin/@filename"))
    assert plugins == {"libgazebo_ros_control.so"}
    assert robot.xpath("transmission/joint/@name") == ["wheel_left_joint", "wheel_right_joint"]
    assert not expand().xpath("transmission | gazebo/plugin[@filename='libgazebo_ros_control.so']")


def test_its_camera_sees_what_is_before_it():
    model = load_model(assets.robot("courier"), xacro_args={"camera": "true"})
    with gazelle.Simulation("turtlebot3_world") as sim:
        robot = sim.spawn(model, pose=Pose(-2.0, -0.5))
        (camera,) = (s for s in robot.sensors.values() if s.description.type == "camera")
        assert len(np.unique(camera.read().color.reshape(-1, 3), axis=0)) > 3


def test_it_stands_still_and_sees_nothing_of_itself():
    with gazelle.Simulation("empty") as sim:
        robot = sim.spawn("courier")
        sim.run(seconds=1.0)
        assert robot.pose.position == pytest.approx((0.0, 0.0, 0.0), abs=1e-3)
        assert np.isinf(robot.sensors["laser"].read().ranges).all()


def test_another_courier_sees_it():
    with gazelle.Simulation("empty") as sim:
        first = sim.spawn("courier", name="first")
        second = sim.spawn("courier", name="second", namespace="/second")
        second.set_pose((1.0, 0.0, 0.0))
        sim.run(seconds=0.2)
        ranges = first.sensors["laser"].read().ranges
        assert 0.7 < ranges.min() < 0.8
        assert ranges.argmin() == pytest.approx(135, abs=12)


def test_it_goes_as_fast_as_it_is_told():
    with gazelle.Simulation("empty") as sim:
        robot = sim.spawn("courier")
        robot.inputs["cmd_vel"].send(0.6, 0.0)
        sim.run(seconds=2.0)
        assert robot.twist.linear[0] == pytest.approx(0.6, abs=0.02)
        robot.inputs["cmd_vel"].send(0.0, 1.5)
        sim.run(seconds=2.0)
        assert robot.twist.angular[2] == pytest.approx(1.5, abs=0.05)
        assert abs(robot.pose.pitch) < 0.02
