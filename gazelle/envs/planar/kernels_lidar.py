"""One lidar on one body in every world: what it sees, and what it reports.

Of closed outlines only the sides that face the lidar are drawn. Where a beam meets one nearer
than beams begin, it may begin inside something; that scan is made anew by the engine's own
kernel, which knows. Both give the same ranges.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.engines.native import each, fused, part, whole
from gazelle.engines.planar.columns import (
    COS,
    FAMILY,
    NEAR,
    RADIUS,
    REACH,
    S_COS,
    S_SIN,
    S_X,
    S_Y,
    S_Z,
    SIN,
    X,
    Y,
    Z,
)
from gazelle.engines.planar.kernels_fan import FEW, beams_in, cover
from gazelle.engines.planar.kernels_scan import aim, scan
from gazelle.envs.planar.tables import Floats, Indices, Table, Worlds

_GOLDEN = np.uint64(0x9E3779B97F4A7C15)
_MIX_1 = np.uint64(0xBF58476D1CE4E5B9)
_MIX_2 = np.uint64(0x94D049BB133111EB)
_MANTISSA = np.uint64(0x000FFFFFFFFFFFFF)
_ONE = np.uint64(0x3FF0000000000000)
_LN2 = math.log(2.0)
_SQRT2 = math.sqrt(2.0)


# -- seeing --------------------------------------------------------------------------------


@part
def find_faces(
    turned: Floats, order: Indices, n: int, base: int, faces: Floats, first: int, last: int,
    reach: float, height: float, x: float, y: float, cos: float, sin: float,
) -> int:  # fmt: skip
    """Turn sides into the lidar's frame, and list those that can be seen; returns how many.

    Args:
        turned: Comes out: both ends, and one over twice the area that a side spans with the
            lidar, in column ``base`` + i for side i.
        order: Comes out from the n-th on: columns of sides that can be seen.
        n: How many are listed.
        base: Where columns begin.
        faces: Sides in their own frame, see ``parts``.
        first: Of the sides.
        last: The one after the last.
        reach: How far the lidar sees [m].
        height: Of the lidar above their frame [m].
        x: Their frame in that of the lidar: origin [m], cosine and sine of its heading.
        y: See x.
        cos: See x.
        sin: See x.
    """
    for i in each(first, last):
        ax, ay, bx, by = faces[0, i], faces[1, i], faces[2, i], faces[3, i]
        x0, y0 = x + cos * ax - sin * ay, y + sin * ax + cos * ay
        x1, y1 = x + cos * bx - sin * by, y + sin * bx + cos * by
        cross, ex, ey = x0 * y1 - x1 * y0, x1 - x0, y1 - y0
        near = cross * cross <= reach * reach * (ex * ex + ey * ey)
        front = (cross < 0.0) | ((faces[4, i] > 0.0) & (cross != 0.0))
        level = (height >= faces[5, i]) & (height <= faces[6, i])
        k = base + i
        turned[0, k], turned[1, k], turned[2, k], turned[3, k] = x0, y0, x1, y1
        turned[4, k] = 1.0 / cross if near & front & level else 0.0
    for k in range(base + first, base + last):
        order[n] = k
        n += 1 if turned[4, k] != 0.0 else 0
    return n


@part
def draw_one(
    beams: Floats, lo: int, hi: int, x0: float, y0: float, x1: float, y1: float, inverse: float,
) -> None:  # fmt: skip
    """A segment into beams lo to hi, however near it is."""
    for k in each(lo, hi):
        dx, dy, best = beams[0, k], beams[1, k], beams[2, k]
        c0, c1 = fused(dx, y0, -dy * x0), fused(dx, y1, -dy * x1)
        v = (c1 - c0) * inverse
        beams[2, k] = v if (c0 * c1 <= 0.0) & (v > best) else best


@part
def draw_two(beams: Floats, turned: Floats, i: int, j: int) -> None:
    """Two segments into all beams."""
    ax, ay, au, av, ai = turned[0, i], turned[1, i], turned[2, i], turned[3, i], turned[4, i]
    bx, by, bu, bv, bi = turned[0, j], turned[1, j], turned[2, j], turned[3, j], turned[4, j]
    for k in each(0, beams.shape[1]):
        dx, dy, best = beams[0, k], beams[1, k], beams[2, k]
        c0, c1 = fused(dx, ay, -dy * ax), fused(dx, av, -dy * au)
        v = (c1 - c0) * ai
        best = v if (c0 * c1 <= 0.0) & (v > best) else best
        c0, c1 = fused(dx, by, -dy * bx), fused(dx, bv, -dy * bu)
        v = (c1 - c0) * bi
        beams[2, k] = v if (c0 * c1 <= 0.0) & (v > best) else best


@part
def draw_disc(beams: Floats, x: float, y: float, radius: float, outside: float) -> None:
    """A disc that beams begin outside of, into all beams."""
    inverse, square = 1.0 / outside, radius * radius
    for k in each(0, beams.shape[1]):
        dx, dy, best = beams[0, k], beams[1, k], beams[2, k]
        along, aside = dx * x + dy * y, dx * y - dy * x
        rest = square - aside * aside
        v = (along + math.sqrt(max(rest, 0.0))) * inverse
        beams[2, k] = v if (rest >= 0.0) & (along > 0.0) & (v > best) else best


@part
def draw_faces(
    beams: Floats, fan: Floats, found: Floats, turned: Floats, order: Indices, n: int
) -> None:
    """Draw the segments listed."""
    count = beams.shape[1]
    if count <= FEW:
        for i in range(0, n - 1, 2):
            draw_two(beams, turned, order[i], order[i + 1])
        if n % 2 == 1:
            k = order[n - 1]
            x0, y0, x1, y1 = turned[0, k], turned[1, k], turned[2, k], turned[3, k]
            draw_one(beams, 0, count, x0, y0, x1, y1, turned[4, k])
        return
    for i in range(n):
        k = order[i]
        for row in range(4):
            found[row, i] = turned[row, k]
        found[4, i], found[8, i] = 0.0, turned[4, k]
    cover(found, n, fan)
    for i in range(n):
        for turn in range(2):
            lo, hi = beams_in(fan, count, found[5, i], found[6, i], -turn)
            if lo < hi:
                x0, y0, x1, y1 = found[0, i], found[1, i], found[2, i], found[3, i]
                draw_one(beams, lo, hi, x0, y0, x1, y1, found[8, i])


@part
def find_bodies(
    beams: Floats, fan: Floats, turned: Floats, order: Indices, base: int, sides: Floats,
    rounds: Floats, spans: Indices, sensors: Floats, m: int, owner: int, kinds: Floats,
    pose: Floats,
) -> int:  # fmt: skip
    """Draw round bodies other than the owner's family, and list sides; -1 from inside a disc."""
    n = 0
    nbody = kinds.shape[0]
    world = owner - owner % nbody
    me = kinds[owner - world, FAMILY]
    c, s = sensors[m, S_COS], sensors[m, S_SIN]
    for k in range(nbody):
        b = world + k
        ox, oy = pose[b, X] - sensors[m, S_X], pose[b, Y] - sensors[m, S_Y]
        far = fan[REACH] + kinds[k, RADIUS]
        if kinds[k, FAMILY] == me or ox * ox + oy * oy > far * far:
            continue
        height = sensors[m, S_Z] - pose[b, Z]
        x, y = c * ox + s * oy, c * oy - s * ox
        cos = c * pose[b, COS] + s * pose[b, SIN]
        sin = c * pose[b, SIN] - s * pose[b, COS]
        n = find_faces(
            turned, order, n, base + spans[k, 4], sides, spans[k, 0], spans[k, 1], fan[REACH], height, x, y,
            cos, sin,
        )  # fmt: skip
        for p in range(spans[k, 2], spans[k, 3]):
            if height < rounds[p, 3] or height > rounds[p, 4]:
                continue
            ax, ay, radius = rounds[p, 0], rounds[p, 1], rounds[p, 2]
            x0, y0 = x + cos * ax - sin * ay, y + sin * ax + cos * ay
            outside = x0 * x0 + y0 * y0 - radius * radius
            if outside <= 0.0:
                return -1
            draw_disc(beams, x0, y0, radius, outside)
    return n


