"""Poses and time of stage_ros: set pose, reset, pause, step, any speed."""

import math
import time

import pytest

from gazelle import RosError
from gazelle.stage.bridge import poses, serve_stage
from gazelle_ros import Node, WallClock, load_message
from gazelle_ros.messages import register

ROBOT = 'robot ( name "r" pose [1 2 0 90] )\n'
POSE, TWIST, EMPTY = "geometry_msgs/Pose", "geometry_msgs/Twist", "std_srvs/Empty"
TURNED = {"orientation__z": math.sin(0.25), "orientation__w": math.cos(0.25)}


def at(world, robot=0):
    """Return a pose between two steps: a message may be setting it on another thread."""
    with world.sim.lock:
        return world.sim.poses[0, robot].tolist()


def test_cmd_pose(stage):
    world = stage(ROBOT)
    world.send("/cmd_pose", POSE, position__x=3.0, position__y=4.0, position__z=9.0, **TURNED)
    world.until(lambda: at(world)[0] == 3.0)
    assert at(world) == pytest.approx([3.0, 4.0, 0.5])


def test_cmd_pose_is_seen_while_the_world_is_paused(stage):
    world = stage(ROBOT)
    truth = world.listen("/base_pose_ground_truth", "nav_msgs/Odometry")
    scan = world.listen("/base_scan", "sensor_msgs/LaserScan")
    world.call("/gazelle/pause", EMPTY)
    world.send("/cmd_pose", "geometry_msgs/Pose", position__x=4.0, orientation__w=1.0)
    world.until(lambda: truth and scan)
    assert truth[-1].pose.pose.position.x == 4.0


def test_cmd_pose_with_no_orientation_has_no_heading(stage):
    world = stage(ROBOT)
    world.send("/cmd_pose", POSE, position__x=3.0)
    world.until(lambda: at(world)[0] == 3.0)
    assert at(world) == [3.0, 0.0, 0.0]


def test_cmd_pose_stamped(stage):
    world = stage('robot ( ) robot ( name "b" pose [5 5 0 0] )')
    fields = {f"pose__{name}": value for name, value in TURNED.items()}
    world.send(
        "/robot_1/cmd_pose_stamped", "geometry_msgs/PoseStamped", pose__position__x=3.0, **fields
    )
    world.until(lambda: at(world, 1)[0] == 3.0)
    assert at(world, 1) == pytest.approx([3.0, 0.0, 0.5])


def test_cmd_pose_may_be_flat(stage):
    world = stage(ROBOT, {"cmd_pose_type": "Pose2D"})
    world.send("/cmd_pose", "geometry_msgs/Pose2D", x=3.0, y=4.0, theta=0.5)
    world.until(lambda: at(world)[0] == 3.0)
    assert at(world) == [3.0, 4.0, 0.5]


def test_a_pose_can_be_set_by_service(stage):
    world = stage('robot ( name "a" ) robot ( name "b" pose [5 5 0 0] )')
    odom = world.listen("/robot_1/odom", "nav_msgs/Odometry")
    kind = "gazelle_msgs/SetPose"
    pose = _pose(3.0, 4.0)
    assert world.call("/gazelle/set_pose", kind, name="b", pose=pose).success
    assert at(world, 1) == [3.0, 4.0, 0.0]
    world.until(lambda: odom)
    assert odom[-1].pose.pose.position.x == 3.0
    assert world.call("/gazelle/set_pose", kind, name="robot_0", pose=_pose(7.0, 0.0)).success
    assert at(world, 0)[0] == 7.0
    answer = world.call("/gazelle/set_pose", kind, name="c", pose=pose)
    assert not answer.success
    assert "there is no robot 'c'" in answer.status_message
    answer = world.call("/gazelle/set_pose", kind, name="robot_2", pose=pose)
    assert "there are robot_0 to robot_1" in answer.status_message
    answer = world.call("/gazelle/set_pose", kind, name="a", pose=_pose(math.nan, 0.0))
    assert "not finite" in answer.status_message


def _pose(x, y):
    pose = load_message(POSE)()
    pose.position.x, pose.position.y = x, y
    return pose


AGV_POSE = "---\nfloat64 x\nfloat64 y\nfloat64 angle\n"


def test_each_robot_tells_its_pose_by_a_service_of_the_users_type(stage):
    register("test_agv", "AgvPose", AGV_POSE, "srv")
    world = stage("robot ( ) robot ( pose [3 4 0 90] )", {"pose_service": "test_agv/AgvPose"})
    answer = world.call("/robot_1/get_pose", "test_agv/AgvPose")
    assert (answer.x, answer.y) == (3.0, 4.0)
    assert answer.angle == pytest.approx(90.0)
    assert world.call("/robot_0/get_pose", "test_agv/AgvPose").x == 0.0


