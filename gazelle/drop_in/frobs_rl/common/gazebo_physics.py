"""Physics of the simulator: pace, step, gravity and ODE's settings."""

from __future__ import annotations

from typing import Any

from gazelle.drop_in.frobs_rl.common.connection import gazebo, reporting
from gazelle_ros.msgs import geometry_msgs


@reporting
def gazebo_set_max_update_rate(max_update_rate: float) -> None:
    """Set the pace as a multiple of real time; 0 for as fast as possible."""
    gazebo().real_time_factor = max_update_rate


def gazebo_get_max_update_rate() -> float:
    """Return the target steps per second of wall time [Hz]; 0 for as many as possible."""
    return gazebo().physics.max_update_rate


@reporting
def gazebo_set_time_step(new_time_step: float) -> None:
    """Set the time between two steps [s]; the pace, as a multiple of real time, stays."""
    simulator = gazebo()
    factor = simulator.real_time_factor
    simulator.set_physics(time_step=new_time_step, max_update_rate=factor / new_time_step)


def gazebo_get_time_step() -> float:
    """Return the time between two steps [s]."""
    return gazebo().time_step


@reporting
def gazebo_set_gravity(x: float, y: float, z: float) -> None:
    """Set gravity [m/s²]."""
    gazebo().gravity = (x, y, z)


def gazebo_get_gravity() -> Any:
    """Return gravity, a ``geometry_msgs/Vector3`` [m/s²]."""
    vector = geometry_msgs.msg.Vector3
    return vector(*gazebo().gravity)


@reporting
def gazebo_set_ODE_physics(  # noqa: N802  # frobs_rl's name
    auto_disable_bodies: bool,  # noqa: FBT001
    sor_pgs_precon_iters: int,
    sor_pgs_iters: int,
    sor_pgs_w: float,
    sor_pgs_rms_error_tol: float,
    contact_surface_layer: float,
    contact_max_correcting_vel: float,
    cfm: float,
    erp: float,
    max_contacts: int,
) -> None:
    """Set ODE's settings."""
    gazebo().set_physics(
        auto_disable_bodies=auto_disable_bodies,
        sor_pgs_precon_iters=sor_pgs_precon_iters,
        sor_pgs_iters=sor_pgs_iters,
        sor_pgs_w=sor_pgs_w,
        sor_pgs_rms_error_tol=sor_pgs_rms_error_tol,
        contact_surface_layer=contact_surface_layer,
        contact_max_correcting_vel=contact_max_correcting_vel,
        cfm=cfm,
        erp=erp,
        max_contacts=max_contacts,
    )


def gazebo_get_ODE_physics() -> Any:  # noqa: N802  # frobs_rl's name
    """Return ODE's settings, a ``gazebo_msgs/ODEPhysics``."""
    return gazebo().physics.ode


@reporting
def gazebo_set_default_properties() -> None:
    """Set what an empty world of Gazebo begins with."""
    gazebo().set_default_physics()
