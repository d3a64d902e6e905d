"""Joint positions that bring a frame to a pose: damped least squares, compiled.

Levenberg and Marquardt's method with the damping of Sugihara ("Solvability-unconcerned inverse
kinematics by the Levenberg-Marquardt method", IEEE Transactions on Robotics 27, 2011): a multiple of
the squared error. A joint that would leave its limits is held at them while the others are asked again.
What does not get better is given up, and started again elsewhere.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np
from cython.cimports.gazelle.kinematics.joint_tree import JointTree, compose
from cython.cimports.gazelle.native.elementary import atan2
from cython.cimports.libc.math import fabs, sqrt

from gazelle.array_types import Floats, Indices

_DAMPING = cython.declare(cython.double, 0.02)
"""Times the squared error."""
_LEAST = cython.declare(cython.double, 1e-9)
_LARGEST_STEP = cython.declare(cython.double, 1.0)
_PATIENCE = cython.declare(cython.int, 8)
"""Steps without an error less than ``_BETTER`` times the least before, after which it is given up."""
_BETTER = cython.declare(cython.double, 0.98)


@cython.cclass
class ChainSolver:
    """Finds positions of some variables that bring a frame to a pose.

    Args:
        tree: The robot.
        joint: Joint that moves the frame.
        offset: The frame in the joint's, shape (12,).
        columns: Of the variables that may be changed, shape (m,).
        lower: Their limits [m or rad], shape (m,).
        upper: Likewise.
        steps: Of one attempt, at most.
    """

    _tree: JointTree
    _path: cython.int[::1]
    _slots: cython.int[::1]
    _offset: cython.double[:, ::1]
    _columns: cython.int[::1]
    _lower: cython.double[::1]
    _upper: cython.double[::1]
    _frames: cython.double[:, ::1]
    _tip: cython.double[:, ::1]
    _variables: cython.double[::1]
    _jacobian: cython.double[:, ::1]
    _error: cython.double[::1]
    _weights: cython.double[::1]
    _matrix: cython.double[:, ::1]
    _right: cython.double[::1]
    _change: cython.double[::1]
    _nearest: cython.double[::1]
    _held: cython.uchar[::1]
    _turn: cython.double[::1]
    _motion: cython.double[::1]
    _size: cython.int
    _steps: cython.int
    _moved: cython.double
    _turned: cython.double

    def __init__(
        self,
        tree: JointTree,
        joint: int,
        offset: Floats,
        columns: Indices,
        lower: Floats,
        upper: Floats,
        steps: int = 60,
    ) -> None:
        self._tree, self._steps = tree, steps
        self._columns = np.ascontiguousarray(columns, np.int32)
        self._lower = np.ascontiguousarray(lower, np.float64)
        self._upper = np.ascontiguousarray(upper, np.float64)
        self._offset = np.array(offset, np.float64).reshape(1, 12)
        self._size = len(columns)
        path = tree.path(joint)
        of_joint = tree.columns()
        slots = np.full(max(of_joint.max(initial=-1), max(columns, default=-1)) + 1, -1, np.int32)
        slots[np.asarray(columns, np.intp)] = np.arange(len(columns))
        self._path = path
        self._slots = slots[of_joint[path]]
        self._frames, self._tip = tree.root(), np.zeros((1, 12))
        self._variables = np.zeros(len(slots))
        self._jacobian, self._matrix = np.zeros((6, max(1, len(columns)))), np.zeros((6, 6))
        self._error, self._right, self._weights = np.zeros(6), np.zeros(6), np.ones(6)
        self._change, self._nearest = np.zeros(len(columns)), np.zeros(len(columns))
        self._held = np.zeros(len(columns), np.uint8)
        self._turn, self._motion = np.zeros(9), np.zeros(6)
        self._moved = self._turned = 0.0

    def solve(
        self,
        target: Floats,
        starts: Floats,
        variables: Floats,
        weights: Floats,
        tolerance: tuple[float, float],
    ) -> int:
        """Try one start after another until one leads to the pose.

        Args:
            target: The pose, shape (12,).
            starts: Positions of the variables that may change, shape (attempts, m).
            variables: Positions of all; the solution is written into it, shape (variables,).
            weights: Of the errors along x, y, z and about them; zero for what does not matter,
                shape (6,).
            tolerance: Of distance [m] and angle [rad].

        Returns:
            Index of the start that led there, -1 if none did.
        """
        goal: cython.double[::1] = np.ascontiguousarray(target, np.float64)
        begin: cython.double[:, ::1] = np.ascontiguousarray(starts, np.float64)
        out: cython.double[::1] = variables
        given: cython.double[::1] = np.ascontiguousarray(weights, np.float64)
        k: cython.int
        near: cython.double = tolerance[0]
        straight: cython.double = tolerance[1]
        for k in range(6):
            self._weights[k] = given[k]
        for k in range(self._variables.shape[0]):
            self._variables[k] = out[k]
        attempt: cython.int
        for attempt in range(begin.shape[0]):
            for k in range(self._size):
                self._variables[self._columns[k]] = min(
                    max(begin[attempt, k], self._lower[k]), self._upper[k]
                )
            if self._descend(goal, near, straight):
                for k in range(self._size):
                    out[self._columns[k]] = self._variables[self._columns[k]]
                return int(attempt)
        return -1

    def follow(
        self,
        targets: Floats,
        variables: Floats,
        weights: Floats,
        tolerance: tuple[float, float],
    ) -> None:
        """Descend from many states as near as possible to as many poses.

        Args:
            targets: The poses, shape (n, 12).
            variables: Positions of all in each state; those found are written into it, shape
                (n, variables).
            weights: As `solve` takes them, shape (6,).
            tolerance: Of distance [m] and angle [rad], where a descent ends.
        """
        goal: cython.double[:, ::1] = np.ascontiguousarray(targets, np.float64)
        out: cython.double[:, ::1] = variables
        given: cython.double[::1] = np.ascontiguousarray(weights, np.float64)
        near: cython.double = tolerance[0]
        straight: cython.double = tolerance[1]
        row: cython.Py_ssize_t
        k: cython.int
        for k in range(6):
            self._weights[k] = given[k]
        for row in range(out.shape[0]):
            for k in range(self._variables.shape[0]):
                self._variables[k] = out[row, k]
            for k in range(self._size):
                self._variables[self._columns[k]] = min(
                    max(out[row, self._columns[k]], self._lower[k]), self._upper[k]
                )
            self._approach(goal[row], near, straight)
            for k in range(self._size):
                out[row, self._columns[k]] = self._nearest[k]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _descend(
        self, goal: cython.double[::1], near: cython.double, straight: cython.double
    ) -> cython.bint:
        """Descend from the variables towards the pose; returns whether it is reached."""
        best: cython.double = -1.0
        since: cython.int = 0
        step: cython.int
        for step in range(self._steps + 1):
            square: cython.double = self._look(goal)
            if self._moved <= near and self._turned <= straight:
                return True
            if best < 0.0 or square < _BETTER * best:
                best, since = square, 0
            else:
                since += 1
            if since > _PATIENCE or step == self._steps:
                return False
            self._step(square)
        return False

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _approach(
        self, goal: cython.double[::1], near: cython.double, straight: cython.double
    ) -> cython.void:
        """Descend towards the pose, and keep the nearest variables in ``_nearest``."""
        best: cython.double = -1.0
        since: cython.int = 0
        left: cython.int = self._steps
        k: cython.int
        while left >= 0:
            left -= 1
            square: cython.double = self._look(goal)
            since += 1
            if best < 0.0 or square < best:
                if best < 0.0 or square < _BETTER * best:
                    since = 0
                best = square
                for k in range(self._size):
                    self._nearest[k] = self._variables[self._columns[k]]
            done: cython.bint = self._moved <= near and self._turned <= straight
            if done or since > _PATIENCE:
                return
            self._step(square)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _look(self, goal: cython.double[::1]) -> cython.double:
        """Find frames, Jacobian and error; returns the square of the weighted error."""
        k: cython.int
        joint: cython.int
        for k in range(self._path.shape[0]):
            self._tree.place(self._path[k], self._frames, self._variables)
        joint = -1
        if self._path.shape[0] > 0:
            joint = self._path[self._path.shape[0] - 1]
        compose(self._frames, joint + 1, self._offset, 0, self._tip, 0)
        self._find_error(goal)
        self._moved = self._turned = 0.0
        square: cython.double = 0.0
        for k in range(6):
            self._error[k] *= self._weights[k]
            size: cython.double = self._error[k] * self._error[k]
            square += size
            if k < 3:
                self._moved += size
            else:
                self._turned += size
        self._moved, self._turned = sqrt(self._moved), sqrt(self._turned)
        return square

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _find_error(self, goal: cython.double[::1]) -> cython.void:
        """Compute the missing translation, and the rotation vector, along the root's axes."""
        i: cython.int
        j: cython.int
        for i in range(3):
            self._error[i] = goal[9 + i] - self._tip[0, 9 + i]
            for j in range(3):
                self._turn[3 * i + j] = (
                    goal[3 * i] * self._tip[0, 3 * j]
                    + goal[3 * i + 1] * self._tip[0, 3 * j + 1]
                    + goal[3 * i + 2] * self._tip[0, 3 * j + 2]
                )
        x: cython.double = 0.5 * (self._turn[7] - self._turn[5])
        y: cython.double = 0.5 * (self._turn[2] - self._turn[6])
        z: cython.double = 0.5 * (self._turn[3] - self._turn[1])
        sine: cython.double = sqrt(x * x + y * y + z * z)
        cosine: cython.double = 0.5 * (self._turn[0] + self._turn[4] + self._turn[8] - 1.0)
        scale: cython.double = 1.0
        if sine > 1e-7:
            scale = atan2(sine, cosine) / sine
        elif cosine < 0.0:
            # Half a turn, about the longest row of R + 1.
            i = 0
            if self._turn[4] > self._turn[0]:
                i = 1
            if self._turn[8] > self._turn[4 * i]:
                i = 2
            x, y, z = self._turn[3 * i], self._turn[3 * i + 1], self._turn[3 * i + 2]
            if i == 0:
                x += 1.0
            elif i == 1:
                y += 1.0
            else:
                z += 1.0
            scale = 3.141592653589793 / sqrt(x * x + y * y + z * z)
        self._error[3], self._error[4], self._error[5] = scale * x, scale * y, scale * z

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _step(self, square: cython.double) -> cython.void:
        """Update the variables, none of them beyond its limits."""
        k: cython.int
        self._find_jacobian()
        for k in range(self._size):
            self._held[k] = 0
        again: cython.bint = True
        while again:
            again = False
            self._find_change(_DAMPING * square + _LEAST)
            for k in range(self._size):
                value: cython.double = self._variables[self._columns[k]]
                out: cython.bint = (value >= self._upper[k] and self._change[k] > 0.0) or (
                    value <= self._lower[k] and self._change[k] < 0.0
                )
                if out and not self._held[k]:
                    self._held[k] = 1
                    again = True
        largest: cython.double = 0.0
        for k in range(self._size):
            largest = max(largest, fabs(self._change[k]))
        scale: cython.double = 1.0
        if largest > _LARGEST_STEP:
            scale = _LARGEST_STEP / largest
        for k in range(self._size):
            column: cython.int = self._columns[k]
            moved: cython.double = self._variables[column] + scale * self._change[k]
            self._variables[column] = min(max(moved, self._lower[k]), self._upper[k])

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _find_jacobian(self) -> cython.void:
        """Compute the Jacobian of the tip, rows weighted."""
        k: cython.int
        row: cython.int
        for row in range(6):
            for k in range(self._size):
                self._jacobian[row, k] = 0.0
        for k in range(self._path.shape[0]):
            if self._slots[k] < 0:
                continue
            joint: cython.int = self._path[k]
            self._tree.motion(joint, self._frames, self._tip, self._motion)
            for row in range(6):
                self._jacobian[row, self._slots[k]] += self._weights[row] * self._motion[row]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _find_change(self, damping: cython.double) -> cython.void:
        """Solve (J J' + damping) y = error by Cholesky; the change is J' y."""
        i: cython.int
        k: cython.int
        total: cython.double
        self._factorize(damping)
        for i in range(6):
            total = self._error[i]
            for k in range(i):
                total -= self._matrix[i, k] * self._right[k]
            self._right[i] = total / self._matrix[i, i]
        for i in range(5, -1, -1):
            total = self._right[i]
            for k in range(i + 1, 6):
                total -= self._matrix[k, i] * self._right[k]
            self._right[i] = total / self._matrix[i, i]
        for k in range(self._size):
            total = 0.0
            if not self._held[k]:
                for i in range(6):
                    total += self._jacobian[i, k] * self._right[i]
            self._change[k] = total

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _factorize(self, damping: cython.double) -> cython.void:
        """Compute the lower triangle of J J' + damping, without the columns of fixed variables."""
        i: cython.int
        j: cython.int
        k: cython.int
        for i in range(6):
            for j in range(i + 1):
                total: cython.double = 0.0
                for k in range(self._size):
                    if not self._held[k]:
                        total += self._jacobian[i, k] * self._jacobian[j, k]
                for k in range(j):
                    total -= self._matrix[i, k] * self._matrix[j, k]
                if i == j:
                    self._matrix[i, i] = sqrt(max(total + damping, 1e-300))
                else:
                    self._matrix[i, j] = total / self._matrix[j, j]
