"""Conversion of controllers' outputs to ROS messages; imported for its registrations."""

from __future__ import annotations

from gazelle.array_types import Floats
from gazelle.bridges.conversions import (
    ConversionContext,
    Encoder,
    add_encoder,
    set_header,
    set_point,
    set_quaternion,
    set_twist,
)
from gazelle.control.values import (
    FourWheelOdometry,
    ImuSample,
    JointControlState,
    JointSample,
    PidStatus,
    StampedTwist,
    StampedWrench,
    TrajectoryState,
)
from gazelle_ros.messages import Message
from gazelle_ros.msgs import (
    control_msgs,
    four_wheel_steering_msgs,
    geometry_msgs,
    sensor_msgs,
    trajectory_msgs,
)
from gazelle_ros.time import Duration


def trajectory_state(
    message: control_msgs.msg.FollowJointTrajectoryFeedback
    | control_msgs.msg.JointTrajectoryControllerState,
    value: TrajectoryState,
    view: ConversionContext,
) -> None:
    """Fill a ``JointTrajectoryControllerState``, or the feedback of a trajectory: the same fields."""
    set_header(message, view, value.stamp)
    message.joint_names = list(value.names)
    since = Duration.from_sec(float(value.time_from_start[view.world]))
    for field in ("desired", "actual", "error"):
        point = getattr(message, field)
        _sample(point, getattr(value, field), view.world)
        point.time_from_start = since


def _sample(
    point: trajectory_msgs.msg.JointTrajectoryPoint, value: JointSample, world: int
) -> None:
    point.positions = value.positions[world].tolist()
    point.velocities = value.velocities[world].tolist()
    if value.accelerations is not None:
        point.accelerations = value.accelerations[world].tolist()


def _joint_state(
    message: control_msgs.msg.JointControllerState,
    value: JointControlState,
    view: ConversionContext,
) -> None:
    set_header(message, view, value.stamp)
    message.time_step = value.time_step
    _fill(message, value, view, ("set_point", "process_value", "process_value_dot", "error"))
    _fill(message, value, view, ("command", "p", "i", "d", "i_clamp"))
    message.antiwindup = value.antiwindup


def _pid_status(
    message: control_msgs.msg.PidState, value: PidStatus, view: ConversionContext
) -> None:
    set_header(message, view, value.stamp)
    message.timestep = Duration.from_sec(value.time_step)
    for quantity in ("error", "term"):
        _fill(message, value, view, tuple(f"{name}_{quantity}" for name in "pid"))
    _fill(message, value, view, ("error", "error_dot", "i_max", "i_min", "output"))


def _fill(
    message: Message, value: object, view: ConversionContext, fields: tuple[str, ...]
) -> None:
    """Copy numbers: those of the graph's world, or those that hold in all worlds."""
    for field in fields:
        found: Floats | float = getattr(value, field)
        setattr(
            message, field, float(found if isinstance(found, int | float) else found[view.world])
        )


def _stamped_twist(
    message: geometry_msgs.msg.TwistStamped, value: StampedTwist, view: ConversionContext
) -> None:
    set_header(message, view, value.stamp, value.frame)
    set_twist(message.twist, value.linear[view.world], value.angular[view.world])


def _four_wheels(
    message: four_wheel_steering_msgs.msg.FourWheelSteeringStamped,
    value: FourWheelOdometry,
    view: ConversionContext,
) -> None:
    set_header(message, view, value.stamp)
    data = message.data
    data.front_steering_angle = float(value.front_angle[view.world])
    data.rear_steering_angle = float(value.rear_angle[view.world])
    data.speed = float(value.speed[view.world])


def _imu(message: sensor_msgs.msg.Imu, value: ImuSample, view: ConversionContext) -> None:
    set_header(message, view, value.stamp, value.frame)
    set_quaternion(message.orientation, value.quaternion[view.world])
    set_point(message.angular_velocity, value.angular_velocity[view.world])
    set_point(message.linear_acceleration, value.linear_acceleration[view.world])
    message.orientation_covariance = list(value.orientation_covariance)
    message.angular_velocity_covariance = list(value.angular_velocity_covariance)
    message.linear_acceleration_covariance = list(value.linear_acceleration_covariance)


def _wrench(
    message: geometry_msgs.msg.WrenchStamped, value: StampedWrench, view: ConversionContext
) -> None:
    set_header(message, view, value.stamp, value.frame)
    set_point(message.wrench.force, value.force[view.world])
    set_point(message.wrench.torque, value.torque[view.world])


for _kind, _encoder in {
    FourWheelOdometry: Encoder("four_wheel_steering_msgs/FourWheelSteeringStamped", _four_wheels),
    ImuSample: Encoder("sensor_msgs/Imu", _imu),
    JointControlState: Encoder("control_msgs/JointControllerState", _joint_state),
    PidStatus: Encoder("control_msgs/PidState", _pid_status),
    StampedTwist: Encoder("geometry_msgs/TwistStamped", _stamped_twist),
    StampedWrench: Encoder("geometry_msgs/WrenchStamped", _wrench),
    TrajectoryState: Encoder("control_msgs/JointTrajectoryControllerState", trajectory_state),
}.items():
    add_encoder(_kind, _encoder)
