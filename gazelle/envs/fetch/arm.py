"""Fetch's arm: its joints move the gripper by commands."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Collection

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.description import Joint, Model, Pose
from gazelle.envs.fetch.gripper import DOWN, FINGERS, GRIP, TIP, FetchGripper, driven, fetch_model
from gazelle.errors import TaskError
from gazelle.kinematics import InverseKinematics, RobotModel
from gazelle.simulation import Simulation

ARM = (
    "shoulder_pan_joint",
    "shoulder_lift_joint",
    "upperarm_roll_joint",
    "elbow_flex_joint",
    "forearm_roll_joint",
    "wrist_flex_joint",
    "wrist_roll_joint",
)

_BENT = (0.01, -0.7, 0.0, 1.45, 0.0, 0.8, 0.0)  # elbow up, near all starts [rad]
_FASTEST = 4.0  # of a joint, where the arm is stretched and commands could be unbounded [rad/s]
_EFFORT = 1000.0  # of the arm's motors, so that they hold their commands [N m]
_TOLERANCE = (1e-4, 1e-4)  # [m], [rad]


def held_model(
    model: Model, moving: Collection[str], changed: Callable[[Joint], Joint] = driven
) -> Model:
    """Return a robot that stands fast, of which only some joints move.

    Args:
        model: As its file says.
        moving: Names of the joints that continue moving; the others stay at zero.
        changed: Function applied to the joints that may move.
    """
    child = {joint.child for joint in model.joints}
    roots = [link.name for link in model.links if link.name not in child]
    joints = [
        changed(joint)
        if joint.name in moving
        else dataclasses.replace(joint, type="fixed", axes=(), sensors=())
        for joint in model.joints
    ]
    held = [Joint(name=f"{root}_held", type="fixed", parent="world", child=root) for root in roots]
    return dataclasses.replace(model, joints=(*joints, *held), plugins=())


class ReachingArm(FetchGripper):
    """The gripper on the arm of a robot that stands fast.

    Inverse kinematics leads from where the joints are to where they shall be, and motors hold the
    velocities that lead there in a period.

    Args:
        simulation: Simulation for it.
        start: Start of the point between its fingers [m], in the world frame.
        base: Position of the robot (x, y) [m].
        fingers_move: See `FetchGripper`.

    Raises:
        TaskError: The arm cannot be there.
    """

    def __init__(
        self,
        simulation: Simulation,
        start: tuple[float, float, float],
        base: tuple[float, float],
        *,
        fingers_move: bool,
    ) -> None:
        moving = *ARM, *(FINGERS if fingers_move else ())
        model = self._completed(held_model(fetch_model(), moving, self._changed))
        self._base = np.array([*base, 0.0])
        robot = RobotModel(model)
        group = robot.group_of(ARM, "arm")
        self._kinematics = InverseKinematics(robot, group, TIP, tolerance=_TOLERANCE)
        self._columns = robot.columns(group.names)
        self._zero = robot.zero()
        # With cones the solver throws an arm about that presses on a table with stiff motors.
        simulation.physics.contacts = "fast"
        spawned = simulation.spawn(model, name="fetch", pose=Pose(*base, 0.0))
        super().__init__(spawned, group.names, fingers_move=fingers_move)
        self._names = group.names
        self._add_motors()
        seed = self._zero.copy()
        seed[robot.columns(ARM)] = _BENT
        found = self._kinematics.solve_many(self._poses(np.array([start])), seed)
        if not found.found.all():
            raise TaskError(f"Fetch's gripper cannot be at {start}")
        self._start = found.positions[0]

    def _changed(self, joint: Joint) -> Joint:
        """Return a movable joint with the task's settings."""
        return driven(joint)

    def _completed(self, model: Model) -> Model:
        """Return the robot with all that it needs."""
        return model

    def _add_motors(self) -> None:
        for joint in self._joints:
            joint.add_motor(_EFFORT)

    def begin(self, worlds: Worlds) -> None:
        """Set the arm to its initial posture."""
        self._robot.set_configuration(self._names, self._start, worlds)
        self._stop(worlds)

    def move(self, way: Floats, period: float) -> None:
        """Set the joint rates for a displacement of the gripper in a period."""
        now = np.hstack([joint.positions() for joint in self._joints])
        states = np.tile(self._zero, (len(now), 1))
        states[:, self._columns] = now
        targets = self._kinematics.follow(self._poses(self.position(None) + way), states)
        rates = (targets - now) / period
        # All of them slower where one would be too fast, so that the way stays straight.
        rates /= np.maximum(np.abs(rates).max(axis=1, keepdims=True) / _FASTEST, 1.0)
        for joint, rate in zip(self._joints, rates.T, strict=True):
            joint.drive(rate)

    def _poses(self, points: Floats) -> Floats:
        """Return poses of the gripper's frame in the robot's, its point at these, (n, 4, 4)."""
        poses = np.zeros((len(points), 4, 4))
        poses[:, :3, :3] = DOWN
        poses[:, :3, 3] = points - self._base - DOWN @ GRIP
        poses[:, 3, 3] = 1.0
        return poses
