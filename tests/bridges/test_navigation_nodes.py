"""Nodes of navigation on a small graph: a robot in an empty room, driven by hand."""

from __future__ import annotations

import math
import threading

import numpy as np
import pytest
from ros.graph import until

from gazelle.bridges.navigation.amcl import AmclNode
from gazelle.bridges.navigation.diagnosis import NavigationWarning, StartDiagnosis
from gazelle.bridges.navigation.frames import missing_links
from gazelle.bridges.navigation.gmapping import GmappingNode
from gazelle.bridges.navigation.hector import HectorNode
from gazelle.bridges.navigation.karto import KartoNode
from gazelle.bridges.navigation.map_server import MapService
from gazelle.bridges.navigation.messages import wrong_quaternion
from gazelle.bridges.navigation.move_base import MoveBaseNode
from gazelle.description import Pose
from gazelle.description.occupancy import OccupancyMap
from gazelle_ros import Master, Node, Time, load_message, load_service
from gazelle_ros.actions import GoalStatus, SimpleActionClient
from gazelle_ros.clock import SimulatedClock
from gazelle_ros.tf import FrameTree

ROOM = np.zeros((80, 80), np.int8)
ROOM[[0, -1]] = ROOM[:, [0, -1]] = 100
DWA = {"max_vel_y": 0.0, "min_vel_y": 0.0, "vy_samples": 0, "vx_samples": 8, "acc_lim_trans": 1.0}
COSTMAP = {
    "robot_base_frame": "base_footprint", "robot_radius": 0.1, "observation_sources": "scan",
    "scan": {"data_type": "LaserScan", "topic": "scan", "marking": True, "clearing": True},
}  # fmt: skip
PLUGINS = [
    {"name": "static_layer", "type": "costmap_2d::StaticLayer"},
    {"name": "obstacle_layer", "type": "costmap_2d::ObstacleLayer"},
    {"name": "inflation_layer", "type": "costmap_2d::InflationLayer"},
]
NESTED = {"plugins": PLUGINS, "robot_base_frame": "base_footprint", "robot_radius": 0.1,
          "publish_frequency": 5.0, "obstacle_layer": COSTMAP}  # fmt: skip
MOVE_BASE = {
    "base_local_planner": "dwa_local_planner/DWAPlannerROS",
    "controller_frequency": 10.0,
    "planner_patience": 0.3,
    "recovery_behavior_enabled": False,
    "DWAPlannerROS": DWA,
    "global_costmap": {**NESTED, "global_frame": "map"},
    "local_costmap": {**NESTED, "global_frame": "odom", "plugins": PLUGINS[1:], "rolling_window": True,
                      "width": 3, "height": 3},
}  # fmt: skip


