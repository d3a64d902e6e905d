"""Values of ports to ROS messages and back, one world at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from gazelle.bridges import message_kinds
from gazelle.control.measurements import JointStates, Odometry, Transforms, TruePose, WrenchValue
from gazelle.description import Pose
from gazelle.engines import Motion, Placement
from gazelle.errors import RosError
from gazelle_ros.msgs import geometry_msgs, nav_msgs, sensor_msgs, std_msgs, tf2_msgs
from gazelle_ros.tf import StampedTransform
from gazelle_ros.tf.naming import resolve_frame
from gazelle_ros.time import Time


@dataclass(frozen=True, slots=True)
class ConversionContext:
    """Context of a conversion: frame, world and time of a graph.

    Attributes:
        frame: Frame of the port, for kinds without one.
        world: World of the batch.
        stamp: Turns a simulated time [ns] into the graph's.
        prefix: Put before the names of frames, as tf does.
    """

    frame: str
    world: int
    stamp: Callable[[int], Time]
    prefix: str = ""

    def resolved(self, frame: str) -> str:
        """Return the name of a frame on the graph."""
        return resolve_frame(self.prefix, frame)


@dataclass(frozen=True, slots=True)
class Encoder:
    """Conversion of values of one kind to messages.

    Attributes:
        message: Type of the messages.
        fill: Puts a value into a fresh message.
    """

    message: str
    fill: Callable[[Any, Any, ConversionContext], None]


@dataclass(frozen=True, slots=True)
class Decoder:
    """Conversion of messages to values of one kind.

    Attributes:
        message: Type of the messages.
        read: The value of a message.
    """

    message: str
    read: Callable[[Any], Any]


class XyzMessage(Protocol):
    """Point or vector."""

    x: float
    y: float
    z: float


class Stamped(Protocol):
    """Message with a header."""

    header: std_msgs.msg.Header


def set_point(target: XyzMessage, values: Iterable[float]) -> None:
    """Fill x, y and z."""
    target.x, target.y, target.z = (float(value) for value in values)


def set_quaternion(target: geometry_msgs.msg.Quaternion, values: Iterable[float]) -> None:
    """Fill x, y, z and w."""
    target.x, target.y, target.z, target.w = (float(value) for value in values)


def set_pose(
    target: geometry_msgs.msg.Pose, position: Iterable[float], quaternion: Iterable[float]
) -> None:
    """Fill a ``geometry_msgs/Pose``."""
    set_point(target.position, position)
    set_quaternion(target.orientation, quaternion)


def set_twist(
    target: geometry_msgs.msg.Twist, linear: Iterable[float], angular: Iterable[float]
) -> None:
    """Fill a ``geometry_msgs/Twist``."""
    set_point(target.linear, linear)
    set_point(target.angular, angular)


def point(message: XyzMessage) -> tuple[float, float, float]:
    """Return x, y and z of a point or vector."""
    return (message.x, message.y, message.z)


def quaternion(message: geometry_msgs.msg.Quaternion) -> tuple[float, float, float, float]:
    """Return x, y, z and w, normalised; all zero is the identity, as in Gazebo."""
    values = np.array([message.x, message.y, message.z, message.w])
    length = float(np.linalg.norm(values))
    if not length > 0.0:
        return (0.0, 0.0, 0.0, 1.0)
    with np.errstate(invalid="ignore"):  # infinite ones are refused where they are used
        x, y, z, w = (values / length).tolist()
    return (x, y, z, w)


def pose_of_message(message: geometry_msgs.msg.Pose) -> Pose:
    """Convert a ``geometry_msgs/Pose``."""
    return Pose.from_quaternion(point(message.position), quaternion(message.orientation))


def pose_of_transform(transform: StampedTransform) -> Pose:
    """Return a transform as the pose of its child."""
    return Pose.from_quaternion(transform.translation, transform.rotation)


def pose_message(pose: Pose) -> geometry_msgs.msg.Pose:
    """Return a ``geometry_msgs/Pose``."""
    message = geometry_msgs.msg.Pose()
    set_pose(message, pose.position, pose.quaternion)
    return message


def set_header(
    message: Stamped, view: ConversionContext, nanoseconds: int, frame: str | None = None
) -> None:
    """Fill a header; the port's frame if None."""
    message.header.stamp = view.stamp(nanoseconds)
    message.header.frame_id = view.resolved(view.frame if frame is None else frame)


def set_plain_header(message: Stamped, view: ConversionContext, nanoseconds: int) -> None:
    """Set the header for sensors whose plugins in Gazebo use the frame as it is written."""
    message.header.stamp, message.header.frame_id = view.stamp(nanoseconds), view.frame


def _odometry(message: nav_msgs.msg.Odometry, value: Odometry, view: ConversionContext) -> None:
    set_header(message, view, value.stamp, value.frame)
    message.child_frame_id = view.resolved(value.child_frame)
    set_pose(message.pose.pose, value.position[view.world], value.quaternion[view.world])
    set_twist(message.twist.twist, value.linear[view.world], value.angular[view.world])
    message.pose.covariance = _diagonal(value.pose_variance)
    message.twist.covariance = _diagonal(value.twist_variance)


def _true_pose(message: nav_msgs.msg.Odometry, value: TruePose, view: ConversionContext) -> None:
    _odometry(message, value, view)
    message.child_frame_id = value.child_frame


def _diagonal(values: Any) -> list[float]:
    return [float(x) for x in np.diag(np.asarray(values, np.float64)).ravel()]


