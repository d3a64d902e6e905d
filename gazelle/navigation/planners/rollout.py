"""Drive some commands ahead over a costmap, and say what each costs.

The rules are those of ``dwa_local_planner`` (D. Fox, W. Burgard and S. Thrun, "The dynamic window
approach to collision avoidance", 1997, with the grids of B. Gerkey and K. Konolige, 2008): what
stands in the way, and how far from the path and from the goal a command ends.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.libc.math import fabs, floor

from gazelle.array_types import Bytes, Floats, Ints32
from gazelle.navigation.costmap.distances import squared_distances

LEFT_MAP = -4.0
ON_OBSTACLE = -6.0
UNREACHABLE = -2.0
NO_MOTION = -10.0
"""Costs of commands that are out of the question."""


@cython.cclass
class TrajectoryRollout:
    """Scoring of commands by simulating them over a costmap.

    Args:
        costs: Of a costmap, shape (rows, columns).
        origin: Of its lower left corner (x, y) [m].
        resolution: Side of a cell [m].
        footprint: Corners of the robot in its frame [m], shape (n, 2); a point has none.
        grids: Steps to the path, to the goal, to the goal's front, and to the path once more, shape
            (4, rows, columns).
        weights: Of those four, of obstacles, and of turning, shape (6,).
        ahead: Distance before the robot at which the last two are looked up [m].
    """

    _costs: cython.uchar[:, ::1]
    _clear: cython.uchar[:, ::1]
    _grids: cython.int[:, :, ::1]
    _footprint: cython.double[:, ::1]
    _weights: cython.double[::1]
    _x0: cython.double
    _y0: cython.double
    _cell: cython.double
    _ahead: cython.double
    _accelerate: cython.bint
    _limits: cython.double[::1]

    def __init__(
        self,
        costs: Bytes,
        origin: tuple[float, float],
        resolution: float,
        footprint: Floats,
        grids: Ints32,
        weights: Floats,
        ahead: float,
    ) -> None:
        self._costs = np.ascontiguousarray(costs)
        self._clear = _clear_of(costs, footprint, resolution)
        self._x0, self._y0, self._cell = origin[0], origin[1], resolution
        self._footprint = np.array(footprint, np.float64, order="C").reshape(-1, 2)
        self._grids = np.ascontiguousarray(grids, np.int32)
        self._weights = np.array(weights, np.float64)
        self._ahead = ahead
        self._accelerate = False
        self._limits = np.zeros(3)

    def accelerate(self, limits: Floats) -> None:
        """Limit the accelerations towards commands [m/s², rad/s²], shape (3,)."""
        self._accelerate, self._limits = True, np.array(limits, np.float64)

    def judge(
        self, pose: Floats, velocity: Floats, commands: Floats, steps: Ints32, duration: float
    ) -> Floats:
        """Return the cost of each command; negative where it is invalid.

        Args:
            pose: x, y [m] and heading [rad], shape (3,).
            velocity: Now [m/s, rad/s], shape (3,).
            commands: x, y [m/s] and turning [rad/s], shape (n, 3).
            steps: Of each, shape (n,); 0 for commands that are no motion.
            duration: Length of the rollout [s].
        """
        result = np.empty(len(commands))
        self._score(pose, velocity, commands, steps, duration, result)
        return result

    @cython.cfunc
    @cython.exceptval(check=False)
    def _score(
        self,
        pose: cython.double[::1],
        velocity: cython.double[::1],
        commands: cython.double[:, ::1],
        steps: cython.int[::1],
        duration: cython.double,
        result: cython.double[::1],
    ) -> cython.void:
        n: cython.Py_ssize_t
        count: cython.Py_ssize_t = commands.shape[0]
        for n in range(count):
            if steps[n] <= 0:
                result[n] = NO_MOTION
            else:
                result[n] = self._drive(pose, velocity, commands, n, steps[n], duration)

    @cython.cfunc
    @cython.exceptval(check=False)
    def _drive(
        self,
        pose: cython.double[::1],
        velocity: cython.double[::1],
        commands: cython.double[:, ::1],
        n: cython.Py_ssize_t,
        steps: cython.int,
        duration: cython.double,
    ) -> cython.double:
        """Return the cost of one command."""
        x: cython.double = pose[0]
        y: cython.double = pose[1]
        heading: cython.double = pose[2]
        dt: cython.double = duration / steps
        vx: cython.double = velocity[0] if self._accelerate else commands[n, 0]
        vy: cython.double = velocity[1] if self._accelerate else commands[n, 1]
        turn: cython.double = velocity[2] if self._accelerate else commands[n, 2]
        c: cython.double = cos(heading)
        s: cython.double = sin(heading)
        dc: cython.double = cos(turn * dt)
        ds: cython.double = sin(turn * dt)
        obstacle: cython.double = 0.0
        path: cython.int = 0
        goal: cython.int = 0
        i: cython.int
        size: cython.int = self._costs.shape[0] * self._costs.shape[1]
        for i in range(steps):
            column: cython.int = cython.cast(cython.int, floor((x - self._x0) / self._cell))
            row: cython.int = cython.cast(cython.int, floor((y - self._y0) / self._cell))
            if not self._within(column, row):
                return LEFT_MAP
            # Only the last place's cost counts, but it must not hit anything before.
            if i == steps - 1 or not self._clear[row, column]:
                obstacle = self._stands(x, y, c, s, column, row)
                if obstacle < 0.0:
                    return obstacle
            path, goal = self._grids[0, row, column], self._grids[1, row, column]
            # Steps beyond the number of cells are none.
            if path >= size or goal >= size:
                return UNREACHABLE
            if i == steps - 1:
                break
            if self._accelerate:
                vx = _toward(vx, commands[n, 0], self._limits[0] * dt)
                vy = _toward(vy, commands[n, 1], self._limits[1] * dt)
                turn = _toward(turn, commands[n, 2], self._limits[2] * dt)
                dc, ds = cos(turn * dt), sin(turn * dt)
            x += (vx * c - vy * s) * dt
            y += (vx * s + vy * c) * dt
            c, s = c * dc - s * ds, s * dc + c * ds
        return self._sum(x, y, c, s, path, goal, obstacle, commands[n, 2])

    @cython.cfunc
    @cython.exceptval(check=False)
    def _sum(
        self,
        x: cython.double,
        y: cython.double,
        c: cython.double,
        s: cython.double,
        path: cython.int,
        goal: cython.int,
        obstacle: cython.double,
        turn: cython.double,
    ) -> cython.double:
        """Return the cost of the final pose of a command."""
        weights = self._weights
        column: cython.int = cython.cast(
            cython.int, floor((x + self._ahead * c - self._x0) / self._cell)
        )
        row: cython.int = cython.cast(
            cython.int, floor((y + self._ahead * s - self._y0) / self._cell)
        )
        cost: cython.double = weights[0] * path + weights[1] * goal
        if self._within(column, row):
            cost += weights[2] * self._grids[2, row, column]
            cost += weights[3] * self._grids[3, row, column]
        elif weights[2] > 0.0 or weights[3] > 0.0:
            return LEFT_MAP
        return cost + weights[4] * obstacle + weights[5] * fabs(turn)

    @cython.cfunc
    @cython.exceptval(check=False)
    def _within(self, column: cython.int, row: cython.int) -> cython.bint:
        return (
            column >= 0
            and row >= 0
            and column < self._costs.shape[1]
            and row < self._costs.shape[0]
        )

    @cython.cfunc
    @cython.exceptval(check=False)
    def _stands(
        self,
        x: cython.double,
        y: cython.double,
        c: cython.double,
        s: cython.double,
        column: cython.int,
        row: cython.int,
    ) -> cython.double:
        """Return the highest cost under the robot's outline, or in its middle; negative if hit."""
        worst: cython.double = self._costs[row, column]
        count: cython.int = self._footprint.shape[0]
        if count < 3:
            return ON_OBSTACLE if worst >= 253.0 else worst
        if worst >= 254.0:
            return ON_OBSTACLE
        k: cython.int
        for k in range(count):
            j: cython.int = k + 1 if k + 1 < count else 0
            ax: cython.double = self._footprint[k, 0]
            ay: cython.double = self._footprint[k, 1]
            bx: cython.double = self._footprint[j, 0]
            by: cython.double = self._footprint[j, 1]
            edge: cython.double = self._edge(
                (x + c * ax - s * ay - self._x0) / self._cell,
                (y + s * ax + c * ay - self._y0) / self._cell,
                (x + c * bx - s * by - self._x0) / self._cell,
                (y + s * bx + c * by - self._y0) / self._cell,
            )
            if edge < 0.0:
                return edge
            worst = max(worst, edge)
        return worst

    @cython.cfunc
    @cython.exceptval(check=False)
    def _edge(
        self, x0: cython.double, y0: cython.double, x1: cython.double, y1: cython.double
    ) -> cython.double:
        """Return the highest cost along an edge of cells, on Bresenham's line between its ends."""
        column: cython.int = cython.cast(cython.int, floor(x0))
        row: cython.int = cython.cast(cython.int, floor(y0))
        wide: cython.int = cython.cast(cython.int, floor(x1)) - column
        high: cython.int = cython.cast(cython.int, floor(y1)) - row
        step_x: cython.int = 1 if wide >= 0 else -1
        step_y: cython.int = 1 if high >= 0 else -1
        wide, high = wide * step_x, high * step_y
        count: cython.int = max(wide, high)
        along: cython.int = count // 2
        aside: cython.int = count // 2
        worst: cython.double = 0.0
        for _ in range(count + 1):
            if not self._within(column, row):
                return LEFT_MAP
            cost: cython.double = self._costs[row, column]
            if cost >= 254.0:
                return ON_OBSTACLE
            worst = max(worst, cost)
            along += wide
            aside += high
            if along >= count:
                along -= count
                column += step_x
            if aside >= count:
                aside -= count
                row += step_y
        return worst

    def footprint_cost(self, x: float, y: float, heading: float) -> float:
        """Return the highest cost under the robot at a place; negative where it cannot stand."""
        column: cython.int = cython.cast(cython.int, floor((x - self._x0) / self._cell))
        row: cython.int = cython.cast(cython.int, floor((y - self._y0) / self._cell))
        if not self._within(column, row):
            return LEFT_MAP
        return float(self._stands(x, y, cos(heading), sin(heading), column, row))

    def can_turn(self, pose: tuple[float, float, float], angle: float, step: float) -> bool:
        """Return whether the robot can turn on the spot without a collision.

        Args:
            pose: x, y [m] and heading [rad].
            angle: Angle of the turn, counter-clockwise [rad].
            step: Between headings that are looked at [rad].
        """
        x, y, heading = pose
        count = max(int(np.ceil(abs(angle) / step)), 1)
        return all(
            self.footprint_cost(x, y, heading + angle * number / count) >= 0.0
            for number in range(count + 1)
        )