class Room:
    """A robot in a room, whose time, place and scans are the test's."""

    def __init__(self, uri):
        self.uri = uri
        self.clock = SimulatedClock()
        self.now = 0
        self.pose = [2.0, 2.0, 0.0]
        self.speed = (0.0, 0.0)
        self.node = Node("/robot", master_uri=uri, clock=self.clock)
        tf = load_message("tf2_msgs/TFMessage")
        self._tf = self.node.advertise("/tf", tf)
        self._scans = self.node.advertise("/scan", load_message("sensor_msgs/LaserScan"))
        self._odoms = self.node.advertise("/odom", load_message("nav_msgs/Odometry"))
        self.node.subscribe("/cmd_vel", load_message("geometry_msgs/Twist"), self._hear)
        self.serve_map()
        self.tick()

    def serve_map(self):
        MapService(self.node, OccupancyMap(ROOM, 0.05, Pose()))

    def _hear(self, message):
        self.speed = message.linear.x, message.angular.z

    def make(self, name, kind, parameters):
        self.node.set_param(name, parameters)
        return kind(Node(name, master_uri=self.uri, clock=self.clock))

    def tick(self, *, located=True):
        """Advance by a tenth of a second."""
        self.now += 100_000_000
        self.clock.set(self.now)
        forward, turn = self.speed
        self.pose[2] += 0.1 * turn
        self.pose[0] += 0.1 * forward * math.cos(self.pose[2])
        self.pose[1] += 0.1 * forward * math.sin(self.pose[2])
        links = [("odom", "base_footprint", self.pose), ("base_footprint", "base_scan", (0, 0, 0))]
        links += [("map", "odom", (0, 0, 0))] * located
        self._tf.publish(
            load_message("tf2_msgs/TFMessage")(transforms=[self._link(*each) for each in links])
        )
        odometry = load_message("nav_msgs/Odometry")()
        odometry.twist.twist.linear.x, odometry.twist.twist.angular.z = self.speed
        self._odoms.publish(odometry)
        self._scans.publish(self.scan())

    def _link(self, parent, child, pose):
        made = load_message("geometry_msgs/TransformStamped")()
        made.header.frame_id, made.child_frame_id = parent, child
        made.header.stamp = Time(nsecs=self.now)
        made.transform.translation.x, made.transform.translation.y = float(pose[0]), float(pose[1])
        made.transform.rotation.z = math.sin(pose[2] / 2)
        made.transform.rotation.w = math.cos(pose[2] / 2)
        return made

    def scan(self):
        made = load_message("sensor_msgs/LaserScan")()
        made.header.frame_id, made.header.stamp = "base_scan", Time(nsecs=self.now)
        angles = np.radians(np.arange(0.0, 360.0, 2.0))
        cos, sin = np.cos(angles + self.pose[2]), np.sin(angles + self.pose[2])
        with np.errstate(divide="ignore"):
            x = np.where(cos > 0, 3.95 - self.pose[0], 0.05 - self.pose[0]) / cos
            y = np.where(sin > 0, 3.95 - self.pose[1], 0.05 - self.pose[1]) / sin
        made.angle_increment, made.range_min, made.range_max = math.radians(2.0), 0.1, 6.0
        made.angle_max = math.radians(358.0)
        made.ranges = np.minimum(np.abs(x), np.abs(y)).tolist()
        return made


@pytest.fixture
def room():
    with Master(port=0) as master:
        made = Room(master.uri)
        made.nodes = [made.node]
        yield made
        for node in reversed(made.nodes):
            node.close()


@pytest.fixture
def move_base(room):
    made = room.make("/move_base", MoveBaseNode, MOVE_BASE)
    room.nodes.append(made._node)

    def ready():
        room.tick()
        made.cycle()
        return made._started

    until(ready)
    return made


@pytest.fixture
def client(room, move_base):
    made = SimpleActionClient(
        room.node, "/move_base", load_message("move_base_msgs/MoveBaseAction")
    )
    assert made.wait_for_server(60.0)
    return made


def goal_message(x, y, w=1.0):
    goal = load_message("move_base_msgs/MoveBaseGoal")()
    goal.target_pose.header.frame_id = "map"
    goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = x, y
    goal.target_pose.pose.orientation.w = w
    return goal


def carry_out(room, move_base, client):
    def done():
        room.tick()
        move_base.cycle()
        return client.get_state() in {
            GoalStatus.SUCCEEDED,
            GoalStatus.ABORTED,
            GoalStatus.PREEMPTED,
        }

    until(done)
    return client.get_state(), client.get_goal_status_text()


def test_a_goal_of_the_action_is_reached(room, move_base, client):
    client.send_goal(goal_message(3.0, 2.5))
    assert carry_out(room, move_base, client) == (GoalStatus.SUCCEEDED, "Goal reached.")
    assert math.dist(room.pose[:2], (3.0, 2.5)) < 0.15


def test_a_simple_goal_is_one_of_the_action(room, move_base):
    current, plans = [], []
    room.node.subscribe(
        "/move_base/current_goal", load_message("geometry_msgs/PoseStamped"), current.append
    )
    room.node.subscribe("/move_base/NavfnROS/plan", load_message("nav_msgs/Path"), plans.append)
    simple = room.node.advertise(
        "/move_base_simple/goal", load_message("geometry_msgs/PoseStamped"), latch=True
    )
    simple.publish(goal_message(2.6, 2.0).target_pose)

    def there():
        room.tick()
        move_base.cycle()
        return math.dist(room.pose[:2], (2.6, 2.0)) < 0.15

    until(there)
    until(lambda: current and plans)
    assert current[0].pose.position.x == pytest.approx(2.6)
    assert plans[0].header.frame_id == "map"


