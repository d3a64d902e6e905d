"""Gazebo's own drives: what ``libDiffDrivePlugin.so`` and ``libSkidSteerDrivePlugin.so`` do."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.description import Cylinder, Parameters, Sphere
from gazelle.plugins.wheels import Side, WheeledDrive
from gazelle.simulation import Robot

# Radius of a wheel without a known shape [m].
_DIAMETER = 0.15


class BuiltinDiffDrive(WheeledDrive):
    """Drives two wheels; sizes and distances are those of the model."""

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, put motors on the wheels, open ``vel_cmd``."""
        names = [parameters.require(tag, str) for tag in ("left_joint", "right_joint")]
        sides = (Side.LEFT, Side.RIGHT)
        _drive(self, robot, parameters, list(zip(names, sides, strict=True)), "torque")


class BuiltinSkidSteer(WheeledDrive):
    """Drives four wheels; sizes and distances are those of the model."""

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, put motors on the wheels, open ``vel_cmd``."""
        wheels = [
            (parameters.require(f"{side.name.lower()}_{end}", str), side)
            for end in ("front", "rear")
            for side in (Side.LEFT, Side.RIGHT)
        ]
        _drive(self, robot, parameters, wheels, "MaxForce")


def _drive(
    drive: WheeledDrive,
    robot: Robot,
    parameters: Parameters,
    wheels: Sequence[tuple[str, Side]],
    effort: str,
) -> None:
    children = [robot.links[robot.joint_description(name).child] for name, _ in wheels]
    left, right = (child.placement().position[0] for child in children[:2])
    shapes = [each.geometry for child in children for each in child.description.collisions]
    round_ones = [shape for shape in shapes if isinstance(shape, Cylinder | Sphere)]
    drive.drive(
        robot,
        wheels,
        separation=float(np.linalg.norm(left - right)),
        diameter=2.0 * round_ones[0].radius if round_ones else _DIAMETER,
        torque=parameters.get(effort, 5.0),
        source=parameters.source,
    )
    drive.listen(robot, f"/{robot.name}/vel_cmd")
