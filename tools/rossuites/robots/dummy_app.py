"""Stands in for the node of controller_manager_tests: a robot of three joints, and its test controllers.

The loop of the original takes a second; this one's period is a tenth of it.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from gazelle.bridges.control import HardwareLoop
from gazelle.control import (
    EFFORT,
    POSITION,
    VELOCITY,
    Controller,
    ControllerManager,
    ControllerParameters,
    RobotHardware,
    register,
)
from gazelle_ros.builtin.arguments import parse_arguments, spin

JOINTS = ("hiDOF_joint1", "hiDOF_joint2", "hiDOF_joint3")
PACKAGE = "controller_manager_tests"
RATE_HZ = 10.0


class _Claiming(Controller):
    """Claims joints by parameters, and does nothing with them."""

    claims: tuple[tuple[str, str, tuple[str, ...] | None], ...] = ()

    def init(self, parameters: ControllerParameters) -> None:
        """Claim what the parameters name, or the default."""
        for interface, parameter, default in self.claims:
            self.claim(interface, parameters.names(parameter, default))


class EffortTestController(_Claiming):
    """Two joints by effort."""

    interfaces = (EFFORT,)
    claims = ((EFFORT, "joints", JOINTS[:2]),)


class VelEffController(_Claiming):
    """Two interfaces."""

    interfaces = (VELOCITY, EFFORT)
    claims = ((VELOCITY, "velocity_joints", None), (EFFORT, "effort_joints", None))


class PosEffController(_Claiming):
    """Two interfaces, one of which the robot lacks."""

    interfaces = (POSITION, EFFORT)
    claims = ((POSITION, "position_joints", None), (EFFORT, "effort_joints", None))


class PosEffOptController(_Claiming):
    """Can do without the interface that the robot lacks."""

    claims = ((EFFORT, "effort_joints", None),)


class MyDummyController(Controller):
    """Wants an interface that nobody has."""

    interfaces = ("controller_manager_tests/MyDummyInterface",)


class ExtensibleController(_Claiming):
    """One interface."""

    interfaces = (VELOCITY,)
    claims = ((VELOCITY, "velocity_joint", None),)


class DerivedController(ExtensibleController):
    """One more."""

    interfaces = (VELOCITY, EFFORT)
    claims = ((VELOCITY, "velocity_joint", None), (EFFORT, "effort_joint", None))


def main(joints: Sequence[str] = JOINTS) -> int:
    """Run until the node is asked to end."""
    for kind in (
        EffortTestController,
        VelEffController,
        PosEffController,
        PosEffOptController,
        MyDummyController,
        ExtensibleController,
        DerivedController,
    ):
        register(f"{PACKAGE}/{kind.__name__}", kind)
    robot = RobotHardware()
    robot.register_joints(joints, {EFFORT: joints, VELOCITY: joints})
    node = parse_arguments(sys.argv[1:], "DummyApp").start()
    with node, HardwareLoop(node, ControllerManager(robot), RATE_HZ) as loop:
        loop.start()
        return spin(node)


if __name__ == "__main__":
    sys.exit(main())
