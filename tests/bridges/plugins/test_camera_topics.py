"""Cameras on a graph, as a client gets them: what gazebo_plugins' own suites of cameras ask."""

import io
import math

import numpy as np
import pytest
from PIL import Image
from plugin_graph import first, running, send, wait

from gazelle_ros.compat.cv_bridge.core import CvBridge
from gazelle_ros.messages import load_message

TARGET = """<model name="red"><static>1</static><pose>3 0 0.5 0 0 0</pose><link name="l">
<visual name="v"><geometry><box><size>1 1 1</size></box></geometry><material>
<ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual></link></model>"""
MODEL = """<model name="robot"><static>1</static><pose>0 0 0.5 0 0 0</pose><link name="base">
<sensor type="{kind}" name="eye"><update_rate>20</update_rate>
<camera name="left"><horizontal_fov>1.0</horizontal_fov><image><width>32</width><height>24</height>
<format>{format}</format></image><clip><near>0.1</near><far>20</far></clip></camera>{more}
<plugin name="p" filename="{file}"><cameraName>camera1</cameraName>
<frameName>optical</frameName></plugin></sensor></link></model>"""


def camera(file, kind="camera", pixels="R8G8B8", more=""):
    return running(TARGET, MODEL.format(file=file, kind=kind, format=pixels, more=more))


def stamp(message):
    return message.header.stamp.to_nsec()


@pytest.mark.parametrize(
    ("pixels", "encoding", "size"), [("R8G8B8", "rgb8", 1), ("L16", "mono16", 2)]
)
def test_a_picture_and_its_lens(pixels, encoding, size):
    with camera("libgazebo_ros_camera.so", pixels=pixels) as graph:
        image = first(graph, "/camera1/image_raw", "sensor_msgs/Image")
        info = first(graph, "/camera1/camera_info", "sensor_msgs/CameraInfo")
    assert (image.encoding, image.header.frame_id) == (encoding, "optical")
    channels = 3 if encoding == "rgb8" else 1
    assert (image.height, image.width, image.step) == (24, 32, 32 * size * channels)
    assert stamp(image) % 50_000_000 == 0
    array = CvBridge().imgmsg_to_cv2(image)
    assert array.shape == ((24, 32, 3) if channels == 3 else (24, 32))
    focal = 32 / (2 * math.tan(0.5))
    assert info.distortion_model == "plumb_bob"
    assert list(info.D) == [0.0] * 5
    assert list(info.K) == pytest.approx([focal, 0, 16.5, 0, focal, 12.5, 0, 0, 1])
    assert list(info.P) == pytest.approx([focal, 0, 16.5, 0, 0, focal, 12.5, 0, 0, 0, 1, 0])


def test_a_picture_as_jpeg():
    with camera("libgazebo_ros_camera.so") as graph:
        topic = "/camera1/image_raw/compressed"
        message = first(graph, topic, "sensor_msgs/CompressedImage")
    assert message.format == "rgb8; jpeg compressed bgr8"
    assert Image.open(io.BytesIO(message.data)).size == (32, 24)


def test_a_depth_camera_has_one_stamp_for_all():
    with camera("libgazebo_ros_depth_camera.so", "depth") as graph:
        images = graph.client.listen("/camera1/ir/image_raw", "sensor_msgs/Image")
        depths = graph.client.listen("/camera1/depth/image_raw", "sensor_msgs/Image")
        clouds = graph.client.listen("/camera1/points", "sensor_msgs/PointCloud2")

        def shared():
            kinds = [set(map(stamp, list(heard))) for heard in (images, depths, clouds)]
            return set.intersection(*kinds)

        wait(shared)
        at = min(shared())
        depth, cloud = (next(m for m in heard if stamp(m) == at) for heard in (depths, clouds))
    pixels = CvBridge().imgmsg_to_cv2(depth)
    assert (depth.encoding, pixels.shape) == ("32FC1", (24, 32))
    assert pixels[12, 16] == pytest.approx(2.5, abs=1e-4)
    assert (cloud.height, cloud.width, cloud.point_step, cloud.row_step) == (24, 32, 32, 1024)
    assert [(f.name, f.offset) for f in cloud.fields] == [("x", 0), ("y", 4), ("z", 8), ("rgb", 16)]
    raw = np.frombuffer(cloud.data, np.uint8).reshape(24, 32, 32)
    z = raw[..., 8:12].copy().view("<f4")[..., 0]
    assert np.array_equal(z, pixels, equal_nan=True)
    # The bytes of the picture in its own order, which exchanges red and blue for rgb8.
    assert raw[12, 16, 16] > 2 * raw[12, 16, 18] + 10
    assert not cloud.is_dense


def test_two_cameras_have_one_stamp():
    more = MODEL.split("<camera", 1)[1].split("</camera>")[0].replace("left", "right")
    more = f"<camera{more}</camera>".format(format="L8")
    with camera("libgazebo_ros_multicamera.so", "multicamera", more=more) as graph:
        sides = [
            graph.client.listen(f"/camera1/{side}/image_raw", "sensor_msgs/Image")
            for side in ("left", "right")
        ]
        wait(lambda: set(map(stamp, list(sides[0]))) & set(map(stamp, list(sides[1]))))


@pytest.mark.long
def test_a_triggered_camera_sends_as_many_pictures_as_there_were_triggers():
    with camera("libgazebo_ros_triggered_camera.so") as graph:
        images = graph.client.listen("/camera1/image_raw", "sensor_msgs/Image")
        wait(lambda: graph.sim.robots["robot"].sensors["eye"].awake)
        before = graph.sim.time
        wait(lambda: graph.sim.time > before + 1.0)
        assert images == []
        trigger = send(graph, "/camera1/image_trigger", "std_msgs/Empty")
        wait(lambda: len(images) == 1)
        for _ in range(2):
            trigger.publish(load_message("std_msgs/Empty")())
        wait(lambda: len(images) == 3)
        before = graph.sim.time
        wait(lambda: graph.sim.time > before + 1.0)
        assert len(images) == 3
