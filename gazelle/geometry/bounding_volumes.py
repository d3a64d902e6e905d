"""Trees of bounding boxes in which MuJoCo finds sooner what may touch, and what a ray meets.

MuJoCo looks for what a shape may touch in the other body's tree of boxes, and the world itself is
one body. It splits boxes into equal numbers along the longest side, with the ground among them,
which is endless and makes every box above it endless. In the tree of ``BoxTree`` it visits half
as many, and finds the same contacts in the same order: a burger's step in ROBOTIS' house takes a
sixth less time. A ray finds the same triangle of a mesh of 25,000 in a quarter of the time.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.native.box_trees import BoxTree

if TYPE_CHECKING:
    import mujoco

# Half a size that MuJoCo takes for endless [m]: it compares no further then.
_ENDLESS = 1e10

# A box with more than this share of the surface of the one around it is met nearly always.
_LIKELY = 0.8


def tighten_hierarchies(model: mujoco.MjModel, seen: Bools) -> None:
    """Replace the bounding volume hierarchies of a compiled model by tighter ones.

    Args:
        model: The model.
        seen: Whether rays may meet each geom, shape (ngeom,); those of other meshes stay.
    """
    model.vis.global_.bvactive = False  # or MuJoCo notes for viewers what it visits
    for start, count in zip(model.body_bvhadr, model.body_bvhnum, strict=True):
        _tighten(model, slice(start, start + count), bodies=True)
    from mujoco import mjtGeom

    meshes = np.unique(model.geom_dataid[seen & (model.geom_type == mjtGeom.mjGEOM_MESH)])
    for mesh in meshes.tolist():
        start = model.mesh_bvhadr[mesh]
        _tighten(model, slice(start, start + model.mesh_bvhnum[mesh]), bodies=False)


def _tighten(model: mujoco.MjModel, nodes: slice, *, bodies: bool) -> None:
    """Replace the nodes of one tree, of a body's shapes or a mesh's triangles."""
    names, boxes = model.bvh_nodeid[nodes], model.bvh_aabb[nodes]
    leaves = np.flatnonzero(names >= 0)
    if len(names) < 5 or len(names) != 2 * len(leaves) - 1:
        return  # two leaves, for which there is one tree
    tree = BoxTree(boxes[leaves])
    bounds = tree.bounds
    if bodies:
        bounds[_likely(tree)] = (0, 0, 0, *[_ENDLESS] * 3)
    names = np.append(names[leaves], -1)  # the last one is that of all that are no leaves
    model.bvh_nodeid[nodes] = names[tree.leaf]
    model.bvh_child[nodes] = tree.children
    model.bvh_depth[nodes] = tree.depth
    model.bvh_aabb[nodes] = bounds


def _likely(tree: BoxTree) -> Bools:
    """Return the nodes with a test better skipped: nearly every query meets them.

    What has the ground below it is met by all; and next to 1e10 m numbers are exact to a
    micrometre only.
    """
    inner = tree.leaf < 0
    surface = _surface(tree.bounds)
    above = np.full(len(inner), np.inf)
    above[tree.children[inner]] = surface[inner, None]
    endless = (tree.bounds[:, 3:] >= _ENDLESS).any(axis=1)
    above[tree.children[inner & endless]] = 0.0
    found: Bools = inner & (endless | (surface > _LIKELY * above))
    return found


def _surface(bounds: Floats) -> Floats:
    x, y, z = bounds[:, 3:].T
    found: Floats = x * y + y * z + z * x
    return found