def test_a_goal_without_a_plan_is_aborted_with_the_known_words(room, move_base, client):
    client.send_goal(goal_message(30.0, 2.0))
    state, text = carry_out(room, move_base, client)
    assert state == GoalStatus.ABORTED
    assert text == "Failed to find a valid plan. Even after executing recovery behaviors."


@pytest.mark.parametrize(
    ("goal", "reason"),
    [
        ((2.5, 2.0, 0.0), "it was sent with an invalid quaternion"),
        ((math.nan, 2.0, 1.0), "its position is not finite"),
    ],
)
def test_a_goal_without_meaning_is_refused(room, move_base, client, goal, reason):
    x, y, w = goal
    client.send_goal(goal_message(x, y, w=w))
    state, text = carry_out(room, move_base, client)
    assert state == GoalStatus.ABORTED
    assert text == f"Aborting on goal because {reason}"


def test_a_cancelled_goal_is_preempted_and_the_robot_stands(room, move_base, client):
    client.send_goal(goal_message(3.5, 3.5))

    def moves():
        room.tick()
        move_base.cycle()
        return room.speed[0] > 0.05

    until(moves)
    client.cancel_goal()
    assert carry_out(room, move_base, client)[0] == GoalStatus.PREEMPTED
    until(lambda: room.speed == (0.0, 0.0))


def test_a_plan_is_made_without_going(room, move_base):
    service = load_service("nav_msgs/GetPlan")
    request = service._request_class()
    request.start, request.goal = goal_message(1, 1).target_pose, goal_message(3, 3).target_pose
    plan = room.node.client("/move_base/make_plan", service).call(request, 30.0).plan
    assert plan.header.frame_id == "map"
    assert plan.poses[0].pose.position.x == pytest.approx(1.0, abs=0.06)
    assert plan.poses[-1].pose.position.y == pytest.approx(3.0)
    request.goal = goal_message(4.05, 3.0).target_pose
    request.tolerance = 0.6
    assert len(room.node.client("/move_base/make_plan", service).call(request, 30.0).plan.poses) > 5


def test_a_global_planner_publishes_its_plan_and_potential(room):
    values = {
        **MOVE_BASE,
        "base_global_planner": "global_planner/GlobalPlanner",
        "GlobalPlanner": {"publish_scale": 50},
    }
    move_base = room.make("/move_base", MoveBaseNode, values)
    room.nodes.append(move_base._node)
    grids, plans = [], []
    topic = "/move_base/GlobalPlanner"
    room.node.subscribe(f"{topic}/potential", load_message("nav_msgs/OccupancyGrid"), grids.append)
    room.node.subscribe(f"{topic}/plan", load_message("nav_msgs/Path"), plans.append)

    def located():
        room.tick()
        move_base.cycle()
        return move_base._started

    until(located)
    service = load_service("nav_msgs/GetPlan")
    request = service._request_class()
    request.start, request.goal = (
        goal_message(1.01, 1.01).target_pose,
        goal_message(3.01, 3.01).target_pose,
    )

    def shown():
        found = room.node.client(f"{topic}/make_plan", service).call(request, 30.0).plan
        assert found.poses[0].pose.position.x == pytest.approx(1.01)
        return grids and plans

    until(shown)
    info = grids[0].info
    assert (grids[0].header.frame_id, info.width, info.height) == ("map", 80, 80)
    cells = np.array(grids[0].data).reshape(80, 80)
    assert cells[20, 20] == 0
    assert cells.max() == 50
    assert cells[0].tolist() == [-1] * 80
    assert cells[20, 20] < cells[30, 30] < cells[50, 50] < cells[60, 60]
    assert plans[0].poses[-1].pose.position.y == pytest.approx(3.01)
    service = load_service("dynamic_reconfigure/Reconfigure")
    tuned = room.node.client(f"{topic}/set_parameters", service)
    request = service._request_class()
    request.config.ints = [
        load_message("dynamic_reconfigure/IntParameter")(name=name, value=value)
        for name, value in (("neutral_cost", 70), ("orientation_mode", 9))
    ]
    request.config.bools = [
        load_message("dynamic_reconfigure/BoolParameter")(name="publish_potential", value=False)
    ]
    answer = tuned.call(request, 30.0).config
    assert {each.name: each.value for each in answer.ints}["orientation_mode"] == 6
    planner = move_base._law.planner
    assert planner.settings.neutral_cost == planner.traversal_costs()[0] == 70
    assert planner.on_potential is None


