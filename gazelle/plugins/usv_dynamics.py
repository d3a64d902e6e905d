"""Vessels on water: what ``libusv_gazebo_dynamics_plugin.so`` does.

Manoeuvring in six degrees of freedom, T. I. Fossen, "Handbook of Marine Craft Hydrodynamics and Motion
Control", chapters 6 and 7: M_A v' + D(v) v with diagonal matrices, and the weight of the water that two round
hulls displace, cut into slices. The water is still.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.rotations import conjugate, cross, rotate
from gazelle.simulation import ModelPlugin, Robot

# As the original has them: of the water's weight, and added to what the file cannot say [kg, kg m²].
_GRAVITY = 9.815
_LITTLE = 0.1


class UsvDynamics(ModelPlugin):
    """Buoyancy and drag of a vessel with two hulls."""

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the body."""
        simulation = robot.simulation
        self._engine, self._applied_wrenches = simulation.engine, simulation.applied_wrenches
        self._link, _ = robot.frame(parameters.get("bodyName", next(iter(robot.links))))
        self._level = parameters.get("waterLevel", 0.5)
        self._read_resistance(parameters)
        self._radius = parameters.get("hullRadius", 0.213)
        width, length = parameters.get("boatWidth", 1.0), parameters.get("boatLength", 1.35)
        slices = parameters.get("length_n", 1)
        if slices < 1 or self._radius <= 0.0:
            raise SimulationError(
                "a hull needs a radius above 0 and a length_n of 1 or more",
                source=parameters.source,
            )
        along = ((np.arange(slices) + 0.5) / slices - 0.5) * length
        sides = np.array((-0.5 * width, 0.5 * width))
        x, y = (each.ravel() for each in np.meshgrid(along, sides))
        self._points: Floats = np.column_stack((x, y, np.zeros_like(x)))
        self._weight = parameters.get("waterDensity", 997.7735) * _GRAVITY * length / slices
        self._before: Floats = np.zeros((simulation.nworld, 6))

    def _read_resistance(self, parameters: Parameters) -> None:
        """Read added mass and drag along and about x, y and z, six each."""
        surge, sway = parameters.get("xDotU", 5.0), parameters.get("yDotV", 5.0)
        yaw = parameters.get("nDotR", 1.0)
        self._added: Floats = np.array((surge, sway, _LITTLE, _LITTLE, _LITTLE, yaw))
        self._linear: Floats = np.array(
            (
                parameters.get("xU", 20.0),
                parameters.get("yV", 20.0),
                parameters.get("zW", 20.0),
                parameters.get("kP", 20.0),
                parameters.get("mQ", 20.0),
                parameters.get("nR", 20.0),
            )
        )
        surge, sway = parameters.get("xUU", 0.0), parameters.get("yVV", 0.0)
        self._quadratic: Floats = np.array((surge, sway, 0.0, 0.0, 0.0, parameters.get("nRR", 0.0)))

    def on_update(self, time: float) -> None:  # noqa: ARG002  it acts at every step
        """Apply buoyancy and drag."""
        place, motion = self._link.placement(), self._link.motion()
        back = conjugate(place.quaternion)
        own = np.hstack((rotate(back, motion.linear), rotate(back, motion.angular)))
        change = (own - self._before) / self._engine.time_step
        self._before = own
        drag = (self._linear + self._quadratic * np.abs(own)) * own
        resisting = -(self._added * change + drag)
        force = rotate(place.quaternion, resisting[:, :3])
        torque = rotate(place.quaternion, resisting[:, 3:])
        turned = place.quaternion[:, None]
        arms = rotate(
            np.broadcast_to(turned, (len(own), len(self._points), 4)),
            np.broadcast_to(self._points, (len(own), *self._points.shape)),
        )
        lift = np.zeros_like(arms)
        lift[..., 2] = self._lift(self._level - place.position[:, None, 2] - arms[..., 2])
        # The points are seen from the centre of mass, as the original has it.
        force += lift.sum(axis=1)
        torque += cross(arms, lift).sum(axis=1)
        self._applied_wrenches.hold("usv_dynamics", self._link.name, force, torque)

    def _lift(self, depth: Floats) -> Floats:
        """Return the weight of water that slices displace at depths [N].

        Half their circle at most.
        """
        radius = self._radius
        sunk = np.clip(depth, 0.0, radius)
        off = radius - sunk
        chord = np.sqrt(np.maximum(2.0 * radius * sunk - sunk**2, 0.0))
        segment = radius * radius * np.arccos(off / radius) - off * chord
        return np.asarray(self._weight * segment, np.float64)

    def reset(self, worlds: Worlds | None) -> None:
        """Reset the velocity to rest."""
        self._before[slice(None) if worlds is None else worlds] = 0.0

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the velocity in the last step."""
        return {"before": self._before.copy()}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._before[:] = state["before"]
