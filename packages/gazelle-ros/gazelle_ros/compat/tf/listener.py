"""Frames in tf's older way: times and timeouts by position, values as lists."""
# ruff: noqa: N802, FBT001, FBT002 - the interface is tf's

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from gazelle_ros.compat.rospy.rostime import Time
from gazelle_ros.compat.tf2_py import TransformException
from gazelle_ros.compat.tf2_ros.buffer import Buffer
from gazelle_ros.compat.tf2_ros.transform_listener import TransformListener as Tf2Listener
from gazelle_ros.messages import load_message
from gazelle_ros.msgs import geometry_msgs, sensor_msgs
from gazelle_ros.tf.twist import twist
from gazelle_ros.transformations import (
    quaternion_from_matrix,
    quaternion_matrix,
    translation_matrix,
)

Pair = tuple[list[float], list[float]]


def strip_leading_slash(s: str) -> str:
    """Return the name without a slash in front."""
    return s.removeprefix("/")


def _plain(*frames: str) -> list[str]:
    """Return names without a slash in front."""
    return [strip_leading_slash(frame) for frame in frames]


def xyz_to_mat44(pos: Any) -> Any:
    """Return the matrix of a position message."""
    return translation_matrix((pos.x, pos.y, pos.z))


def xyzw_to_mat44(ori: Any) -> Any:
    """Return the matrix of an orientation message."""
    return quaternion_matrix((ori.x, ori.y, ori.z, ori.w))


