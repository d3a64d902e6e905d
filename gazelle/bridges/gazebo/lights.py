"""The services on lights."""

from __future__ import annotations

from dataclasses import replace

from gazelle.bridges.conversions import point, pose_of_message
from gazelle.bridges.gazebo.answers import Answer, no, yes
from gazelle.bridges.gazebo.context import GazeboContext
from gazelle.description import Light
from gazelle_ros.msgs import gazebo_msgs, std_msgs


class LightServices:
    """Services of ``/gazebo`` about lights."""

    def __init__(self, context: GazeboContext) -> None:
        self._simulation = context.simulation

    def add(self, light: Light) -> bool:
        """Add a light to the world; False if there is a light or a model of that name."""
        if self._find(light.name) is not None or light.name in self._simulation.robots:
            return False
        self._keep((*self._simulation.world.lights, light))
        return True

    def delete(self, request: gazebo_msgs.srv.DeleteLightRequest) -> Answer:
        """Answer ``delete_light``."""
        if self._find(request.light_name) is None:
            # Gazebo writes this over the better reason.
            return no(f'DeleteLight: Timeout reached while removing light "{request.light_name}"')
        lights = self._simulation.world.lights
        self._keep(tuple(light for light in lights if light.name != request.light_name))
        return yes("DeleteLight: " + request.light_name + " successfully deleted")

    def get(self, request: gazebo_msgs.srv.GetLightPropertiesRequest) -> Answer:
        """Answer ``get_light_properties``."""
        light = self._find(request.light_name)
        if light is None:
            return no("getLightProperties: Requested light " + request.light_name + " not found!")
        return {
            "diffuse": std_msgs.msg.ColorRGBA(*light.diffuse),
            "attenuation_constant": light.attenuation.constant,
            "attenuation_linear": light.attenuation.linear,
            "attenuation_quadratic": light.attenuation.quadratic,
            **yes(""),
        }

    def set(self, request: gazebo_msgs.srv.SetLightPropertiesRequest) -> Answer:
        """Answer ``set_light_properties``."""
        light = self._find(request.light_name)
        if light is None:
            return no("setLightProperties: Requested light " + request.light_name + " not found!")
        self._simulation.set_light(
            request.light_name,
            cast_shadows=request.cast_shadows,
            diffuse=_colour(request.diffuse),
            specular=_colour(request.specular),
            attenuation=replace(
                light.attenuation,
                constant=request.attenuation_constant,
                linear=request.attenuation_linear,
                quadratic=request.attenuation_quadratic,
            ),
            direction=point(request.direction),
            pose=pose_of_message(request.pose),
        )
        return yes("")

    def _find(self, name: str) -> Light | None:
        return next((light for light in self._simulation.world.lights if light.name == name), None)

    def _keep(self, lights: tuple[Light, ...]) -> None:
        engine = self._simulation.engine
        engine.update_world(replace(self._simulation.world, lights=lights))


def _colour(message: std_msgs.msg.ColorRGBA) -> tuple[float, float, float, float]:
    return (message.r, message.g, message.b, message.a)
