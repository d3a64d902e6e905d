"""Trees of boxes: all is in its place, little is visited."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from gazelle.native.box_trees import BoxTree

number = st.floats(-10.0, 10.0)


def boxes_of(count):
    centres = arrays(np.float64, (count, 3), elements=number)
    halves = arrays(np.float64, (count, 3), elements=st.floats(0.0, 5.0))
    return st.tuples(centres, halves).map(np.hstack)


def below(tree, node):
    """Return boxes below a node."""
    first, second = tree.children[node]
    if first < 0:
        return [int(tree.leaf[node])]
    return below(tree, first) + below(tree, second)


def visited(tree, box, node=0):
    """Return nodes that a search for hits of a box visits."""
    apart = np.abs(tree.bounds[node, :3] - box[:3]) > tree.bounds[node, 3:] + box[3:]
    if apart.any() or tree.children[node, 0] < 0:
        return 1
    return 1 + sum(visited(tree, box, child) for child in tree.children[node])


@pytest.mark.long
@given(st.integers(1, 40).flatmap(boxes_of))
def test_every_box_is_below_the_root_once_and_within_all_that_is_above_it(boxes):
    tree = BoxTree(boxes)
    assert len(tree.leaf) == 2 * len(boxes) - 1
    assert sorted(below(tree, 0)) == list(range(len(boxes)))
    for node in range(len(tree.leaf)):
        inside = boxes[below(tree, node)]
        low = tree.bounds[node, :3] - tree.bounds[node, 3:]
        high = tree.bounds[node, :3] + tree.bounds[node, 3:]
        np.testing.assert_allclose(low, (inside[:, :3] - inside[:, 3:]).min(axis=0), atol=1e-12)
        np.testing.assert_allclose(high, (inside[:, :3] + inside[:, 3:]).max(axis=0), atol=1e-12)


@given(st.integers(1, 40).flatmap(boxes_of))
def test_nodes_come_before_what_is_below_them(boxes):
    tree = BoxTree(boxes)
    inner = np.flatnonzero(tree.leaf < 0)
    assert (tree.children[inner] > inner[:, None]).all()
    assert tree.depth[0] == 0
    for node in inner:
        assert (tree.depth[tree.children[node]] == tree.depth[node] + 1).all()
    leaves = tree.leaf >= 0
    assert (tree.children[leaves] == -1).all()
    np.testing.assert_array_equal(tree.bounds[leaves], boxes[tree.leaf[leaves]])


def test_endless_boxes_stand_apart_from_all_others():
    rng = np.random.default_rng(0)
    boxes = np.hstack((rng.uniform(-5, 5, (30, 3)), rng.uniform(0.1, 0.5, (30, 3))))
    boxes[[7, 20], 3:] = (1e10, 1e10, 5e9)
    tree = BoxTree(boxes)
    left, right = (sorted(below(tree, child)) for child in tree.children[0])
    assert left == [7, 20]
    assert len(right) == 28


@pytest.mark.parametrize("shape", ["alike", "nested", "in a row"])
def test_no_arrangement_makes_it_deep(shape):
    count = 5000
    boxes = np.zeros((count, 6))
    boxes[:, 3:] = 1.0
    if shape == "nested":
        boxes[:, 3:] = np.geomspace(1e-6, 1e6, count)[:, None]
        boxes[:, 0] = np.geomspace(1e-6, 1e6, count)
    elif shape == "in a row":
        boxes[:, 0] = np.arange(count)
    assert BoxTree(boxes).depth.max() <= 48 + 1 + np.ceil(np.log2(count))


def test_few_boxes_are_visited_in_a_building():
    """Halves along the longest side have walls that span the building in most boxes."""
    rng = np.random.default_rng(1)
    walls = [((x, 0.0, 1.0), (0.1, 20.0, 1.0)) for x in np.linspace(-20.0, 20.0, 6)]
    walls += [((0.0, y, 1.0), (20.0, 0.1, 1.0)) for y in np.linspace(-20.0, 20.0, 6)]
    things = [(rng.uniform(-19, 19, 3) * (1, 1, 0), rng.uniform(0.1, 0.5, 3)) for _ in range(200)]
    boxes = np.array([np.concatenate(each) for each in walls + things])
    tree = BoxTree(boxes)
    counts = [
        visited(tree, np.array([x, y, 0.1, 0.1, 0.1, 0.1]))
        for x, y in rng.uniform(-19.0, 19.0, (200, 2))
    ]
    assert np.mean(counts) < 40.0


def test_no_box_is_no_tree():
    with pytest.raises(ValueError, match="a box tree needs at least one box"):
        BoxTree(np.zeros((0, 6)))
