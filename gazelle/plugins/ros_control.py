"""Joints under ros_control: what ``libgazebo_ros_control.so`` does.

Tags, defaults and rules are those of gazebo_ros_pkgs 2.9 (Noetic).
"""

from __future__ import annotations

import importlib
import warnings
from collections.abc import Mapping, Sequence
from typing import Any

from gazelle import formats
from gazelle.array_types import Worlds
from gazelle.control import ControllerParameters
from gazelle.control.limits import JointLimits
from gazelle.control.pid import PidGains
from gazelle.description import Model, Parameters, Transmission
from gazelle.errors import ControlWarning, Error, SimulationError, did_you_mean, located
from gazelle.simulation import Input, Robot, Setting, absolute, namespace_of
from gazelle.simulation.control_loop import ControlLoop
from gazelle.simulation.joint_hardware import JointHardware
from gazelle.simulation.simulated_hardware import (
    INTERFACES,
    CommandedJoint,
    HardwareSetup,
    SimulatedHardware,
)
from gazelle.simulation.values import EmergencyStop
from gazelle_ros.base.entry_points import UNIMPORTABLE

DEFAULT_HARDWARE = "gazebo_ros_control/DefaultRobotHWSim"
_PREFIX = "hardware_interface/"


class RosControl(ControlLoop):
    """Controllers for the joints of transmissions, each through its first interface.

    Its controllers are ``robot.controllers``; of a model with several of these plugins, each with a
    namespace of its own, ``robot.managers[namespace]``. Settings and inputs of the second and
    further ones have their full names: ``robot.settings["/head/joint_limits"]``.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the joints of the transmissions."""
        self._parameters = parameters
        namespace = absolute(namespace_of(robot, parameters, robot.name), "")
        self._namespace = namespace
        self._gains: Mapping[str, Any] = {}
        self._limits: Mapping[str, Any] = {}
        self._actuated = False
        self._model = robot.description
        self._owner = robot
        self.begin(robot, self._make(), self._model, namespace)
        if "controlPeriod" in parameters:
            self.set_period(parameters.require("controlPeriod", float))
        self._open(robot, parameters)
        robot.add_manager(_free(namespace, robot.managers), self.manager)

    def _open(self, robot: Robot, parameters: Parameters) -> None:
        """Open ports: the emergency stop, and parameters of the parameter server."""
        topic = parameters.get("eStopTopic", "")
        if topic:
            full = absolute(self._namespace, topic)
            name = _unused("emergency_stop", full, robot.inputs)
            robot.inputs[name] = Input(full, EmergencyStop, self._press, queue_size=1)
        gains = absolute(self._namespace, "gazebo_ros_control/pid_gains")
        limits = absolute(self._namespace, "joint_limits")
        for full, name, take in (
            (gains, "pid_gains", self.take_gains),
            (limits, "joint_limits", self.take_limits),
        ):
            robot.settings[_unused(name, full, robot.settings)] = Setting(full, {}, take)
        full = absolute(self._namespace, "gazebo_ros_control/use_transmissions")
        name = _unused("use_transmissions", full, robot.settings)
        robot.settings[name] = Setting(full, False, self.use_transmissions)
        if "robotParam" in parameters or not robot.description.transmissions:
            name = parameters.get("robotParam", "robot_description")
            full = absolute(self._namespace, name)
            awaited = not robot.description.transmissions
            robot.settings[_unused(name, full, robot.settings)] = Setting(
                full, "", self.take_description, search=True, awaited=awaited
            )

    def _press(self, stop: EmergencyStop, worlds: Worlds | None) -> None:
        self.press(worlds, on=stop.on)

    # -- what parameters say -----------------------------------------------------------

    def take_gains(self, gains: Mapping[str, Any]) -> None:
        """Set gains by joint, as in ``gazebo_ros_control/pid_gains``."""
        self._gains = gains
        self._make_again()

    def take_limits(self, limits: Mapping[str, Any]) -> None:
        """Set limits by joint, as in ``joint_limits``."""
        self._limits = limits
        self._make_again()

    def use_transmissions(self, use: bool) -> None:  # noqa: FBT001  the setting's value
        """Set whether transmissions are more than names of joints, as they are in Gazebo.

        Then there are actuators, which turn by reductions and offsets (``ActuatorStateInterface``),
        and joints of differential and four-bar transmissions are controlled as well.
        """
        self._actuated = use
        self._make_again()

    def take_description(self, text: str) -> None:
        """Set the URDF of the parameter ``robotParam``.

        It holds if the model's own file has no transmissions.
        """
        self._model = formats.load_model_string(text) if text else self._owner.description
        self.manager.model = self._model
        self._make_again()

    def _make_again(self) -> None:
        """Make the hardware again from the parameters, unless controllers are loaded."""
        if self.manager.loaded:
            text = (
                f"parameters of the joints of '{self._owner.name}' changed after controllers were "
                "loaded, and are not taken"
            )
            warnings.warn(ControlWarning(text), stacklevel=3)
            return
        try:
            self.change_hardware(self._make())
        except Error as error:
            warnings.warn(ControlWarning(f"the joints stay as they are: {error}"), stacklevel=3)

    # -- making the robot's side ---------------------------------------------------------

    def transmissions_of(self, model: Model) -> Sequence[Transmission]:
        """Return the transmissions of controlled joints of a model."""
        return model.transmissions

    def _make(self) -> SimulatedHardware:
        used = [each for each in self.transmissions_of(self._model) if self._is_good(each)]
        joints = [
            self._joint(transmission, *joint)
            for transmission in used
            for joint in transmission.joints
        ]
        drives = used if self._actuated else ()
        setup = HardwareSetup(self._namespace, joints, self._model, self._parameters, drives)
        return self._hardware_class()(self._owner, setup)

    def _hardware_class(self) -> type[SimulatedHardware]:
        name = self._parameters.get("robotSimType", DEFAULT_HARDWARE)
        if name == DEFAULT_HARDWARE:
            return JointHardware
        module, _, attribute = name.partition(":" if ":" in name else "/")
        try:
            found = getattr(importlib.import_module(module), attribute, None)
        except UNIMPORTABLE:
            found = None
        if not (isinstance(found, type) and issubclass(found, SimulatedHardware)):
            raise SimulationError(
                f"robotSimType '{name}' names no class of hardware",
                source=self._parameters.source,
                hint="name a Python class as package/Class or package.module:Class, a subclass of "
                "gazelle.simulation.joint_hardware.SimulatedHardware",
            )
        return found

    def _is_good(self, transmission: Transmission) -> bool:
        """Return whether a transmission is used; warn with the reason if it is not."""
        fault = _fault_of(transmission, several=self._actuated)
        if fault:
            text = f"transmission '{transmission.name}' of '{self._owner.name}' {fault}; it is left out"
            warnings.warn(ControlWarning(located(text, transmission.source)), stacklevel=4)
        return not fault

    def _joint(
        self, transmission: Transmission, name: str, interfaces: tuple[str, ...]
    ) -> CommandedJoint:
        first = interfaces[0]
        kind = first if first.startswith(_PREFIX) else _PREFIX + first
        if kind not in INTERFACES:
            raise SimulationError(
                f"transmission '{transmission.name}': the simulation has no interface '{first}'",
                source=transmission.source,
                hint=did_you_mean(kind, INTERFACES),
            )
        limits = JointLimits.of_joint(self._owner.joint_description(name))
        given = self._limits.get(name)
        if isinstance(given, Mapping):
            limits = limits.overridden(given, f"{self._namespace}/joint_limits/{name}")
        gains = self._gains.get(name)
        pid = None
        if isinstance(gains, Mapping) and "p" in gains:
            place = f"{self._namespace}/gazebo_ros_control/pid_gains/{name}"
            pid = PidGains.read(ControllerParameters(gains, place))
        return CommandedJoint(name, (kind,), limits, pid)


def _fault_of(transmission: Transmission, *, several: bool) -> str:
    """Return the reason why a transmission cannot be used; empty if it can.

    Args:
        transmission: Transmission to check.
        several: Whether it may have several joints.
    """
    if not transmission.name:
        return "has no name"
    if not transmission.type:
        return "has no <type>"
    if not transmission.joints:
        return "has no joint"
    if len(transmission.joints) > 1 and not several:
        return (
            f"has {len(transmission.joints)} joints, and the simulation takes those with one, unless "
            "use_transmissions is set"
        )
    if not all(interfaces for _, interfaces in transmission.joints):
        return "has a joint without <hardwareInterface>"
    if not transmission.actuators:
        return "has no <actuator>"
    return ""


def _unused(name: str, full: str, taken: Mapping[str, object]) -> str:
    """Return the short name of a port, or its full one if another plugin uses the short one."""
    return full if name in taken else name


def _free(namespace: str, taken: Mapping[str, object]) -> str:
    if namespace not in taken:
        return namespace
    count = 2
    while f"{namespace} {count}" in taken:
        count += 1
    return f"{namespace} {count}"
