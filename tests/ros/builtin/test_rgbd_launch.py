"""The launch files of rgbd_launch: what their nodelets make of a camera's images."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from ros.graph import until

import gazelle_ros.builtin
from gazelle_ros import Time
from gazelle_ros.builtin import registry
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.launch import load_launch
from gazelle_ros.msgs import geometry_msgs, sensor_msgs, std_msgs, stereo_msgs, tf2_msgs
from gazelle_ros.names import resolve_remappings

FOLDER = Path(gazelle_ros.builtin.__file__).parent / "share/rgbd_launch/launch"
IMAGE, CLOUD = sensor_msgs.msg.Image, sensor_msgs.msg.PointCloud2
DISPARITY = stereo_msgs.msg.DisparityImage
SIZE = (6, 8)
MADE = {
    "/color/image_color": IMAGE,
    "/color/image_rect_color": IMAGE,
    "/color/image_rect_mono": IMAGE,
    "/ir/image_rect_ir": IMAGE,
    "/depth/image": IMAGE,
    "/depth/image_rect": IMAGE,
    "/depth/points": CLOUD,
    "/depth/disparity": DISPARITY,
    "/depth_registered/image": IMAGE,
    "/depth_registered/hw_registered/image_rect": IMAGE,
    "/depth_registered/sw_registered/image_rect": IMAGE,
    "/depth_registered/points": CLOUD,
    "/depth_registered/disparity": DISPARITY,
}


def header(frame):
    return std_msgs.msg.Header(stamp=Time(3), frame_id=frame)


def image(value, encoding, frame):
    kind = np.uint16 if encoding == "16UC1" else np.uint8
    return CvBridge().cv2_to_imgmsg(np.full(SIZE, value, kind), encoding, header(frame))


def camera(frame, base=0.0):
    """Return a camera, which may be the right one of two with a base [m]."""
    made = sensor_msgs.msg.CameraInfo(width=SIZE[1], height=SIZE[0], header=header(frame))
    made.P = [10.0, 0.0, 3.5, -10.0 * base, 0.0, 10.0, 2.5, 0.0, 0.0, 0.0, 1.0, 0.0]
    made.K = [10.0, 0.0, 3.5, 0.0, 10.0, 2.5, 0.0, 0.0, 1.0]
    made.R = np.eye(3).ravel().tolist()
    return made


def messages():
    link = geometry_msgs.msg.TransformStamped(header=header("rgb"), child_frame_id="depth")
    link.transform.rotation.w = 1.0
    return {
        "/tf_static": tf2_msgs.msg.TFMessage(transforms=[link]),
        "/color/image_raw": image(7, "bayer_rggb8", "rgb"),
        "/color/camera_info": camera("rgb"),
        "/ir/image_raw": image(7, "mono8", "ir"),
        "/ir/camera_info": camera("ir"),
        "/depth/image_raw": image(2000, "16UC1", "depth"),
        "/depth/camera_info": camera("depth"),
        "/depth_registered/image_raw": image(2000, "16UC1", "rgb"),
        "/depth_registered/camera_info": camera("rgb"),
        "/projector/camera_info": camera("depth", base=0.1),
    }


@pytest.fixture
def nodelets(make_node):
    """Return a function that runs the nodelets of a launch file in this process."""

    def run(file, arguments):
        plan = load_launch(FOLDER / file, arguments)
        for name, parameter in plan.parameters.items():
            make_node("server").set_param(name, parameter.value)
        for each in plan.nodes:
            load, kind, _manager, *_bond = each.arguments.split()
            assert load == "load"
            node = make_node(each.name, remappings=resolve_remappings(dict(each.remappings), "/a"))
            registry.nodelet(kind)(node)

    return run


def test_all_is_made_of_the_images_of_a_camera(make_node, listen, nodelets):
    nodelets("includes/processing.launch.xml", {"manager": "manager", "rgb": "color"})
    got = {topic: listen(topic, kind) for topic, kind in MADE.items()}
    driver, sent = make_node("driver"), messages()
    publishers = {topic: driver.advertise(topic, type(each)) for topic, each in sent.items()}

    def arrived():
        for topic, message in sent.items():
            publishers[topic].publish(message)
        return all(got.values())

    until(arrived)
    metres = CvBridge().imgmsg_to_cv2(got["/depth/image"][0])
    assert metres == pytest.approx(2.0)
    shifts = got["/depth/disparity"][0]
    assert CvBridge().imgmsg_to_cv2(shifts.image) == pytest.approx(10.0 * 0.1 / 2.0)
    assert (shifts.min_disparity, shifts.max_disparity) == (0.25, 2.0)
    assert got["/depth_registered/points"][0].header.frame_id == "rgb"


def test_a_respawning_nodelet_has_a_bond():
    file = FOLDER / "includes/depth.launch.xml"
    for respawn, last in (("true", "manager"), ("false", "--no-bond")):
        plan = load_launch(file, {"manager": "manager", "depth": "depth", "respawn": respawn})
        assert {each.arguments.split()[-1] for each in plan.nodes} == {last}
        assert {each.respawn for each in plan.nodes} == {respawn == "true"}


def test_the_cameras_of_a_kinect_look_ahead():
    plan = load_launch(FOLDER / "kinect_frames.launch", {"camera": "head", "tf_prefix": "robot"})
    frames = {tuple(each.arguments.split()[-2:]) for each in plan.nodes}
    assert frames == {
        ("robot/head_link", "robot/head_depth_frame"),
        ("robot/head_link", "robot/head_rgb_frame"),
        ("robot/head_depth_frame", "robot/head_depth_optical_frame"),
        ("robot/head_rgb_frame", "robot/head_rgb_optical_frame"),
    }
    for each in plan.nodes:
        assert callable(registry.main_of(each.package, each.type))
