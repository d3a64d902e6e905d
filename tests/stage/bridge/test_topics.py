"""Topics of a Stage world."""

import math

import pytest

ROBOT = 'robot ( name "r" pose [1 2 0 90] )\n'
WALL = "model ( size [8 1 2] pose [1 5.5 0 0] ranger_return 250 )\n"
ODOMETRY, SCAN, TWIST = "nav_msgs/Odometry", "sensor_msgs/LaserScan", "geometry_msgs/Twist"


def heading(quaternion):
    return 2.0 * math.atan2(quaternion.z, quaternion.w)


def drive(world, **fields):
    world.send("/cmd_vel", TWIST, **fields)
    wanted = fields.get("linear__x", 0.0)
    world.until(lambda: world.sim.commands[0, 0, 0] == wanted)


def test_odom_and_ground_truth(stage):
    world = stage(ROBOT)
    odom = world.listen("/odom", ODOMETRY)
    truth = world.listen("/base_pose_ground_truth", ODOMETRY)
    drive(world, linear__x=0.5, linear__y=0.0, angular__z=0.0)
    message = world.step(odom)
    world.until(lambda: truth)
    assert message.header.frame_id == "odom"
    assert message.child_frame_id == "base_footprint"
    assert (message.header.stamp.secs, message.header.stamp.nsecs) == (0, 100_000_000)
    assert message.pose.pose.position.x == pytest.approx(1.0)
    assert message.pose.pose.position.y == pytest.approx(2.05)
    assert heading(message.pose.pose.orientation) == pytest.approx(math.pi / 2)
    assert message.twist.twist.linear.x == pytest.approx(0.5)
    assert truth[-1].header.frame_id == "odom"
    assert truth[-1].pose.pose.position.y == pytest.approx(2.05)
    assert truth[-1].twist.twist.linear.y == pytest.approx(0.5)


def test_odometry_that_begins_at_zero(stage):
    world = stage('robot ( pose [1 2 0 90] localization "odom" odom_error [0 0 0 0] )')
    odom = world.listen("/odom", ODOMETRY)
    drive(world, linear__x=0.5)
    assert world.step(odom).pose.pose.position.x == pytest.approx(0.05)
    assert world.sim.poses[0, 0, 1] == pytest.approx(2.05)


def test_a_scan(stage):
    world = stage(ROBOT + WALL)
    message = world.step(world.listen("/base_scan", SCAN))
    assert message.header.frame_id == "base_laser_link"
    assert message.angle_min == pytest.approx(-math.pi / 2)
    assert message.angle_max == pytest.approx(math.pi / 2)
    assert message.angle_increment == pytest.approx(math.pi / 180)
    assert (message.range_min, message.range_max) == pytest.approx((0.1, 8.0))
    assert (message.time_increment, message.scan_time) == (0.0, 0.0)
    assert len(message.ranges) == len(message.intensities) == 181
    assert message.ranges[90] == pytest.approx(5.0 - 2.1)
    assert message.ranges[0] == 8.0
    assert message.intensities[90] == 250.0
    assert message.intensities[0] == 0.0


def test_transforms(stage):
    world = stage(ROBOT)
    message = world.step(world.listen("/tf", "tf2_msgs/TFMessage"))
    odom, base, laser = message.transforms
    assert (odom.header.frame_id, odom.child_frame_id) == ("odom", "base_footprint")
    assert odom.transform.translation.y == pytest.approx(2.0)
    assert heading(odom.transform.rotation) == pytest.approx(math.pi / 2)
    assert (base.header.frame_id, base.child_frame_id) == ("base_footprint", "base_link")
    assert base.transform.rotation.w == 1.0
    assert (laser.header.frame_id, laser.child_frame_id) == ("base_link", "base_laser_link")
    where = laser.transform.translation
    assert (where.x, where.y, where.z) == pytest.approx((0.1, 0.0, 0.3))


