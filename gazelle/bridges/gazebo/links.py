"""The services on links: state, properties, wrenches."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.bridges.conversions import point, set_pose, set_twist
from gazelle.bridges.gazebo.answers import Answer, no, yes
from gazelle.bridges.gazebo.context import GazeboContext
from gazelle.bridges.gazebo.entities import State, is_world
from gazelle.bridges.gazebo.models import read_state
from gazelle.errors import Error
from gazelle.rotations import cross, rotate
from gazelle.simulation import LinkHandle
from gazelle_ros.msgs import gazebo_msgs
from gazelle_ros.time import Duration

_UNSCOPED = "link not found, did you forget to scope the link by model name?"


class LinkServices:
    """Services of ``/gazebo`` about links."""

    def __init__(self, context: GazeboContext) -> None:
        self._context = context
        self._entities = context.entities
        self._engine = context.simulation.engine

    def get_properties(self, request: gazebo_msgs.srv.GetLinkPropertiesRequest) -> Answer:
        """Answer ``get_link_properties``."""
        link = self._entities.link(request.link_name)
        if link is None:
            return no(f"GetLinkProperties: {_UNSCOPED}")
        mass, gravity, tensor = (
            self._value(kind, link) for kind in ("link_mass", "link_gravity", "link_inertia")
        )
        response = self._context.response("GetLinkProperties")
        set_pose(response.com, self._value("link_centre", link), (0.0, 0.0, 0.0, 1.0))
        response.gravity_mode = bool(gravity[0] > 0.0)
        response.mass = float(mass[0])
        response.ixx, response.iyy, response.izz = tensor[:3].tolist()
        response.ixy, response.ixz, response.iyz = tensor[3:].tolist()
        response.success = True
        response.status_message = "GetLinkProperties: got properties"
        return response

    def set_properties(self, request: gazebo_msgs.srv.SetLinkPropertiesRequest) -> Answer:
        """Answer ``set_link_properties``; the orientation of ``com`` has no meaning here."""
        link = self._entities.link(request.link_name)
        if link is None:
            return no(f"SetLinkProperties: {_UNSCOPED}")
        tensor = [request.ixx, request.iyy, request.izz, request.ixy, request.ixz, request.iyz]
        try:
            link.set_properties(
                mass=request.mass,
                centre=np.array([point(request.com.position)]),
                inertia=np.array([tensor]),
                gravity=float(request.gravity_mode),
                worlds=self._entities.worlds,
            )
        except Error as error:
            return no(f"SetLinkProperties: {error}")
        return yes("SetLinkProperties: properties set")

    def get_state(self, request: gazebo_msgs.srv.GetLinkStateRequest) -> Answer:
        """Answer ``get_link_state``."""
        link = self._entities.link(request.link_name)
        if link is None:
            return no(f"GetLinkState: {_UNSCOPED}")
        frame = self._entities.frame(request.reference_frame)
        if frame is None:
            return no(
                "GetLinkState: reference reference_frame not found, did you forget to scope the "
                "link by model name?"
            )
        seen = self._entities.state(link).seen_from(frame)
        response = self._context.response("GetLinkState")
        state = response.link_state
        state.link_name = request.link_name
        state.reference_frame = request.reference_frame
        set_pose(state.pose, seen.position, seen.quaternion)
        set_twist(state.twist, seen.linear, seen.angular)
        response.success = True
        response.status_message = "GetLinkState: got state"
        return response

    def set_state(self, request: gazebo_msgs.srv.SetLinkStateRequest) -> Answer:
        """Answer ``set_link_state``."""
        return self.set_state_of(request.link_state)

    def set_state_of(self, target: gazebo_msgs.msg.LinkState) -> Answer:
        """Apply a ``gazebo_msgs/LinkState`` of the service or the topic."""
        link = self._entities.link(target.link_name)
        if link is None:
            return no("SetLinkState: link does not exist")
        frame = self._entities.frame(target.reference_frame)
        if frame is None:
            return no("SetLinkState: failed")
        state, worlds = read_state(target), self._entities.worlds
        place = state.placed_in(frame)
        # Gazebo does not turn the velocity, and takes the frame's own off.
        linear, angular = state.linear - frame.linear, state.angular - frame.angular
        try:
            missed = link.approach(place.position, place.quaternion, worlds)
            link.set_twist(linear, angular, worlds)
        except Error as error:
            return no(f"SetLinkState: failed: {error}")
        return yes(f"SetLinkState: success{', but ' if missed else ''}{missed}")

    def apply_wrench(self, request: gazebo_msgs.srv.ApplyBodyWrenchRequest) -> Answer:
        """Answer ``apply_body_wrench``.

        As in Gazebo the force acts at the centre of mass, and the torque of the force at
        ``reference_point`` is added. Given in a frame, the lever begins at the body's origin;
        given in the world frame, ``reference_point`` is the lever.
        """
        link = self._entities.link(request.body_name)
        if link is None:
            return no("ApplyBodyWrench: body does not exist")
        frame = self._entities.frame(request.reference_frame)
        if frame is None:
            return no("ApplyBodyWrench: reference_frame not found")
        force, torque = self._wrench(request, link, frame)
        try:
            link.apply_wrench(
                force,
                torque,
                start=self._context.seconds(request.start_time),
                duration=_duration(request.duration),
                worlds=self._entities.worlds,
            )
        except Error as error:
            return no(f"ApplyBodyWrench: {error}")
        return yes("")

    def _wrench(
        self, request: gazebo_msgs.srv.ApplyBodyWrenchRequest, link: LinkHandle, frame: State
    ) -> tuple[Any, Any]:
        force = rotate(frame.quaternion, np.array(point(request.wrench.force)))
        torque = rotate(frame.quaternion, np.array(point(request.wrench.torque)))
        lever = rotate(frame.quaternion, np.array(point(request.reference_point)))
        if not is_world(request.reference_frame):
            lever = lever + frame.position - self._entities.state(link).position
        torque = torque + cross(lever, force)
        return force, torque

    def clear_wrenches(self, request: gazebo_msgs.srv.BodyRequestRequest) -> Answer:
        """Answer ``clear_body_wrenches``; unknown bodies are ignored."""
        link = self._entities.link(request.body_name)
        if link is not None:
            link.clear_wrenches()
        return {}

    def _value(self, kind: str, link: LinkHandle) -> Any:
        return self._engine.parameter(kind, link.name, self._entities.worlds)[0]


def _duration(duration: Duration) -> float | None:
    """Return seconds; None for negative ones, which mean for ever."""
    seconds = duration.to_sec()
    return None if seconds < 0.0 else seconds
