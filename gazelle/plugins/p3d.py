"""The true pose of a body: what ``libgazebo_ros_p3d.so`` does."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.description import Noise, Parameters, Pose
from gazelle.engines import Motion, Placement
from gazelle.plugins.frames import Frame, placed
from gazelle.plugins.publishing import Publishing
from gazelle.plugins.stateful import Noisy
from gazelle.rotations import conjugate, multiply, rotate
from gazelle.sensors import NoiseModel
from gazelle.simulation import (
    FramePrefix,
    LinkArray,
    Output,
    PublisherSystem,
    Robot,
    absolute,
    namespace_of,
)
from gazelle.simulation.values import TruePose

_INERTIAL = frozenset({"", "world", "/world", "map", "/map"})


class P3D(Noisy, Publishing):
    """Publishes where a body is, and how it moves, as the simulation knows it.

    The offset is added to the position as seen from the frame, and turns before the body's own
    turn. Noise is on the velocities only. Both are so in the original.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find body and frame, open the port."""
        self._robot, self.system = robot, P3DSystem
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
        deviation = parameters.get("gaussianNoise", 0.0)
        self._variance = deviation * deviation  # infinite where a power is an OverflowError
        self._make_noise(robot, body, deviation)
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
        self.published.append(self._output)

    def _make_noise(self, robot: Robot, body: str, stddev: float) -> None:
        simulation = robot.simulation
        noise = Noise("gaussian", stddev=stddev)
        name = f"{robot.name}::{body}::p3d"
        self._noise = NoiseModel(noise, simulation.seed, name, simulation.nworld, 6)
        self._noises = {"noise": self._noise}

    @property
    def frames(self) -> list[Frame]:
        """The body, and the frame that it is seen from if that is not the world."""
        return [self._body] if self._frame is None else [self._body, self._frame]

    def _measure(self) -> TruePose:
        return poses_of([self])[0]

    def seen(self, place: Sequence[Placement], motion: Sequence[Motion]) -> TruePose:
        """Return the values to publish, with new noise.

        Args:
            place: Of its ``frames``.
            motion: Of the frames' links.
        """
        at, moves = place[0], motion[0]
        if self._frame is not None:
            back = conjugate(place[1].quaternion)
            moves = Motion(
                rotate(back, moves.linear - motion[1].linear),
                rotate(back, moves.angular - motion[1].angular),
            )
            at = at.relative_to(place[1])
        turn = np.broadcast_to(self._turn, at.quaternion.shape)
        twist = np.concatenate((moves.linear, moves.angular), axis=1)
        twist = self._noise.apply(twist, 0.0)
        six = (self._variance,) * 6
        return TruePose(
            self._robot.simulation.clock.now_ns,
            self._frame_name,
            self._child,
            at.position + self._offset,
            multiply(turn, at.quaternion),
            twist[:, :3],
            twist[:, 3:],
            six,
            six,
        )

    @property
    def robot(self) -> Robot:
        """Robot that has the body."""
        return self._robot

    @property
    def output(self) -> Output[TruePose]:
        """Output that it publishes."""
        return self._output


class P3DSystem(PublisherSystem[P3D]):
    """Publishers with bodies read in one batch."""

    def measure(self, plugins: Sequence[P3D]) -> list[TruePose]:
        """Return the pose that each plugin publishes."""
        return poses_of(plugins)

    def publish(self, plugin: P3D, measured: TruePose) -> None:
        """Publish the measured state of one body."""
        plugin.output.publish_computed(measured)


def poses_of(plugins: Sequence[P3D]) -> list[TruePose]:
    """Return the pose that each plugin publishes."""
    if len(plugins) == 1:  # a single one is looked up faster by itself
        frames = plugins[0].frames
        return [plugins[0].seen([*map(placed, frames)], [link.motion() for link, _ in frames])]
    frames = [frame for each in plugins for frame in each.frames]
    links = LinkArray(plugins[0].robot.simulation, [link for link, _ in frames])
    place, motion = links.placements(), links.motions()
    at = np.array([pose.position for _, pose in frames])
    turn = np.array([pose.quaternion for _, pose in frames])
    shape = place.position.shape
    position = place.position + rotate(place.quaternion, np.broadcast_to(at, shape))
    quaternion = multiply(place.quaternion, np.broadcast_to(turn, place.quaternion.shape))
    places = iter([Placement(position[:, i], quaternion[:, i]) for i in range(len(frames))])
    motions = iter([Motion(motion.linear[:, i], motion.angular[:, i]) for i in range(len(frames))])
    return [
        each.seen([next(places) for _ in each.frames], [next(motions) for _ in each.frames])
        for each in plugins
    ]
