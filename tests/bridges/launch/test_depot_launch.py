"""A fleet in a Stage world, each AGV with amcl and move_base of its own: wiring, goals, real clients."""

from __future__ import annotations

import math
import re
import subprocess
import sys

import pytest
from launching import Launched, environment
from ports import free_port
from ros.real import INSTALLED, RealNode, tool

import gazelle
from gazelle import assets
from gazelle.formats import load_map
from gazelle.navigation.move_base import navigation_stack
from gazelle.navigation.true_map import true_map
from gazelle.stage import stage_of
from gazelle.stage.bridge.naming import Naming
from gazelle_ros import Master
from gazelle_ros.launch import load_launch

PACKAGE = assets.root() / "fleet_stage"
DEPOT = PACKAGE / "launch" / "depot.launch"
NAMES = [f"robot_{number}" for number in range(4)]


@pytest.fixture(scope="module")
def plan():
    return load_launch([DEPOT])


@pytest.fixture(scope="module")
def depot():
    with gazelle.Simulation("depot", engine="planar", seed=0) as sim:
        yield sim


def parameters(plan, name):
    """Return the parameters below a node, nested."""
    whole = {}
    for path, each in plan.parameters.items():
        head, _, rest = path.partition(f"/{name}/")
        if not head and rest:
            *groups, last = rest.split("/")
            place = whole
            for group in groups:
                place = place.setdefault(group, {})
            place[last] = each.value
    return whole


def test_the_map_is_the_floor_of_the_world(depot):
    served, true = load_map(PACKAGE / "maps" / "depot.yaml"), true_map(depot.world, 0.3, margin=0.0)
    assert (served.origin.x, served.origin.y) == pytest.approx((true.origin.x, true.origin.y))
    assert served.data.shape == true.data.shape
    assert ((served.data == 100) == (true.data == 100)).mean() > 0.999


def test_there_is_one_map_and_a_stack_for_each(plan):
    nodes = sorted(each.full_name for each in plan.nodes)
    stacks = [f"/{name}/{node}" for name in NAMES for node in ("amcl", "move_base")]
    assert nodes == sorted(["/map_server", "/stageros", *stacks])


@pytest.mark.parametrize("name", NAMES)
def test_all_start_where_the_world_has_them(plan, depot, name):
    amcl = parameters(plan, f"{name}/amcl")
    x, y, yaw = stage_of(depot).poses[0, NAMES.index(name)]
    assert [amcl["initial_pose_x"], amcl["initial_pose_y"]] == pytest.approx([x, y])
    assert math.remainder(amcl["initial_pose_a"] - yaw, 2 * math.pi) == pytest.approx(0, abs=1e-4)


@pytest.mark.parametrize("name", NAMES)
def test_frames_of_the_stack_are_those_that_stage_sends(plan, depot, name):
    amcl, move_base = (parameters(plan, f"{name}/{node}") for node in ("amcl", "move_base"))
    stack, naming = navigation_stack(move_base), Naming(list(depot.robots))
    odom, base = (naming.frame(NAMES.index(name), each) for each in ("odom", "base_footprint"))
    assert (amcl["odom_frame_id"], amcl["base_frame_id"]) == (odom, base)
    assert (stack.whole.costmap.frame, stack.local.costmap.frame) == ("map", odom)
    assert stack.whole.base_frame == stack.local.base_frame == base
    scans = {dict(node.remappings).get("scan") for node in plan.nodes if node.type == "amcl"}
    assert scans == {"base_scan"}


def launch(folder, *words, timeout):
    command = [sys.executable, "-m", "gazelle", "launch", "fleet_stage", "depot.launch", *words]
    return subprocess.run(
        [*command, "-p", str(free_port())],
        cwd=folder, capture_output=True, text=True, timeout=timeout, check=False,
        env=environment("", "", folder),
    )  # fmt: skip