@cython.cfunc
@cython.exceptval(check=False)
def _toward(now: cython.double, target: cython.double, most: cython.double) -> cython.double:
    if now < target:
        return min(target, now + most)
    return max(target, now - most)


def _clear_of(costs: Bytes, footprint: Floats, resolution: float) -> Bytes:
    """Return a mask of cells free of collisions at any heading, shape (rows, columns)."""
    corners = np.asarray(footprint, np.float64).reshape(-1, 2)
    reach = float(np.hypot(corners[:, 0], corners[:, 1]).max()) if len(corners) else 0.0
    # What is off the map is hit, too.
    hit = np.ones((costs.shape[0] + 2, costs.shape[1] + 2), np.uint8)
    hit[1:-1, 1:-1] = costs >= (253 if len(corners) < 3 else 254)
    near = (reach / resolution + 1.5) ** 2
    return np.ascontiguousarray(squared_distances(hit)[1:-1, 1:-1] > near, np.uint8)


def steps_of(
    commands: Floats, duration: float, granularity: float, angular_granularity: float
) -> Ints32:
    """Return the number of simulated steps of each command, shape (n,).

    Args:
        commands: Shape (n, 3).
        duration: Length of the rollout [s].
        granularity: Longest step [m].
        angular_granularity: Greatest turn of a step [rad].
    """
    speed = np.hypot(commands[:, 0], commands[:, 1])
    steps = np.maximum(
        speed * duration / granularity, np.abs(commands[:, 2]) * duration / angular_granularity
    )
    return np.ceil(steps).astype(np.int32)
