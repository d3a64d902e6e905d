"""Hector's GPS and magnetometer: ``libhector_gazebo_ros_gps.so`` and its kin."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters, SphericalCoordinates
from gazelle.errors import FormatError
from gazelle.plugins.frames import placed
from gazelle.plugins.hector_body import OnBody, SampledOnBody, SampleSystem
from gazelle.plugins.hector_imu import rate_of
from gazelle.plugins.hector_status import FLAGS, flags_of, status_of
from gazelle.rotations import conjugate, rotate
from gazelle.sensors.geodesy import EQUATORIAL_RADIUS, FLATTENING
from gazelle.simulation import Output, Robot, Service, Tuning
from gazelle.simulation.values import Fix, GeoReference, MagneticValue, VectorValue

_E2 = FLATTENING * (2.0 - FLATTENING)  # first eccentricity squared


def _origin(robot: Robot, parameters: Parameters) -> GeoReference:
    """Return the geographic position of the world's origin, if the tags do not give it."""
    if not parameters.get("useWorldSphericalCoordinates", False):
        return GeoReference(49.9, 8.9, 0.0, 0.0)
    origin = robot.simulation.world.spherical_coordinates or SphericalCoordinates()
    # SDF counts the heading from east to north, a compass from north to east.
    heading = math.pi / 2.0 - math.radians(origin.heading)
    return GeoReference(origin.latitude, origin.longitude, origin.elevation, heading)


class HectorGps(SampledOnBody):
    """Publishes where a body is on Earth, and its velocity north, west and up.

    The world's x axis points ``referenceHeading`` degrees east of north.
    """

    system = SampleSystem

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the body, open the ports."""
        self.hold(robot, parameters, "hector_gps")
        nworld = robot.simulation.nworld
        origin = _origin(robot, parameters)
        heading = parameters.get("referenceHeading", math.degrees(origin.heading))
        given = [
            parameters.get("referenceLatitude", origin.latitude),
            parameters.get("referenceLongitude", origin.longitude),
            parameters.get("referenceAltitude", origin.altitude),
            math.radians(heading),
        ]
        self._reference: Floats = np.tile(given, (nworld, 1))
        self._status = parameters.get("status", 0)
        self._service = parameters.get("service", 0)
        self._position = self.errors(parameters, "", 3)
        self._velocity = self.errors(parameters, "velocity", 3)
        self.update_rate = rate_of(parameters, 4.0)
        frame = parameters.get("frameId", "/world")
        topic = parameters.get("topicName", "fix")
        speed = parameters.get("velocityTopicName", "fix_velocity")
        self.open_output(
            parameters, topic, Output("", Fix, self._locate, frame=frame, queue_size=10)
        )
        self.open_output(
            parameters, speed, Output("", VectorValue, self._move, frame=frame, queue_size=10)
        )
        service = f"{topic}/set_reference_geopose"
        robot.services[service.strip("/")] = Service(
            self.full(parameters, service), GeoReference, None, self._refer
        )
        self.tune(parameters, f"{topic}/position", self._position)
        self.tune(parameters, f"{topic}/velocity", self._velocity)
        robot.tunings[f"{topic}/status".strip("/")] = Tuning(
            self.full(parameters, f"{topic}/status"), FLAGS, self._set_status, self._flags
        )

    def _refer(self, reference: GeoReference, worlds: Worlds | None) -> None:
        """Set another reference; drifts start again, as the original's do."""
        self._reference[slice(None) if worlds is None else worlds] = (
            reference.latitude,
            reference.longitude,
            reference.altitude,
            reference.heading,
        )
        self.reset(worlds)

    def _set_status(self, status: Mapping[str, bool]) -> None:
        self._status, self._service = status_of(status)

    def _flags(self) -> dict[str, bool]:
        return flags_of(self._status, self._service)

    def measure(self) -> tuple[Floats, Floats]:
        """Return position and velocity in the world; the velocity's drift moves the position's."""
        interval = self._interval.since(self._simulation.clock.now_ns)
        velocity = self._velocity.apply(self._frame[0].motion().linear, interval)
        position = self._position.apply(placed(self._frame).position, interval)
        drifted = self._position.drifted + interval * self._velocity.drifted
        self._position.set_drift(drifted, None)
        return position, velocity

    def _locate(self) -> Fix:
        place, _ = self.sample or self.measure()
        latitude, longitude, altitude = self._on_earth(place)
        now_ns, variance = self._simulation.clock.now_ns, self._position.variance
        return Fix(now_ns, latitude, longitude, altitude, variance, self._status, self._service)

    def _on_earth(self, place: Floats) -> tuple[Floats, Floats, Floats]:
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

    def _move(self) -> VectorValue:
        now_ns = self._simulation.clock.now_ns
        _, velocity = self.sample or self.measure()
        heading = self._reference[:, 3]
        x, y, z = velocity.T
        north = np.cos(heading) * x + np.sin(heading) * y
        west = -np.sin(heading) * x + np.cos(heading) * y
        return VectorValue(now_ns, np.stack((north, west, z), axis=1))

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the errors, the origin, and the receiver's status."""
        kept = np.array([self._status, self._service])
        return {**super().state(), "reference": self._reference.copy(), "status": kept}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        super().restore(state)
        self._reference[:] = state["reference"]
        self._status, self._service = (int(x) for x in np.asarray(state["status"], np.int64))


class HectorMagnetic(OnBody):
    """Publishes the Earth's magnetic field as a body feels it."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the body, open the port."""
        body = self.hold(robot, parameters, "hector_magnetic")
        given = parameters.get("referenceHeading", math.degrees(_origin(robot, parameters).heading))
        heading = math.radians(given)
        turn = heading - math.radians(parameters.get("declination", 0.0))
        dip = math.radians(parameters.get("inclination", 60.0))
        if not math.isfinite(turn + dip):
            raise FormatError("the angles of a field must be finite", source=parameters.source)
        level = math.cos(dip)
        self._field = parameters.get("magnitude", 1.0) * np.array(
            [level * math.cos(turn), level * math.sin(turn), -math.sin(dip)]
        )
        self._error = self.errors(parameters, "", 3)
        self.update_rate = rate_of(parameters, 0.0)
        as_field = parameters.get("useMagneticFieldMsgs", False)
        self._kind = MagneticValue if as_field else VectorValue
        frame = parameters.get("frameId", body)
        topic = parameters.get("topicName", "magnetic")
        self.open_output(parameters, topic, Output("", self._kind, self._measure, frame=frame))
        self.tune(parameters, topic, self._error)

    def _measure(self) -> VectorValue:
        clock = self._simulation.clock
        place = placed(self._frame)
        field = np.broadcast_to(self._field, place.position.shape)
        measured = rotate(conjugate(place.quaternion), field)
        return self._kind(
            clock.now_ns, self._error.apply(measured, self._interval.since(clock.now_ns))
        )
