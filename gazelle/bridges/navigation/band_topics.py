"""The planner with TEB's parameters on a graph: obstacles, points to pass, and its bands."""

from __future__ import annotations

import logging
import threading

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.navigation.band_markers import band_markers
from gazelle.bridges.navigation.frames import GraphFrames
from gazelle.bridges.navigation.messages import fill_pose, stamped, twist_message
from gazelle.navigation.planners.planar import moved
from gazelle.navigation.planners.teb import TebPlanner
from gazelle.navigation.planners.teb_cost import Band
from gazelle.navigation.planners.teb_obstacles import BandObstacle
from gazelle.navigation.planners.teb_settings import TebSettings
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.msgs import (
    costmap_converter,
    geometry_msgs,
    nav_msgs,
    std_msgs,
    teb_local_planner,
    visualization_msgs,
)
from gazelle_ros.node import Node
from gazelle_ros.time import Duration, Time

_LOG = logging.getLogger("gazelle.navigation")


class BandTopics:
    """Topics ``obstacles``, ``via_points``, ``teb_poses``, ``teb_markers`` and ``teb_feedback``, and settings.

    They stand below the planner's name. dynamic_reconfigure changes the settings that it does in the original.

    Args:
        node: On the graph.
        planner: The planner.
        frames: Of the graph.
        lock: Of the planner.
    """

    def __init__(
        self, node: Node, planner: TebPlanner, frames: GraphFrames, lock: threading.RLock
    ) -> None:
        self._planner, self._frames, self._lock = planner, frames, lock
        name = f"~{planner.name}"
        feedback = teb_local_planner.msg.FeedbackMsg
        self._poses = node.advertise(f"{name}/teb_poses", geometry_msgs.msg.PoseArray, queue_size=1)
        self._feedback = node.advertise(f"{name}/teb_feedback", feedback, queue_size=1)
        marker = visualization_msgs.msg.Marker
        self._markers = node.advertise(f"{name}/teb_markers", marker, queue_size=1000)
        TunedSettings(node, planner.settings, self._tune, name)
        obstacles = costmap_converter.msg.ObstacleArrayMsg
        self._obstacles = obstacles()
        node.subscribe(f"{name}/obstacles", obstacles, self._receive_obstacles, 1)
        node.subscribe(f"{name}/via_points", nav_msgs.msg.Path, self._receive_vias, 1)

    def _tune(self, settings: TebSettings) -> None:
        with self._lock:
            self._planner.configure(settings)

    def publish(self, now: int) -> None:
        """Publish the bands of the last cycle, of a time [ns]."""
        bands, frame = self._planner.search.bands, self._planner.costmap.frame
        if self._markers.has_subscribers:
            header = std_msgs.msg.Header(stamp=Time(nsecs=now), frame_id=frame)
            for marker in band_markers(self._planner, header):
                self._markers.publish(marker)
        if not bands:
            return
        if self._poses.has_subscribers:
            message = geometry_msgs.msg.PoseArray()
            message.header.frame_id, message.header.stamp = frame, Time(nsecs=now)
            poses = bands[0].poses.tolist()
            message.poses = [stamped((x, y, yaw), frame, now).pose for x, y, yaw in poses]
            self._poses.publish(message)
        if self._planner.settings.publish_feedback and self._feedback.has_subscribers:
            feedback = teb_local_planner.msg.FeedbackMsg()
            feedback.header.frame_id, feedback.header.stamp = frame, Time(nsecs=now)
            for band in bands:
                trajectory = trajectory_message(band)
                trajectory.header = feedback.header
                feedback.trajectories.append(trajectory)
            feedback.obstacles_msg = self._obstacles
            self._feedback.publish(feedback)

    def _receive_obstacles(self, message: costmap_converter.msg.ObstacleArrayMsg) -> None:
        frame = self._planner.costmap.frame
        source = message.header.frame_id.strip("/") or frame
        to_local = self._frames.pose(frame, source)
        if to_local is None:
            _LOG.warning(
                "obstacles are ignored: the frame '%s' is not known in '%s'", source, frame
            )
            return
        found = []
        for each in message.obstacles:
            corners = np.array([(point.x, point.y) for point in each.polygon.points])
            velocity = each.velocities.twist.linear
            numbers = np.array([*corners.ravel(), each.radius, velocity.x, velocity.y])
            if not len(corners) or not np.isfinite(numbers).all():
                _LOG.warning("ignoring an obstacle without corners or with non-finite numbers")
                continue
            radius = max(float(each.radius), 0.0) if len(corners) == 1 else 0.0
            # Velocities are given in the planner's frame, as in the original.
            found.append(
                BandObstacle(moved(corners, to_local), radius, np.array([velocity.x, velocity.y]))
            )
        with self._lock:
            self._planner.obstacles, self._obstacles = found, message

    def _receive_vias(self, message: nav_msgs.msg.Path) -> None:
        places = [each.pose.position for each in message.poses]
        points: Floats = np.array([(each.x, each.y) for each in places]).reshape(-1, 2)
        with self._lock:
            self._planner.vias = points[np.isfinite(points).all(axis=1)]


def trajectory_message(band: Band) -> teb_local_planner.msg.TrajectoryMsg:
    """Return poses, velocities and accelerations of a band, in its frame.

    Velocities are means of the intervals around a pose, 0 at both ends; accelerations are their slopes.
    """
    velocities = np.column_stack(band.velocities())
    ends = np.zeros((1, 3))
    means = np.vstack((ends, 0.5 * (velocities[1:] + velocities[:-1]), ends))
    times = band.arrivals()
    slopes = np.gradient(means, times, axis=0)
    message = teb_local_planner.msg.TrajectoryMsg()
    for pose, velocity, slope, time in zip(
        band.poses.tolist(), means.tolist(), slopes.tolist(), times.tolist(), strict=True
    ):
        point = teb_local_planner.msg.TrajectoryPointMsg()
        fill_pose(point.pose, tuple(pose))
        point.velocity, point.acceleration = twist_message(velocity), twist_message(slope)
        point.time_from_start = Duration(time)
        message.trajectory.append(point)
    return message
