"""Pictures of cameras on the graph, with stage_ros's names, frames and encodings."""

import math

import numpy as np
import pytest
from real import INSTALLED, RealNode

IMAGE, INFO, TF = "sensor_msgs/Image", "sensor_msgs/CameraInfo", "tf2_msgs/TFMessage"
CAMERA = "camera ( resolution [40 30] range [0.2 8] fov [90 60] {} )"
PLAIN = CAMERA.format("")
ROBOT = f"robot ( {PLAIN} )\n"
WALL = 'model ( size [1 20 2] pose [3.7 0 0 0] color "green" )\n'

READ = """
rospy.init_node("real")
import struct, tf2_ros
from sensor_msgs.msg import Image, CameraInfo
seen = {}
for name, kind in (("image", Image), ("depth", Image), ("camera_info", CameraInfo)):
    rospy.Subscriber(name, kind, lambda m, name=name: seen.update({name: m}))
while len(seen) < 3: time.sleep(0.01)
image, depth, info = (seen[name] for name in ("image", "depth", "camera_info"))
at = 15 * 40 + 20
say(image.encoding, image.width, image.height, image.step, tuple(image.data[4 * at:4 * at + 4]))
say(depth.encoding, depth.step, round(struct.unpack_from("<f", depth.data, 4 * at)[0], 5))
say(info.width, round(info.K[0], 6), info.header.frame_id)
buffer = tf2_ros.Buffer(); listener = tf2_ros.TransformListener(buffer)
t = buffer.lookup_transform("base_link", "camera", rospy.Time(0), rospy.Duration(60)).transform
say(*(round(v, 6) + 0.0 for v in (t.translation.z, t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w)))
"""


def pixels(message, kind, channels=1):
    return np.frombuffer(message.data, kind).reshape(message.height, message.width, channels)


def test_a_picture(stage):
    world = stage(ROBOT + WALL)
    message = world.step(world.listen("/image", IMAGE))
    assert (message.encoding, message.width, message.height, message.step) == ("rgba8", 40, 30, 160)
    assert message.header.frame_id == "camera"
    assert message.header.stamp.nsecs == 100_000_000
    seen = pixels(message, np.uint8, 4)
    assert tuple(seen[15, 20]) == (0, 255, 0, 255)
    assert tuple(seen[-1, 20]) == (255, 255, 255, 255)


def test_depths_in_metres(stage):
    world = stage(ROBOT + WALL)
    message = world.step(world.listen("/depth", IMAGE))
    assert (message.encoding, message.step) == ("32FC1", 160)
    seen = pixels(message, "<f4")
    assert seen[15, 20, 0] == pytest.approx(3.2, abs=1e-5)
    assert math.isinf(seen[0, 20, 0])


def test_depths_in_millimetres(stage):
    world = stage(ROBOT + WALL, params={"is_depth_canonical": False})
    message = world.step(world.listen("/depth", IMAGE))
    assert (message.encoding, message.step) == ("16UC1", 80)
    seen = pixels(message, "<u2")
    assert seen[15, 20, 0] in {3199, 3200}
    assert seen[0, 20, 0] == 0


def test_what_the_lens_is(stage):
    world = stage(ROBOT)
    info = world.step(world.listen("/camera_info", INFO))
    fx, fy = 20.0 / math.tan(math.pi / 4), 15.0 / math.tan(math.pi / 6)
    assert list(info.K) == pytest.approx([fx, 0, 20, 0, fy, 15, 0, 0, 1])
    assert list(info.P) == pytest.approx([fx, 0, 20, 0, 0, fy, 15, 0, 0, 0, 1, 0])
    assert (list(info.D), info.header.frame_id) == ([0.0] * 4, "camera")


def test_names_of_several_cameras_and_robots(stage):
    one = stage(f"robot ( {PLAIN} {PLAIN} )")
    topics = one.topics()
    for name in ("image", "depth", "camera_info"):
        assert {f"/{name}_0", f"/{name}_1"} <= topics.keys()
        assert f"/{name}" not in topics
    message = one.step(one.listen("/image_1", IMAGE))
    assert message.header.frame_id == "camera_1"
    two = stage(ROBOT * 2)
    assert {"/robot_0/image", "/robot_1/depth", "/robot_1/camera_info"} <= two.topics().keys()
    message = two.step(two.listen("/robot_1/image", IMAGE))
    assert message.header.frame_id == "robot_1/camera"


def test_the_frame_is_told_while_somebody_looks(stage):
    world = stage(f"robot ( {CAMERA.format('pose [.1 .2 .05 10] pantilt [30 20]')} )")
    frames = world.listen("/tf", TF)
    assert "camera" not in {t.child_frame_id for t in world.step(frames).transforms}
    world.listen("/image", IMAGE)
    (camera,) = [t for t in world.step(frames).transforms if t.child_frame_id == "camera"]
    assert camera.header.frame_id == "base_link"
    where, q = camera.transform.translation, camera.transform.rotation
    assert (where.x, where.y, where.z) == pytest.approx((0.1, 0.2, 0.45))
    # The optical frame looks along z: to the right by the pan less the heading, and down.
    ahead = (
        2 * (q.x * q.z + q.w * q.y),
        2 * (q.y * q.z - q.w * q.x),
        1 - 2 * (q.x**2 + q.y**2),
    )
    yaw, down = math.radians(-20), math.radians(20)
    assert ahead == pytest.approx(
        (math.cos(yaw) * math.cos(down), math.sin(yaw) * math.cos(down), -math.sin(down))
    )


def test_nothing_is_drawn_without_listeners(stage, monkeypatch):
    world = stage(ROBOT)
    for name in ("picture", "draw"):
        monkeypatch.setattr(world.sim.stage_fleet, name, lambda *_: pytest.fail("nobody looks"))
    world.sim.step(3)


def test_pictures_of_all_robots_are_drawn_in_one_call(stage, monkeypatch):
    world = stage(ROBOT * 3 + WALL)
    topics = [world.listen(f"/robot_{number}/image", IMAGE) for number in (0, 2)]
    fleet, calls = world.sim.stage_fleet, []
    draw = fleet.draw
    monkeypatch.setattr(fleet, "draw", lambda keys: (calls.append(keys), draw(keys)))
    world.step(topics[0])
    assert calls == [[("position:0", 0, 0), ("position:2", 0, 0)]]


@pytest.mark.long
@pytest.mark.ros
def test_real_rospy_sees_pictures(stage, running):
    if not INSTALLED:
        pytest.skip("the real ROS 1 is not installed (Debian: ros-core python3-rospy)")
    world = stage(ROBOT + WALL)
    running(world.server)
    half = "0.5"
    with RealNode(world.master.uri, READ) as real:
        real.expect(
            "rgba8 40 30 160 (0, 255, 0, 255)",
            "32FC1 160 3.2",
            "40 20.0 camera",
            f"0.4 -{half} {half} -{half} {half}",
        )
