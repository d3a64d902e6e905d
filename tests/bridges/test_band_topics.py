"""Topics of the planner with TEB's parameters: obstacles come in, bands go out."""

import threading
from contextlib import ExitStack

import numpy as np
import pytest
from navigation.planners.car_drives import ROOMS, costmaps
from ros.graph import until

from gazelle.bridges.navigation.band_markers import band_markers
from gazelle.bridges.navigation.band_topics import BandTopics, trajectory_message
from gazelle.bridges.navigation.frames import GraphFrames
from gazelle.navigation.planners.plugins import STOP
from gazelle.navigation.planners.teb import TebPlanner
from gazelle.navigation.planners.teb_cost import Band
from gazelle_ros import Master, Node, load_message, load_service


def obstacle(corners, radius=0.0, velocity=(0.0, 0.0)):
    found = load_message("costmap_converter/ObstacleMsg")()
    point = load_message("geometry_msgs/Point32")
    found.polygon.points = [point(x, y, 0.0) for x, y in corners]
    found.radius = radius
    found.velocities.twist.linear.x, found.velocities.twist.linear.y = velocity
    return found


def test_obstacles_and_points_to_pass_come_in_and_bands_go_out(caplog):
    running = ExitStack()
    master = running.enter_context(Master(port=0))
    node, user = (Node(name, master_uri=master.uri) for name in ("/move_base", "/user"))
    for each in (node, user):
        running.callback(each.close)
    planner = TebPlanner("teb", costmaps(ROOMS[0])[2], {"publish_feedback": True}, 0.2)
    planner.costmap.frame = "odom"
    topics = BandTopics(node, planner, GraphFrames(node), threading.RLock())
    poses, feedback = [], []
    kind = load_message("teb_local_planner/FeedbackMsg")
    user.subscribe("/move_base/teb/teb_feedback", kind, feedback.append)
    user.subscribe(
        "/move_base/teb/teb_poses", load_message("geometry_msgs/PoseArray"), poses.append
    )
    markers = {}
    user.subscribe(
        "/move_base/teb/teb_markers",
        load_message("visualization_msgs/Marker"),
        lambda each: markers.update({(each.ns, each.id): each}),
    )
    many, way, links = map(
        load_message, ("costmap_converter/ObstacleArrayMsg", "nav_msgs/Path", "tf2_msgs/TFMessage")
    )
    sent = user.advertise("/move_base/teb/obstacles", many)
    vias = user.advertise("/move_base/teb/via_points", way)
    frames = user.advertise("/tf", links, latch=True)
    link = load_message("geometry_msgs/TransformStamped")()
    link.header.frame_id, link.child_frame_id = "odom", "map"
    link.transform.translation.x, link.transform.rotation.w = 1.0, 1.0
    frames.publish(links(transforms=[link]))
    message = many()
    message.header.frame_id = "map"
    message.obstacles = [
        obstacle([(2.0, 1.0)], radius=0.3, velocity=(0.0, 0.5)),
        obstacle([(0.0, 4.0), (1.0, 4.0)], radius=0.3),
        obstacle([]),
        obstacle([(float("nan"), 0.0)]),
    ]
    path = way()
    path.poses = [load_message("geometry_msgs/PoseStamped")()]
    path.poses[0].pose.position.x = 2.0

    def received():
        sent.publish(message)
        vias.publish(path)
        return planner.obstacles and len(planner.vias)

    with running:
        until(received)
        circle, line = planner.obstacles
        assert circle.corners.tolist() == [[3.0, 1.0]]
        assert (circle.radius, circle.velocity.tolist()) == (0.3, [0.0, 0.5])
        assert (line.radius, line.moving) == (0.0, False)
        assert planner.vias.tolist() == [[2.0, 0.0]]
        assert "an obstacle without corners" in caplog.text
        planner.set_plan(np.linspace(ROOMS[0].start, ROOMS[0].goal, 30))
        assert planner.command(ROOMS[0].start, STOP, (0.0, 0.0, 0.0)) is not None

        def shown():
            topics.publish(1_000_000_000)
            return poses and feedback and len(markers) == 5

        until(shown)
        assert_markers(markers, planner)
        band = planner.search.bands[0]
        assert [each.position.x for each in poses[0].poses] == pytest.approx(band.poses[:, 0])
        assert poses[0].header.frame_id == "odom"
        assert len(feedback[0].trajectories) == len(planner.search.bands)
        assert len(feedback[0].obstacles_msg.obstacles) == 4


