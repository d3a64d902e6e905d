"""Control law of SJTU's quadrotor (``libplugin_drone.so``), in every world at once.

Three PIDs in a row for each horizontal axis: of the place (if commanded), of the velocity, of the tilt;
one for the velocity upwards, and one for the turning rate. Their output acts as one force along
the drone's own z axis and one torque, as if four rotors had made them at once. Forces are not rotors'.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats, Worlds
from gazelle.description import Parameters
from gazelle.engines import Motion, Placement
from gazelle.plugins.filtered_pid import FilteredGains, FilteredPids
from gazelle.rotations import conjugate, from_yaw, roll_pitch_yaw, rotate

# Thrust is not raised any more for what is tilted farther: the cosine there.
_STEEPEST = 1e-3
_WEIGHTLESS = 1e-9


@dataclass(frozen=True, slots=True)
class DroneMoment:
    """Input of one step of the law.

    Attributes:
        place: Positions of the drones.
        motion: Twists, in the world frame.
        acceleration: Change of the velocity since the last step [m/s²], shape (nworld, 3).
        moved: Change of the position since then [m], likewise.
        step: Time since then [s].
    """

    place: Placement
    motion: Motion
    acceleration: Floats
    moved: Floats
    step: float


@dataclass(frozen=True, slots=True)
class DroneOrders:
    """Commands of drones, arrays over worlds.

    Attributes:
        linear: Velocity, or place where ``places`` [m/s or m], shape (nworld, 3).
        angular: Tilt about x and y [rad], or velocities where ``speeds`` [m/s], for drones that take off or
            land; turning rate about z [rad/s], shape (nworld, 3).
        flying: Neither on the ground, taking off nor landing.
        places: Fly to a place in the world frame.
        speeds: Take ``angular`` for velocities.
    """

    linear: Floats
    angular: Floats
    flying: Bools
    places: Bools
    speeds: Bools


class DroneLaw:
    """The controllers of one drone in every world.

    Args:
        parameters: Tags of the plugin.
        mass: Assumed mass of the drone [kg], shape (nworld,).
        inertia: Likewise, about x, y and z [kg m²], shape (nworld, 3).

    Attributes:
        pids: All controllers, by the prefix of their tags.
    """

    def __init__(self, parameters: Parameters, mass: Floats, inertia: Floats) -> None:
        self._mass, self._inertia = mass, inertia
        self._max_force = parameters.get("maxForce", -1.0)
        counts = {"rollpitch": 2, "yaw": 1, "velocityXY": 2, "velocityZ": 1}
        counts |= {"positionXY": 2, "positionZ": 1}
        self.pids = {
            prefix: FilteredPids(FilteredGains.read(parameters, prefix), len(mass), count)
            for prefix, count in counts.items()
        }

    def reset(self, worlds: Worlds | None) -> None:
        """Discard sums and filtered commands."""
        for each in self.pids.values():
            each.reset(worlds)

    def wrench(
        self, now: DroneMoment, orders: DroneOrders, gravity: Floats
    ) -> tuple[Floats, Floats]:
        """Return thrust along z [N], (nworld,), and torque in the drone's frame [N m].

        The torque has shape (nworld, 3).

        Args:
            now: Motion of the drones.
            orders: The commands.
            gravity: In the world frame [m/s²], shape (nworld, 3).
        """
        pids, step, linear = self.pids, now.step, now.motion.linear
        angles = roll_pitch_yaw(now.place.quaternion)
        weight = np.maximum(np.linalg.norm(gravity, axis=1), _WEIGHTLESS)
        # A drone that is commanded a place is not held up unless it flies; so in the original.
        held = orders.flying | ~orders.places
        tilt, climb = self._tilt_and_climb(now, orders, from_yaw(-angles[:, 2]), weight)
        rates = rotate(conjugate(now.place.quaternion), now.motion.angular)
        turning = orders.angular[:, 2:]
        angular = np.hstack(
            (
                pids["rollpitch"].update(tilt, angles[:, :2], rates[:, :2], step, held),
                pids["yaw"].update(turning, now.motion.angular[:, 2:], 0.0, step, ~orders.places),
            )
        )
        angular[orders.places, 2] = 0.0
        rising, change = linear[:, 2:], now.acceleration[:, 2:]
        lift = pids["velocityZ"].update(climb, rising, change, step, held)[:, 0]
        thrust = self._mass * (lift + _load(now.place, gravity, weight) * weight)
        most = self._max_force if self._max_force > 0.0 else np.inf
        return np.where(held, np.clip(thrust, 0.0, most), 0.0), self._inertia * angular * held[
            :, None
        ]

    def _tilt_and_climb(
        self, now: DroneMoment, orders: DroneOrders, back: Floats, weight: Floats
    ) -> tuple[Floats, Floats]:
        """Return roll and pitch [rad], (nworld, 2), and upward velocity [m/s], (nworld, 1)."""
        pids, step = self.pids, now.step
        velocity, change = rotate(back, now.motion.linear), rotate(back, now.acceleration)
        desired = np.where(orders.flying[:, None], orders.linear[:, :2], orders.angular[:, :2])
        climb = orders.linear[:, 2:]
        chasing = orders.flying & orders.places
        if chasing.any():
            place, moved = now.place.position, now.moved
            # The rate is what it moved in a step, not in a second; so in the original.
            level = pids["positionXY"].update(
                orders.linear[:, :2], place[:, :2], moved[:, :2], step, chasing
            )
            up = pids["positionZ"].update(climb, place[:, 2:], moved[:, 2:], step, chasing)
            own = rotate(back, np.hstack((level, up)))
            desired = np.where(chasing[:, None], own[:, :2], desired)
            climb = np.where(chasing[:, None], up, climb)
        steady = orders.flying | (orders.speeds & ~orders.places)
        pull = pids["velocityXY"].update(desired, velocity[:, :2], change[:, :2], step, steady)
        pull = pull / weight[:, None]
        leaning = np.column_stack((-pull[:, 1], pull[:, 0]))
        return np.where(steady[:, None], leaning, orders.angular[:, :2]), climb


def _load(place: Placement, gravity: Floats, weight: Floats) -> Floats:
    """Return the factor of a tilted drone's thrust, shape (nworld,)."""
    cosine = (gravity * rotate(place.quaternion, gravity)).sum(axis=1) / weight**2
    kept = np.where(cosine < 0.0, -1.0, 1.0) * np.maximum(np.abs(cosine), _STEEPEST)
    load: Floats = 1.0 / kept
    return load