def test_costmaps_are_published_and_cleared(room, move_base):
    grids = []
    room.node.subscribe(
        "/move_base/global_costmap/costmap", load_message("nav_msgs/OccupancyGrid"), grids.append
    )

    def shown():
        room.tick()
        move_base.cycle()
        return grids

    until(shown)
    cells = np.array(grids[0].data).reshape(80, 80)
    assert cells[0].tolist() == [100] * 80
    assert cells[40, 40] == 0
    empty = load_service("std_srvs/Empty")
    room.node.client("/move_base/clear_costmaps", empty).call(empty._request_class(), 30.0)
    room.tick()
    move_base.cycle()
    assert (move_base.stack.whole.costmap.cells[0] == 254).all()


# amcl ------------------------------------------------------------------------------------


def spin_amcl(room, node, done):
    def step():
        room.tick(located=False)
        node._scans.work(node._find, node._use)
        return done()

    until(step)


def test_amcl_says_where_the_robot_is(room):
    amcl = room.make("/amcl", AmclNode, {
        "base_frame_id": "base_footprint", "initial_pose_x": 2.1, "initial_pose_y": 1.9,
        "initial_cov_xx": 0.02, "initial_cov_yy": 0.02, "initial_cov_aa": 0.01, "min_particles": 300,
        "max_particles": 500, "transform_tolerance": 0.5,
    })  # fmt: skip
    room.nodes.append(amcl._node)
    amcl._take_map(OccupancyMap(ROOM, 0.05, Pose()))
    poses, tree = [], amcl.frames.tree
    kind = load_message("geometry_msgs/PoseWithCovarianceStamped")
    room.node.subscribe("/amcl_pose", kind, poses.append)
    spin_amcl(room, amcl, lambda: poses and tree.has("map"))
    empty = load_service("std_srvs/Empty")
    for _ in range(8):
        room.node.client("/request_nomotion_update", empty).call(empty._request_class(), 30.0)
        count = len(poses)
        spin_amcl(room, amcl, lambda before=count: len(poses) > before)
    place = poses[-1].pose.pose.position
    assert (place.x, place.y) == pytest.approx((2.0, 2.0), abs=0.1)
    assert poses[-1].pose.covariance[0] < 0.02
    # The transform is dated ahead.
    until(lambda: tree.latest_common_time("map", "odom") > room.now)
    amcl._save()
    assert room.node.get_param("/amcl/initial_pose_x") == pytest.approx(2.0, abs=0.1)


def test_amcl_begins_where_it_is_told_and_is_tuned(room):
    amcl = room.make("/amcl", AmclNode, {"base_frame_id": "base_footprint"})
    room.nodes.append(amcl._node)
    amcl._take_map(OccupancyMap(ROOM, 0.05, Pose()))
    kind = load_message("geometry_msgs/PoseWithCovarianceStamped")
    message = kind()
    message.header.frame_id = "map"
    message.pose.pose.position.x, message.pose.pose.orientation.w = 3.0, 1.0
    message.pose.covariance = [0.0] * 36
    amcl._begin(message)
    assert np.allclose(amcl._localizer.filter.poses, [3.0, 0.0, 0.0])
    empty = load_service("std_srvs/Empty")
    room.node.client("/global_localization", empty).call(empty._request_class(), 30.0)
    assert amcl._localizer.filter.poses[:, :2].std() > 0.5
    service = load_service("dynamic_reconfigure/Reconfigure")
    request = service._request_class()
    request.config.ints = [
        load_message("dynamic_reconfigure/IntParameter")(name="max_particles", value=700)
    ]
    room.node.client("/amcl/set_parameters", service).call(request, 30.0)
    assert amcl.settings.max_particles == 700
    assert room.node.get_param("/amcl/max_particles") == 700