@part
def look(
    m: int, owner: int, sensors: Floats, fan: Floats, faces: Floats, discs: Floats,
    sides: Floats, rounds: Floats, spans: Indices, kinds: Floats, pose: Floats, beams: Floats,
    found: Floats, turned: Floats, order: Indices,
) -> bool:  # fmt: skip
    """Scan from outside of everything; False if that is not sure."""
    nothing = 1.0 / fan[REACH]
    for k in each(0, beams.shape[1]):
        beams[2, k] = nothing
    c, s = sensors[m, S_COS], sensors[m, S_SIN]
    x, y = sensors[m, S_X], sensors[m, S_Y]
    total = faces.shape[1]
    n = find_bodies(
        beams, fan, turned, order, total, sides, rounds, spans, sensors, m, owner, kinds, pose
    )
    if n < 0:
        return False
    for i in range(discs.shape[0]):
        ox, oy, radius = discs[i, 0] - x, discs[i, 1] - y, discs[i, 2]
        outside = ox * ox + oy * oy - radius * radius
        if outside <= 0.0:
            return False
        draw_disc(beams, c * ox + s * oy, c * oy - s * ox, radius, outside)
    n = find_faces(
        turned, order, n, 0, faces, 0, total, fan[REACH], sensors[m, S_Z],
        -c * x - s * y, s * x - c * y, c, -s,
    )  # fmt: skip
    draw_faces(beams, fan, found, turned, order, n)
    nearer = 0
    for k in each(0, beams.shape[1]):
        nearer += 1 if beams[2, k] > fan[NEAR] else 0
    return nearer == 0


