"""The pictures of one robot's cameras, as stage_ros publishes them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.stage import MountedCamera, cameras_of
from gazelle.stage.bridge.place import GraphRobot
from gazelle_ros import Publisher, Time
from gazelle_ros.msgs import sensor_msgs

_MILLIMETRES = 1000.0


@dataclass(frozen=True, slots=True)
class _Eye:
    """A camera that is published."""

    which: int
    camera: MountedCamera
    frame: str
    image: Publisher
    depth: Publisher
    info: Publisher

    @property
    def watched(self) -> bool:
        """True if an image topic has subscribers."""
        return bool(self.image.has_subscribers or self.depth.has_subscribers)

    @property
    def has_subscribers(self) -> bool:
        """True if any of its topics has subscribers."""
        return bool(self.watched or self.info.has_subscribers)


class CameraTopics:
    """Pictures, depths and what the lens is, of the cameras directly on a robot.

    Args:
        at: The robot on the graph.
        metres: Whether depths are metres in 32FC1, not millimetres in 16UC1.
    """

    def __init__(self, at: GraphRobot, *, metres: bool) -> None:
        self._simulation, self._robot, self._world = at.simulation, at.robot, at.world
        self._metres = metres
        self._image = sensor_msgs.msg.Image
        self._info = sensor_msgs.msg.CameraInfo
        direct = [(k, c) for k, c in enumerate(cameras_of(at.robot)) if c.direct]
        count = len(direct)
        self._eyes = [
            _Eye(
                which,
                camera,
                at.frame("camera", place, count),
                at.advertise("image", self._image, place, count),
                at.advertise("depth", self._image, place, count),
                at.advertise("camera_info", self._info, place, count),
            )
            for place, (which, camera) in enumerate(direct)
        ]

    def watched(self) -> Iterator[tuple[str, int, int]]:
        """Yield robot, number and world of each camera with subscribers of pictures or depths."""
        for eye in self._eyes:
            if eye.watched:
                yield self._robot.name, eye.which, self._world

    def publish(self, stamp: Time) -> None:
        """Render and publish the topics with subscribers."""
        for eye in self._eyes:
            if eye.watched:
                seen = self._simulation.picture(self._robot.name, eye.which, self._world)
                if eye.image.has_subscribers:
                    self._send(eye, eye.image, stamp, "rgba8", seen.color)
                if eye.depth.has_subscribers:
                    self._send(eye, eye.depth, stamp, *self._depths(eye, seen.depth))
            if eye.has_subscribers:
                eye.info.publish(self._lens(eye, stamp))

    def places(self) -> list[tuple[str, tuple[float, float, float], tuple[float, ...]]]:
        """Return frame, place and quaternion on the robot of each camera with subscribers."""
        return [
            (eye.frame, (eye.camera.pose.x, eye.camera.pose.y, eye.camera.pose.z), _optical(eye))
            for eye in self._eyes
            if eye.has_subscribers
        ]

    def close(self) -> None:
        """Publish no more."""
        for eye in self._eyes:
            for publisher in (eye.image, eye.depth, eye.info):
                publisher.close()

    def _depths(self, eye: _Eye, depth: NDArray[np.float32]) -> tuple[str, NDArray[Any]]:
        """Return depths by REP 118: in metres, or in millimetres with 0 for unknown."""
        if self._metres:
            return "32FC1", depth
        near, far = (int(_MILLIMETRES * end) for end in eye.camera.device.range)
        with np.errstate(invalid="ignore"):
            whole = np.where(np.isfinite(depth), depth * _MILLIMETRES, 0.0).astype(np.int64)
        return "16UC1", np.where((whole > near) & (whole < far), whole, 0).astype(np.uint16)

    def _send(
        self, eye: _Eye, to: Publisher, stamp: Time, encoding: str, pixels: NDArray[Any]
    ) -> None:
        message = self._image()
        message.header.stamp, message.header.frame_id = stamp, eye.frame
        message.height, message.width = pixels.shape[:2]
        message.encoding, message.step = encoding, pixels[0].nbytes
        message.data = pixels.astype(pixels.dtype.newbyteorder("<"), copy=False).tobytes()
        to.publish(message)

    def _lens(self, eye: _Eye, stamp: Time) -> sensor_msgs.msg.CameraInfo:
        lens = eye.camera.lens
        (fx, fy), cx, cy = lens.focals, lens.width / 2.0, lens.height / 2.0
        message = self._info()
        message.header.stamp, message.header.frame_id = stamp, eye.frame
        message.height, message.width = lens.height, lens.width
        message.D = [0.0] * 4
        message.K = [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]
        message.R = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
        message.P = [fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0]
        return message


def _optical(eye: _Eye) -> tuple[float, ...]:
    """Return the optical frame's quaternion (x, y, z, w) on the robot, z ahead and y down.

    See REP 103.

    It is the turn by the heading about z after that by -90 degrees less the tilt about x.
    """
    pan, tilt = eye.camera.device.pantilt
    yaw = (eye.camera.pose.yaw - pan - math.pi / 2.0) / 2.0
    roll = (-math.pi / 2.0 - tilt) / 2.0
    cos, sin = math.cos(roll), math.sin(roll)
    return (math.cos(yaw) * sin, math.sin(yaw) * sin, math.sin(yaw) * cos, math.cos(yaw) * cos)