def start_message(x, frame="map", stamp=0):
    message = load_message("geometry_msgs/PoseWithCovarianceStamped")()
    message.header.frame_id, message.header.stamp = frame, Time(nsecs=stamp)
    message.pose.pose.position.x, message.pose.pose.orientation.w = x, 1.0
    message.pose.covariance = [0.0] * 36
    return message


def test_amcl_remembers_a_pose_that_comes_before_the_map(room):
    amcl = room.make("/amcl", AmclNode, {"base_frame_id": "base_footprint"})
    room.nodes.append(amcl._node)
    until(lambda: amcl.frames.latest("odom", "base_footprint") or room.tick(located=False))
    given = amcl.frames.latest("odom", "base_footprint")
    amcl._begin(start_message(1.0, stamp=given))
    room.speed = (1.0, 0.0)
    for _ in range(5):
        room.tick(located=False)
    until(lambda: amcl.frames.latest("odom", "base_footprint") >= room.now)
    amcl._take_map(OccupancyMap(ROOM, 0.05, Pose()))
    moved = (room.now - given) / 1e9
    assert np.allclose(amcl._localizer.filter.poses[0], [1.0 + moved, 0.0, 0.0])
    # A second map begins where parameters say, as that pose was for the first one.
    amcl._take_map(OccupancyMap(ROOM, 0.05, Pose()))
    assert abs(amcl._localizer.filter.poses[:, 0].mean()) < 0.2


def test_amcl_looks_everywhere_though_it_is_asked_before_there_is_a_map(room):
    amcl = room.make("/amcl", AmclNode, {"base_frame_id": "base_footprint"})
    room.nodes.append(amcl._node)
    empty = load_service("std_srvs/Empty")
    answers = []
    asking = threading.Thread(
        target=lambda: answers.append(
            room.node.client("/global_localization", empty).call(empty._request_class(), 60.0)
        )
    )
    asking.start()
    until(lambda: amcl._pending is not None)
    assert not answers, "it has not begun yet"
    amcl._take_map(OccupancyMap(ROOM, 0.05, Pose()))
    asking.join(60.0)
    assert answers
    assert amcl._localizer.filter.poses[:, :2].std() > 0.5


def test_amcl_that_has_its_map_from_a_topic_answers_before_it_came(room):
    values = {"base_frame_id": "base_footprint", "use_map_topic": True}
    amcl = room.make("/amcl", AmclNode, values)
    room.nodes.append(amcl._node)
    empty = load_service("std_srvs/Empty")
    room.node.client("/global_localization", empty).call(empty._request_class(), 60.0)
    amcl._take_map(OccupancyMap(ROOM, 0.05, Pose()))
    assert amcl._localizer.filter.poses[:, :2].std() > 0.5


def test_amcl_says_why_it_ignores_a_pose(room):
    amcl = room.make("/amcl", AmclNode, {"base_frame_id": "base_footprint"})
    room.nodes.append(amcl._node)
    amcl._take_map(OccupancyMap(ROOM, 0.05, Pose()))
    before = amcl._localizer.filter.poses.copy()
    with pytest.warns(NavigationWarning, match="pose in 'odom': give it in 'map'"):
        amcl._begin(start_message(1.0, frame="odom"))
    assert np.array_equal(amcl._localizer.filter.poses, before)
    amcl._begin(start_message(1.0, frame=""))
    assert np.allclose(amcl._localizer.filter.poses, [1.0, 0.0, 0.0])


AREA = {"xmin": -1, "ymin": -1, "xmax": 5, "ymax": 5, "temporalUpdate": 0.1, "particles": 2}


