"""The topics of one robot, as stage_ros has them, and what people added to it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.stage import Ranger, StageFleet
from gazelle.stage.bridge.actuators import ActuatorTopics
from gazelle.stage.bridge.cameras import CameraTopics
from gazelle.stage.bridge.finders import FinderTopics
from gazelle.stage.bridge.grippers import GripperTopics
from gazelle.stage.bridge.place import GraphRobot
from gazelle_ros import Publisher, Time, load_message
from gazelle_ros.msgs import geometry_msgs, nav_msgs, sensor_msgs, std_msgs

Values = list[float]


@dataclass(frozen=True, slots=True)
class GraphState:
    """The state of all robots of the world that the graph sees, each a list by robot.

    Attributes:
        stamp: Time of the facts.
        odometry: Their odometry: x, y [m], heading [rad].
        velocity: In their own frames [m/s, rad/s].
        pose: Their poses.
        true_velocity: In the world's axes.
        stalled: Whether their last move was not made.
    """

    stamp: Time
    odometry: list[Values]
    velocity: list[Values]
    pose: list[Values]
    true_velocity: list[Values]
    stalled: list[bool]


def graph_state(simulation: StageFleet, world: int, stamp: Time) -> GraphState:
    """Return the state now; arrays become lists at once, as messages need them."""
    return GraphState(
        stamp,
        simulation.odometry[world].tolist(),
        simulation.velocities[world].tolist(),
        simulation.poses[world].tolist(),
        simulation.true_velocities[world].tolist(),
        simulation.stalled[world].tolist(),
    )


class Messages:
    """The classes of the messages, looked up once."""

    def __init__(self) -> None:
        self.odometry = nav_msgs.msg.Odometry
        self.scan = sensor_msgs.msg.LaserScan
        self.transform = geometry_msgs.msg.TransformStamped
        self.twist = geometry_msgs.msg.Twist
        self.bool = std_msgs.msg.Bool
        self.int8 = std_msgs.msg.Int8


@dataclass(frozen=True, slots=True)
class _Laser:
    """A ranger that is published: its first sensor, as in stage_ros."""

    ranger: Ranger
    frame: str
    publisher: Publisher


class RobotTopics:
    """Topics that one robot publishes.

    Args:
        at: The robot on the graph.
        messages: Classes.
        metres: Whether depths of cameras are in metres, not in millimetres.

    Attributes:
        cameras: Those on it.
    """

    def __init__(self, at: GraphRobot, messages: Messages, *, metres: bool = True) -> None:
        self._simulation, self._robot, self._world = at.simulation, at.robot, at.world
        self._messages = messages
        self._z = at.robot.model.pose.z
        self._odom = at.advertise("odom", messages.odometry)
        self._truth = at.advertise("base_pose_ground_truth", messages.odometry)
        self._stall = at.advertise("stall", messages.bool)
        self._crashed = at.advertise("is_crashed", messages.int8)
        self._odom_frame = at.frame("odom")
        self._footprint = at.frame("base_footprint")
        self._base = at.frame("base_link")
        self._lasers = self._open_lasers(at)
        self.cameras = CameraTopics(at, metres=metres)
        self._finders = FinderTopics(at)
        self._grippers = GripperTopics(at)
        self._actuators = ActuatorTopics(at)

    def _open_lasers(self, at: GraphRobot) -> list[_Laser]:
        direct = [each for each in self._robot.rangers if each.direct]
        seeing = [(k, each) for k, each in enumerate(direct) if each.sensors]
        return [
            _Laser(
                each,
                at.frame("base_laser_link", k, len(direct)),
                at.advertise("base_scan", self._messages.scan, k, len(direct)),
            )
            for k, each in seeing
        ]

    def publish(self, facts: GraphState) -> None:
        """Publish the present values to all subscribers."""
        i = self._robot.index
        if self._odom.has_subscribers:
            self._odom.publish(self._odometry(facts, facts.odometry[i], facts.velocity[i]))
        if self._truth.has_subscribers:
            message = self._odometry(facts, facts.pose[i], facts.true_velocity[i])
            self._truth.publish(message)
        if self._stall.has_subscribers:
            self._stall.publish(self._messages.bool(facts.stalled[i]))
        if self._crashed.has_subscribers:
            self._crashed.publish(self._messages.int8(int(facts.stalled[i])))
        for laser in self._lasers:
            if laser.publisher.has_subscribers:
                laser.publisher.publish(self._scan(facts, laser))
        self.cameras.publish(facts.stamp)
        self._finders.publish(facts.stamp)
        self._grippers.publish(facts.stamp)
        self._actuators.publish()

    def transforms(self, facts: GraphState) -> list[Any]:
        """Return transforms from odom to base_footprint, base_link, lasers and cameras in use."""
        x, y, yaw = facts.odometry[self._robot.index]
        found = [
            self._transform(facts, self._odom_frame, self._footprint, x, y, self._z, yaw),
            self._transform(facts, self._footprint, self._base, 0.0, 0.0, 0.0, 0.0),
        ]
        for laser in self._lasers:
            at = laser.ranger.pose
            found.append(self._transform(facts, self._base, laser.frame, at.x, at.y, at.z, at.yaw))
        for frame, place, turn in self.cameras.places():
            transform = self._transform(facts, self._base, frame, *place, 0.0)
            q = transform.transform.rotation
            q.x, q.y, q.z, q.w = turn
            found.append(transform)
        return found

    def close(self) -> None:
        """Publish no more."""
        self.cameras.close()
        self._finders.close()
        self._grippers.close()
        self._actuators.close()
        for publisher in (self._odom, self._truth, self._stall, self._crashed):
            publisher.close()
        for laser in self._lasers:
            laser.publisher.close()

    def _odometry(self, facts: GraphState, pose: Values, velocity: Values) -> nav_msgs.msg.Odometry:
        message = self._messages.odometry()
        message.header.stamp = facts.stamp
        message.header.frame_id = self._odom_frame
        message.child_frame_id = self._footprint
        position, twist = message.pose.pose, message.twist.twist
        position.position.x, position.position.y, position.position.z = pose[0], pose[1], self._z
        set_heading(position.orientation, pose[2])
        twist.linear.x, twist.linear.y, twist.angular.z = velocity
        return message

    def _scan(self, facts: GraphState, laser: _Laser) -> sensor_msgs.msg.LaserScan:
        sensor = laser.ranger.sensors[0]
        scanner, place = laser.ranger.places[0]
        message = self._messages.scan()
        message.header.stamp = facts.stamp
        message.header.frame_id = laser.frame
        message.angle_min, message.angle_max = -sensor.fov / 2.0, sensor.fov / 2.0
        message.angle_increment = sensor.fov / max(sensor.samples - 1, 1)
        message.range_min, message.range_max = sensor.range
        message.ranges = self._simulation.scan(scanner)[self._world, place].tolist()
        message.intensities = self._simulation.returns(scanner, place, self._world).tolist()
        return message

    def _transform(
        self, facts: GraphState, parent: str, child: str, x: float, y: float, z: float, yaw: float
    ) -> geometry_msgs.msg.TransformStamped:
        message = self._messages.transform()
        message.header.stamp = facts.stamp
        message.header.frame_id, message.child_frame_id = parent, child
        where = message.transform.translation
        where.x, where.y, where.z = x, y, z
        set_heading(message.transform.rotation, yaw)
        return message


def set_heading(quaternion: geometry_msgs.msg.Quaternion, yaw: float) -> None:
    """Fill a quaternion that turns about z."""
    quaternion.x = quaternion.y = 0.0
    quaternion.z, quaternion.w = math.sin(yaw / 2.0), math.cos(yaw / 2.0)


def heading_of(quaternion: geometry_msgs.msg.Quaternion) -> float:
    """Return the heading of a quaternion; all zero, as in an empty message, is the identity."""
    x, y, z, w = quaternion.x, quaternion.y, quaternion.z, quaternion.w
    return math.atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)


class RobotInputs:
    """Subscriptions of one robot: velocities and poses.

    Args:
        at: The robot on the graph.
        flat_poses: Whether ``cmd_pose`` carries ``geometry_msgs/Pose2D``.
        commanded: Called with the robot's index at each velocity command.
        placed: Called when it was put somewhere.
    """

    def __init__(
        self,
        at: GraphRobot,
        *,
        flat_poses: bool,
        commanded: Callable[[int], None],
        placed: Callable[[], None],
    ) -> None:
        self._simulation, self._robot, self._world = at.simulation, at.robot, at.world
        self._commanded, self._placed = commanded, placed
        flat = "geometry_msgs/Pose2D" if flat_poses else "geometry_msgs/Pose"
        self._subscribers = [
            at.subscribe(name, load_message(kind), self._between(act))
            for name, kind, act in (
                ("cmd_vel", "geometry_msgs/Twist", self.drive),
                ("cmd_pose", flat, self._place_flat if flat_poses else self.place),
                (
                    "cmd_pose_stamped",
                    "geometry_msgs/PoseStamped",
                    lambda message: self.place(message.pose),
                ),
            )
        ]

    def _between(self, act: Callable[[Any], None]) -> Callable[[Any], None]:
        return self._simulation.lock.wrap(act)

    def drive(self, message: geometry_msgs.msg.Twist) -> None:
        """Command a velocity.

        Numbers that are not finite are ignored, as they would spoil the world.
        """
        command = (message.linear.x, message.linear.y, message.angular.z)
        if not all(map(math.isfinite, command)):
            return
        self._simulation.commands[self._world, self._robot.index] = command
        self._commanded(self._robot.index)

    def place(self, pose: geometry_msgs.msg.Pose) -> None:
        """Set the pose in the world; height, roll and pitch are ignored."""
        self._put(pose.position.x, pose.position.y, heading_of(pose.orientation))

    def _place_flat(self, pose: geometry_msgs.msg.Pose2D) -> None:
        self._put(pose.x, pose.y, pose.theta)

    def _put(self, x: float, y: float, yaw: float) -> None:
        if all(map(math.isfinite, (x, y, yaw))):
            worlds = np.array([self._world])
            self._simulation.set_pose_of(self._robot.index, (x, y, yaw), worlds)
            self._placed()

    def close(self) -> None:
        """Unsubscribe."""
        for subscriber in self._subscribers:
            subscriber.close()