@whole
def see(
    first: int, last: int, worlds: Worlds, faces: Floats, discs: Floats, sides: Floats,
    rounds: Floats, spans: Indices, found: Floats, turned: Floats, order: Indices,
    sensors: Floats, owners: Table, mounts: Floats, fan: Floats, kinds: Floats,
    pose: Floats, beams: Floats, ranges: Floats, names: Floats, own: Table,
) -> None:  # fmt: skip
    """Scan in worlds[first] to worlds[last - 1].

    What comes out in ``ranges`` is infinite where nothing is met within the reach, negative
    infinite where a beam begins inside something. The rest is what ``kernels_scan.scan`` takes,
    with ``names`` of one row a world.
    """
    nothing = 1.0 / fan[REACH]
    for i in range(first, last):
        w = worlds[i]
        aim(sensors, w, owners, mounts, pose)
        if look(
            w, owners[w], sensors, fan, faces, discs, sides, rounds, spans, kinds, pose, beams,
            found, turned, order,
        ):  # fmt: skip
            for k in each(0, beams.shape[1]):
                best = beams[2, k]
                ranges[w, k] = 1.0 / best if best > nothing else np.inf
            continue
        scan(w, w + 1, *own)
        for k in range(beams.shape[1]):
            if names[w, k] == 0.0:
                ranges[w, k] = np.inf
            elif names[w, k] < 0.0:
                ranges[w, k] = -np.inf


# -- reporting -----------------------------------------------------------------------------


@part
def logarithm(values: Floats, bits: Table) -> None:
    """Natural logarithms in place of numbers in (0, 1], to 1e-14.

    By the series of the inverse hyperbolic tangent: Abramowitz and Stegun, 4.1.27.

    Args:
        values: The numbers.
        bits: The same memory as unsigned integers.
    """
    for k in each(0, values.shape[0]):
        raw = bits[k]
        power = float(np.int64(raw >> np.uint64(52)) - 1023)
        bits[k] = (raw & _MANTISSA) | _ONE
        m = values[k]
        large = m > _SQRT2
        m = 0.5 * m if large else m
        power = power + 1.0 if large else power
        f = (m - 1.0) / (m + 1.0)
        q = f * f
        series = fused(q, 1 / 15, 1 / 13)
        series = fused(q, fused(q, fused(q, series, 1 / 11), 1 / 9), 1 / 7)
        series = fused(q, fused(q, fused(q, series, 1 / 5), 1 / 3), 1.0)
        values[k] = fused(power, _LN2, 2.0 * f * series)


