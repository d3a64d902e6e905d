"""Laser scans that are made of a depth camera's images and clouds, against a lidar beside it."""

from __future__ import annotations

import numpy as np
import pytest
from plugin_graph import first, running
from ros.graph import Background

from gazelle_ros.builtin.scans.depth_image import DepthImageToLaserScan
from gazelle_ros.builtin.scans.pointcloud import pointcloud_to_laserscan
from gazelle_ros.msgs import geometry_msgs, std_msgs, tf2_msgs
from gazelle_ros.node import Node

# A wall 2.5 m ahead, and in front of its left half another.
WALLS = """<model name="walls"><static>1</static><link name="l">
<visual name="far"><pose>3 0 0.5 0 0 0</pose><geometry><box><size>1 8 2</size></box></geometry></visual>
<collision name="far"><pose>3 0 0.5 0 0 0</pose><geometry><box><size>1 8 2</size></box></geometry></collision>
<visual name="near"><pose>2 2 0.5 0 0 0</pose><geometry><box><size>1 4 2</size></box></geometry></visual>
<collision name="near"><pose>2 2 0.5 0 0 0</pose><geometry><box><size>1 4 2</size></box></geometry></collision>
</link></model>"""
ROBOT = """<model name="robot"><static>1</static><pose>0 0 0.5 0 0 0</pose><link name="base">
<sensor type="depth" name="eye"><update_rate>20</update_rate>
<camera name="left"><horizontal_fov>1.0</horizontal_fov><image><width>160</width><height>24</height>
</image><clip><near>0.1</near><far>20</far></clip></camera>
<plugin name="p" filename="libgazebo_ros_depth_camera.so"><cameraName>camera</cameraName>
<frameName>optical</frameName></plugin></sensor>
<sensor type="ray" name="laser"><update_rate>20</update_rate><ray><scan><horizontal>
<samples>81</samples><min_angle>-0.4</min_angle><max_angle>0.4</max_angle></horizontal></scan>
<range><min>0.1</min><max>20</max></range></ray>
<plugin name="q" filename="libgazebo_ros_laser.so"><topicName>lidar</topicName>
<frameName>laser</frameName></plugin></sensor></link></model>"""
CONVERTERS = {
    "image": (DepthImageToLaserScan, {}, {"image": "/camera/depth/image_raw"}),
    "cloud": (
        pointcloud_to_laserscan,
        {
            "target_frame": "laser", "min_height": -0.05, "max_height": 0.05,
            "angle_min": -0.4, "angle_max": 0.4, "angle_increment": 0.02,
        },
        {"cloud_in": "/camera/points"},
    ),
}  # fmt: skip


def mount(node):
    """Publish the pose of the optical frame in that of the lidar."""
    made = geometry_msgs.msg.TransformStamped(
        header=std_msgs.msg.Header(frame_id="laser"), child_frame_id="optical"
    )
    turn = made.transform.rotation
    turn.x, turn.y, turn.z, turn.w = -0.5, 0.5, -0.5, 0.5
    kind = tf2_msgs.msg.TFMessage
    node.advertise("/tf_static", kind, latch=True).publish(kind(transforms=[made]))


@pytest.mark.parametrize("kind", CONVERTERS)
def test_the_scan_is_that_of_the_lidar(kind):
    make, parameters, remappings = CONVERTERS[kind]
    values = {f"/converter/{name}": value for name, value in parameters.items()}
    with running(WALLS, ROBOT, parameters=values) as graph:
        uri = graph.client.node.master_uri
        mount(graph.client.node)
        with Node("converter", master_uri=uri, remappings=remappings) as node:
            working = Background(make(node).run)
            scan = first(graph, "/scan", "sensor_msgs/LaserScan")
            lidar = first(graph, "/lidar", "sensor_msgs/LaserScan")
            working.end()
    beams = lidar.angle_min + np.arange(len(lidar.ranges)) * lidar.angle_increment
    angles = scan.angle_min + (np.arange(len(scan.ranges)) + 0.5) * scan.angle_increment
    seen = np.isfinite(scan.ranges) & (np.abs(angles) < 0.39)
    assert seen.sum() > 0.8 * (np.abs(angles) < 0.39).sum()
    at_edge = np.abs(angles) < 0.03  # where a column and a beam may meet different walls
    expected = np.interp(angles, beams, lidar.ranges)
    away = np.array(scan.ranges)[seen & ~at_edge]
    assert away == pytest.approx(expected[seen & ~at_edge], rel=0.015)
    assert (away < 1.7).sum() > 10
    assert (away > 2.4).sum() > 10
