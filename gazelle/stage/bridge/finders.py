"""Topics of one robot's bumpers and finders, with subscribers; stage_ros has no such topics."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from gazelle.stage.bridge.place import GraphRobot
from gazelle.stage.description import (
    StageBlobfinder,
    StageBumper,
    StageFiducial,
)
from gazelle_ros import Publisher, Time, load_message
from gazelle_ros.msgs import gazelle_msgs, std_msgs


@dataclass(frozen=True, slots=True)
class _Topic:
    """One device that is published."""

    publisher: Publisher
    fill: Callable[[Any], None]


class FinderTopics:
    """Bumpers, fiducial finders and blob finders on a robot, by names like stage_ros's.

    Args:
        at: The robot on the graph.
    """

    def __init__(self, at: GraphRobot) -> None:
        self._simulation, self._name, self._world = at.simulation, at.robot.name, at.world
        self._frame = at.frame("base_link")
        self._topics: list[_Topic] = []
        devices = [placed.model.device for placed in at.robot.model.walk()]
        for kind, name, message, fill in (
            (StageBumper, "bumper", "Bumper", self._touch),
            (StageFiducial, "fiducials", "Fiducials", self._read),
            (StageBlobfinder, "blobs", "Blobs", self._see),
        ):
            found = [device for device in devices if isinstance(device, kind)]
            for which, device in enumerate(found):
                sort = load_message(f"gazelle_msgs/{message}")
                publisher = at.advertise(name, sort, which, len(found))
                self._topics.append(_Topic(publisher, fill(which, device)))

    def publish(self, stamp: Time) -> None:
        """Publish the topics with subscribers."""
        for topic in self._topics:
            if topic.publisher.has_subscribers:
                message: Any = topic.publisher.message_class()
                message.header.stamp, message.header.frame_id = stamp, self._frame
                topic.fill(message)
                topic.publisher.publish(message)

    def close(self) -> None:
        """Publish no more."""
        for topic in self._topics:
            topic.publisher.close()

    def _touch(self, which: int, _device: object) -> Callable[[Any], None]:
        def fill(message: gazelle_msgs.msg.Bumper) -> None:
            touched = self._simulation.bumps(self._name, which, self._world)
            message.touched = [name or "" for name in touched]

        return fill

    def _read(self, which: int, _device: object) -> Callable[[Any], None]:
        kind = gazelle_msgs.msg.Fiducial

        def fill(message: gazelle_msgs.msg.Fiducials) -> None:
            message.fiducials = [
                kind(each.name, each.id, each.distance, each.bearing, each.heading)
                for each in self._simulation.fiducials(self._name, which, self._world)
            ]

        return fill

    def _see(self, which: int, device: Any) -> Callable[[Any], None]:
        kind = gazelle_msgs.msg.Blob
        color = std_msgs.msg.ColorRGBA

        def fill(message: gazelle_msgs.msg.Blobs) -> None:
            message.width = device.image[0]
            message.blobs = [
                kind(color(*each.color), each.left, each.right, each.distance)
                for each in self._simulation.blobs(self._name, which, self._world)
            ]

        return fill
