"""The true pose of a body: what ``libgazebo_ros_p3d.so`` does."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np

from gazelle.description import Noise, Parameters, Pose
from gazelle.engines import Motion, Placement
from gazelle.plugins.frames import Frame, placed, relative
from gazelle.plugins.publishing import Publishing
from gazelle.plugins.stateful import Noisy
from gazelle.rotations import conjugate, multiply, rotate
from gazelle.sensors import NoiseModel
from gazelle.simulation import FramePrefix, Output, Robot, absolute, namespace_of
from gazelle.simulation.values import TruePose

_INERTIAL = frozenset({"", "world", "/world", "map", "/map"})


class P3D(Noisy, Publishing):
    """Publishes where a body is, and how it moves, as the simulation knows it.

    The offset is added to the position as seen from the frame, and turns before the body's own
    turn. Noise is on the velocities only. Both are so in the original.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find body and frame, open the port."""
        self._robot = robot
        body = parameters.require("bodyName", str)
        topic = parameters.require("topicName", str)
        self._body = robot.frame(body)
        self._frame_name = parameters.get("frameName", "world")
        self._frame = None
        if self._frame_name not in _INERTIAL:
            self._frame = robot.frame(self._frame_name.lstrip("/"))
        offset = parameters.numbers("xyzOffset", (0.0, 0.0, 0.0))
        turn = parameters.numbers("rpyOffset", (0.0, 0.0, 0.0))
        self._offset = np.asarray(offset)
        self._turn = np.asarray(Pose(0.0, 0.0, 0.0, *turn).quaternion)
        self._variance = parameters.get("gaussianNoise", 0.0) ** 2
        self._make_noise(robot, body, parameters.get("gaussianNoise", 0.0))
        self.update_rate = parameters.get("updateRate", 0.0)
        self._child = body
        namespace = namespace_of(robot, parameters)
        self._output = robot.outputs[topic.strip("/")] = Output(
            absolute(namespace, topic),
            TruePose,
            self._measure,
            namespace=namespace,
            prefix=FramePrefix.OWN,
        )
        self._published.append(self._output)

    def _make_noise(self, robot: Robot, body: str, stddev: float) -> None:
        simulation = robot.simulation
        noise = Noise("gaussian", stddev=stddev)
        name = f"{robot.name}::{body}::p3d"
        self._noise = NoiseModel(noise, simulation.seed, name, simulation.nworld, 6)
        self._noises = {"noise": self._noise}

    def kind(self) -> Hashable | None:
        """All that see bodies from the world, where the engine looks at many links at once."""
        alike = self._frame is None and self._robot.simulation.tables is not None
        return "P3D" if alike else None

    @classmethod
    def measure_together(cls, plugins: Sequence[P3D]) -> list[tuple[Placement, Motion]]:
        """Where the bodies of all are, and how they move."""
        engine = plugins[0].robot.simulation.tables
        if engine is None:
            raise TypeError("the engine looks at one link at a time")
        links = tuple(each.body[0].name for each in plugins)
        place, motion = engine.link_placements(links), engine.link_motions(links)
        at = np.array([each.body[1].position for each in plugins])
        turn = np.array([each.body[1].quaternion for each in plugins])
        position = place.position + rotate(place.quaternion, at)
        quaternion = multiply(place.quaternion, np.broadcast_to(turn, place.quaternion.shape))
        return [
            (
                Placement(position[:, i], quaternion[:, i]),
                Motion(motion.linear[:, i], motion.angular[:, i]),
            )
            for i in range(len(plugins))
        ]

    def publish_measured(self, measured: tuple[Placement, Motion] | None) -> None:
        """Publish what was measured of the body."""
        if self._output.wanted:
            place, motion = measured or (placed(self._body), self._body[0].motion())
            self._output.hand(self._seen(place, motion))

    @property
    def robot(self) -> Robot:
        """Whose body it is."""
        return self._robot

    @property
    def body(self) -> Frame:
        """What it looks at."""
        return self._body

    def _measure(self) -> TruePose:
        return self._seen(placed(self._body), self._body[0].motion())

    def _seen(self, place: Placement, motion: Motion) -> TruePose:
        """What is published of a body, with new noise."""
        if self._frame is not None:
            place, motion = self._seen_from_frame(place, motion)
        turn = np.broadcast_to(self._turn, place.quaternion.shape)
        twist = np.concatenate((motion.linear, motion.angular), axis=1)
        twist = self._noise.apply(twist, 0.0)
        six = (self._variance,) * 6
        return TruePose(
            self._robot.simulation.clock.now_ns,
            self._frame_name,
            self._child,
            place.position + self._offset,
            multiply(turn, place.quaternion),
            twist[:, :3],
            twist[:, 3:],
            six,
            six,
        )

    def _seen_from_frame(self, place: Placement, motion: Motion) -> tuple[Placement, Motion]:
        frame = self._frame
        if frame is None:
            return place, motion
        origin, own = placed(frame), frame[0].motion()
        back = conjugate(origin.quaternion)
        moved = Motion(
            rotate(back, motion.linear - own.linear), rotate(back, motion.angular - own.angular)
        )
        return relative(origin, place), moved
