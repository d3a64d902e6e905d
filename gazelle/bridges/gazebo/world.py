"""The services on the world and its physics: pause, reset, properties, and Gazelle's own."""

from __future__ import annotations

import math
from typing import Any

from gazelle.bridges.conversions import point, set_point
from gazelle.bridges.gazebo.answers import Answer, no, yes
from gazelle.bridges.gazebo.context import GazeboContext
from gazelle.bridges.pacing import ACCEPTED, read_factor
from gazelle.errors import Error
from gazelle.simulation.physics import PhysicsProperties
from gazelle_ros.msgs import gazebo_msgs, gazelle_msgs, std_srvs

_MOST_STEPS = 10_000_000


class WorldServices:
    """Services of ``/gazebo`` about the world, and of ``/gazelle`` about the run."""

    def __init__(self, context: GazeboContext) -> None:
        self._context = context
        self._simulation = context.simulation

    def pause(self, _request: std_srvs.srv.EmptyRequest) -> Answer:
        """Answer ``pause_physics``: no step is made once this is answered."""
        self._simulation.pause()
        return {}

    def unpause(self, _request: std_srvs.srv.EmptyRequest) -> Answer:
        """Answer ``unpause_physics``."""
        self._simulation.unpause()
        return {}

    def reset_simulation(self, _request: std_srvs.srv.EmptyRequest) -> Answer:
        """Answer ``reset_simulation``: everything, and time."""
        self._simulation.reset()
        return {}

    def reset_world(self, _request: std_srvs.srv.EmptyRequest) -> Answer:
        """Answer ``reset_world``: everything but time."""
        self._simulation.reset(time=False)
        return {}

    def get_properties(self, _request: gazebo_msgs.srv.GetWorldPropertiesRequest) -> Answer:
        """Answer ``get_world_properties``."""
        return {
            "sim_time": self._context.now().to_sec(),
            "model_names": list(self._simulation.robots),
            "rendering_enabled": True,
            **yes("GetWorldProperties: got properties"),
        }

    def get_physics(self, _request: gazebo_msgs.srv.GetPhysicsPropertiesRequest) -> Answer:
        """Answer ``get_physics_properties``."""
        physics = self._simulation.physics
        response = self._context.response("GetPhysicsProperties")
        response.time_step = physics.time_step
        response.pause = self._simulation.paused
        response.max_update_rate = physics.update_rate
        set_point(response.gravity, physics.gravity)
        ode = response.ode_config
        ode.auto_disable_bodies = bool(physics.auto_disable)
        ode.sor_pgs_precon_iters = physics.precon_iterations
        ode.sor_pgs_iters = physics.iterations
        ode.sor_pgs_w = physics.sor
        ode.contact_surface_layer = physics.contact_surface_layer
        ode.contact_max_correcting_vel = physics.contact_max_correcting_velocity
        ode.cfm, ode.erp = physics.cfm, physics.erp
        ode.max_contacts = physics.max_contacts
        response.success = True
        response.status_message = "GetPhysicsProperties: got properties"
        return response

    def set_physics(self, request: gazebo_msgs.srv.SetPhysicsPropertiesRequest) -> Answer:
        """Answer ``set_physics_properties``."""
        ode = request.ode_config
        try:
            self.change_physics(
                time_step=request.time_step,
                update_rate=request.max_update_rate,
                gravity=point(request.gravity),
                auto_disable=ode.auto_disable_bodies,
                precon_iterations=ode.sor_pgs_precon_iters,
                iterations=ode.sor_pgs_iters,
                sor=ode.sor_pgs_w,
                cfm=ode.cfm,
                erp=ode.erp,
                contact_surface_layer=ode.contact_surface_layer,
                contact_max_correcting_velocity=ode.contact_max_correcting_vel,
                max_contacts=ode.max_contacts,
            )
        except Error as error:
            return no(f"SetPhysicsProperties: {error}")
        return yes("physics engine updated")

    def change_physics(self, **requested: Any) -> None:
        """Set the properties that differ from the present ones."""
        physics = self._simulation.physics
        changed = {name: value for name, value in requested.items() if value != _now(physics, name)}
        if changed:
            physics.set(**changed)

    def step(self, request: gazelle_msgs.srv.StepRequest) -> Answer:
        """Answer ``/gazelle/step``: advance a paused world, and answer when the steps are made."""
        if not self._simulation.paused:
            return {"time": self._context.now(), **no("Step: the simulation is not paused")}
        if request.steps > _MOST_STEPS:
            return {"time": self._context.now(), **no(f"Step: at most {_MOST_STEPS} at once")}
        self._simulation.step(request.steps)
        return {"time": self._context.now(), **yes("Step: steps made")}

    def seed(self, request: gazelle_msgs.srv.SeedRequest) -> Answer:
        """Answer ``/gazelle/seed``: reset everything with another seed."""
        self._simulation.reset(seed=request.seed)
        return yes("Seed: the simulation is reset")

    def snapshot(self, _request: gazelle_msgs.srv.SnapshotRequest) -> Answer:
        """Answer ``/gazelle/snapshot``."""
        return {"state": self._simulation.snapshot(), **yes("Snapshot: taken")}

    def restore(self, request: gazelle_msgs.srv.RestoreRequest) -> Answer:
        """Answer ``/gazelle/restore``."""
        try:
            self._simulation.restore(bytes(request.state))
        except Error as error:
            return no(f"Restore: {error}")
        return yes("Restore: done")

    def set_real_time_factor(self, request: gazelle_msgs.srv.SetRealTimeFactorRequest) -> Answer:
        """Answer ``/gazelle/set_real_time_factor``: a number, or ``max``."""
        factor = read_factor(request.real_time_factor)
        if factor is None:
            said = f"expected {ACCEPTED}, not '{request.real_time_factor}'"
            return no(f"SetRealTimeFactor: {said}")
        physics = self._simulation.physics
        rate = factor / physics.time_step
        self.change_physics(update_rate=rate if math.isfinite(rate) else 0.0)
        return yes("SetRealTimeFactor: done")


def _now(physics: PhysicsProperties, name: str) -> Any:
    """Return a property as a request would give it."""
    value = getattr(physics, name)
    return bool(value) if name == "auto_disable" else value
