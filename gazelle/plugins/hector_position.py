"""Hector's GPS, magnetometer and barometer: ``libhector_gazebo_ros_gps.so`` and its kin."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.description import Parameters, SphericalCoordinates
from gazelle.plugins.frames import placed
from gazelle.plugins.hector_errors import Interval, SensorErrors
from gazelle.plugins.hector_imu import rate_of
from gazelle.plugins.publishing import Publishing
from gazelle.plugins.stateful import Noisy
from gazelle.rotations import conjugate, rotate
from gazelle.sensors.geodesy import EQUATORIAL_RADIUS, FLATTENING, TangentPlane
from gazelle.simulation import Output, Robot, Service, absolute, namespace_of
from gazelle.simulation.values import Fix, GeoReference, MagneticValue, PointValue, VectorValue

Floats = NDArray[np.float64]
Worlds = NDArray[np.intp]

_E2 = FLATTENING * (2.0 - FLATTENING)  # first eccentricity squared


class _OnBody(Noisy, Publishing):
    """A sensor on a body, with errors."""

    def _hold(self, robot: Robot, parameters: Parameters, kind: str) -> str:
        """Find the body; returns its name."""
        self._robot, self._simulation = robot, robot.simulation
        body = parameters.get("bodyName", next(iter(robot.links)))
        self._frame = robot.frame(body)
        self._name = f"{robot.name}::{body}::{kind}"
        self._interval = Interval()
        self._noises = {"interval": self._interval}
        return body

    def _errors(self, parameters: Parameters, prefix: str, axes: int) -> SensorErrors:
        simulation = self._simulation
        name = f"{self._name}::{prefix}"
        made = SensorErrors(parameters, prefix, axes, simulation.seed, name, simulation.nworld)
        self._noises[prefix or "errors"] = made
        return made

    def _publish(self, parameters: Parameters, topic: str, output: Output[object]) -> None:
        output.topic = absolute(namespace_of(self._robot, parameters), topic)
        self._robot.outputs[topic.strip("/")] = output
        self._published.append(output)


class HectorGps(_OnBody):
    """Publishes where a body is on Earth, and its velocity north, west and up.

    The world's x axis points ``referenceHeading`` degrees east of north.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the body, open the ports."""
        self._hold(robot, parameters, "hector_gps")
        nworld = robot.simulation.nworld
        self._spherical = parameters.get("useWorldSphericalCoordinates", False)
        given = [
            parameters.get("referenceLatitude", 49.9),
            parameters.get("referenceLongitude", 8.9),
            parameters.get("referenceAltitude", 0.0),
            math.radians(parameters.get("referenceHeading", 0.0)),
        ]
        self._reference: Floats = np.tile(given, (nworld, 1))
        self._status = parameters.get("status", 0)
        self._service = parameters.get("service", 0)
        self._position = self._errors(parameters, "", 3)
        self._velocity = self._errors(parameters, "velocity", 3)
        self._velocity_interval = Interval()
        self._noises["velocity_interval"] = self._velocity_interval
        self.update_rate = rate_of(parameters, 4.0)
        frame = parameters.get("frameId", "/world")
        topic = parameters.get("topicName", "fix")
        speed = parameters.get("velocityTopicName", "fix_velocity")
        self._publish(parameters, topic, Output("", Fix, self._locate, frame=frame, queue_size=10))
        self._publish(
            parameters, speed, Output("", VectorValue, self._move, frame=frame, queue_size=10)
        )
        service = f"{topic}/set_reference_geopose"
        robot.services[service.strip("/")] = Service(
            absolute(namespace_of(robot, parameters), service), GeoReference, None, self._refer
        )

    def _refer(self, reference: GeoReference, worlds: Worlds | None) -> None:
        self._reference[slice(None) if worlds is None else worlds] = (
            reference.latitude,
            reference.longitude,
            reference.altitude,
            reference.heading,
        )

    def _locate(self) -> Fix:
        clock = self._simulation.clock
        place = self._position.apply(placed(self._frame).position, self._interval.since(clock.now))
        latitude, longitude, altitude = self._on_earth(place)
        variance = self._position.variance
        return Fix(
            clock.now_ns, latitude, longitude, altitude, variance, self._status, self._service
        )

    def _on_earth(self, place: Floats) -> tuple[Floats, Floats, Floats]:
        if self._spherical:
            return self._plane().geodetic(place)
        latitude, longitude, altitude, heading = self._reference.T
        curved = 1.0 / (1.0 - _E2 * np.sin(np.radians(latitude)) ** 2)
        across = EQUATORIAL_RADIUS * np.sqrt(curved)
        north = np.cos(heading) * place[:, 0] + np.sin(heading) * place[:, 1]
        west = -np.sin(heading) * place[:, 0] + np.cos(heading) * place[:, 1]
        return (
            latitude + np.degrees(north / (across * (1.0 - _E2) * curved)),
            longitude - np.degrees(west / (across * np.cos(np.radians(latitude)))),
            altitude + place[:, 2],
        )

    def _plane(self) -> TangentPlane:
        origin = self._simulation.world.spherical_coordinates
        return TangentPlane(origin or SphericalCoordinates())

    def _move(self) -> VectorValue:
        clock = self._simulation.clock
        motion = self._frame[0].motion().linear
        velocity = self._velocity.apply(motion, self._velocity_interval.since(clock.now))
        if self._spherical:
            east, north, up = self._plane().east_north_up(velocity).T
            return VectorValue(clock.now_ns, np.stack((north, -east, up), axis=1))
        heading = self._reference[:, 3]
        x, y, z = velocity.T
        north = np.cos(heading) * x + np.sin(heading) * y
        west = -np.sin(heading) * x + np.cos(heading) * y
        return VectorValue(clock.now_ns, np.stack((north, west, z), axis=1))

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """The errors, and where the origin is."""
        return {**super().state(), "reference": self._reference.copy()}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        super().restore(state)
        self._reference[:] = state["reference"]


