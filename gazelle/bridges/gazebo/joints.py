"""The services on joints: properties and efforts.

Joints that do not move are there, as in Gazebo: nothing that is done to them has an effect.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.bridges.gazebo.answers import Answer, no, yes
from gazelle.bridges.gazebo.context import GazeboContext
from gazelle.errors import Error
from gazelle.simulation import JointHandle
from gazelle_ros.msgs import gazebo_msgs


class JointServices:
    """Services of ``/gazebo`` about joints."""

    def __init__(self, context: GazeboContext) -> None:
        self._context = context
        self._entities = context.entities

    def get_properties(self, request: gazebo_msgs.srv.GetJointPropertiesRequest) -> Answer:
        """Answer ``get_joint_properties``; as in Gazebo the type is always 0 and damping empty."""
        found = self._entities.joint(request.joint_name)
        if found is None:
            if not self._entities.has_fixed_joint(request.joint_name):
                return no("GetJointProperties: joint not found")
            # What ODE's fixed joint answers.
            return {
                "position": [math.nan],
                "rate": [0.0],
                **yes("GetJointProperties: got properties"),
            }
        _, joint = found
        worlds = self._entities.worlds
        return {
            "type": 0,
            "damping": [],
            "position": joint.positions(worlds)[0, :1].tolist(),
            "rate": joint.velocities(worlds)[0, :1].tolist(),
            **yes("GetJointProperties: got properties"),
        }

    def set_properties(self, request: gazebo_msgs.srv.SetJointPropertiesRequest) -> Answer:
        """Answer ``set_joint_properties``: each list that is not empty changes something.

        Damping, limits and the motor's ``fmax`` and ``vel`` act. ODE's other numbers have no
        counterpart.
        """
        found = self._entities.joint(request.joint_name)
        if found is None:
            if not self._entities.has_fixed_joint(request.joint_name):
                return no("SetJointProperties: joint not found")
            return yes("SetJointProperties: properties set")
        _, joint = found
        config = request.ode_joint_config
        try:
            joint.set_properties(
                damping=_first(config.damping),
                lower=_first(config.loStop),
                upper=_first(config.hiStop),
                worlds=self._entities.worlds,
            )
            self._set_motor(joint, list(config.fmax), list(config.vel))
        except Error as error:
            return no(f"SetJointProperties: {error}")
        return yes("SetJointProperties: properties set")

    def _set_motor(
        self, joint: JointHandle, efforts: Sequence[float], speeds: Sequence[float]
    ) -> None:
        """Set ODE's motor: either number may come first, and each axis has its own."""
        if not efforts and not speeds:
            return
        worlds = self._entities.worlds
        if not joint.has_motor:
            joint.add_motor(0.0)
        known = joint.motor_effort(worlds)[0]
        if efforts:
            joint.set_properties(motor_effort=_filled(efforts, known), worlds=worlds)
        if speeds:
            joint.drive(_filled(speeds, np.zeros_like(known))[None], worlds)

    def apply_effort(self, request: gazebo_msgs.srv.ApplyJointEffortRequest) -> Answer:
        """Answer ``apply_joint_effort``."""
        found = self._entities.joint(request.joint_name)
        if found is None:
            if not self._entities.has_fixed_joint(request.joint_name):
                return no("ApplyJointEffort: joint not found")
            return yes("ApplyJointEffort: effort set")
        _, joint = found
        duration = request.duration.to_sec()
        try:
            joint.apply_effort(
                request.effort,
                start=self._context.seconds(request.start_time),
                duration=None if duration < 0.0 else duration,
                worlds=self._entities.worlds,
            )
        except Error as error:
            return no(f"ApplyJointEffort: {error}")
        return yes("ApplyJointEffort: effort set")

    def clear_efforts(self, request: gazebo_msgs.srv.JointRequestRequest) -> Answer:
        """Answer ``clear_joint_forces``; unknown joints are ignored."""
        found = self._entities.joint(request.joint_name)
        if found is not None:
            found[1].clear_efforts()
        return {}


def _filled(values: Sequence[float], rest: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the given values of the first axes, and ``rest`` for those after."""
    count = min(len(values), len(rest))
    return np.concatenate((np.asarray(values[:count], np.float64), rest[count:]))


def _first(values: Sequence[float] | NDArray[Any]) -> float | None:
    return float(values[0]) if len(values) else None