def _joint_states(
    message: sensor_msgs.msg.JointState, value: JointStates, view: ConversionContext
) -> None:
    set_header(message, view, value.stamp)
    message.name = list(value.names)
    message.position = value.position[view.world].tolist()
    message.velocity = value.velocity[view.world].tolist()
    if value.effort is not None:
        message.effort = value.effort[view.world].tolist()


def _transforms(
    message: tf2_msgs.msg.TFMessage, value: Transforms, view: ConversionContext
) -> None:
    stamped = geometry_msgs.msg.TransformStamped
    for each in value.transforms:
        one = stamped()
        set_header(one, view, value.stamp, each.frame)
        one.child_frame_id = view.resolved(each.child_frame)
        set_point(one.transform.translation, each.position[view.world])
        set_quaternion(one.transform.rotation, each.quaternion[view.world])
        message.transforms.append(one)


def _wrench(
    message: geometry_msgs.msg.WrenchStamped, value: WrenchValue, view: ConversionContext
) -> None:
    set_header(message, view, value.stamp)
    set_point(message.wrench.force, value.force[view.world])
    set_point(message.wrench.torque, value.torque[view.world])


def _placement(message: geometry_msgs.msg.Pose, value: Placement, view: ConversionContext) -> None:
    set_pose(message, value.position[view.world], value.quaternion[view.world])


def _motion(message: geometry_msgs.msg.Twist, value: Motion, view: ConversionContext) -> None:
    set_twist(message, value.linear[view.world], value.angular[view.world])


def _data(message: Any, value: Any, _view: ConversionContext) -> None:
    message.data = value


def _read_data(message: Any) -> Any:
    return message.data


_ENCODERS: dict[type[Any], Encoder] = {
    Odometry: Encoder("nav_msgs/Odometry", _odometry),
    TruePose: Encoder("nav_msgs/Odometry", _true_pose),
    JointStates: Encoder("sensor_msgs/JointState", _joint_states),
    Transforms: Encoder("tf2_msgs/TFMessage", _transforms),
    WrenchValue: Encoder("geometry_msgs/WrenchStamped", _wrench),
    Placement: Encoder("geometry_msgs/Pose", _placement),
    Motion: Encoder("geometry_msgs/Twist", _motion),
    bool: Encoder("std_msgs/Bool", _data),
    int: Encoder("std_msgs/Int32", _data),
    float: Encoder("std_msgs/Float64", _data),
    str: Encoder("std_msgs/String", _data),
}
_DECODERS: dict[type[Any], Decoder] = {
    bool: Decoder("std_msgs/Bool", _read_data),
    int: Decoder("std_msgs/Int32", _read_data),
    float: Decoder("std_msgs/Float64", _read_data),
    str: Decoder("std_msgs/String", _read_data),
}
_SERVICES: dict[tuple[type[Any] | None, type[Any] | None], ServiceCodec] = {}


@dataclass(frozen=True, slots=True)
class ServiceCodec:
    """Conversion of a service's requests and responses to and from ROS.

    Attributes:
        service: Type of the service.
        read: The question of a request message.
        answer: The response's fields, from the answer.
    """

    service: str
    read: Callable[[Any], Any]
    answer: Callable[[Any], Mapping[str, Any]]


def add_encoder(kind: type[Any], encoder: Encoder) -> None:
    """Register an encoder, so that outputs of another kind can be published."""
    _ENCODERS[kind] = encoder


def add_decoder(kind: type[Any], decoder: Decoder) -> None:
    """Register a decoder, so that inputs of another kind can be subscribed to."""
    _DECODERS[kind] = decoder


def add_service(request: type[Any] | None, response: type[Any] | None, codec: ServiceCodec) -> None:
    """Register a codec, so that services of another kind can be called."""
    _SERVICES[request, response] = codec


add_service(None, None, ServiceCodec("std_srvs/Empty", lambda _request: None, lambda _answer: {}))


def encoder_of(kind: type[Any]) -> Encoder:
    """Return the encoder of values of a kind; those of message classes are messages already.

    Raises:
        RosError: No function is registered; see ``add_encoder``.
    """
    message = message_kinds.name_of(kind)
    if message is not None:
        return Encoder(message, message_kinds.fill)
    found: Encoder = _found(_ENCODERS, kind, "published")
    return found


def decoder_of(kind: type[Any]) -> Decoder:
    """Return the decoder of values of a kind.

    Raises:
        RosError: No function is registered; see ``add_decoder``.
    """
    message = message_kinds.name_of(kind)
    if message is not None:
        return Decoder(message, message_kinds.same)
    found: Decoder = _found(_DECODERS, kind, "subscribed to")
    return found


def service_of(request: type[Any] | None, response: type[Any] | None) -> ServiceCodec:
    """Return the codec of a service type, by the classes of its request and response.

    Raises:
        RosError: No function is registered; see ``add_service``.
    """
    service = message_kinds.service_name_of(request, response)
    if service is not None:
        return ServiceCodec(service, message_kinds.same, message_kinds.slots_of)
    found: ServiceCodec = _found(_SERVICES, (request, response), "called")
    return found


def _found(table: Mapping[Any, Any], kind: Any, done: str) -> Any:
    try:
        return table[kind]
    except KeyError:
        name = getattr(kind, "__name__", str(kind))
        raise RosError(
            f"a port of kind '{name}' cannot be {done} over ROS",
            hint="take a class of gazelle_ros.load_message, or see gazelle.bridges.conversions",
        ) from None
