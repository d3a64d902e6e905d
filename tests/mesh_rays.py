"""Hits of rays on the triangles of a mesh, without an index and without an engine."""

import numpy as np


def first_hits(mesh, origins, directions):
    """Return distances along each ray to a mesh, by signed volumes; infinite for none."""
    a, b, c = (mesh.triangles[None, :, i] for i in range(3))
    p, q = origins[:, None], (origins + 1e3 * directions)[:, None]

    def volume(u, v, w, x):
        return np.einsum("...i,...i", np.cross(v - u, w - u), x - u)

    ends = volume(a, b, c, p), volume(a, b, c, q)
    sides = np.stack([volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)])
    through = (np.sign(ends[0]) != np.sign(ends[1])) & (
        (sides >= 0.0).all(axis=0) | (sides <= 0.0).all(axis=0)
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        share = ends[0] / (ends[0] - ends[1])
    return np.where(through, 1e3 * share, np.inf).min(axis=1)


def rays_at(mesh, count, seed):
    """Return rays from around a mesh to points near to it."""
    chance = np.random.default_rng(seed)
    size = float(np.linalg.norm(mesh.extents))
    start = chance.normal(size=(count, 3))
    start *= size / np.linalg.norm(start, axis=1)[:, None]
    aim = mesh.bounds.mean(axis=0) + chance.uniform(-0.5, 0.5, (count, 3)) * mesh.extents
    along = aim - start
    return start, along / np.linalg.norm(along, axis=1)[:, None]
