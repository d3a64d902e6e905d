"""The dynamic_reconfigure server of ``gazebo_ros/Physics``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gazelle.bridges.gazebo.context import GazeboContext
from gazelle.bridges.gazebo.world import WorldServices
from gazelle.simulation import Tunable, Tuning
from gazelle_ros.reconfigure import ReconfigureServer

_PHYSICS = (
    Tunable("time_step", 0.001, 0.0, 10.0, "Time between two steps of the physics [s]"),
    Tunable("max_update_rate", 60.0, 0.0, 1000.0, "Steps a second of real time to aim at"),
    Tunable("gravity_x", 0.0, -100.0, 100.0, "Gravity along x [m/s^2]"),
    Tunable("gravity_y", 0.0, -100.0, 100.0, "Gravity along y [m/s^2]"),
    Tunable("gravity_z", -9.8, -100.0, 100.0, "Gravity along z [m/s^2]"),
    Tunable("auto_disable_bodies", False, False, True, "Let bodies at rest sleep"),
    Tunable("sor_pgs_precon_iters", 0, 0, 10000, "Preconditioning iterations"),
    Tunable("sor_pgs_iters", 20, 0, 10000, "Iterations of the solver"),
    Tunable("sor_pgs_w", 1.3, 0.0, 5.0, "Over-relaxation"),
    Tunable("sor_pgs_rms_error_tol", -1.0, -1.0, 10000.0, "Error to stop at; not used"),
    Tunable("cfm", 0.0, 0.0, 10.0, "Constraint force mixing"),
    Tunable("erp", 0.2, 0.0, 10.0, "Share of an error reduced in a step"),
    Tunable("contact_surface_layer", 0.001, 0.0, 10.0, "Depth left uncorrected [m]"),
    Tunable("contact_max_correcting_vel", 100.0, 0.0, 1e7, "Fastest correction [m/s]"),
    Tunable("max_contacts", 100, 0, 10_000_000, "Contacts between two shapes"),
)
_NAMES = {
    "time_step": "time_step",
    "max_update_rate": "update_rate",
    "auto_disable_bodies": "auto_disable",
    "sor_pgs_precon_iters": "precon_iterations",
    "sor_pgs_iters": "iterations",
    "sor_pgs_w": "sor",
    "cfm": "cfm",
    "erp": "erp",
    "contact_surface_layer": "contact_surface_layer",
    "contact_max_correcting_vel": "contact_max_correcting_velocity",
    "max_contacts": "max_contacts",
}


class PhysicsReconfigure:
    """Physics properties as rqt_reconfigure sets them; it begins with those that hold."""

    def __init__(self, context: GazeboContext, world: WorldServices) -> None:
        self._world = world
        self._physics = context.simulation.physics
        tuning = Tuning(context.node.name, _PHYSICS, self._change, self._now)
        tuning.bind(context.simulation.lock)
        self._server = ReconfigureServer(context.node, tuning.topic, tuning)

    def close(self) -> None:
        """Remove it from the graph."""
        self._server.close()

    def _now(self) -> dict[str, Any]:
        values = {theirs: getattr(self._physics, ours) for theirs, ours in _NAMES.items()}
        values["auto_disable_bodies"] = bool(values["auto_disable_bodies"])
        gravity = dict(
            zip(("gravity_x", "gravity_y", "gravity_z"), self._physics.gravity, strict=True)
        )
        return {**values, **gravity, "sor_pgs_rms_error_tol": -1.0}

    def _change(self, changes: Mapping[str, Any]) -> None:
        values = {ours: changes[theirs] for theirs, ours in _NAMES.items()}
        gravity = (changes["gravity_x"], changes["gravity_y"], changes["gravity_z"])
        self._world.change_physics(gravity=gravity, **values)
