"""Topics, frames and parameters are those of stage_ros."""

import pytest

from gazelle.stage.bridge.naming import Naming

ONE = 'robot ( name "r" )'
TWO = 'robot ( name "a" ) robot ( pose [2 0 0 0] )'
ODOMETRY, SCAN, TWIST = "nav_msgs/Odometry", "sensor_msgs/LaserScan", "geometry_msgs/Twist"


def test_one_robot_has_plain_names(stage):
    world = stage(ONE)
    topics = world.topics()
    assert {name: topics.get(name) for name in ("/odom", "/base_scan", "/cmd_vel", "/tf")} == {
        "/odom": ODOMETRY,
        "/base_scan": SCAN,
        "/cmd_vel": TWIST,
        "/tf": "tf2_msgs/TFMessage",
    }
    assert topics["/base_pose_ground_truth"] == ODOMETRY
    assert topics["/clock"] == "rosgraph_msgs/Clock"
    assert topics["/cmd_pose"] == "geometry_msgs/Pose"
    assert topics["/cmd_pose_stamped"] == "geometry_msgs/PoseStamped"
    assert topics["/stall"] == "std_msgs/Bool"
    assert topics["/is_crashed"] == "std_msgs/Int8"
    assert world.server.node.name == "/stageros"
    assert world.node.get_param("/use_sim_time") is True


def test_several_robots_have_prefixes(stage):
    topics = stage(TWO).topics()
    for robot in ("robot_0", "robot_1"):
        for name in ("odom", "base_scan", "cmd_vel", "base_pose_ground_truth", "cmd_pose"):
            assert f"/{robot}/{name}" in topics
    assert "/odom" not in topics


def test_several_rangers_of_a_robot_are_numbered(stage):
    topics = stage("robot ( scanner ( ) )").topics()
    assert {"/base_scan_0", "/base_scan_1"} <= topics.keys()
    assert "/base_scan" not in topics


def test_rangers_on_what_a_robot_carries_are_not_published(stage):
    topics = stage("position ( model ( scanner ( ) ) )").topics()
    assert not any("base_scan" in name for name in topics)


def test_frames_have_no_slash(stage):
    world = stage(TWO)
    heard = world.listen("/tf", "tf2_msgs/TFMessage")
    message = world.step(heard)
    pairs = [(t.header.frame_id, t.child_frame_id) for t in message.transforms]
    assert pairs == [
        (f"robot_{i}/{parent}", f"robot_{i}/{child}")
        for i in range(2)
        for parent, child in (
            ("odom", "base_footprint"),
            ("base_footprint", "base_link"),
            ("base_link", "base_laser_link"),
        )
    ]


def test_frames_have_stage_ros_slash_where_it_is_asked_for(stage):
    world = stage(TWO, {"slashed_frames": True})
    heard = world.listen("/robot_1/odom", ODOMETRY)
    assert world.step(heard).header.frame_id == "/robot_1/odom"


def test_names_can_be_those_of_the_models(stage):
    topics = stage(TWO, model_names=True).topics()
    assert "/a/odom" in topics
    assert "/robot_1/odom" in topics


@pytest.mark.parametrize(
    ("robots", "options", "topic", "second", "frame"),
    [
        (["r"], {}, "odom", "/base_scan_1", "base_laser_link_1"),
        (["r"], {"slashed_frames": True}, "odom", "/base_scan_1", "/base_laser_link_1"),
        (["r"], {"model_names": True}, "/r/odom", "/r/base_scan_1", "r/base_laser_link_1"),
        (["a", "b"], {}, "/robot_0/odom", "/robot_0/base_scan_1", "robot_0/base_laser_link_1"),
        (
            ["position:0", "b"],
            {"model_names": True},
            "/robot_0/odom",
            "/robot_0/base_scan_1",
            "robot_0/base_laser_link_1",
        ),
    ],
)
def test_names_follow_from_robots_and_options(robots, options, topic, second, frame):
    naming = Naming(robots, **options)
    assert naming.topic(0, "odom") == topic
    assert naming.device_topic(0, "base_scan", 1, 2) == second
    assert naming.frame(0, "base_laser_link", 1, 2) == frame