@pytest.mark.slow
def test_all_reach_their_goals(tmp_path):
    done = launch(tmp_path, "goals:=true", "rounds:=3", timeout=900)
    assert "12 of 12 goals reached" in done.stdout, done.stdout[-3000:] + done.stderr[-3000:]
    assert done.stdout.count("Goal reached.") == 12


CLIENT = """
import math, actionlib, tf, tf2_ros
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseWithCovarianceStamped
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import OccupancyGrid, Odometry
from nav_msgs.srv import GetPlan, GetPlanRequest
rospy.init_node("real")
client = actionlib.SimpleActionClient("/robot_0/move_base", MoveBaseAction)
assert client.wait_for_server(rospy.Duration(300))
goal = MoveBaseGoal()
goal.target_pose.header.frame_id = "map"
goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = -7.0, 4.5
goal.target_pose.pose.orientation.w = 1.0
request = GetPlanRequest(goal=goal.target_pose, tolerance=0.2)
request.start.header.frame_id = "map"
request.start.pose.position.x, request.start.pose.position.y = -8.5, 4.5
request.start.pose.orientation.w = 1.0
rospy.wait_for_service("/robot_0/move_base/make_plan", 300)
plan = rospy.ServiceProxy("/robot_0/move_base/make_plan", GetPlan)(request).plan
say("plan", plan.header.frame_id, len(plan.poses) > 10)
seen = []
client.send_goal(goal, feedback_cb=lambda m: seen.append(m.base_position.header.frame_id))
assert client.wait_for_result(rospy.Duration(300))
say("result", client.get_state() == GoalStatus.SUCCEEDED, client.get_goal_status_text(), set(seen))
buffer = tf2_ros.Buffer(); listener = tf2_ros.TransformListener(buffer)
at = buffer.lookup_transform("map", "robot_0/base_link", rospy.Time(0), rospy.Duration(60)).transform
true = rospy.wait_for_message("/robot_0/base_pose_ground_truth", Odometry, 60).pose.pose.position
say("tf2", math.hypot(at.translation.x - true.x, at.translation.y - true.y) < 0.2)
old = tf.TransformListener()
old.waitForTransform("map", "robot_0/base_laser_link", rospy.Time(0), rospy.Duration(60))
place, _ = old.lookupTransform("map", "robot_0/base_laser_link", rospy.Time(0))
say("tf", math.hypot(place[0] + 7.0, place[1] - 4.5) < 0.8)
found = rospy.wait_for_message("/robot_0/amcl_pose", PoseWithCovarianceStamped, 60)
say("amcl", found.header.frame_id, math.hypot(found.pose.pose.position.x + 7.0, found.pose.pose.position.y - 4.5) < 0.5)
cost = rospy.wait_for_message("/robot_0/move_base/global_costmap/costmap", OccupancyGrid, 60)
say("costmap", cost.info.width, cost.info.height, max(cost.data))
"""


@pytest.mark.slow
@pytest.mark.ros
def test_real_rospy_sends_goals_and_hears_where_an_agv_is(tmp_path):
    if not INSTALLED:
        pytest.skip("the real ROS 1 is not installed (Debian: ros-core python3-rospy)")
    with (
        Master(port=0) as master,
        Launched(master.uri, "", tmp_path, "fleet_stage depot.launch") as launched,
    ):
        launched.wait_for([], {"/robot_0/amcl_pose", "/robot_0/cmd_vel"}, set())
        with RealNode(master.uri, CLIENT) as real:
            real.expect(
                "plan map True", "result True Goal reached. {'map'}", "tf2 True", "tf True",
                "amcl map True", "costmap 400 240 100",
            )  # fmt: skip
        said = tool(master.uri, "rostopic", "echo", "-n", "1", "/robot_0/amcl_pose")
        assert re.search(r"frame_id: \"?map\"?", said), said
        assert len(re.search(r"covariance: \[(.*?)\]", said, re.DOTALL)[1].split(",")) == 36
        kind = tool(master.uri, "rostopic", "type", "/robot_0/amcl_pose").strip()
        assert kind == "geometry_msgs/PoseWithCovarianceStamped"
