"""A hand that holds a link where a frame is: what ``libgazebo_ros_hand_of_god.so`` does."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.plugins.frames import frames_output
from gazelle.plugins.received_frames import ReceivedFrames
from gazelle.rotations import conjugate, multiply
from gazelle.simulation import FramePrefix, Input, ModelPlugin, Robot, Transform, Transforms


class HandOfGod(ModelPlugin):
    """Draws a weightless link to the frame ``<frameId>_desired``, without swinging.

    The frame may be given in any other that tf connects with ``world``. Until it is known where
    it is in ``world`` nothing is done.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the link, subscribe to tf."""
        self._robot, self._simulation = robot, robot.simulation
        self._link, _ = robot.frame(parameters.require("linkName", str))
        self._link.set_properties(gravity=0.0)
        self._name = parameters.get("frameId", "hog")
        self._stiffness = parameters.get("kl", 200.0), parameters.get("ka", 200.0)
        self._frames = ReceivedFrames(robot.simulation.nworld)
        robot.inputs[f"{self._name}_desired"] = Input(
            "/tf", Transforms, self._frames.receive, forget=self.reset, queue_size=100
        )
        robot.inputs[f"{self._name}_static"] = Input(
            "/tf_static", Transforms, self._receive_static, queue_size=100
        )
        actual = f"{self._name}_actual"
        self._actual = robot.outputs[actual] = frames_output(
            self._actual_frame, prefix=FramePrefix.NONE
        )

    @property
    def active(self) -> bool:
        """True if there are frames or subscribers."""
        return self._frames.any or self._actual.has_subscribers

    def _receive_static(self, transforms: Transforms, worlds: Worlds | None) -> None:
        self._frames.receive(transforms, worlds, static=True)

    def on_update(self, time: float) -> None:  # noqa: ARG002  it draws at every step
        """Pull the link, and publish its pose."""
        if self._frames.any:
            known, position, quaternion = self._frames.find(f"{self._name}_desired", "world")
            self._draw(known[:, None], position, quaternion)
        self._actual.publish()

    def _draw(self, known: NDArray[np.bool_], position: Floats, quaternion: Floats) -> None:
        engine, name = self._simulation.engine, self._link.name
        place, motion = self._link.placement(), self._link.motion()
        mass = engine.parameter("link_mass", name)
        inertia = engine.parameter("link_inertia", name)[:, :1]
        linear, angular = self._stiffness
        force = linear * (position - place.position)
        force -= 2.0 * np.sqrt(linear * mass) * motion.linear
        turn = multiply(quaternion, conjugate(place.quaternion))
        # Twice the vector part, the short way round, is the turn for small angles.
        torque = angular * 2.0 * turn[:, :3] * np.where(turn[:, 3:] < 0.0, -1.0, 1.0)
        torque -= 2.0 * np.sqrt(angular * inertia) * motion.angular
        self._simulation.applied_wrenches.hold(
            "hand_of_god", name, np.where(known, force, 0.0), np.where(known, torque, 0.0)
        )

    def _actual_frame(self) -> Transforms:
        place = self._link.placement()
        actual = Transform("world", f"{self._name}_actual", place.position, place.quaternion)
        return Transforms(self._simulation.clock.now_ns, (actual,))

    def reset(self, worlds: Worlds | None) -> None:
        """Stop following."""
        self._frames.forget(worlds)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the frames that are known."""
        return self._frames.state()

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._frames.restore(state)
