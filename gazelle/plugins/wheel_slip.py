"""Wheels that slip: ``libgazebo_ros_wheel_slip.so`` and ``libWheelSlipPlugin.so``.

A wheel of radius r that turns at w slips along its axle and across it by a velocity of
``compliance * r * |w| / wheel_normal_force`` for each unit of the friction force, within its
friction. A wheel that stands does not slip.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.description import Cylinder, Parameters, Sphere
from gazelle.errors import SimulationError
from gazelle.rotations import rotate
from gazelle.simulation import (
    LinkHandle,
    ModelPlugin,
    Robot,
    Tunable,
    Tuning,
    absolute,
)

_LATERAL, _LONGITUDINAL = (
    f"slip_compliance_unitless_{direction}" for direction in ("lateral", "longitudinal")
)
# What says that a compliance shall stay, and the most that can be set, as in gazebo_plugins.
_UNCHANGED, _MOST = -1.0, 20.0


@dataclass(slots=True)
class _Wheel:
    """A wheel that slips.

    Attributes:
        link: Its link.
        axle: Direction in the link's frame.
        radius: [m].
        force: Nominal load on the wheel [N].
        compliance: Along the axle and across it; what the file says until it is tuned.
    """

    link: LinkHandle
    axle: Floats
    radius: float
    force: float
    compliance: list[float]


class WheelSlip(ModelPlugin):
    """Wheel slip in proportion to speed and the force on the wheels."""

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the wheels; offer their compliances to be tuned."""
        self._simulation, self._slips = robot.simulation, False
        self._wheels = [_wheel(robot, tag) for tag in parameters.find_all("wheel")]
        if not self._wheels:
            raise SimulationError("a <wheel> is required here", source=parameters.source)
        self._tuned = dict.fromkeys((_LATERAL, _LONGITUDINAL), _UNCHANGED)
        name = parameters.get("robotNamespace", "wheel_slip")
        topic = absolute(self._simulation.ports.namespace, f"{robot.name}/{name.strip('/')}")
        robot.tunings[f"{name} slip"] = Tuning(
            topic,
            [
                Tunable(tag, _UNCHANGED, _UNCHANGED, _MOST, f"Slip compliance {text}")
                for tag, text in ((_LATERAL, "along the axles"), (_LONGITUDINAL, "across them"))
            ],
            self._tune,
            lambda: dict(self._tuned),
        )

    def _tune(self, changes: Mapping[str, Any]) -> None:
        """Set the compliances of all wheels; negative ones stay as they are."""
        for index, name in enumerate((_LATERAL, _LONGITUDINAL)):
            self._tuned[name] = float(changes[name])
            if self._tuned[name] >= 0.0:
                for wheel in self._wheels:
                    wheel.compliance[index] = self._tuned[name]

    @property
    def active(self) -> bool:
        """True if any wheel slips, or did."""
        return self._slips or any(any(wheel.compliance) for wheel in self._wheels)

    def on_update(self, time: float) -> None:  # noqa: ARG002  it acts at every step
        """Set the slip of wheels by their speeds."""
        engine = self._simulation.engine
        self._slips = any(any(wheel.compliance) for wheel in self._wheels)
        # All are looked at before one is changed: the engine computes where links are once.
        slips = [(wheel.link.name, _slip(wheel)) for wheel in self._wheels]
        for name, slip in slips:
            engine.set_parameter("wheel_slip", name, slip)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the compliances."""
        return {
            "compliance": np.array([wheel.compliance for wheel in self._wheels]),
            "tuned": np.array(list(self._tuned.values())),
            "slips": np.array(self._slips),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        for wheel, compliance in zip(self._wheels, state["compliance"], strict=True):
            wheel.compliance[:] = (float(each) for each in compliance)
        for name, value in zip(self._tuned, state["tuned"], strict=True):
            self._tuned[name] = float(value)
        self._slips = bool(state["slips"])


def _slip(wheel: _Wheel) -> Floats:
    """Return velocities for each unit of force, along the axle and about it, shape (nworld, 2)."""
    axle = rotate(wheel.link.placement().quaternion, wheel.axle[None])
    spin = np.einsum("ni,ni->n", wheel.link.motion().angular, axle)
    speed = wheel.radius * np.abs(spin)[:, None]
    slip: Floats = speed / wheel.force * np.array(wheel.compliance)
    # About the axle: the force acts at the radius, and so does the velocity.
    slip[:, 1] /= wheel.radius**2
    return slip


def _wheel(robot: Robot, tag: Parameters) -> _Wheel:
    """Return a wheel as its element describes it.

    Raises:
        SimulationError: The link is not a wheel, or its radius is not known.
    """
    name = tag.attributes.get("link_name", "")
    link = robot.links[name]
    if len(link.description.collisions) != 1:
        raise SimulationError(f"wheel '{name}' must have exactly one collision", source=tag.source)
    axle = _axle(robot, link, tag)
    force = tag.require("wheel_normal_force", float)
    if not force > 0.0:
        raise SimulationError("wheel_normal_force must be positive", source=tag.source)
    shape = link.description.collisions[0].geometry
    round_by = shape.radius if isinstance(shape, Cylinder | Sphere) else 0.0
    radius = tag.get("wheel_radius", round_by) or round_by
    if not radius > 0.0:
        raise SimulationError(f"a <wheel_radius> is required for '{name}'", source=tag.source)
    compliance = [
        tag.get("slip_compliance_lateral", 0.0),
        tag.get("slip_compliance_longitudinal", 0.0),
    ]
    if min(compliance) < 0.0:
        raise SimulationError("a slip compliance must not be negative", source=tag.source)
    return _Wheel(link, axle, radius, force, compliance)


def _axle(robot: Robot, link: LinkHandle, tag: Parameters) -> Floats:
    """Return the direction of a wheel's axle in its frame."""
    own = link.name.removeprefix(f"{robot.name}::")
    joints = [
        joint
        for placed in robot.description.walk()
        for joint in placed.model.joints
        if f"{placed.scope}::{joint.child}".removeprefix(f"{robot.name}::") == own
    ]
    if len(joints) != 1 or joints[0].type not in {"revolute", "continuous"}:
        raise SimulationError(
            f"wheel '{own}' must have exactly one parent joint, a revolute one", source=tag.source
        )
    return np.array(joints[0].pose.rotate(joints[0].axes[0].xyz))
