"""``IK`` of TRAC-IK: damped steps between limits, begun again from elsewhere until one arrives."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle_ros.compat.kdl_parser_py.urdf import treeFromString
from gazelle_ros.compat.PyKDL import ChainIkSolverPos_LMA, Frame, JntArray, Rotation, Vector
from gazelle_ros.robot.tree import read_joints

_TRIES = 20


class IK:
    """Inverse kinematics of the chain between two links.

    Args:
        base_link: Its base.
        tip_link: Its end.
        timeout: Without effect: a fixed number of starts is tried, so that answers are reproducible.
        epsilon: Largest error of the place [m] and angle [rad].
        solve_type: Without effect: the first solution between the limits is taken.
        urdf_string: The robot; by default the parameter ``robot_description``.

    Raises:
        ValueError: There is no such chain.
    """

    def __init__(
        self,
        base_link: str,
        tip_link: str,
        timeout: float = 0.005,
        epsilon: float = 1e-5,
        solve_type: str = "Speed",
        urdf_string: str | None = None,
    ) -> None:
        del timeout, solve_type
        text = _described() if urdf_string is None else urdf_string
        found, tree = treeFromString(text)
        if not found or tree is None:
            raise ValueError("the robot's URDF is no tree of links")
        chain = tree.getChain(base_link, tip_link)
        joints = read_joints(text)
        self.base_link, self.tip_link = base_link, tip_link
        self.link_names = tuple(each.getName() for each in chain.segments)
        self.joint_names = tuple(
            each.getJoint().getName() for each in chain.segments if each.moves()
        )
        self.number_of_joints = len(self.joint_names)
        self._solver = ChainIkSolverPos_LMA(chain, epsilon, 100)
        limits = [(joints[name].lower, joints[name].upper) for name in self.joint_names]
        self._lower = np.array([-math.inf if low is None else low for low, _ in limits])
        self._upper = np.array([math.inf if high is None else high for _, high in limits])

    def get_joint_limits(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return the lower and the upper limits."""
        return tuple(self._lower.tolist()), tuple(self._upper.tolist())

    def set_joint_limits(self, lower: Sequence[float], upper: Sequence[float]) -> None:
        """Set the limits."""
        self._lower, self._upper = np.array(lower, float), np.array(upper, float)

    def get_ik(
        self,
        qinit: Sequence[float],
        x: float,
        y: float,
        z: float,
        rx: float,
        ry: float,
        rz: float,
        rw: float,
        *_bounds: float,
    ) -> tuple[float, ...] | None:
        """Return positions at which the tip is at a pose in the base; None if none are found.

        Args:
            qinit: Initial positions.
            x: Of the place [m].
            y: Likewise.
            z: Likewise.
            rx: Of the quaternion.
            ry: Likewise.
            rz: Likewise.
            rw: Likewise.
        """
        goal = Frame(Rotation.Quaternion(rx, ry, rz, rw), Vector(x, y, z))
        random = np.random.default_rng(0)
        low, high = np.maximum(self._lower, -math.pi), np.minimum(self._upper, math.pi)
        start, found = JntArray(len(qinit)), JntArray(len(qinit))
        start.data = np.array(qinit, float)
        for _ in range(_TRIES):
            reached = self._solver.CartToJnt(start, goal, found) == 0
            place = self._between(found.data)
            if reached and place is not None:
                return tuple(place)
            start.data = random.uniform(low, high)
        return None

    def _between(self, positions: NDArray[np.float64]) -> list[float] | None:
        """Return positions turned by whole turns to lie between the limits; None if they cannot."""
        whole = 2.0 * math.pi
        turned = positions - whole * np.round(positions / whole)
        for each in (positions, turned):
            if np.all(each >= self._lower - 1e-9) and np.all(each <= self._upper + 1e-9):
                return [float(value) for value in each]
        return None


def _described() -> str:
    from gazelle_ros.compat import rospy

    return str(rospy.get_param("robot_description"))
