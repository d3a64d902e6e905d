"""Fetch's arm, drawn after a body that nothing moves, as Gymnasium-Robotics has it."""

from __future__ import annotations

import dataclasses

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.description import Inertia, Inertial, Joint, Link, Model
from gazelle.envs.fetch.arm import ARM, ReachingArm
from gazelle.envs.fetch.gripper import FINGERS, TIP, driven, heavy_finger
from gazelle.simulation import Simulation

WELDED_STEP = 0.002
"""Of the physics there [s]."""

_SETTLING = 0.02  # time constant of the weld there [s]
_HELD = "gripper_held"
# Of the arm's joints there: damping [N m s/rad], spring [N m/rad] and armature [kg m²].
_DYNAMICS = 50.0, 0.0, 1.0
_OF_JOINT = {"forearm_roll_joint": (3.5247, 10.0, 2.7538)}  # that differ
_DOWN = np.array([0.0, 1.0, 0.0, 1.0])  # quaternion (x, y, z, w), not normalised, that is added


class WeldedArm(ReachingArm):
    """The arm without motors: a soft weld draws the gripper after a body that is only placed.

    That body, which MuJoCo calls mocap, is put where the gripper is wanted, from where it is, and
    turned as the sum of two quaternions: what the gripper has, and the one for pointing down.

    Args:
        simulation: See `ReachingArm`.
        start: Likewise.
        base: Likewise.
        fingers_move: Likewise.

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
        leader = Model(name="fetch_leader", static=True, links=(Link(name="leader"),))
        self._leader = simulation.spawn(leader)
        super().__init__(simulation, start, base, fingers_move=fingers_move)
        self._tip = self._robot.links[_HELD]

    def begin(self, worlds: Worlds) -> None:
        """Set the arm to its initial posture, and hold the gripper there."""
        super().begin(worlds)
        place = self._tip.placement(worlds)
        self._leader.set_pose(place.position, place.quaternion, worlds=worlds)
        leader = self._leader.links["leader"]
        self._robot.simulation.attach(leader, self._tip, worlds, settling=_SETTLING)

    def move(self, way: Floats, period: float) -> None:
        """Set the leader of the weld to the displaced pose of the gripper."""
        del period
        place = self._tip.placement()
        turned = place.quaternion * np.where(place.quaternion @ _DOWN < 0.0, -1.0, 1.0)[:, None]
        turned = turned + _DOWN
        turned /= np.linalg.norm(turned, axis=1, keepdims=True)
        self._leader.set_pose(place.position + way, turned)

    def _changed(self, joint: Joint) -> Joint:
        if joint.name not in ARM:
            return driven(joint)
        damping, spring, armature = _OF_JOINT.get(joint.name, _DYNAMICS)
        axes = tuple(
            dataclasses.replace(axis, damping=damping, spring_stiffness=spring, armature=armature)
            for axis in joint.axes
        )
        return dataclasses.replace(joint, axes=axes)

    def _completed(self, model: Model) -> Model:
        """Return the model with the original's finger masses, and a link for the weld."""
        frame = next(each for each in model.frames if each.name == TIP)
        wrist = next(link for link in model.links if link.name == frame.attached_to)
        speck = Inertial(mass=1e-3, inertia=Inertia(1e-6, 1e-6, 1e-6))
        held = Link(name=_HELD, pose=wrist.pose * frame.pose, inertial=speck)
        joint = Joint(name=f"{_HELD}_fixed", type="fixed", parent=wrist.name, child=_HELD)
        fingers = {each.child for each in model.joints if each.name in FINGERS}
        links = [heavy_finger(link) if link.name in fingers else link for link in model.links]
        return dataclasses.replace(model, links=(*links, held), joints=(*model.joints, joint))

    def _add_motors(self) -> None:
        pass  # the weld alone moves the arm

    def _stop(self, worlds: Worlds) -> None:
        for finger in self._fingers[:1]:
            finger.drive(0.0, worlds)
