"""Topics of the planner with TEB's parameters: obstacles come in, bands go out."""

import threading
from contextlib import ExitStack

import numpy as np
import pytest
from navigation.planners.car_drives import ROOMS, costmaps
from ros.graph import until

from gazelle.bridges.navigation.band_topics import BandTopics, trajectory_message
from gazelle.bridges.navigation.frames import GraphFrames
from gazelle.navigation.planners.plugins import STOP
from gazelle.navigation.planners.teb import TebPlanner
from gazelle.navigation.planners.teb_cost import Band
from gazelle_ros import Master, Node, load_message


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
            return poses and feedback

        until(shown)
        band = planner.search.bands[0]
        assert [each.position.x for each in poses[0].poses] == pytest.approx(band.poses[:, 0])
        assert poses[0].header.frame_id == "odom"
        assert len(feedback[0].trajectories) == len(planner.search.bands)
        assert len(feedback[0].obstacles_msg.obstacles) == 4


def test_a_trajectory_has_the_velocities_and_accelerations_of_its_band():
    poses = np.zeros((4, 3))
    poses[:, 0] = 0.0, 0.1, 0.3, 0.4
    points = trajectory_message(Band(poses, np.full(3, 0.5))).trajectory
    assert [each.velocity.linear.x for each in points] == pytest.approx([0.0, 0.3, 0.3, 0.0])
    assert [each.acceleration.linear.x for each in points] == pytest.approx([0.6, 0.3, -0.3, -0.6])
    assert [each.time_from_start.to_sec() for each in points] == [0.0, 0.5, 1.0, 1.5]
