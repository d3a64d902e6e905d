"""Bodies in water: what ``libBuoyancyPlugin.so`` does."""

from __future__ import annotations

import math
import warnings
from functools import singledispatch
from typing import Any

import numpy as np

from gazelle.description import Box, Cylinder, Ellipsoid, Parameters, Sphere
from gazelle.errors import SimulationError, SimulationWarning
from gazelle.rotations import cross, rotate
from gazelle.simulation import LinkHandle, ModelPlugin, Robot

# Of fresh water at 15 °C [kg/m³].
_WATER = 999.1026


class Buoyancy(ModelPlugin):
    """Lifts links by the weight of the fluid that they displace; all is under water.

    Volumes are those of the file's ``<link>`` tags, else of boxes, spheres, cylinders and
    ellipsoids that collide.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, add up volumes."""
        self._simulation = robot.simulation
        self._density = parameters.get("fluid_density", _WATER)
        self._bodies = {link.name: (link, *_displaced(link)) for link in robot.links.values()}
        for tags in parameters.find_all("link"):
            link = robot.links[tags.attributes.get("name", "").rpartition("::")[2]]
            centre = np.asarray(tags.numbers("center_of_volume", (0.0, 0.0, 0.0)))
            volume = tags.get("volume", self._bodies[link.name][1])
            if not volume >= 0.0:
                raise SimulationError("a volume must not be negative", source=tags.source)
            self._bodies[link.name] = (link, volume, centre)

    def on_update(self, time: float) -> None:  # noqa: ARG002  it acts at every step
        """Apply buoyancy."""
        engine = self._simulation.engine
        gravity = engine.parameter("gravity", "")
        for name, (link, volume, centre) in self._bodies.items():
            place = link.placement()
            lever = rotate(place.quaternion, np.broadcast_to(centre, place.position.shape))
            lever = place.position + lever - engine.links[name].centre()
            force = -self._density * volume * gravity
            self._simulation.applied_wrenches.hold("buoyancy", name, force, cross(lever, force))


def _displaced(link: LinkHandle) -> tuple[float, np.ndarray[Any, np.dtype[np.float64]]]:
    """Return the volume [m³] and its centre in the link frame [m]."""
    volumes = [volume_of(each.geometry) for each in link.description.collisions]
    if any(math.isnan(volume) for volume in volumes):
        warnings.warn(
            SimulationWarning(
                f"'{link.name}': the volume of its meshes is not counted for buoyancy; give "
                "<link><volume> in the plugin"
            ),
            stacklevel=2,
        )
    volumes = [0.0 if math.isnan(volume) else volume for volume in volumes]
    total = sum(volumes)
    if total <= 0.0:
        return 0.0, np.zeros(3)
    places = np.array([each.pose.position for each in link.description.collisions])
    return total, np.asarray(volumes) @ places / total


@singledispatch
def volume_of(geometry: object) -> float:
    """Return the volume of a shape [m³]; NaN for an unknown one."""
    del geometry
    return math.nan


@volume_of.register
def _(geometry: Box) -> float:
    return math.prod(geometry.size)


@volume_of.register
def _(geometry: Sphere) -> float:
    return 4.0 / 3.0 * math.pi * geometry.radius**3


@volume_of.register
def _(geometry: Cylinder) -> float:
    return math.pi * geometry.radius**2 * geometry.length


@volume_of.register
def _(geometry: Ellipsoid) -> float:
    return 4.0 / 3.0 * math.pi * math.prod(geometry.radii)