def test_the_clock_ticks_at_every_step_and_is_never_zero(stage):
    world = stage(ROBOT)
    clock = world.listen("/clock", "rosgraph_msgs/Clock")
    world.step(clock, count=3)
    world.until(lambda: clock[-1].clock.to_sec() > 0.25)
    # who comes is told the time once more, whenever the machine finds the time for it
    assert sorted({m.clock.to_sec() for m in clock}) == pytest.approx([0.1, 0.2, 0.3])


def test_a_node_that_comes_late_is_told_the_time(stage):
    world = stage(ROBOT)
    world.step(count=5)
    clock = world.listen("/clock", "rosgraph_msgs/Clock")
    world.until(lambda: clock)
    assert clock[0].clock.to_sec() == pytest.approx(0.5)


def test_a_stall_is_told(stage):
    world = stage("robot ( ) model ( size [1 1 1] pose [0.75 0 0 0] )")
    stall = world.listen("/stall", "std_msgs/Bool")
    crashed = world.listen("/is_crashed", "std_msgs/Int8")
    assert world.step(stall).data is False
    drive(world, linear__x=1.0)
    world.step(stall)
    world.until(lambda: len(crashed) == len(stall) == 2)
    assert (stall[-1].data, crashed[-1].data) == (True, 1)


def test_a_command_holds_until_the_watchdog_stops_it(stage):
    world = stage(ROBOT)
    drive(world, linear__x=0.5)
    world.step()
    assert world.sim.commands[0, 0, 0] == 0.5
    world.step(count=3)
    assert world.sim.commands[0, 0, 0] == 0.0
    assert world.sim.poses[0, 0, 1] == pytest.approx(2.1)


def test_each_robot_has_a_watchdog_of_its_own(stage):
    world = stage(
        'robot ( ) robot ( pose [0 3 0 0] )robot ( pose [0 9 0 0] ctrl "wander" )',
    )
    world.send("/robot_0/cmd_vel", TWIST, linear__x=0.5)
    world.until(lambda: world.sim.commands[0, 0, 0] == 0.5)
    world.step(count=2)
    world.send("/robot_1/cmd_vel", TWIST, linear__x=0.5)
    world.until(lambda: world.sim.commands[0, 1, 0] == 0.5)
    world.step()
    assert world.sim.commands[0, :, 0].tolist() == [0.0, 0.5, 0.4]
    world.step(count=3)
    assert world.sim.commands[0, :, 0].tolist() == [0.0, 0.0, 0.4]


@pytest.mark.parametrize("timeout", [0.0, -1.0])
def test_the_watchdog_can_be_turned_off(stage, timeout):
    world = stage(ROBOT, {"base_watchdog_timeout": timeout})
    drive(world, linear__x=0.5)
    world.step(count=50)
    assert world.sim.commands[0, 0, 0] == 0.5


def test_a_command_that_is_not_finite_changes_nothing(stage):
    world = stage(ROBOT)
    world.send("/cmd_vel", TWIST, linear__x=math.nan)
    drive(world, linear__x=0.25)
    world.step()
    assert world.sim.poses[0, 0, 1] == pytest.approx(2.025)


def test_topics_can_be_published_less_often_than_steps(stage):
    world = stage(ROBOT, {"publish_rate": 2.0})
    odom = world.listen("/odom", ODOMETRY)
    clock = world.listen("/clock", "rosgraph_msgs/Clock")
    world.step(clock, count=20)
    world.until(lambda: len(odom) >= 5)
    assert [m.header.stamp.to_sec() for m in odom] == pytest.approx([0.1, 0.5, 1.0, 1.5, 2.0])


def test_nothing_is_measured_when_nobody_listens(stage, monkeypatch):
    world = stage(ROBOT + WALL)
    measured, scan = [], world.sim.scan
    monkeypatch.setattr(
        world.sim.stage_fleet, "scan", lambda *which: measured.append(which) or scan(*which)
    )
    world.step(count=3)
    assert not measured
    world.step(world.listen("/base_scan", "sensor_msgs/LaserScan"))
    assert measured
