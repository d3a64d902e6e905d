"""fake_localization: where a simulator says that the robot is, in amcl's form."""

from __future__ import annotations

import pytest
from ros.graph import until

from gazelle.bridges.conversions import pose_message, pose_of_message, pose_of_transform
from gazelle.bridges.navigation.fake_localization import FakeLocalizationNode
from gazelle.description import Pose
from gazelle_ros import Master, Node, Time, load_message
from gazelle_ros.clock import SimulatedClock

ODOMETRY = Pose(x=0.4, y=-0.2, yaw=0.3)
TRUTH = Pose(x=2.0, y=1.0, z=0.1, roll=0.05, yaw=1.0)


class Robot:
    """A robot whose odometry and true pose a test gives."""

    def __init__(self, uri, parameters):
        self.clock = SimulatedClock()
        self.now = 0
        self.node = Node("/simulator", master_uri=uri, clock=self.clock)
        self.tf = self.node.advertise("/tf", load_message("tf2_msgs/TFMessage"))
        self.truths = self.node.advertise(
            "/base_pose_ground_truth", load_message("nav_msgs/Odometry")
        )
        covariant = load_message("geometry_msgs/PoseWithCovarianceStamped")
        self.begin = self.node.advertise("/initialpose", covariant)
        self.poses, self.clouds = [], []
        self.node.subscribe("/amcl_pose", covariant, self.poses.append)
        self.node.subscribe(
            "/particlecloud", load_message("geometry_msgs/PoseArray"), self.clouds.append
        )
        self.node.set_param("/fake_localization", parameters)
        self.fake = FakeLocalizationNode(
            Node("/fake_localization", master_uri=uri, clock=self.clock)
        )

    def tell(self, truth, odometry=ODOMETRY):
        """Publish both, and return what the node says of it."""
        self.now += 100_000_000
        self.clock.set(self.now)
        message = load_message("nav_msgs/Odometry")()
        message.header.stamp, message.header.frame_id = Time(nsecs=self.now), "world"
        message.pose.pose = pose_message(truth)
        self.truths.publish(message)
        link = load_message("geometry_msgs/TransformStamped")()
        link.header.stamp, link.header.frame_id = Time(nsecs=self.now), "odom"
        link.child_frame_id = "base_link"
        at = pose_message(odometry)
        link.transform.translation.x, link.transform.translation.y = at.position.x, at.position.y
        link.transform.rotation = at.orientation
        self.tf.publish(self.tf.message_class(transforms=[link]))

        def said():
            self.fake._truths.work(self.fake._odometry, self.fake._localise)
            return any(each.header.stamp.to_nsec() == self.now for each in self.clouds)

        until(said)
        return self.poses[-1]

    def close(self):
        self.fake._node.close()
        self.node.close()


@pytest.fixture
def start():
    made = []
    with Master(port=0, rosout=False) as master:

        def make(**parameters):
            made.append(Robot(master.uri, parameters))
            until(lambda: made[-1].tf.num_connections >= 1 and made[-1].truths.num_connections)
            return made[-1]

        yield make
        for each in made:
            each.close()


def test_the_true_pose_is_published_and_its_transform(start):
    robot = start(transform_tolerance=0.5)
    message = robot.tell(TRUTH)
    assert message.header.frame_id == "map"
    assert pose_of_message(message.pose.pose).is_close(TRUTH)
    (particle,) = robot.clouds[-1].poses
    assert pose_of_message(particle).is_close(TRUTH)
    tree = robot.fake.frames.tree
    until(lambda: tree.has("map"))
    stamp = robot.now + 500_000_000
    found = pose_of_transform(tree.lookup("map", "odom", stamp))
    assert (found * ODOMETRY).is_close(TRUTH)


def test_the_map_is_moved_by_parameters_and_by_initialpose(start):
    robot = start(delta_x=1.0, delta_y=-2.0, delta_yaw=0.5)
    offset = Pose(x=-1.0, y=2.0, yaw=-0.5)
    for _ in range(2):  # the transform is dated ahead: only between two of them it is known
        assert pose_of_message(robot.tell(TRUTH).pose.pose).is_close(offset * TRUTH)
    until(lambda: robot.fake.frames.find("map", "base_link") is not None)
    wanted = Pose(x=-3.0, y=0.5, yaw=2.0)
    message = robot.begin.message_class()
    message.header.frame_id, message.pose.pose = "map", pose_message(wanted)
    until(lambda: robot.begin.num_connections)
    before = robot.fake._offset
    robot.begin.publish(message)
    until(lambda: robot.fake._offset != before)
    assert pose_of_message(robot.tell(TRUTH).pose.pose).is_close(wanted)
    ahead = Pose(x=0.3)
    moved = robot.tell(TRUTH * ahead, ODOMETRY * ahead)
    assert pose_of_message(moved.pose.pose).is_close(wanted * ahead)


def test_a_pose_waits_for_its_odometry(start):
    robot = start()
    robot.tell(TRUTH)
    late = load_message("nav_msgs/Odometry")()
    late.header.stamp = Time(nsecs=robot.now + 100_000_000)
    robot.truths.publish(late)
    until(lambda: robot.fake._truths.seen == 2)
    count = len(robot.poses)
    robot.fake._truths.work(robot.fake._odometry, robot.fake._localise)
    assert len(robot.poses) == count
    assert robot.fake._missing() == []
