"""Scan matching on a map: hill climbing as in ``gmapping``, then alignment along surfaces.

The climb: G. Grisetti, C. Stachniss and W. Burgard, "Improved techniques for grid mapping with
Rao-Blackwellized particle filters", 2007. It counts distances to single ends of earlier beams, and so is
held back by where these happen to lie along a wall: by one or two hundredths of a radian. Afterwards the
pose is moved to where ends lie on lines through their neighbours, which have no such places: Y. Chen and
G. Medioni, "Object modelling by registration of multiple range images", 1992.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.gazelle.navigation.mapping.tiled_maps import TiledMaps
from cython.cimports.libc.math import exp, floor

from gazelle.array_types import Floats


@cython.cclass
class ScanMatcher:
    """Fits scans to the maps of particles.

    Args:
        maps: Of the particles.
        sigma: Of ends of beams about their mean [m²], as gmapping's ``sigma``.
        spread: Of the likelihood [m²], as ``lsigma``.
        kernel: Cells around an end that are looked at.
    """

    _maps: TiledMaps
    _sigma: cython.double
    _spread: cython.double
    _kernel: cython.int
    _likelihood: cython.double
    _normal_x: cython.double
    _normal_y: cython.double
    _off: cython.double
    _weight: cython.double
    _sums: cython.double[::1]

    def __init__(self, maps: TiledMaps, sigma: float, spread: float, kernel: int) -> None:
        self._maps = maps
        self._sigma, self._spread, self._kernel = sigma, spread, kernel
        self._likelihood = self._normal_x = self._normal_y = self._off = self._weight = 0.0
        self._sums = np.zeros(9)

    def likelihood(self, particle: int, pose: Floats, beams: Floats) -> float:
        """Return the logarithm of the likelihood of a scan at a pose; arguments as of `match`."""
        self._score(particle, pose[0], pose[1], pose[2], beams)
        return float(self._likelihood)

    def match(
        self,
        particle: int,
        pose: Floats,
        beams: Floats,
        step: float,
        turn: float,
        rounds: int,
    ) -> float:
        """Move a pose to where a scan fits a map best.

        Args:
            particle: Particle with the map.
            pose: x, y [m] and heading [rad] of the laser, changed in place, shape (3,).
            beams: x and y of ends, in the laser's frame [m], shape (n, 2).
            step: First step of the climb [m].
            turn: First turn of the climb [rad].
            rounds: Number of halvings of the step.

        Returns:
            How many beams fit after the climb, each up to 1.
        """
        guess = np.array(pose)
        score = self._climb(particle, pose, beams, step, turn, rounds)
        self._slide(particle, pose, guess, beams)
        return float(score)

    @cython.cfunc
    @cython.exceptval(check=False)
    def _climb(
        self,
        particle: cython.int,
        pose: cython.double[::1],
        beams: cython.double[:, ::1],
        step: cython.double,
        turn: cython.double,
        rounds: cython.int,
    ) -> cython.double:
        x: cython.double = pose[0]
        y: cython.double = pose[1]
        heading: cython.double = pose[2]
        current: cython.double = self._score(particle, x, y, heading, beams)
        best: cython.double = -1.0
        halved: cython.int = 0
        while current > best or halved < rounds:
            if best >= current:
                halved += 1
                step *= 0.5
                turn *= 0.5
            best = current
            better_x: cython.double = x
            better_y: cython.double = y
            better_heading: cython.double = heading
            move: cython.int
            for move in range(6):
                dx: cython.double = step if move == 0 else -step if move == 1 else 0.0
                dy: cython.double = step if move == 2 else -step if move == 3 else 0.0
                dh: cython.double = turn if move == 4 else -turn if move == 5 else 0.0
                score: cython.double = self._score(particle, x + dx, y + dy, heading + dh, beams)
                if score > current:
                    current = score
                    better_x, better_y, better_heading = x + dx, y + dy, heading + dh
            x, y, heading = better_x, better_y, better_heading
        pose[0], pose[1], pose[2] = x, y, heading
        return current

    @cython.cfunc
    @cython.exceptval(check=False)
    def _score(
        self,
        particle: cython.int,
        x: cython.double,
        y: cython.double,
        heading: cython.double,
        beams: cython.double[:, ::1],
    ) -> cython.double:
        """Score the fit of beams' ends; the likelihood is stored in an attribute."""
        c: cython.double = cos(heading)
        s: cython.double = sin(heading)
        total: cython.double = 0.0
        likelihood: cython.double = 0.0
        n: cython.Py_ssize_t
        i: cython.int
        j: cython.int
        count: cython.Py_ssize_t = beams.shape[0]
        kernel: cython.int = self._kernel
        maps: TiledMaps = self._maps
        for n in range(count):
            bx: cython.double = c * beams[n, 0] - s * beams[n, 1]
            by: cython.double = s * beams[n, 0] + c * beams[n, 1]
            px: cython.double = x + bx
            py: cython.double = y + by
            column: cython.int = cython.cast(cython.int, floor((px - maps.x0) / maps.cell))
            row: cython.int = cython.cast(cython.int, floor((py - maps.y0) / maps.cell))
            # One cell towards the laser, which has to be free.
            far: cython.double = (bx * bx + by * by) ** 0.5
            back_x: cython.int = cython.cast(cython.int, floor(0.5 - 1.4 * bx / far))
            back_y: cython.int = cython.cast(cython.int, floor(0.5 - 1.4 * by / far))
            nearest: cython.double = -1.0
            for i in range(-kernel, kernel + 1):
                for j in range(-kernel, kernel + 1):
                    at: cython.Py_ssize_t = self._surface(
                        particle, column + i, row + j, back_x, back_y
                    )
                    if at < 0:
                        continue
                    place: cython.Py_ssize_t = at % 4096
                    hits: cython.float = maps.pool[at // 4096, place + 2]
                    dx: cython.double = px - maps.pool[at // 4096, place] / hits
                    dy: cython.double = py - maps.pool[at // 4096, place + 1] / hits
                    away: cython.double = dx * dx + dy * dy
                    if nearest < 0.0 or away < nearest:
                        nearest = away
            if nearest >= 0.0:
                total += exp(-nearest / self._sigma)
                likelihood -= nearest / self._spread
            else:
                likelihood -= 0.5 / self._spread
        self._likelihood = likelihood
        return total

    @cython.cfunc
    @cython.exceptval(check=False)
    def _surface(
        self,
        particle: cython.int,
        column: cython.int,
        row: cython.int,
        back_x: cython.int,
        back_y: cython.int,
    ) -> cython.Py_ssize_t:
        """Return the index of a cell in the pool; -1 if it is not full, or invisible to the laser."""
        maps: TiledMaps = self._maps
        at: cython.Py_ssize_t = maps.find(particle, column, row)
        if at < 0:
            return -1
        place: cython.Py_ssize_t = at % 4096
        if maps.pool[at // 4096, place + 2] <= 0.1 * maps.pool[at // 4096, place + 3]:
            return -1
        free: cython.Py_ssize_t = maps.find(particle, column + back_x, row + back_y)
        if free >= 0:
            behind: cython.Py_ssize_t = free // 4096
            spot: cython.Py_ssize_t = free % 4096
            if maps.pool[behind, spot + 2] > 0.1 * maps.pool[behind, spot + 3]:
                return -1
        return at

    # Sliding along surfaces ---------------------------------------------------------------

    @cython.cfunc
    @cython.exceptval(check=False)
    def _slide(
        self,
        particle: cython.int,
        pose: cython.double[::1],
        guess: cython.double[::1],
        beams: cython.double[:, ::1],
    ) -> cython.void:
        """Minimise by Gauss and Newton, in eight rounds at most."""
        sums: cython.double[::1] = self._sums
        for _ in range(8):
            # Odometry counts as two beams: where walls say nothing, as along a corridor, it decides.
            sums[0] = sums[2] = 2.0
            sums[1] = sums[3] = sums[4] = 0.0
            sums[5] = 0.1
            sums[6] = 2.0 * (pose[0] - guess[0])
            sums[7] = 2.0 * (pose[1] - guess[1])
            sums[8] = 0.1 * (pose[2] - guess[2])
            self._add_beams(particle, pose, beams)
            # By Cholesky's factors.
            l00: cython.double = sums[0] ** 0.5
            l10: cython.double = sums[1] / l00
            l20: cython.double = sums[3] / l00
            l11: cython.double = (sums[2] - l10 * l10) ** 0.5
            l21: cython.double = (sums[4] - l20 * l10) / l11
            square: cython.double = sums[5] - l20 * l20 - l21 * l21
            z0: cython.double = sums[6] / l00
            z1: cython.double = (sums[7] - l10 * z0) / l11
            dt: cython.double = (sums[8] - l20 * z0 - l21 * z1) / square
            dy: cython.double = (z1 - l21 * dt) / l11
            dx: cython.double = (z0 - l10 * dy - l20 * dt) / l00
            pose[0] -= dx
            pose[1] -= dy
            pose[2] -= dt
            if dx * dx + dy * dy < 1e-8 and dt * dt < 1e-8:
                break

    @cython.cfunc
    @cython.exceptval(check=False)
    def _add_beams(
        self, particle: cython.int, pose: cython.double[::1], beams: cython.double[:, ::1]
    ) -> cython.void:
        """Add what beams say to the normal equations: xx, xy, yy, xt, yt, tt, and the right side."""
        sums: cython.double[::1] = self._sums
        c: cython.double = cos(pose[2])
        s: cython.double = sin(pose[2])
        # An end half a cell off counts half.
        square: cython.double = 0.25 * self._maps.cell * self._maps.cell
        n: cython.Py_ssize_t
        count: cython.Py_ssize_t = beams.shape[0]
        for n in range(count):
            bx: cython.double = c * beams[n, 0] - s * beams[n, 1]
            by: cython.double = s * beams[n, 0] + c * beams[n, 1]
            if not self._find_line(particle, pose[0] + bx, pose[1] + by, bx, by):
                continue
            nx: cython.double = self._normal_x
            ny: cython.double = self._normal_y
            off: cython.double = self._off
            weight: cython.double = self._weight / (1.0 + off * off / square)
            turn: cython.double = ny * bx - nx * by
            sums[0] += weight * nx * nx
            sums[1] += weight * nx * ny
            sums[2] += weight * ny * ny
            sums[3] += weight * nx * turn
            sums[4] += weight * ny * turn
            sums[5] += weight * turn * turn
            sums[6] += weight * nx * off
            sums[7] += weight * ny * off
            sums[8] += weight * turn * off

    @cython.cfunc
    @cython.exceptval(check=False)
    def _find_line(
        self,
        particle: cython.int,
        px: cython.double,
        py: cython.double,
        bx: cython.double,
        by: cython.double,
    ) -> cython.bint:
        """Fit a line to the ends in the cells around a place; False if there is none.

        Its normal, how far off it the place is [m] and how straight it is, up to 1, are left in
        attributes.
        """
        maps: TiledMaps = self._maps
        column: cython.int = cython.cast(cython.int, floor((px - maps.x0) / maps.cell))
        row: cython.int = cython.cast(cython.int, floor((py - maps.y0) / maps.cell))
        far: cython.double = (bx * bx + by * by) ** 0.5
        back_x: cython.int = cython.cast(cython.int, floor(0.5 - 1.4 * bx / far))
        back_y: cython.int = cython.cast(cython.int, floor(0.5 - 1.4 * by / far))
        total: cython.double = 0.0
        mx: cython.double = 0.0
        my: cython.double = 0.0
        sxx: cython.double = 0.0
        sxy: cython.double = 0.0
        syy: cython.double = 0.0
        i: cython.int
        j: cython.int
        kernel: cython.int = self._kernel
        for i in range(-kernel, kernel + 1):
            for j in range(-kernel, kernel + 1):
                at: cython.Py_ssize_t = self._surface(particle, column + i, row + j, back_x, back_y)
                if at < 0:
                    continue
                place: cython.Py_ssize_t = at % 4096
                hits: cython.double = maps.pool[at // 4096, place + 2]
                dx: cython.double = maps.pool[at // 4096, place] / hits - px
                dy: cython.double = maps.pool[at // 4096, place + 1] / hits - py
                # A cell that is looked at for long counts no more than its neighbours.
                w: cython.double = min(hits, 4.0)
                total += w
                mx += w * dx
                my += w * dy
                sxx += w * dx * dx
                sxy += w * dx * dy
                syy += w * dy * dy
        if total <= 0.0:
            return False
        mx, my = mx / total, my / total
        sxx = sxx / total - mx * mx
        sxy = sxy / total - mx * my
        syy = syy / total - my * my
        half: cython.double = 0.5 * (sxx - syy)
        root: cython.double = (half * half + sxy * sxy) ** 0.5
        most: cython.double = 0.5 * (sxx + syy) + root
        least: cython.double = 0.5 * (sxx + syy) - root
        if most < 0.01 * maps.cell * maps.cell:
            return False
        nx: cython.double = sxy if half >= 0.0 else least - syy
        ny: cython.double = least - sxx if half >= 0.0 else sxy
        size: cython.double = (nx * nx + ny * ny) ** 0.5
        if size <= 0.0:
            return False
        self._normal_x, self._normal_y = nx / size, ny / size
        self._off = -(mx * nx + my * ny) / size
        self._weight = 1.0 - max(least, 0.0) / most
        return True
