"""Sensors of a simulated robot as controllers see them."""

from __future__ import annotations

from collections.abc import Callable

from gazelle.control import FORCE_TORQUE, IMU, SensorInterface
from gazelle.control.values import ImuSample, StampedWrench
from gazelle.sensors import ForceTorqueModel, ImuModel
from gazelle.simulation.robot import Robot, SensorUnit


def sensor_interfaces(robot: Robot) -> list[SensorInterface]:
    """Return the interfaces of its IMUs and force-torque sensors; none for a kind that it lacks.

    Gazebo's robot side has none. Names are those of the sensors, frames those of the links that they are
    on, or of a joint's child.
    """
    imus = {u.description.name: _imu(u) for u in robot.sensors.values() if _is(u, ImuModel)}
    wrists = {
        u.description.name: _wrist(u) for u in robot.sensors.values() if _is(u, ForceTorqueModel)
    }
    found = ((IMU, imus), (FORCE_TORQUE, wrists))
    return [SensorInterface(name, sensors) for name, sensors in found if sensors]


def _is(unit: SensorUnit, kind: type) -> bool:
    return isinstance(unit.model, kind)


def _imu(unit: SensorUnit) -> Callable[[], ImuSample]:
    frame = unit.name.split("::")[-2]

    def measure() -> ImuSample:
        values = unit.measure()
        now = unit.robot.simulation.clock.now_ns
        return ImuSample(now, frame, values[:, :4], values[:, 4:7], values[:, 7:])

    return measure


def _wrist(unit: SensorUnit) -> Callable[[], StampedWrench]:
    joint = unit.robot.joint_description(unit.name.split("::")[-2])
    frame = joint.child.split("::")[-1]

    def measure() -> StampedWrench:
        values = unit.measure()
        now = unit.robot.simulation.clock.now_ns
        return StampedWrench(now, frame, values[:, :3], values[:, 3:])

    return measure
