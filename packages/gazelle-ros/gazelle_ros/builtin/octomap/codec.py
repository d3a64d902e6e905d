"""Trees of cells as ``octomap_msgs/Octomap`` holds them: OctoMap's two formats of data."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle_ros.base.array_types import Bools, Ints64
from gazelle_ros.builtin.octomap.morton import DEPTH

FREE, OCCUPIED, INNER = 1, 2, 3
"""Kinds of a child in binary trees."""
_CHILDREN = 8
_NODE = np.dtype([("value", "<f4"), ("children", "u1")])


def binary_tree(codes: Ints64, occupied: Bools) -> bytes:
    """Return which cells are occupied and which free: two bytes for each inner node.

    Eight cells of the same kind are one of twice the size.

    Args:
        codes: Of the cells, ascending.
        occupied: Shape (n,).
    """
    leaves, kinds = codes, np.where(occupied, OCCUPIED, FREE)
    inner: Ints64 = np.zeros(0, np.int64)
    depths, starts, words = [], [], []
    for depth in range(DEPTH - 1, -1, -1):
        same, pruned, pruned_kinds = _groups(leaves, kinds)
        children = np.concatenate((leaves[~same], inner))
        states = np.concatenate((kinds[~same], np.full(len(inner), INNER)))
        parents, place = np.unique(children >> 3, return_inverse=True)
        described = np.zeros(len(parents), np.uint16)
        np.bitwise_or.at(described, place, (states << 2 * (children & 7)).astype(np.uint16))
        depths.append(np.full(len(parents), depth))
        starts.append(parents << 3 * (DEPTH - depth))
        words.append(described)
        leaves, kinds, inner = pruned, pruned_kinds, parents
    order = np.lexsort((np.concatenate(depths), np.concatenate(starts)))
    return np.concatenate(words)[order].astype("<u2").tobytes()


def full_tree(codes: Ints64, values: NDArray[np.float32]) -> bytes:
    """Return the log odds of all nodes, each with the children that it has; inner nodes have the greatest.

    Args:
        codes: Of the cells, ascending.
        values: Their log odds, shape (n,).
    """
    depths, starts = [np.full(len(codes), DEPTH)], [codes]
    nodes = [_nodes(values, np.zeros(len(codes), np.uint8))]
    for depth in range(DEPTH - 1, -1, -1):
        parents, first = np.unique(codes >> 3, return_index=True)
        if len(codes):
            masks = np.bitwise_or.reduceat((1 << (codes & 7)).astype(np.uint8), first)
            values = np.maximum.reduceat(values, first)
            nodes.append(_nodes(values, masks))
            depths.append(np.full(len(parents), depth))
            starts.append(parents << 3 * (DEPTH - depth))
        codes = parents
    order = np.lexsort((np.concatenate(depths), np.concatenate(starts)))
    return np.concatenate(nodes)[order].tobytes()


def _groups(leaves: Ints64, kinds: Ints64) -> tuple[Bools, Ints64, Ints64]:
    """Return whether a leaf is one of eight of the same kind; those eight as one leaf, and its kind."""
    parents, first, counts = np.unique(leaves >> 3, return_index=True, return_counts=True)
    if not len(leaves):
        return np.zeros(0, np.bool_), leaves, kinds
    alike = np.minimum.reduceat(kinds, first) == np.maximum.reduceat(kinds, first)
    whole = alike & (counts == _CHILDREN)
    return np.repeat(whole, counts), parents[whole], kinds[first[whole]]


def _nodes(values: NDArray[np.float32], children: NDArray[np.uint8]) -> NDArray[np.void]:
    made = np.zeros(len(values), _NODE)
    made["value"], made["children"] = values, children
    return made
