"""Conversion of ROS messages to controllers' commands.

Unlike a plugin's inputs these may have a time at which something is to begin: a reader gets the
graph, which knows what simulated time a stamp is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from gazelle.bridges.conversions import decoder_of, point
from gazelle.bridges.graph import TimedGraph
from gazelle.control.values import (
    BaseTwist,
    FourWheelCommand,
    GripperGoal,
    JointTarget,
    JointTargets,
    JointTolerance,
    JointTrajectory,
    TrajectoryGoal,
    TrajectoryPoint,
)
from gazelle_ros.msgs import control_msgs, four_wheel_steering_msgs, geometry_msgs, trajectory_msgs
from gazelle_ros.time import Time

Read = Callable[[Any, TimedGraph], Any]
"""Makes a value of a message."""


@dataclass(frozen=True, slots=True)
class CommandDecoder:
    """Conversion of messages to commands of one kind.

    Attributes:
        message: Type of the messages.
        read: The command of a message.
    """

    message: str
    read: Read


def command_decoder_of(kind: type[Any]) -> CommandDecoder:
    """Return the decoder of commands of a kind; those of message classes are commands already.

    Raises:
        RosError: No function is registered; see ``gazelle.bridges.conversions.add_decoder``.
    """
    found = _DECODERS.get(kind)
    if found is not None:
        return found
    plain = decoder_of(kind)
    return CommandDecoder(plain.message, lambda message, _graph: plain.read(message))


def simulated(stamp: Time, graph: TimedGraph) -> int:
    """Return a stamp as simulated time [ns]; 0, which stands for now, stays 0."""
    return graph.own_ns(stamp) if stamp else 0


def trajectory(message: trajectory_msgs.msg.JointTrajectory, graph: TimedGraph) -> JointTrajectory:
    """Convert a ``trajectory_msgs/JointTrajectory``."""
    return JointTrajectory(
        tuple(message.joint_names),
        tuple(_point(each) for each in message.points),
        simulated(message.header.stamp, graph),
    )


def _point(message: trajectory_msgs.msg.JointTrajectoryPoint) -> TrajectoryPoint:
    return TrajectoryPoint(
        message.time_from_start.to_sec(),
        tuple(message.positions),
        tuple(message.velocities),
        tuple(message.accelerations),
        tuple(message.effort),
    )


def trajectory_goal(
    message: control_msgs.msg.FollowJointTrajectoryGoal, graph: TimedGraph
) -> TrajectoryGoal:
    """Convert a ``control_msgs/FollowJointTrajectoryGoal``."""
    return TrajectoryGoal(
        trajectory(message.trajectory, graph),
        _tolerances(message.path_tolerance),
        _tolerances(message.goal_tolerance),
        message.goal_time_tolerance.to_sec(),
    )


def _tolerances(messages: Iterable[Any]) -> tuple[JointTolerance, ...]:
    return tuple(
        JointTolerance(each.name, each.position, each.velocity, each.acceleration)
        for each in messages
    )


def gripper_goal(message: control_msgs.msg.GripperCommandGoal, _graph: TimedGraph) -> GripperGoal:
    """Convert a ``control_msgs/GripperCommandGoal``."""
    return GripperGoal(message.command.position, message.command.max_effort)


def _twist(message: geometry_msgs.msg.Twist, _graph: TimedGraph) -> BaseTwist:
    return BaseTwist(point(message.linear), point(message.angular))


def _four_wheels(
    message: four_wheel_steering_msgs.msg.FourWheelSteering, _graph: TimedGraph
) -> FourWheelCommand:
    return FourWheelCommand(
        message.front_steering_angle, message.rear_steering_angle, message.speed
    )


_DECODERS: Mapping[type[Any], CommandDecoder] = {
    BaseTwist: CommandDecoder("geometry_msgs/Twist", _twist),
    FourWheelCommand: CommandDecoder("four_wheel_steering_msgs/FourWheelSteering", _four_wheels),
    JointTarget: CommandDecoder("std_msgs/Float64", lambda message, _: JointTarget(message.data)),
    JointTargets: CommandDecoder(
        "std_msgs/Float64MultiArray", lambda message, _: JointTargets(tuple(message.data))
    ),
    JointTrajectory: CommandDecoder("trajectory_msgs/JointTrajectory", trajectory),
}