def test_without_the_type_there_is_no_such_service(stage, monkeypatch):
    # Other tests of this process may have registered the usual one.
    monkeypatch.setattr(poses, "USUAL_TYPE", "nowhere/AgvPose")
    world = stage(ROBOT)
    services = list(world.node.master.system_state()[2])
    assert "/reset_positions" in services
    assert not any("get_pose" in name for name in services)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("---\nstring x\nfloat64 y\n", "x is of type string; write 'float64 x'"),
        ("float64 x\n---\n", "cannot hold a pose"),
        ("---\nflaot64 x\n", "odd_agv/AgvPoseResponse: .*did you mean 'float64'"),
    ],
)
def test_a_type_that_cannot_hold_a_pose_is_refused_at_the_start(stage, text, said):
    register("odd_agv", "AgvPose", text, "srv")
    with pytest.raises(RosError, match=said):
        stage("robot ( )", {"pose_service": "odd_agv/AgvPose"})


def test_a_pose_service_of_an_unknown_type_is_an_error(stage):
    with pytest.raises(RosError, match="nothing is known of the package"):
        stage(ROBOT, {"pose_service": "nowhere/Pose"})


def test_reset_positions_puts_robots_back_and_at_rest(stage):
    world = stage('robot ( pose [1 2 0 90] localization "odom" )')
    world.send("/cmd_vel", TWIST, linear__x=0.5)
    world.until(world.sim.commands.any)
    world.step(count=2)
    world.call("/reset_positions", EMPTY)
    assert at(world) == pytest.approx([1.0, 2.0, math.pi / 2])
    assert not world.sim.commands.any()
    assert not world.sim.odometry.any()
    assert world.sim.time == pytest.approx(0.2)
    world.step()
    assert at(world) == pytest.approx([1.0, 2.0, math.pi / 2])


def test_a_reset_starts_time_over(stage):
    world = stage(ROBOT)
    world.step(count=5)
    world.call("/gazelle/reset", EMPTY)
    assert world.sim.time == 0.0
    clock = world.listen("/clock", "rosgraph_msgs/Clock")
    world.step(clock)
    assert clock[-1].clock.to_sec() == pytest.approx(0.1)


def test_pause_and_step(stage, running):
    world = stage(ROBOT, rate=None)
    running(world.server)
    world.until(lambda: world.sim.time > 1.0)
    world.call("/gazelle/pause", EMPTY)
    held = world.sim.time
    time.sleep(0.1)
    assert world.sim.time == held
    answer = world.call("/gazelle/step", "gazelle_msgs/Step", steps=5)
    assert answer.success
    assert answer.time.to_sec() == pytest.approx(held + 0.5)
    assert world.sim.time == pytest.approx(held + 0.5)
    world.call("/gazelle/unpause", EMPTY)
    assert not world.call("/gazelle/step", "gazelle_msgs/Step", steps=5).success
    world.until(lambda: world.sim.time > held + 2.0)


def test_a_world_may_begin_paused(stage, running):
    world = stage("paused 1 " + ROBOT, rate=None)
    running(world.server)
    time.sleep(0.05)
    assert world.sim.time == 0.0
    world.call("/gazelle/unpause", EMPTY)
    world.until(lambda: world.sim.time > 0.0)


@pytest.mark.parametrize(("speedup", "rate"), [("4", 4.0), ("-1", None), ("0", None)])
def test_the_files_speedup_is_the_pace(stage, speedup, rate):
    assert stage(f"speedup {speedup} " + ROBOT).interface.rate == rate


def test_the_pace_is_kept(stage, running):
    world = stage("speedup 10 " + ROBOT)
    start = time.monotonic()
    running(world.server, 4.0).thread.join(60)
    assert world.sim.time == pytest.approx(4.0)
    assert time.monotonic() - start > 0.35


def test_the_pace_can_be_changed_while_it_runs(stage, running):
    world = stage("speedup 0.01 " + ROBOT)
    running(world.server)
    kind = "gazelle_msgs/SetRealTimeFactor"
    assert world.call("/gazelle/set_real_time_factor", kind, real_time_factor="inf").success
    world.until(lambda: world.sim.time > 20.0)
    answer = world.call("/gazelle/set_real_time_factor", kind, real_time_factor="fast")
    assert "a positive number or max" in answer.status_message


def test_quit_time_ends_the_run(stage, running):
    world = stage("quit_time 3 " + ROBOT, rate=None)
    running(world.server).thread.join(60)
    assert world.sim.time == pytest.approx(3.0)


def published(world):
    return dict(world.node.master.published_topics())


def test_a_graph_is_left_as_it_was(stage):
    world = stage(ROBOT)
    assert "/odom" in published(world)
    world.server.close()
    world.until(lambda: "/odom" not in published(world))
    world.sim.step()


def test_a_world_can_be_served_on_a_node_that_is_there(stage):
    world = stage(ROBOT)
    world.server.close()
    with Node("mine", master_uri=world.master.uri, clock=WallClock()) as node:
        with serve_stage(world.sim.simulation, node) as server:
            assert server.node is node
            assert "/odom" in published(world)
        assert not node.closed
        world.until(lambda: "/odom" not in published(world))
