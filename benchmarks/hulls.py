"""Convex hulls: time, faces and error of each, beside Qhull's in SciPy on the same points.

Times are of the processor, the best of some rounds in turns. The error is the largest distance of a
given point beyond the hull's faces, by the size of the cloud. trimesh, too, calls Qhull by SciPy.

    gazelle bench hulls
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable

import numpy as np

from gazelle.array_types import Floats
from gazelle.geometry.hull import convex_hull


def clouds() -> dict[str, Floats]:
    """Return points by name, as meshes of robots have them."""
    random = np.random.default_rng(1)
    turn = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
    ring = np.stack((np.cos(turn), np.sin(turn)), axis=1)
    rims = [np.column_stack((ring, np.full(64, z))) for z in (0.0, 0.3)]
    ball = random.normal(size=(2000, 3))
    grid = np.stack(np.meshgrid(*[np.linspace(0.0, 1.0, 12)] * 3), axis=-1).reshape(-1, 3)
    return {
        "8 corners of a box": np.array(np.meshgrid(*[[0.0, 1.0]] * 3)).reshape(3, -1).T,
        "64-gon prism": np.concatenate(rims),
        "12 x 12 x 12 grid": grid,
        "same, turned": grid @ np.linalg.qr(random.normal(size=(3, 3)))[0],
        "2,000 on a sphere": ball / np.linalg.norm(ball, axis=1, keepdims=True),
        "2,000 in a ball": ball * random.uniform(0.0, 1.0, (2000, 1)),
    }


def own(points: Floats) -> tuple[int, float]:
    """Return the number of faces and the error of Gazelle's hull."""
    hull = convex_hull(points)
    if hull is None:
        return 0, np.inf
    return len(hull.faces), -float(hull.depth(points).min())


def qhull(points: Floats) -> tuple[int, float]:
    """Return the number of faces and the error of Qhull's hull."""
    from scipy.spatial import ConvexHull  # type: ignore[import-untyped]  # no types

    hull = ConvexHull(points)
    beyond = hull.equations[:, :3] @ points.T + hull.equations[:, 3:]
    return len(hull.simplices), float(beyond.max())


def best(build: Callable[[Floats], object], points: Floats, seconds: float) -> float:
    """Return the least processor time of a call [s]."""
    least, end = np.inf, time.process_time() + seconds
    while time.process_time() < end:
        begun = time.process_time()
        build(points)
        least = min(least, time.process_time() - begun)
    return least


def main() -> None:
    """Measure each cloud with both."""
    parser = argparse.ArgumentParser(prog="gazelle bench hulls", description=__doc__)
    parser.add_argument("--seconds", type=float, default=0.3, help="of each figure (%(default)s)")
    args = parser.parse_args()
    from scipy.spatial import ConvexHull

    print(
        f"{'points':22}{'own [us]':>10}{'Qhull':>9}{'faces':>8}{'Qhull':>8}{'error':>10}{'Qhull':>10}"
    )
    for name, points in clouds().items():
        size = float(np.ptp(points, axis=0).max())
        spent = [best(build, points, args.seconds) for build in (convex_hull, ConvexHull)]
        (faces, error), (others, off) = own(points), qhull(points)
        print(
            f"{name:22}{spent[0] * 1e6:>10.0f}{spent[1] * 1e6:>9.0f}{faces:>8}{others:>8}"
            f"{error / size:>10.0e}{off / size:>10.0e}"
        )


if __name__ == "__main__":
    main()
