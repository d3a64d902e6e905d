"""Odometry as drives publish it, and from a model's true motion, as most of Gazebo's do."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, TypeVar

import numpy as np

from gazelle.array_types import Floats
from gazelle.plugins.frames import frames_output
from gazelle.rotations import seen_on_ground
from gazelle.simulation import Odometry, Output, PluginSystem, Robot, Transform, Transforms
from gazelle.simulation.plugin_system import Published
from gazelle.simulation.values import SixNumbers

POSE_VARIANCE: SixNumbers = (1e-5, 1e-5, 1e12, 1e12, 1e12, 1e-3)
"""Of planar bases that are sure of x, y and yaw."""

_ABOUT_Z = np.array([0.0, 0.0, 1.0])


class OdometrySource(ABC):
    """Source of a robot's odometry, or that of many at once."""

    __slots__ = ()

    @abstractmethod
    def __call__(self) -> Odometry:
        """Return the odometry now."""

    @classmethod
    @abstractmethod
    def measure_all(cls, sources: Sequence[Any]) -> Sequence[Odometry]:
        """Return the odometry of many robots of one simulation.

        Args:
            sources: Of this class, at least one.
        """


@dataclass(frozen=True, slots=True)
class TrueOdometry(OdometrySource):
    """A model's pose in the world, and its velocity on the ground as seen from its heading.

    Args:
        robot: The model.
        frame: Of the pose.
        child_frame: Of the velocity.
        pose_variance: Of the six directions.
        twist_variance: Likewise.
    """

    robot: Robot
    frame: str
    child_frame: str
    pose_variance: SixNumbers = POSE_VARIANCE
    twist_variance: SixNumbers = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)

    def __call__(self) -> Odometry:
        """Return the odometry now."""
        place, motion = self.robot.placement(), self.robot.motion()
        linear = seen_on_ground(place.quaternion, motion.linear)
        return self.of(place.position, place.quaternion, linear, motion.angular * _ABOUT_Z)

    @classmethod
    def measure_all(cls, sources: Sequence[TrueOdometry]) -> list[Odometry]:
        """Return the odometry of many robots of one simulation; at once where its engine can."""
        return _measured_together(sources)

    def of(self, position: Floats, quaternion: Floats, linear: Floats, angular: Floats) -> Odometry:
        """Return the odometry of a measurement."""
        return Odometry(
            self.robot.simulation.clock.now_ns,
            self.frame,
            self.child_frame,
            position,
            quaternion,
            linear,
            angular,
            self.pose_variance,
            self.twist_variance,
        )


class OdometryOutputs:
    """A robot's odometry and the frame of tf that says the same, computed once for both.

    Args:
        robot: Gets the outputs ``odom`` and ``odom_tf``.
        topic: Of the odometry.
        measure: The odometry now.
        namespace: Namespace of the frame.
        published: Whether there is ``odom``.
        framed: Whether there is ``odom_tf``.

    Attributes:
        source: Source that measures several at once, if any.
    """

    def __init__(
        self,
        robot: Robot,
        topic: str,
        measure: Callable[[], Odometry],
        namespace: str,
        *,
        published: bool = True,
        framed: bool = True,
    ) -> None:
        self._measure = measure
        self.source = measure if isinstance(measure, OdometrySource) else None
        self._odom: Output[Odometry] | None = None
        self._frame: Output[Transforms] | None = None
        if published:
            self._odom = robot.outputs["odom"] = Output(
                topic, Odometry, measure, namespace=namespace
            )
        if framed:
            self._frame = robot.outputs["odom_tf"] = frames_output(
                lambda: as_transforms(measure()), namespace
            )

    @property
    def has_subscribers(self) -> bool:
        """True if either has subscribers."""
        odom, frame = self._odom, self._frame
        return (odom is not None and odom.has_subscribers) or (
            frame is not None and frame.has_subscribers
        )

    def publish(self, measured: Odometry | None = None) -> None:
        """Publish the odometry to all subscribers, if there are any.

        It is measured unless given.
        """
        if self.has_subscribers:
            self.publish_computed(measured or self._measure())

    def publish_computed(self, odometry: Odometry) -> None:
        """Publish a measured odometry to all subscribers."""
        if self._odom is not None and self._odom.has_subscribers:
            self._odom.publish_computed(odometry)
        if self._frame is not None and self._frame.has_subscribers:
            self._frame.publish_computed(as_transforms(odometry))


class OdometryPlugin(Protocol):
    """A plugin that publishes an odometry, and may publish more."""

    published: Sequence[Published]

    @property
    def odometry(self) -> OdometryOutputs | None:
        """The odometry, if it is published."""


D = TypeVar("D", bound=OdometryPlugin)


class OdometrySystem(PluginSystem[D]):
    """Plugins with odometry measured in one batch."""

    def measure(self, plugins: Sequence[D]) -> Sequence[Odometry | None]:
        """Return the odometry of each plugin if that output has subscribers."""
        return measure_wanted([each.odometry for each in plugins])

    def publish(self, plugin: D, measured: Odometry | None) -> None:
        """Publish all outputs of one plugin, with its odometry as it was measured."""
        for output in plugin.published:
            if isinstance(output, OdometryOutputs):
                output.publish(measured)
            else:
                output.publish()


def measure_wanted(outputs: Sequence[OdometryOutputs | None]) -> list[Odometry | None]:
    """Measure the odometry that has subscribers, together where possible; None for the rest."""
    found: list[Odometry | None] = [None] * len(outputs)
    by_type: dict[type[OdometrySource], dict[int, OdometrySource]] = {}
    for i, each in enumerate(outputs):
        if each is not None and each.source is not None and each.has_subscribers:
            by_type.setdefault(type(each.source), {})[i] = each.source
    for kind, sources in by_type.items():
        for i, odometry in zip(sources, kind.measure_all(list(sources.values())), strict=True):
            found[i] = odometry
    return found


def _measured_together(sources: Sequence[TrueOdometry]) -> list[Odometry]:
    """Return the odometry of many robots of one simulation; at once where its engine can."""
    links = [each.robot.first_link for each in sources]
    if len(sources) == 1 or None in links:
        return [each() for each in sources]
    engine = sources[0].robot.simulation.engine
    place = engine.models[tuple(each.robot.name for each in sources)].placement()
    motion = engine.links[tuple(link.name for link in links if link is not None)].motion()
    quaternions, linear = place.quaternion.reshape(-1, 4), motion.linear.reshape(-1, 3)
    seen = seen_on_ground(quaternions, linear).reshape(motion.linear.shape)
    turning = motion.angular * _ABOUT_Z
    return [
        each.of(place.position[:, i], place.quaternion[:, i], seen[:, i], turning[:, i])
        for i, each in enumerate(sources)
    ]


def as_transforms(odometry: Odometry) -> Transforms:
    """Return the same pose as a frame of tf."""
    place = Transform(odometry.frame, odometry.child_frame, odometry.position, odometry.quaternion)
    return Transforms(odometry.stamp, (place,))
