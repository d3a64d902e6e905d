"""Forward and inverse kinematics of chains.

Inverse kinematics are Newton's steps with the pseudo-inverse, and damped ones; what is returned is 0 or
one of KDL's negative codes (orocos_kdl, solveri.hpp).
"""
# ruff: noqa: N801, N802 - the names are KDL's

from __future__ import annotations

import numpy as np

from gazelle_ros.base.array_types import Floats
from gazelle_ros.compat.PyKDL.arrays import Jacobian, JntArray
from gazelle_ros.compat.PyKDL.chain import Chain
from gazelle_ros.compat.PyKDL.difference import diff
from gazelle_ros.compat.PyKDL.frame import Frame
from gazelle_ros.compat.PyKDL.motion import Twist
from gazelle_ros.compat.PyKDL.rotation import Rotation
from gazelle_ros.compat.PyKDL.vector import Vector

E_NOERROR, E_SIZE_MISMATCH, E_MAX_ITERATIONS_EXCEEDED = 0, -4, -5
_RELAXED, _TIGHTENED = 5.0, 0.3
_DAMPING = 1e-3
_STUCK, _NO_GAIN = 1e6, 1e-4
"""Of the damping and the share of the error that a step took away: there is nothing more to gain."""


def _frames(chain: Chain, positions: Floats, count: int) -> list[Frame]:
    """Return the frames of the ends of the first segments in the base."""
    found, frame, joint = [], Frame(), 0
    for segment in chain.segments[:count]:
        moves = segment.moves()
        frame = frame * segment.pose(float(positions[joint]) if moves else 0.0)
        joint += moves
        found.append(frame)
    return found


def _tip(chain: Chain, positions: Floats) -> Frame:
    frames = _frames(chain, positions, len(chain.segments))
    return frames[-1] if frames else Frame()


def _jacobian(chain: Chain, positions: Floats) -> Floats:
    frames = _frames(chain, positions, len(chain.segments))
    columns, before = [], Frame()
    for segment, frame in zip(chain.segments, frames, strict=True):
        if segment.moves():
            joint = segment.getJoint()
            motion = before.M * joint.twist(1.0)
            arm = frames[-1].p - (before * joint.JointOrigin())
            columns.append([*motion.RefPoint(arm)])
        before = frame
    return np.array(columns).T.reshape(6, -1)


def _error(chain: Chain, positions: Floats, goal: Frame) -> Floats:
    return np.array([*diff(_tip(chain, positions), goal)])


def _put(frame: Frame, into: Frame) -> None:
    into.M, into.p = Rotation(frame.M), Vector(frame.p)


class ChainFkSolverPos_recursive:
    """Places of a chain's segments."""

    def __init__(self, chain: Chain) -> None:
        self._chain = chain

    def JntToCart(self, q_in: JntArray, p_out: Frame, segmentNr: int = -1) -> int:  # noqa: N803
        """Write the frame of the end of the first segments, or of all, to ``p_out``."""
        count = self._chain.getNrOfSegments() if segmentNr < 0 else segmentNr
        if len(q_in) != self._chain.getNrOfJoints() or count > self._chain.getNrOfSegments():
            return E_SIZE_MISMATCH
        frames = _frames(self._chain, q_in.data, count)
        _put(frames[-1] if frames else Frame(), p_out)
        return E_NOERROR


class ChainJntToJacSolver:
    """Jacobians of a chain's end, in the base's axes."""

    def __init__(self, chain: Chain) -> None:
        self._chain = chain

    def JntToJac(self, q_in: JntArray, jac: Jacobian) -> int:
        """Write the Jacobian to ``jac``."""
        if len(q_in) != self._chain.getNrOfJoints():
            return E_SIZE_MISMATCH
        jac.data = _jacobian(self._chain, q_in.data)
        return E_NOERROR


class ChainIkSolverVel_pinv:
    """Speeds of joints for a motion of the end, by the pseudo-inverse."""

    def __init__(self, chain: Chain, eps: float = 1e-5, maxiter: int = 150) -> None:
        del maxiter
        self._chain, self._eps = chain, eps

    def CartToJnt(self, q_in: JntArray, v_in: Twist, qdot_out: JntArray) -> int:
        """Write the speeds to ``qdot_out``."""
        inverse = np.linalg.pinv(_jacobian(self._chain, q_in.data), rcond=self._eps)
        qdot_out.data = inverse @ np.array([v_in[place] for place in range(6)])
        return E_NOERROR


class _Newton:
    """Newton's steps from a guess, between limits where there are any."""

    def __init__(
        self, chain: Chain, limits: tuple[Floats, Floats] | None, maxiter: int, eps: float
    ) -> None:
        self._chain, self._limits, self._most, self._eps = chain, limits, maxiter, eps

    def CartToJnt(self, q_init: JntArray, p_in: Frame, q_out: JntArray) -> int:
        """Write positions with the end at a frame to ``q_out``; 0 if they are found."""
        positions = np.array(q_init.data)
        for _ in range(self._most):
            error = _error(self._chain, positions, p_in)
            if np.all(np.abs(error) < self._eps):
                q_out.data = positions
                return E_NOERROR
            positions = positions + np.linalg.pinv(_jacobian(self._chain, positions)) @ error
            if self._limits is not None:
                positions = np.clip(positions, *self._limits)
        q_out.data = positions
        return E_MAX_ITERATIONS_EXCEEDED


class ChainIkSolverPos_NR(_Newton):
    """Inverse kinematics by Newton's steps."""

    def __init__(
        self,
        chain: Chain,
        fksolver: object,
        iksolver: object,
        maxiter: int = 100,
        eps: float = 1e-6,
    ) -> None:
        del fksolver, iksolver
        super().__init__(chain, None, maxiter, eps)


class ChainIkSolverPos_NR_JL(_Newton):
    """Inverse kinematics by Newton's steps between limits of joints."""

    def __init__(
        self,
        chain: Chain,
        q_min: JntArray,
        q_max: JntArray,
        fksolver: object,
        iksolver: object,
        maxiter: int = 100,
        eps: float = 1e-6,
    ) -> None:
        del fksolver, iksolver
        super().__init__(chain, (np.array(q_min.data), np.array(q_max.data)), maxiter, eps)


class ChainIkSolverPos_LMA:
    """Inverse kinematics by damped steps (Levenberg and Marquardt)."""

    def __init__(
        self, chain: Chain, eps: float = 1e-5, maxiter: int = 500, eps_joints: float = 1e-15
    ) -> None:
        del eps_joints
        self._chain, self._eps, self._most = chain, eps, maxiter

    def CartToJnt(self, q_init: JntArray, p_in: Frame, q_out: JntArray) -> int:
        """Write positions with the end at a frame to ``q_out``; 0 if they are found."""
        positions, damping = np.array(q_init.data), _DAMPING
        error = _error(self._chain, positions, p_in)
        for _ in range(self._most):
            if np.linalg.norm(error) < self._eps:
                break
            jacobian = _jacobian(self._chain, positions)
            normal = jacobian.T @ jacobian + damping * np.eye(len(positions))
            tried = positions + np.linalg.solve(normal, jacobian.T @ error)
            left = _error(self._chain, tried, p_in)
            gained = np.linalg.norm(error) - np.linalg.norm(left)
            better = gained > 0.0
            if damping > _STUCK or 0.0 < gained < _NO_GAIN * np.linalg.norm(error):
                break
            damping *= _TIGHTENED if better else _RELAXED
            if better:
                positions, error = tried, left
        q_out.data = positions
        done = np.linalg.norm(error) < self._eps
        return E_NOERROR if done else E_MAX_ITERATIONS_EXCEEDED