class HectorMagnetic(_OnBody):
    """Publishes the Earth's magnetic field as a body feels it."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the body, open the port."""
        body = self._hold(robot, parameters, "hector_magnetic")
        heading = math.radians(parameters.get("referenceHeading", 0.0))
        if parameters.get("useWorldSphericalCoordinates", False):
            origin = robot.simulation.world.spherical_coordinates or SphericalCoordinates()
            heading = math.radians(origin.heading)
        turn = heading - math.radians(parameters.get("declination", 0.0))
        dip = math.radians(parameters.get("inclination", 60.0))
        level = math.cos(dip)
        self._field = parameters.get("magnitude", 1.0) * np.array(
            [level * math.cos(turn), level * math.sin(turn), -math.sin(dip)]
        )
        self._error = self._errors(parameters, "", 3)
        self.update_rate = rate_of(parameters, 0.0)
        as_field = parameters.get("useMagneticFieldMsgs", False)
        self._kind = MagneticValue if as_field else VectorValue
        frame = parameters.get("frameId", body)
        topic = parameters.get("topicName", "magnetic")
        self._publish(parameters, topic, Output("", self._kind, self._measure, frame=frame))

    def _measure(self) -> VectorValue:
        clock = self._simulation.clock
        place = placed(self._frame)
        field = np.broadcast_to(self._field, place.position.shape)
        felt = rotate(conjugate(place.quaternion), field)
        return self._kind(clock.now_ns, self._error.apply(felt, self._interval.since(clock.now)))


class HectorBarometer(_OnBody):
    """Publishes the height of a body as a place; pressure has no message that is known here."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the body, open the port."""
        body = self._hold(robot, parameters, "hector_baro")
        self._error = self._errors(parameters, "", 1)
        self.update_rate = rate_of(parameters, 0.0)
        topic = parameters.get("heightTopicName", parameters.get("topicName", "pressure_height"))
        frame = parameters.get("frameId", body)
        self._publish(
            parameters, topic, Output("", PointValue, self._measure, frame=frame, queue_size=10)
        )

    def _measure(self) -> PointValue:
        clock = self._simulation.clock
        height = placed(self._frame).position[:, 2:]
        measured = np.zeros((len(height), 3))
        measured[:, 2:] = self._error.apply(height, self._interval.since(clock.now))
        return PointValue(clock.now_ns, measured)
