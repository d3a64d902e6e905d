"""Wings and keels: what ``libLiftDragPlugin.so`` does.

A thin aerofoil with coefficients linear in the angle of attack, up to stall and beyond it;
Anderson, "Fundamentals of Aerodynamics", chapters 4 and 5, for the meaning of the terms.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Parameters
from gazelle.rotations import cross, rotate
from gazelle.simulation import ModelPlugin, Robot

# Slower than this there is no flow [m/s].
_CALM = 0.01


class LiftDrag(ModelPlugin):
    """Pushes a link with lift and drag of its motion through air or water at rest."""

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find link and control joint."""
        self._simulation = robot.simulation
        self._link, _ = robot.frame(parameters.require("link_name", str))
        self._zero = parameters.get("a0", 0.0)
        self._slopes = {
            name: (parameters.get(name, slope), parameters.get(f"{name}_stall", 0.0))
            for name, slope in (("cla", 1.0), ("cda", 0.01))
        }
        self._stall = parameters.get("alpha_stall", math.pi / 2.0)
        self._centre = np.asarray(parameters.numbers("cp", (0.0, 0.0, 0.0)))
        self._forward = np.asarray(parameters.numbers("forward", (1.0, 0.0, 0.0)))
        self._upward = np.asarray(parameters.numbers("upward", (0.0, 0.0, 1.0)))
        self._radial = parameters.get("radial_symmetry", False)
        density = parameters.get("air_density", 1.2041)
        self._scale = 0.5 * density * parameters.get("area", 1.0)
        joint = parameters.get("control_joint_name", "")
        self._joint = robot.joints[joint.rpartition("::")[2]] if joint else None
        self._joint_lift = parameters.get("control_joint_rad_to_cl", 4.0)
        self._name = f"lift_drag {self._centre.tolist()} {self._forward.tolist()} {joint}"

    def on_update(self, time: float) -> None:  # noqa: ARG002  it acts at every step
        """Apply lift and drag."""
        place, motion = self._link.placement(), self._link.motion()
        arm = rotate(place.quaternion, np.broadcast_to(self._centre, place.position.shape))
        velocity = motion.linear + cross(motion.angular, arm)
        force = self._force(place.quaternion, velocity)
        force[np.linalg.norm(velocity, axis=1) <= _CALM] = 0.0
        lever = place.position + arm - self._simulation.engine.links[self._link.name].centre()
        self._simulation.applied_wrenches.hold(
            self._name, self._link.name, force, cross(lever, force)
        )

    def _force(self, quaternion: Floats, velocity: Floats) -> Floats:
        """Return lift and drag [N], in the world frame, shape (nworld, 3)."""
        forward = rotate(quaternion, np.broadcast_to(self._forward, velocity.shape))
        if self._radial:
            upward = _unit(-cross(forward, cross(forward, velocity)))
        else:
            upward = rotate(quaternion, np.broadcast_to(self._upward, velocity.shape))
        span = _unit(cross(forward, upward))
        sweep = np.clip(_dot(span, _unit(velocity)), -1.0, 1.0)
        straight = 1.0 - sweep**2
        flow = velocity - _dot(velocity, span)[:, None] * span
        lifting = _unit(cross(span, flow))
        turned = np.arccos(np.clip(_dot(lifting, upward), -1.0, 1.0))
        angle = self._zero + np.where(_dot(lifting, forward) >= 0.0, turned, -turned)
        angle = (angle + math.pi / 2.0) % math.pi - math.pi / 2.0
        pressure = self._scale * _dot(flow, flow)
        lift = self._coefficient("cla", angle) * straight
        if self._joint is not None:
            lift = lift + self._joint_lift * self._joint.positions()[:, 0]
        drag = np.abs(self._coefficient("cda", angle) * straight)
        along: Floats = (pressure * lift)[:, None] * lifting
        return along - (pressure * drag)[:, None] * _unit(flow)

    def _coefficient(self, name: str, angle: Floats) -> Floats:
        """Return a coefficient: linear up to stall, with another slope beyond.

        Lift keeps its sign there.
        """
        slope, beyond = self._slopes[name]
        over = np.maximum(np.abs(angle) - self._stall, 0.0)
        size = slope * np.minimum(np.abs(angle), self._stall) + beyond * over
        if name == "cla":
            size = np.where(over > 0.0, np.maximum(size, 0.0), size)
        return np.asarray(np.sign(angle) * size, np.float64)


def _dot(a: Floats, b: Floats) -> Floats:
    return np.asarray((a * b).sum(axis=1), np.float64)


def _unit(v: Floats) -> Floats:
    return np.asarray(v / np.maximum(np.linalg.norm(v, axis=1, keepdims=True), 1e-12), np.float64)
