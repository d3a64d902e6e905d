"""Names of frames of several robots on one graph."""

from ros.graph import until

import gazelle

KINDS = {
    "odom": "nav_msgs/Odometry",
    "scan": "sensor_msgs/LaserScan",
    "imu": "sensor_msgs/Imu",
    "joint_states": "sensor_msgs/JointState",
}


def heard_from(graph, name):
    """Return one message of each topic of a robot in a namespace of its own."""
    graph.sim.spawn("turtlebot3_burger", name=name, namespace=f"/{name}", pose=gazelle.Pose(1.0))
    heard = {topic: graph.client.listen(f"/{name}/{topic}", kind) for topic, kind in KINDS.items()}
    transforms = graph.client.listen("/tf", "tf2_msgs/TFMessage")

    def complete():
        graph.sim.step(20)
        return transforms and all(heard.values())

    until(complete)
    pairs = {
        (each.header.frame_id, each.child_frame_id)
        for message in transforms
        for each in message.transforms
    }
    return {topic: messages[-1] for topic, messages in heard.items()}, pairs


def test_frames_get_the_prefix_of_the_robots_namespace(graph):
    graph.client.node.set_param("/tb/tf_prefix", "tb")
    heard, transforms = heard_from(graph, "tb")
    assert heard["odom"].header.frame_id == "tb/odom"
    assert heard["odom"].child_frame_id == "tb/base_footprint"
    assert heard["scan"].header.frame_id == "tb/base_scan"
    assert ("tb/odom", "tb/base_footprint") in transforms
    # Gazebo's plugins leave these as they are; libsdformat names the body that the IMU's link,
    # which a fixed joint holds, has become a part of.
    assert heard["imu"].header.frame_id == "base_footprint"
    assert heard["joint_states"].header.frame_id == ""


def test_a_prefix_of_all_is_taken_where_there_is_no_nearer_one(graph):
    graph.client.node.set_param("/tf_prefix", "/fleet")
    heard, transforms = heard_from(graph, "tb")
    assert heard["odom"].header.frame_id == "fleet/odom"
    assert ("fleet/odom", "fleet/base_footprint") in transforms


def test_without_a_prefix_frames_are_called_as_in_the_file(graph):
    heard, transforms = heard_from(graph, "tb")
    assert heard["odom"].header.frame_id == "odom"
    assert ("odom", "base_footprint") in transforms
