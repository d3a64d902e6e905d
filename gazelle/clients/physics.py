"""The physics of a Gazebo: step, pace, gravity and ODE's settings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from gazelle.argument_checks import checked
from gazelle.clients.calls import Caller
from gazelle.clients.errors import ClientError
from gazelle.clients.poses import Vector, three
from gazelle_ros.msgs import geometry_msgs


@dataclass(frozen=True, slots=True)
class PhysicsSettings:
    """Physics settings of a world.

    Attributes:
        time_step: Between two steps [s].
        max_update_rate: Steps a second of wall time to aim at [Hz]; 0 for as many as possible.
        gravity: [m/s²].
        paused: Whether time stands still.
        ode: ODE's settings, a ``gazebo_msgs/ODEPhysics``.
    """

    time_step: float
    max_update_rate: float
    gravity: Vector
    paused: bool
    ode: Any


@checked(ClientError, after=True)
class PhysicsCalls:
    """Calls of a client of Gazebo that concern its physics."""

    _caller: Caller

    @property
    def physics(self) -> PhysicsSettings:
        """Settings of the physics."""
        found = self._caller.demand("get_physics_properties", "gazebo_msgs/GetPhysicsProperties")
        gravity = (found.gravity.x, found.gravity.y, found.gravity.z)
        return PhysicsSettings(
            found.time_step, found.max_update_rate, gravity, found.pause, found.ode_config
        )

    def set_physics(
        self,
        *,
        time_step: float | None = None,
        max_update_rate: float | None = None,
        gravity: Vector | None = None,
        **ode: Any,
    ) -> None:
        """Set properties of the physics; those that are None stay.

        Args:
            time_step: [s].
            max_update_rate: [Hz]; 0 for as fast as possible.
            gravity: [m/s²].
            ode: Fields of ``gazebo_msgs/ODEPhysics``, such as ``sor_pgs_iters=100``.

        Raises:
            ClientError: There is no such field, or Gazebo refuses.
        """
        now = self.physics
        for name, value in ode.items():
            if name not in now.ode.__slots__:
                raise ClientError(f"ODEPhysics has no field '{name}'")
            setattr(now.ode, name, value)
        x, y, z = three(gravity or now.gravity, "gravity")
        self._caller.demand(
            "set_physics_properties",
            "gazebo_msgs/SetPhysicsProperties",
            time_step=now.time_step if time_step is None else time_step,
            max_update_rate=now.max_update_rate if max_update_rate is None else max_update_rate,
            gravity=vector(x, y, z),
            ode_config=now.ode,
        )

    @property
    def real_time_factor(self) -> float:
        """Simulated seconds a wall second to aim at; 0 for as many as possible."""
        now = self.physics
        return now.max_update_rate * now.time_step

    @real_time_factor.setter
    def real_time_factor(self, value: float) -> None:
        self.set_physics(max_update_rate=value / self.physics.time_step)

    @property
    def time_step(self) -> float:
        """Time between two steps of the physics [s]."""
        return self.physics.time_step

    @time_step.setter
    def time_step(self, value: float) -> None:
        self.set_physics(time_step=value)

    @property
    def gravity(self) -> Vector:
        """Gravity [m/s²]."""
        return self.physics.gravity

    @gravity.setter
    def gravity(self, value: Vector) -> None:
        self.set_physics(gravity=value)

    def set_default_physics(self) -> None:
        """Set the physics of an empty world of Gazebo: 1 ms steps in real time, 9.8 m/s² down."""
        self.set_physics(
            time_step=0.001,
            max_update_rate=1000.0,
            gravity=(0.0, 0.0, -9.8),
            auto_disable_bodies=False,
            sor_pgs_precon_iters=0,
            sor_pgs_iters=50,
            sor_pgs_w=1.3,
            cfm=0.0,
            erp=0.2,
            contact_surface_layer=0.001,
            contact_max_correcting_vel=100.0,
            max_contacts=20,
        )


def vector(x: float, y: float, z: float) -> geometry_msgs.msg.Vector3:
    """Return a ``geometry_msgs/Vector3``."""
    return geometry_msgs.msg.Vector3(x, y, z)