def assert_markers(markers, planner):
    """Check kind, place and colour of what is shown."""
    band = planner.search.bands[0]
    kind = load_message("visualization_msgs/Marker")
    lines = markers["TebContainer", 0]
    ways = np.array([(each.x, each.y) for each in lines.points]).reshape(-1, 2, 2)
    assert lines.type == kind.LINE_LIST
    assert len(ways) == sum(len(each.poses) - 1 for each in planner.search.bands)
    assert np.allclose(ways[: len(band.poses) - 1, 0], band.poses[:-1, :2])
    cells = markers["PointObstacles", 0]
    assert len(cells.points) == (planner.costmap.cells == 254).sum() > 0
    first = cells.points[0]
    assert planner.costmap.cost_at(first.x, first.y) == 254
    circle, line = markers["CircularObstacles", 0], markers["LineObstacles", 1]
    assert [(each.x, each.y) for each in circle.points] == [(3.0, 1.0)]
    assert (circle.scale.x, circle.color.g) == (pytest.approx(0.3), 1.0)
    assert [(each.x, each.y) for each in line.points] == [(1.0, 4.0), (2.0, 4.0)]
    assert [(each.x, each.y) for each in markers["ViaPoints", 0].points] == [(2.0, 0.0)]
    assert {each.header.frame_id for each in markers.values()} == {"odom"}


@pytest.mark.parametrize(
    ("model", "kind", "count"),
    [
        ({"type": "circular", "radius": 0.4}, "CYLINDER", 1),
        (
            {"type": "two_circles", "front_offset": 0.3, "front_radius": 0.2,
             "rear_offset": 0.1, "rear_radius": 0.3},
            "CYLINDER", 2,
        ),
        ({"type": "line", "line_start": [0.0, 0.0], "line_end": [0.4, 0.0]}, "LINE_STRIP", 1),
        ({"type": "point"}, "", 0),
    ],
)  # fmt: skip
def test_the_shape_of_the_robot_is_shown_where_its_band_begins(model, kind, count):
    planner = TebPlanner("teb", costmaps(ROOMS[0])[2], {"footprint_model": model}, 0.2)
    planner.set_plan(np.linspace(ROOMS[0].start, ROOMS[0].goal, 30))
    assert planner.command(ROOMS[0].start, STOP, (0.0, 0.0, 0.0)) is not None
    made = [
        each
        for each in band_markers(planner, load_message("std_msgs/Header")())
        if each.ns == "RobotFootprintModel"
    ]
    assert len(made) == count
    x, y, yaw = ROOMS[0].start
    for each, radius, away in zip(
        made, planner.footprint.radii, planner.footprint.centers[:, 0], strict=False
    ):
        assert each.type == getattr(each, kind)
        if kind == "CYLINDER":
            place = each.pose.position
            expected = (x + away * np.cos(yaw), y + away * np.sin(yaw))
            assert (place.x, place.y) == pytest.approx(expected)
            assert each.scale.x == each.scale.y == pytest.approx(2.0 * radius)


def test_settings_change_while_it_runs_within_their_limits():
    running = ExitStack()
    master = running.enter_context(Master(port=0))
    node, user = (Node(name, master_uri=master.uri) for name in ("/move_base", "/user"))
    for each in (node, user):
        running.callback(each.close)
    given = {"max_vel_x": 0.7, "weight_inflation": 50.0}
    planner = TebPlanner("teb", costmaps(ROOMS[0])[2], given, 0.2)
    service = load_service("dynamic_reconfigure/Reconfigure")
    with running:
        BandTopics(node, planner, GraphFrames(node), threading.RLock())
        assert planner.settings.weight_inflation == 10.0  # the greatest that is allowed
        request = service._request_class()
        number = load_message("dynamic_reconfigure/DoubleParameter")
        flag = load_message("dynamic_reconfigure/BoolParameter")
        request.config.doubles = [number("max_vel_x", 0.25), number("acc_lim_x", 1e9)]
        request.config.bools = [flag("include_dynamic_obstacles", True)]
        answer = user.client("/move_base/teb/set_parameters", service).call(request, 30.0)
        found = {each.name: each.value for each in answer.config.doubles}
        assert (found["max_vel_x"], found["acc_lim_x"]) == (0.25, 100.0)
        assert planner.settings.max_vel_x == planner.search._settings.max_vel_x == 0.25
        assert planner.settings.include_dynamic_obstacles
        assert node.get_param("/move_base/teb/max_vel_x") == 0.25


def test_a_trajectory_has_the_velocities_and_accelerations_of_its_band():
    poses = np.zeros((4, 3))
    poses[:, 0] = 0.0, 0.1, 0.3, 0.4
    points = trajectory_message(Band(poses, np.full(3, 0.5))).trajectory
    assert [each.velocity.linear.x for each in points] == pytest.approx([0.0, 0.3, 0.3, 0.0])
    assert [each.acceleration.linear.x for each in points] == pytest.approx([0.6, 0.3, -0.3, -0.6])
    assert [each.time_from_start.to_sec() for each in points] == [0.0, 0.5, 1.0, 1.5]