@part
def uniforms(key: np.uint64, start: np.uint64, values: Floats) -> None:
    """The next numbers in [0, 1) of a world of ``gazelle.streams.Stream``."""
    for k in each(0, values.shape[0]):
        z = key + (start + np.uint64(k) + np.uint64(1)) * _GOLDEN
        z = (z ^ (z >> np.uint64(30))) * _MIX_1
        z = (z ^ (z >> np.uint64(27))) * _MIX_2
        values[k] = float(np.int64((z ^ (z >> np.uint64(31))) >> np.uint64(11))) * 2.0**-53


@part
def normals(
    key: np.uint64, start: np.uint64, pairs: int, lanes: Floats, bits: Table, values: Floats,
) -> None:  # fmt: skip
    """The next normal numbers of a world of ``gazelle.streams.Stream``, to 1e-13.

    Sines and cosines by their series about the nearest quarter turn.

    Args:
        key: Of the world.
        start: Numbers drawn before.
        pairs: Half of how many numbers.
        lanes: Room for two rows of at least as many, best filled up to what fits vector units.
        bits: The same memory as unsigned integers.
        values: Comes out, with room for as much more as the rows are longer.
    """
    uniforms(key, start, lanes[0])
    uniforms(key, start + np.uint64(pairs), lanes[1])
    width = lanes.shape[1]
    for k in each(0, width):
        lanes[0, k] = 1.0 - lanes[0, k]
    logarithm(lanes[0], bits[0])
    for k in each(0, width):
        radius = math.sqrt(max(-2.0 * lanes[0, k], 0.0))
        t = 4.0 * lanes[1, k]
        quarter = math.floor(t + 0.5)
        r = (t - quarter) * (0.5 * math.pi)
        q = r * r
        sine = fused(q, fused(q, 1 / 6227020800, -1 / 39916800), 1 / 362880)
        sine = fused(q, fused(q, fused(q, sine, -1 / 5040), 1 / 120), -1 / 6)
        sine = fused(r * q, sine, r)
        cosine = fused(q, fused(q, -1 / 87178291200, 1 / 479001600), -1 / 3628800)
        cosine = fused(q, fused(q, fused(q, cosine, 1 / 40320), -1 / 720), 1 / 24)
        cosine = fused(q, fused(q, cosine, -0.5), 1.0)
        odd = (quarter == 1.0) | (quarter == 3.0)
        a, b = (sine if odd else cosine), (cosine if odd else sine)
        a = -a if (quarter == 1.0) | (quarter == 2.0) else a
        b = -b if (quarter == 2.0) | (quarter == 3.0) else b
        values[k], lanes[1, k] = radius * a, radius * b
    for k in each(0, width):
        values[pairs + k] = lanes[1, k]


@whole
def report(
    first: int, last: int, worlds: Worlds, ranges: Floats, law: Floats, deviation: Floats,
    keys: Table, counters: Table, lanes: Floats, bits: Table, values: Floats, cleaned: Floats,
) -> None:  # fmt: skip
    """What the lidar reports, fit for a policy; see ``gazelle.envs.scans.clean_ranges``.

    Args:
        first: Index of the first world of ``worlds``.
        last: The one after the last.
        worlds: Which worlds.
        ranges: True ranges as ``see`` gives them, a row a world.
        law: Least and greatest range [m], what ranges are rounded to [m] or 0, mean of the noise
            [m], cap [m].
        deviation: Standard deviation of the noise in each world [m].
        keys: Of the noise's stream.
        counters: Numbers drawn so far.
        lanes: Room, see ``normals``.
        bits: The same memory as unsigned integers.
        values: Room for the noise, see ``normals``.
        cleaned: Comes out, a row an index.
    """
    count = ranges.shape[1]
    pairs = (count + 1) // 2
    least, most, quantum, mean, cap = law[0], law[1], law[2], law[3], law[4]
    for i in range(first, last):
        w = worlds[i]
        noisy = deviation[w] != 0.0
        spread = deviation[w]
        if noisy:
            normals(keys[w], counters[w], pairs, lanes, bits, values)
            counters[w] += np.uint64(2 * pairs)
        for k in each(0, count):
            true = ranges[w, k]
            measured = true + mean + spread * values[k] if noisy else true + mean
            if quantum > 0.0:
                measured = np.rint(measured / quantum) * quantum
            measured = min(max(measured, least), most)
            measured = cap if true >= most else measured
            measured = least if true == -np.inf else measured
            cleaned[i, k] = min(max(measured, 0.0), cap)
