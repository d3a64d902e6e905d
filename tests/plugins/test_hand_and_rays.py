"""The hand of God, and rays under any message."""

import numpy as np
import pytest
from models import block, plugin, simulate

from gazelle.errors import PluginWarning
from gazelle.sensors import LaserScan
from gazelle.simulation import Transform, Transforms
from gazelle.simulation.values import ChannelPoints, LaserPoints, RangeValue

HAND = plugin("libgazebo_ros_hand_of_god.so", linkName="core")


def desired(position, frame="world", child="hog_desired"):
    upright = np.array([[0.0, 0.0, 0.0, 1.0]])
    return Transforms(0, (Transform(frame, child, np.array([position]), upright),))


@pytest.mark.long
def test_a_hand_draws_its_link_to_a_frame_without_swinging():
    with simulate(block(plugin=HAND), ground=False, nworld=2) as sim:
        robot = sim.robots["cube"]
        sim.run(seconds=0.2)
        assert robot.position[:, 2] == pytest.approx(0.5)
        robot.inputs["hog_desired"].send(desired((0.3, 0.0, 1.0)), np.array([1]))
        highest = 0.0
        for _ in range(20):
            sim.run(seconds=0.1)
            highest = max(highest, robot.position[1, 2])
        assert robot.position[1] == pytest.approx([0.3, 0.0, 1.0], abs=0.01)
        assert highest < 1.01
        assert robot.position[0] == pytest.approx([0.0, 0.0, 0.5], abs=1e-6)
        tell = robot.outputs["hog_actual"].last.transforms[0]
        assert (tell.frame, tell.child_frame) == ("world", "hog_actual")
        state = sim.snapshot()
        sim.reset()
        sim.run(seconds=0.5)
        assert robot.position[1, 2] == pytest.approx(0.5, abs=1e-3)
        sim.restore(state)
        sim.run(seconds=0.1)
        assert robot.position[1] == pytest.approx([0.3, 0.0, 1.0], abs=0.01)


@pytest.mark.long
def test_a_hand_follows_a_frame_through_others():
    east = np.array([[0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)]])
    with simulate(block(plugin=HAND), ground=False, nworld=2) as sim:
        robot = sim.robots["cube"]
        hear, told = robot.inputs["hog_desired"], robot.inputs["hog_static"]
        assert (hear.topic, told.topic) == ("/tf", "/tf_static")
        hear.send(desired((0.5, 0.0, 0.0), frame="/hand"))
        sim.run(seconds=0.1)
        assert robot.position[:, 2] == pytest.approx(0.5)  # nobody says where the hand is
        world = np.array([[1.0, 0.0, -1.0]])
        told.send(Transforms(0, (Transform("map", "world", world, east),)))
        hear.send(desired((1.0, 0.2, 0.0), frame="map", child="hand"), np.array([1]))
        sim.run(seconds=3.0)
        # In the map at (1.5, 0.2, 0), seen from a world at (1, 0, -1) that is turned left.
        assert robot.position[1] == pytest.approx([0.2, -0.5, 1.0], abs=0.01)
        turned = robot.quaternion[1] * np.sign(robot.quaternion[1, 3])
        assert turned == pytest.approx([0.0, 0.0, -np.sqrt(0.5), np.sqrt(0.5)], abs=0.01)
        assert robot.position[0] == pytest.approx([0.0, 0.0, 0.5], abs=1e-6)
        state = sim.snapshot()
        sim.reset()
        hear.send(desired((0.0, 0.0, 1.0), frame="map"))
        sim.run(seconds=3.0)
        # What is told once and for all outlives a reset.
        assert robot.position[0] == pytest.approx([0.0, 1.0, 2.0], abs=0.01)
        sim.restore(state)
        sim.run(seconds=0.1)
        assert robot.position[1] == pytest.approx([0.2, -0.5, 1.0], abs=0.01)


RAYS = """<sensor name="eye" type="ray"><pose>0.2 0 0 0 0 0</pose><update_rate>20</update_rate>
<ray><scan><horizontal><samples>3</samples><min_angle>-0.2</min_angle><max_angle>0.2</max_angle>
</horizontal></scan><range><min>0.05</min><max>2</max></range></ray>{plugin}</sensor>"""
WALL = """<model name="wall"><static>1</static><pose>1.1 0 0.5 0 0 0</pose><link name="l">
<collision name="c"><geometry><box><size>0.2 4 2</size></box></geometry></collision></link></model>"""


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("LaserScan", LaserScan),
        ("PointCloud", ChannelPoints),
        ("PointCloud2", LaserPoints),
        ("Range", RangeValue),
    ],
)
def test_rays_come_as_the_message_that_is_asked_for(name, kind):
    tags = plugin(
        "libgazebo_ros_ray_sensor.so",
        output_type=f"sensor_msgs/{name}",
        frame_name="eye_frame",
        ros="<namespace>/r1</namespace><remapping>~/out:=scan</remapping>",
    )
    with simulate(block(RAYS.format(plugin=tags), gravity=False), WALL, ground=False) as sim:
        output = sim.robots["cube"].outputs["scan"]
        assert (output.topic, output.frame) == ("/r1/scan", "eye_frame")
        value = output.last
        assert isinstance(value, kind)
        if kind is LaserScan:
            assert value.ranges[0, 1] == pytest.approx(0.8, abs=1e-6)
        elif kind is RangeValue:
            assert value.distance[0] == pytest.approx(0.8, abs=1e-6)
        else:
            assert value.points[0, :, 0] == pytest.approx(0.8, abs=1e-6)


def test_an_unknown_message_is_refused():
    tags = plugin("libgazebo_ros_ray_sensor.so", output_type="sensor_msgs/LaserScn")
    with pytest.raises(PluginWarning, match="LaserScn"):
        simulate(block(RAYS.format(plugin=tags)))
