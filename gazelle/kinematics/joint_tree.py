"""Forward kinematics and Jacobians of a robot, compiled.

A rigid transform is twelve numbers here: the rotation matrix row by row, then the translation.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np
from cython.cimports.gazelle.native.elementary import cos, sin

from gazelle.array_types import Bools, Floats, Indices, Ints32


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def compose(
    first: cython.double[:, ::1],
    i: cython.int,
    second: cython.double[:, ::1],
    j: cython.int,
    made: cython.double[:, ::1],
    k: cython.int,
) -> cython.void:
    """Set row k of ``made`` to row i of ``first`` times row j of ``second``; not in place."""
    row: cython.int
    column: cython.int
    for row in range(3):
        a: cython.double = first[i, 3 * row]
        b: cython.double = first[i, 3 * row + 1]
        c: cython.double = first[i, 3 * row + 2]
        for column in range(3):
            made[k, 3 * row + column] = (
                a * second[j, column] + b * second[j, 3 + column] + c * second[j, 6 + column]
            )
        made[k, 9 + row] = (
            a * second[j, 9] + b * second[j, 10] + c * second[j, 11] + first[i, 9 + row]
        )


@cython.cclass
class JointTree:
    """Joints that each turn or slide about an axis of their frame, parents before children.

    Args:
        parents: Index of each joint's parent, -1 for the root, shape (joints,).
        origins: Frame of each joint at zero in its parent's, shape (joints, 12).
        axes: Unit vectors in the joint's frame, shape (joints, 3).
        slides: Whether a joint slides along its axis rather than turning, shape (joints,).
        columns: Of which variable a joint's position is made, shape (joints,).
        multipliers: By which the variable is multiplied, shape (joints,).
        offsets: Offsets that are added then [m or rad], shape (joints,).
    """

    _parents: cython.int[::1]
    _origins: cython.double[:, ::1]
    _axes: cython.double[:, ::1]
    _slides: cython.uchar[::1]
    _columns: cython.int[::1]
    _multipliers: cython.double[::1]
    _offsets: cython.double[::1]
    joints: cython.int

    def __init__(
        self,
        parents: Ints32,
        origins: Floats,
        axes: Floats,
        slides: Bools,
        columns: Ints32,
        multipliers: Floats,
        offsets: Floats,
    ) -> None:
        self.joints = len(parents)
        self._parents = np.ascontiguousarray(parents, np.int32)
        self._origins = np.ascontiguousarray(origins, np.float64)
        self._axes = np.ascontiguousarray(axes, np.float64)
        self._slides = np.ascontiguousarray(slides, np.uint8)
        self._columns = np.ascontiguousarray(columns, np.int32)
        self._multipliers = np.ascontiguousarray(multipliers, np.float64)
        self._offsets = np.ascontiguousarray(offsets, np.float64)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def place(
        self,
        joint: cython.int,
        frames: cython.double[:, ::1],
        variables: cython.double[::1],
    ) -> cython.void:
        """Write the frame of a joint, moved, whose parent's is there; row 0 is the root's."""
        value: cython.double = (
            variables[self._columns[joint]] * self._multipliers[joint] + self._offsets[joint]
        )
        x: cython.double = self._axes[joint, 0]
        y: cython.double = self._axes[joint, 1]
        z: cython.double = self._axes[joint, 2]
        row: cython.int
        me: cython.int = joint + 1
        compose(frames, self._parents[joint] + 1, self._origins, joint, frames, me)
        if self._slides[joint]:
            for row in range(3):
                frames[me, 9 + row] += value * (
                    frames[me, 3 * row] * x
                    + frames[me, 3 * row + 1] * y
                    + frames[me, 3 * row + 2] * z
                )
            return
        s: cython.double = sin(value)
        c: cython.double = cos(value)
        v: cython.double = 1.0 - c
        # Rodrigues' formula, column by column.
        for row in range(3):
            a: cython.double = frames[me, 3 * row]
            b: cython.double = frames[me, 3 * row + 1]
            d: cython.double = frames[me, 3 * row + 2]
            along: cython.double = (a * x + b * y + d * z) * v
            frames[me, 3 * row] = a * c + along * x + (b * z - d * y) * s
            frames[me, 3 * row + 1] = b * c + along * y + (d * x - a * z) * s
            frames[me, 3 * row + 2] = d * c + along * z + (a * y - b * x) * s

    def forward(self, variables: Floats, joints: Indices, offsets: Floats) -> Floats:
        """Compute frames that are fixed to joints.

        Args:
            variables: Shape (n, variables).
            joints: Joint that each frame moves with, -1 for the root, shape (k,).
            offsets: Each frame in its joint's, shape (k, 12).

        Returns:
            Homogeneous transforms in the root's frame, shape (n, k, 4, 4).
        """
        given: cython.double[:, ::1] = np.ascontiguousarray(variables, np.float64)
        chosen: cython.int[::1] = np.ascontiguousarray(joints, np.int32)
        fixed: cython.double[:, ::1] = np.ascontiguousarray(offsets, np.float64)
        size: cython.int = given.shape[0]
        count: cython.int = chosen.shape[0]
        made = np.zeros((size, count, 4, 4))
        made[:, :, 3, 3] = 1.0
        out: cython.double[:, :, :, ::1] = made
        frames: cython.double[:, ::1] = self.root()
        one: cython.double[:, ::1] = np.zeros((1, 12))
        n: cython.int
        k: cython.int
        row: cython.int
        column: cython.int
        for n in range(size):
            for k in range(self.joints):
                self.place(k, frames, given[n])
            for k in range(count):
                compose(frames, chosen[k] + 1, fixed, k, one, 0)
                for row in range(3):
                    for column in range(3):
                        out[n, k, row, column] = one[0, 3 * row + column]
                    out[n, k, row, 3] = one[0, 9 + row]
        return made

    def jacobian(self, variables: Floats, joint: int, offset: Floats) -> Floats:
        """Compute the Jacobian of a frame.

        Args:
            variables: Shape (n, variables).
            joint: Joint that moves the frame, -1 for the root.
            offset: The frame in its joint's, shape (12,).

        Returns:
            Velocity of the frame's origin [m] and angular velocity [rad], both along the root's
            axes, for a unit speed of each variable: shape (n, 6, variables).
        """
        given: cython.double[:, ::1] = np.ascontiguousarray(variables, np.float64)
        fixed: cython.double[:, ::1] = np.ascontiguousarray(offset, np.float64).reshape(1, 12)
        size: cython.int = given.shape[0]
        made = np.zeros((size, 6, given.shape[1]))
        out: cython.double[:, :, ::1] = made
        frames: cython.double[:, ::1] = self.root()
        one: cython.double[:, ::1] = np.zeros((1, 12))
        moved: cython.double[::1] = np.zeros(6)
        tip: cython.int = joint
        n: cython.int
        k: cython.int
        row: cython.int
        for n in range(size):
            for k in range(self.joints):
                self.place(k, frames, given[n])
            compose(frames, tip + 1, fixed, 0, one, 0)
            k = tip
            while k >= 0:
                self.motion(k, frames, one, moved)
                for row in range(6):
                    out[n, row, self._columns[k]] += moved[row]
                k = self._parents[k]
        return made

    def path(self, joint: int) -> Ints32:
        """Return the joints from the root to one, itself the last, shape (k,)."""
        found: list[int] = []
        while joint >= 0:
            found.insert(0, joint)
            joint = int(np.asarray(self._parents)[joint])
        return np.array(found, np.int32)

    def columns(self) -> Ints32:
        """Return the index of each joint's variable, shape (joints,)."""
        return np.array(self._columns, np.int32)

    def root(self) -> Floats:
        """Return memory for frames of the root and all joints, the root's being the identity."""
        frames = np.zeros((self.joints + 1, 12))
        frames[0, [0, 4, 8]] = 1.0
        return frames

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def motion(
        self,
        joint: cython.int,
        frames: cython.double[:, ::1],
        tip: cython.double[:, ::1],
        out: cython.double[::1],
    ) -> cython.void:
        """Compute velocity and angular velocity of a tip, per unit speed of a joint's variable."""
        row: cython.int
        me: cython.int = joint + 1
        for row in range(3):
            out[3 + row] = self._multipliers[joint] * (
                frames[me, 3 * row] * self._axes[joint, 0]
                + frames[me, 3 * row + 1] * self._axes[joint, 1]
                + frames[me, 3 * row + 2] * self._axes[joint, 2]
            )
        if self._slides[joint]:
            for row in range(3):
                out[row] = out[3 + row]
                out[3 + row] = 0.0
            return
        dx: cython.double = tip[0, 9] - frames[me, 9]
        dy: cython.double = tip[0, 10] - frames[me, 10]
        dz: cython.double = tip[0, 11] - frames[me, 11]
        out[0] = out[4] * dz - out[5] * dy
        out[1] = out[5] * dx - out[3] * dz
        out[2] = out[3] * dy - out[4] * dx
