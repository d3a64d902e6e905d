"""Debian's real rospy and tf2 beside Stage's server: rates, scans, commands, poses, transforms."""

import math

import pytest
from real import INSTALLED, RealNode

pytestmark = pytest.mark.ros

READY = """
rospy.init_node("real")
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from geometry_msgs.msg import Twist, Pose, PoseStamped
from std_srvs.srv import Empty
"""
RATES = """
counts = {"odom": 0, "base_scan": 0}
def count(message, name): counts[name] += 1
for name, kind in (("odom", Odometry), ("base_scan", LaserScan)):
    rospy.Subscriber(name, kind, count, name)
while not all(counts.values()): rospy.sleep(0.1)
for attempt in range(20):  # a pause of a thread or process makes one wrong
    before, begin = dict(counts), rospy.get_time()
    rospy.sleep(4.0)
    rates = [(counts[name] - before[name]) / 4.0 for name in sorted(counts)]
    if all(abs(rate - 10.0) < 2.0 for rate in rates): break
for name, rate in zip(sorted(counts), rates): say(name, rate)
"""
INTENSITY = """
scan = rospy.wait_for_message("base_scan", LaserScan, 60)
say(max(scan.intensities), len(scan.ranges), scan.header.frame_id)
"""
COMMANDS = """
last = {}
rospy.Subscriber("base_pose_ground_truth", Odometry, lambda m: last.update(m=m))
drive = rospy.Publisher("cmd_vel", Twist, queue_size=1)
put = rospy.Publisher("cmd_pose", Pose, queue_size=1)
stamped = rospy.Publisher("cmd_pose_stamped", PoseStamped, queue_size=1)
def where(): return last["m"].pose.pose
def wait(true):
    end = time.time() + 60
    while not ("m" in last and true()):
        assert time.time() < end, "it did not come true"
        time.sleep(0.01)
wait(lambda: drive.get_num_connections() and put.get_num_connections() and stamped.get_num_connections())
wait(lambda: where().position.x == 0.0)

forward = Twist(); forward.linear.x = 0.5
def stands():
    before = where()
    rospy.sleep(0.6)
    return where() is not before and where() == before
while where().position.x < 0.05: drive.publish(forward); rospy.sleep(0.05)
while not stands(): pass
held = where().position.x
say("x", 0.03 < held < 9.0, where().position.y == 0.0, last["m"].twist.twist.linear.x == 0.0)

turn = Twist(); turn.angular.z = 0.5
while where().orientation.z < 0.02: drive.publish(turn); rospy.sleep(0.05)
while not stands(): pass
say("yaw", 0.01 < where().orientation.z < 1.0, where().position.x == held)

pose = Pose(); pose.position.x, pose.position.y, pose.position.z = 2.0, 3.0, 9.0
pose.orientation.z, pose.orientation.w = 0.6, 0.8
put.publish(pose)
wait(lambda: where().position.x == 2.0)
say("pose", where().position.y, where().position.z, round(where().orientation.z, 7))

message = PoseStamped(); message.header.frame_id = "anything"
message.pose.position.x = -1.0; message.pose.orientation.w = 1.0
stamped.publish(message)
wait(lambda: where().position.x == -1.0)
say("stamped", where().position.y, where().orientation.z)

rospy.ServiceProxy("reset_positions", Empty)()
wait(lambda: where().position.x == 0.0)
say("reset", where().position.y, where().orientation.w)
"""
TRANSFORMS = """
import tf2_ros
buffer = tf2_ros.Buffer(); listener = tf2_ros.TransformListener(buffer)
for target, source in (("robot_1/odom", "robot_1/base_laser_link"),
                       ("robot_0/odom", "robot_0/base_footprint")):
    t = buffer.lookup_transform(target, source, rospy.Time(0), rospy.Duration(60)).transform
    say(*(round(v, 6) + 0.0 for v in (t.translation.x, t.translation.y, t.translation.z)))
"""


@pytest.fixture(autouse=True)
def _installed():
    if not INSTALLED:
        pytest.skip("the real ROS 1 is not installed (Debian: ros-core python3-rospy)")


@pytest.mark.long
def test_topics_come_at_the_rate_of_the_steps(stage, running):
    world = stage("robot ( )", rate=1.0)
    running(world.server)
    with RealNode(world.master.uri, READY + RATES) as real:
        for name in ("base_scan", "odom"):
            got, rate = real.line().split()
            assert got == name
            assert float(rate) == pytest.approx(10.0, abs=2.0)


def test_intensities_are_returns_of_any_size(stage, running):
    world = stage(
        "robot ( ) "
        + "".join(
            f"model ( size [.5 .5 .5] pose [1 {y} 0 0] ranger_return {value} )"
            for y, value in ((-2, 0), (-1, 100), (0, 250), (1, 4000), (2, 1000000))
        )
    )
    running(world.server)
    with RealNode(world.master.uri, READY + INTENSITY) as real:
        highest, count, frame = real.line().split()
    assert float(highest) == 1e6
    assert (count, frame) == ("181", "base_laser_link")


@pytest.mark.long
def test_velocities_poses_and_reset(stage, running):
    world = stage("robot ( )", rate=1.0)
    running(world.server)
    with RealNode(world.master.uri, READY + COMMANDS) as real:
        real.expect(
            "x True True True",
            "yaw True True",
            "pose 3.0 0.0 0.6",
            "stamped 0.0 0.0",
            "reset 0.0 1.0",
        )


@pytest.mark.long
def test_tf2_takes_the_frames(stage, running):
    world = stage("robot ( pose [1 2 0 90] ) robot ( pose [3 4 0 90] )")
    running(world.server)
    with RealNode(world.master.uri, READY + TRANSFORMS) as real:
        real.expect("3.0 4.1 0.3", "1.0 2.0 0.0")
    assert math.isclose(world.sim.poses[0, 1, 1], 4.0)
