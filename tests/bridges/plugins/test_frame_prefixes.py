"""Use of the parameter tf_prefix for each plugin's frames; Gazebo's plugins differ in it."""

import pytest
from models import block, plugin
from plugin_graph import first, running, send
from test_state_plugins import ARM, RAYS

from gazelle_ros import load_message

ROOT, BOTH = {"/tf_prefix": "all"}, {"/tf_prefix": "all", "/r1/tf_prefix": "own"}
LASERS = {
    "libgazebo_ros_laser.so": "sensor_msgs/LaserScan",
    "libgazebo_ros_range.so": "sensor_msgs/Range",
    "libgazebo_ros_block_laser.so": "sensor_msgs/PointCloud",
    "libgazebo_ros_velodyne_laser.so": "sensor_msgs/PointCloud2",
}
NEAREST, OWN, SPACE = ("all/f", "own/f"), ("f", "own/f"), ("r1/f", "r1/f")


def model_of(filename):
    """Return a model with the plugin in namespace r1, publishing on r1/deep/t with frame f."""
    tags = {"robotNamespace": "r1", "topicName": "deep/t", "frameName": "f"}
    if filename in LASERS:
        return block(RAYS.format(plugin=plugin(filename, **tags)), gravity=False)
    if "bumper" in filename:
        inside = plugin(filename, bumperTopicName="deep/t", **tags)
        contact = "<contact><collision>hull</collision></contact>"
        return block(f'<sensor name="s" type="contact">{contact}{inside}</sensor>', gravity=False)
    if "ft_sensor" in filename:
        arm = ARM.format(
            gravity=0, kind="fixed", plugin=plugin(filename, jointName="elbow", **tags)
        )
        return arm.replace(">tip<", ">f<").replace('"tip"', '"f"')
    return block(plugin=plugin(filename, bodyName="core", **tags), gravity=False)


@pytest.mark.parametrize(
    ("filename", "kind", "frames"),
    [
        ("libgazebo_ros_laser.so", "sensor_msgs/LaserScan", NEAREST),
        ("libgazebo_ros_range.so", "sensor_msgs/Range", OWN),
        ("libgazebo_ros_block_laser.so", "sensor_msgs/PointCloud", OWN),
        ("libgazebo_ros_bumper.so", "gazebo_msgs/ContactsState", OWN),
        ("libgazebo_ros_f3d.so", "geometry_msgs/WrenchStamped", OWN),
        ("libgazebo_ros_ft_sensor.so", "geometry_msgs/WrenchStamped", OWN),
        ("libgazebo_ros_velodyne_laser.so", "sensor_msgs/PointCloud2", SPACE),
        ("libgazebo_ros_imu.so", "sensor_msgs/Imu", ("f", "f")),
    ],
)
def test_the_prefix_is_looked_for_where_the_original_looks(filename, kind, frames):
    for parameters, frame in zip((ROOT, BOTH), frames, strict=True):
        with running(model_of(filename), parameters=parameters) as graph:
            assert first(graph, "/r1/deep/t", kind).header.frame_id == frame


def test_in_the_root_a_velodyne_takes_the_roots_prefix():
    tags = plugin("libgazebo_ros_velodyne_laser.so", topicName="/t", frameName="f")
    with running(block(RAYS.format(plugin=tags), gravity=False), parameters=ROOT) as graph:
        assert first(graph, "/t", "sensor_msgs/PointCloud2").header.frame_id == "all/f"


def test_a_true_pose_has_its_body_without_a_prefix():
    tags = plugin("libgazebo_ros_p3d.so", robotNamespace="r1", bodyName="core", topicName="t")
    with running(block(plugin=tags, gravity=False), parameters=BOTH) as graph:
        message = first(graph, "/r1/t", "nav_msgs/Odometry")
    assert (message.header.frame_id, message.child_frame_id) == ("own/world", "core")


def test_a_hand_tells_its_link_without_a_prefix():
    hand = plugin("libgazebo_ros_hand_of_god.so", linkName="core", frameId="hog")
    with running(block(plugin=hand, gravity=False), parameters=ROOT) as graph:
        stamped = load_message("geometry_msgs/TransformStamped")()
        stamped.header.frame_id, stamped.child_frame_id = "world", "hog_desired"
        stamped.transform.rotation.w = 1.0
        send(graph, "/tf", "tf2_msgs/TFMessage", transforms=[stamped])
        message = first(graph, "/tf", "tf2_msgs/TFMessage")
    assert message.transforms[0].child_frame_id in ("hog_actual", "hog_desired")
    assert message.transforms[0].header.frame_id == "world"