@pytest.mark.parametrize(
    ("node", "values", "walls"),
    [
        (GmappingNode, {**AREA, "map_update_interval": 0.1}, 40),
        # It waits for a second beam in a cell, and so for the robot to move.
        (KartoNode, {"map_update_interval": 0.1}, 0),
        (HectorNode, {"map_pub_period": 0.1, "map_size": 256, "map_resolution": 0.05}, 40),
    ],
)
def test_a_mapping_node_publishes_a_map_and_its_frame(room, node, values, walls):
    slam = room.make("/slam", node, {"base_frame": "base_footprint", **values})
    room.nodes.append(slam._node)
    maps = []
    # A map_server has the name here; it only has to be another message.
    room.node.subscribe("/map", load_message("nav_msgs/OccupancyGrid"), maps.append)
    spin_amcl(room, slam, lambda: any(each.info.width > 100 for each in maps))
    grid = next(each for each in maps if each.info.width > 100)
    cells = np.array(grid.data, np.int8).reshape(grid.info.height, grid.info.width)
    assert (cells == 100).sum() >= walls
    assert (cells == 0).sum() > 1000
    assert slam.place() is not None
    service = load_service("nav_msgs/GetMap")
    answer = room.node.client("/dynamic_map", service).call(service._request_class(), 30.0)
    assert answer.map.info.width == grid.info.width


def test_hector_mapping_is_reset_paused_and_put_elsewhere(room):
    hector = room.make(
        "/hector_mapping",
        HectorNode,
        {"base_frame": "base_footprint", "map_size": 256, "pub_odometry": True},
    )
    room.nodes.append(hector._node)
    poses, odometry = [], []
    room.node.subscribe("/scanmatch_odom", load_message("nav_msgs/Odometry"), odometry.append)
    room.node.subscribe("/slam_out_pose", load_message("geometry_msgs/PoseStamped"), poses.append)
    spin_amcl(room, hector, lambda: poses and odometry)
    assert odometry[0].child_frame_id == "base_footprint"
    assert odometry[0].pose.pose == next(
        each.pose for each in poses if each.header.stamp == odometry[0].header.stamp
    )
    assert poses[0].header.frame_id == "map"
    assert (hector.drawn().data != -1).any()
    switch = load_service("std_srvs/SetBool")
    room.node.client("/pause_mapping", switch).call(switch._request_class(data=True), 30.0)
    assert hector._paused
    reset = load_service("std_srvs/Trigger")
    assert room.node.client("/reset_map", reset).call(reset._request_class(), 30.0).success
    assert (hector.drawn().data == -1).all()
    message = load_message("geometry_msgs/PoseWithCovarianceStamped")()
    message.header.frame_id, message.pose.pose.orientation.w = "map", 1.0
    message.pose.pose.position.x = 1.5
    hector._begin(message)
    assert hector._start == pytest.approx((1.5, 0.0, 0.0))
    again = load_service("hector_mapping/ResetMapping")
    request = again._request_class()
    request.initial_pose.position.y = request.initial_pose.orientation.w = 1.0
    room.node.client("/restart_mapping_with_new_pose", again).call(request, 30.0)
    assert not hector._paused
    assert hector._start == pytest.approx((0.0, 1.0, 0.0))


# What is missing -------------------------------------------------------------------------


def test_missing_links_are_named_with_who_should_send_them():
    tree = FrameTree()
    tree.place("odom", "base", 1, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    found = missing_links(tree, "map", "odom", "base", "scan")
    assert len(found) == 2
    assert "'map' to 'odom' (amcl" in found[0]
    assert "'base' to 'scan' (robot_state_publisher" in found[1]


def test_the_warning_comes_once(room):
    said = StartDiagnosis(room.node, lambda: ["scans"], patience=0.0)
    with pytest.warns(NavigationWarning, match="/robot waits for: scans"):
        assert said.check(waiting=True)
    assert said.check(waiting=True) is None
    assert StartDiagnosis(room.node, lambda: ["scans"], patience=0.0).check(waiting=False) is None


def test_orientations_have_to_be_upright_quaternions():
    turn = load_message("geometry_msgs/Quaternion")
    assert wrong_quaternion(turn(0.0, 0.0, 0.6, 0.8)) is None
    assert "nans" in wrong_quaternion(turn(math.nan, 0.0, 0.0, 1.0))
    assert "zero" in wrong_quaternion(turn())
    assert "vertical" in wrong_quaternion(turn(0.7, 0.0, 0.0, 0.7))