class Transformer:
    """Frames over time.

    Args:
        interpolate: Accepted; times between two are always interpolated.
        cache_time: Time to keep transforms, 10 s by default.
    """

    def __init__(self, interpolate: bool = True, cache_time: Any = None) -> None:
        del interpolate
        self._buffer = Buffer(cache_time, debug=False)
        self._using_dedicated_thread = False

    def allFramesAsDot(self, current_time: Any = None) -> str:
        """Return the tree as a graph in the dot language."""
        return self._buffer._allFramesAsDot(current_time)  # noqa: SLF001  # a class beside this one

    def allFramesAsString(self) -> str:
        """Return one line for each frame and its parent."""
        return self._buffer.all_frames_as_string()

    def setTransform(
        self, transform: geometry_msgs.msg.TransformStamped, authority: str = "default_authority"
    ) -> None:
        """Add a ``TransformStamped``."""
        self._buffer.set_transform(transform, authority)

    def canTransform(self, target_frame: str, source_frame: str, time: Any) -> bool:
        """Return whether there is a transform at a time."""
        target, source = _plain(target_frame, source_frame)
        return bool(self._buffer.can_transform(target, source, time))

    def canTransformFull(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> bool:
        """Return whether there is a transform from one time to another."""
        target, source, fixed = _plain(target_frame, source_frame, fixed_frame)
        frames = (target, target_time, source, source_time, fixed)
        return bool(self._buffer.can_transform_full(*frames))

    def waitForTransform(
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Any,
        polling_sleep_duration: Any = None,
    ) -> None:
        """Wait for a transform.

        Raises:
            TransformException: It does not come in time.
        """
        del polling_sleep_duration
        target, source = _plain(target_frame, source_frame)
        frames = (target, source, time, timeout, True)
        self._demand(lambda: self._buffer.can_transform(*frames), target, source)

    def waitForTransformFull(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any,
        polling_sleep_duration: Any = None,
    ) -> None:
        """Wait for a transform from one time to another.

        Raises:
            TransformException: It does not come in time.
        """
        del polling_sleep_duration
        target, source, fixed = _plain(target_frame, source_frame, fixed_frame)
        frames = (target, target_time, source, source_time, fixed, timeout, True)
        self._demand(lambda: self._buffer.can_transform_full(*frames), target, source)

    def _demand(self, wait: Callable[[], tuple[bool, str]], target: str, source: str) -> None:
        if not self._using_dedicated_thread:
            raise TransformException(
                "cannot wait for transform without a dedicated thread that listens to incoming TF "
                "messages"
            )
        found, why = wait()
        if not found:
            raise TransformException(why or f'no such transformation: "{target}" -> "{source}"')

    def chain(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> list[str]:
        """Return the frames on the way between two."""
        return self._buffer._chain(  # noqa: SLF001  # a class beside this one
            target_frame, target_time, source_frame, source_time, fixed_frame
        )

    def clear(self) -> None:
        """Discard all transforms but static ones."""
        self._buffer.clear()

    def frameExists(self, frame_id: str) -> bool:
        """Return whether a frame has a parent."""
        return strip_leading_slash(frame_id) in self.getFrameStrings()

    def getFrameStrings(self) -> list[str]:
        """Return all frames that have a parent."""
        return [name for name, _, cache in self._buffer.tree.known() if cache.latest()]

    def getLatestCommonTime(self, source_frame: str, dest_frame: str) -> Time:
        """Return the latest time at which both frames are known.

        Raises:
            TransformException: There is none.
        """
        source, target = _plain(source_frame, dest_frame)
        return self._buffer.get_latest_common_time(target, source)

    def lookupTransform(self, target_frame: str, source_frame: str, time: Any) -> Pair:
        """Return translation [m] and rotation (x, y, z, w) from source to target.

        Raises:
            TransformException: There is none; its class says why.
        """
        target, source = _plain(target_frame, source_frame)
        return _pair(self._buffer.lookup_transform(target, source, time))

    def lookupTransformFull(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> Pair:
        """Return translation and rotation from source at one time to target at another.

        Raises:
            TransformException: There is none; its class says why.
        """
        target, source, fixed = _plain(target_frame, source_frame, fixed_frame)
        frames = (target, target_time, source, source_time, fixed)
        return _pair(self._buffer.lookup_transform_full(*frames))

    def lookupTwist(
        self, tracking_frame: str, observation_frame: str, time: Any, averaging_interval: Any
    ) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return linear [m/s] and angular [rad/s] velocity of a frame, in the observing frame.

        Raises:
            TransformException: There is no transform; its class says why.
        """
        return self.lookupTwistFull(
            tracking_frame,
            observation_frame,
            observation_frame,
            (0.0, 0.0, 0.0),
            tracking_frame,
            time,
            averaging_interval,
        )

    def lookupTwistFull(
        self,
        tracking_frame: str,
        observation_frame: str,
        reference_frame: str,
        ref_point: Sequence[float],
        reference_point_frame: str,
        time: Any,
        averaging_interval: Any,
    ) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return linear and angular velocity of a frame, relative to another.

        Args:
            tracking_frame: Moving frame.
            observation_frame: Reference frame.
            reference_frame: Frame of the result's axes.
            ref_point: Point of the velocity on the moving frame.
            reference_point_frame: The frame of `ref_point`.
            time: Time, 0 for the latest.
            averaging_interval: Over how long.

        Raises:
            TransformException: There is no transform; its class says why.
        """
        return twist(
            self._buffer.tree,
            strip_leading_slash(tracking_frame),
            strip_leading_slash(observation_frame),
            reference=strip_leading_slash(reference_frame),
            point=(float(ref_point[0]), float(ref_point[1]), float(ref_point[2])),
            point_frame=strip_leading_slash(reference_point_frame),
            stamp=time.to_nsec(),
            interval=averaging_interval.to_nsec(),
        )

    def setUsingDedicatedThread(self, value: bool) -> None:
        """Set whether transforms come while one waits for them."""
        self._using_dedicated_thread = value

    def getTFPrefix(self) -> str:
        """Return an empty text: there are no prefixes any more."""
        return ""


def _pair(found: Any) -> Pair:
    place, turn = found.transform.translation, found.transform.rotation
    return [place.x, place.y, place.z], [turn.x, turn.y, turn.z, turn.w]


class TransformerROS(Transformer):
    """A `Transformer` that transforms messages."""

    def asMatrix(self, target_frame: str, hdr: Any) -> Any:
        """Return the matrix that maps points from the frame of a header to the target."""
        return self.fromTranslationRotation(
            *self.lookupTransform(target_frame, hdr.frame_id, hdr.stamp)
        )

    def fromTranslationRotation(
        self, translation: Sequence[float], rotation: Sequence[float]
    ) -> Any:
        """Return the matrix of a translation and a quaternion."""
        return translation_matrix(translation) @ quaternion_matrix(rotation)

    def transformPoint(self, target_frame: str, ps: Any) -> Any:
        """Transform a ``PointStamped`` to another frame."""
        return self._move("PointStamped", "point", 1.0, target_frame, ps)

    def transformVector3(self, target_frame: str, v3s: Any) -> Any:
        """Transform a ``Vector3Stamped`` to another frame."""
        return self._move("Vector3Stamped", "vector", 0.0, target_frame, v3s)

    def _move(self, kind: str, field: str, weight: float, target_frame: str, stamped: Any) -> Any:
        """Transform three numbers; translate them if their weight is not zero."""
        result, three = _made(kind, target_frame, stamped), getattr(stamped, field)
        moved = self.asMatrix(target_frame, stamped.header) @ (three.x, three.y, three.z, weight)
        put = getattr(result, field)
        put.x, put.y, put.z = moved[:3].tolist()
        return result

    def transformQuaternion(self, target_frame: str, ps: Any) -> Any:
        """Transform a ``QuaternionStamped`` to another frame."""
        result = _made("QuaternionStamped", target_frame, ps)
        turned = self.asMatrix(target_frame, ps.header) @ xyzw_to_mat44(ps.quaternion)
        _put_quaternion(result.quaternion, turned)
        return result

    def transformPose(self, target_frame: str, ps: Any) -> Any:
        """Transform a ``PoseStamped`` to another frame."""
        result = _made("PoseStamped", target_frame, ps)
        pose = xyz_to_mat44(ps.pose.position) @ xyzw_to_mat44(ps.pose.orientation)
        moved = self.asMatrix(target_frame, ps.header) @ pose
        place = result.pose.position
        place.x, place.y, place.z = moved[:3, 3].tolist()
        _put_quaternion(result.pose.orientation, moved)
        return result

    def transformPointCloud(self, target_frame: str, point_cloud: Any) -> Any:
        """Transform a ``PointCloud`` to another frame."""
        result = sensor_msgs.msg.PointCloud()
        result.header.stamp = point_cloud.header.stamp
        result.header.frame_id = target_frame
        result.channels = point_cloud.channels
        if point_cloud.points:
            points = np.array([(p.x, p.y, p.z, 1.0) for p in point_cloud.points])
            moved = points @ self.asMatrix(target_frame, point_cloud.header).T
            point = geometry_msgs.msg.Point32
            result.points = [point(*row[:3].tolist()) for row in moved]
        return result


def _made(name: str, target_frame: str, like: Any) -> Any:
    made: Any = load_message(f"geometry_msgs/{name}")()
    made.header.stamp, made.header.frame_id = like.header.stamp, target_frame
    return made


def _put_quaternion(message: geometry_msgs.msg.Quaternion, turned: Any) -> None:
    message.x, message.y, message.z, message.w = quaternion_from_matrix(turned).tolist()


class TransformListener(TransformerROS):
    """A `TransformerROS` filled from /tf and /tf_static; arguments as `Transformer`'s."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._listener = Tf2Listener(self._buffer)
        self.setUsingDedicatedThread(True)
