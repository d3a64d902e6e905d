"""Octrees of OctoMap: occupied space survives encoding, joining and real OctoMap's own writing."""

import base64
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.errors import FormatError
from gazelle.formats import Octree
from gazelle.formats.octree import joined

DEPTH = 16
CORNER = -(1 << (DEPTH - 1))
RECORDS = {"OcTree": 4, "ColorOcTree": 7}

# Written by OctoMap 1.10 (`OcTree.write`, `writeBinary` of pyoctomap 1.2.2, heads of files cut off): resolution
# 0.1, points every 0.1 m of [0, 0.4] x [-0.4, 0.1] x [0, 0.2], one at (1.05, -2.05, 0.55), and free
# space at (0.85, 0.05, 0.05).
FULL = (
    "g+hYP6CD6Fg/BIPoWD8Eg+hYPwSD6Fg/BIPoWD8Eg+hYPwSD6Fg/BIPoWD8Eg+hYPwSD6Fg/BIPoWD8Fg+hYPwiD6Fg/EIPoWD8I"
    "g+hYP0CD6Fg/AIPoWD8Eg+hYPwSD6Fg/D4PoWD8Ag+hYPwCD6Fg/AIPoWD8Ag+hYPwGD6Fg/AYPoWD8Bg+hYPwGD6Fg/AYPoWD8B"
    "g+hYPwGD6Fg/AYPoWD8Bg+hYPwGD6Fg/AYPoWD8Dg+hYPwGD6Fg/A4PoWD8zg+hYPwCD6Fg/AIPoWD8Ag+hYPwCD6Fg/M4PoWD8A"
    "g+hYPwCD6Fg/AIPoWD8AH5nPvgEfmc++AR+Zz74BH5nPvgA="
)
BINARY = (
    "AMwwADAAMAAwADAAMAAwADAAMAAwADMAwAAAA8AAACAwADAAqgADAAMAAwADAAMAAwADAAMAAwADAAMADwADAA8ACgoKCgMAAwAB"
    "AA=="
)

# A node is True (occupied), False (free), None (unknown), or a list of eight nodes.
leaf = st.sampled_from([True, False, None])
inner = st.recursive(
    st.lists(leaf, min_size=8, max_size=8),
    lambda node: st.lists(leaf | node, min_size=8, max_size=8),
    max_leaves=6,
)


def binary_of(node):
    """Encode as ``writeBinaryData`` does: two bits a child, then the children's own."""
    codes = {None: 0, False: 1, True: 2}
    word = sum(
        (3 if isinstance(child, list) else codes[child]) << (2 * i) for i, child in enumerate(node)
    )
    return struct.pack("<H", word) + b"".join(
        binary_of(child) for child in node if isinstance(child, list)
    )


def full_of(node, kind="OcTree"):
    """Encode as ``writeData`` does: log-odds, colour, a bit for each child, the children."""
    colour = bytes(range(RECORDS[kind] - 4))
    if not isinstance(node, list):
        return struct.pack("<f", 0.85 if node else -0.4) + colour + b"\0"
    bits = sum((child is not None) << i for i, child in enumerate(node))
    head = (
        struct.pack("<f", -3.5) + colour + bytes([bits])
    )  # of what has children it does not count
    return head + b"".join(full_of(child, kind) for child in node if child is not None)


def leaves_of(node, low=(CORNER,) * 3, edge=1 << DEPTH):
    """Return occupied leaves: lower corners and edges, in finest leaves."""
    if not isinstance(node, list):
        return [(*low, edge)] if node else []
    half = edge // 2
    corners = [tuple(at + half * (i >> axis & 1) for axis, at in enumerate(low)) for i in range(8)]
    return [
        each for child, at in zip(node, corners, strict=True) for each in leaves_of(child, at, half)
    ]


def assert_same_space(octree, leaves):
    """Check that cuboids hold each leaf once, and nothing else: volumes add up to the leaves'."""
    middles, edges = octree.cuboids()
    low, high = (middles - edges / 2) / octree.resolution, (middles + edges / 2) / octree.resolution
    for x, y, z, edge in leaves:
        at = np.array([x, y, z])
        inside = (low <= at + 1e-6).all(axis=1) & (high >= at + edge - 1e-6).all(axis=1)
        assert inside.sum() == 1
    volume = float(np.prod(edges / octree.resolution, axis=1).sum())
    assert volume == pytest.approx(float(sum(edge**3 for *_, edge in leaves)), rel=1e-9)
    assert len(middles) <= len(leaves)


@pytest.mark.long
@given(inner, st.sampled_from([0.01, 0.05, 0.3]))
def test_the_binary_form_survives(node, resolution):
    assert_same_space(Octree(resolution, binary_of(node)), leaves_of(node))


@pytest.mark.long
@given(inner, st.sampled_from([*RECORDS]))
def test_the_full_form_survives(node, kind):
    octree = Octree(0.1, full_of(node, kind), binary=False, kind=kind)
    assert_same_space(octree, leaves_of(node))


def test_the_finest_leaf_is_where_octomap_has_it():
    """All steps but the first are to the greater x, y and z: it ends at the origin."""
    deep = [None] * 8
    child = [None] * 7 + [True]
    for _ in range(DEPTH - 2):
        child = [None] * 7 + [child]
    deep[0] = child
    for octree in (Octree(0.1, binary_of(deep)), Octree(0.1, full_of(deep), binary=False)):
        middles, edges = octree.cuboids()
        np.testing.assert_allclose(middles, [[-0.05, -0.05, -0.05]], atol=1e-9)
        np.testing.assert_allclose(edges, [[0.1, 0.1, 0.1]])


@pytest.mark.parametrize(("text", "binary"), [(FULL, False), (BINARY, True)])
def test_what_octomap_itself_wrote(text, binary):
    octree = Octree(0.1, base64.b64decode(text), binary=binary)
    low, high = (octree.cuboids()[0] + side * octree.cuboids()[1] / 2 for side in (-1, 1))
    found = sorted(zip(np.round(low, 6).tolist(), np.round(high, 6).tolist(), strict=True))
    assert found == [([0.0, -0.4, 0.0], [0.4, 0.1, 0.2]), ([1.0, -2.1, 0.5], [1.1, -2.0, 0.6])]


def test_log_odds_of_zero_are_occupied_as_in_octomap():
    for value, occupied in ((0.0, 1), (-0.0, 1), (1e-30, 1), (-1e-30, 0), (np.inf, 1), (np.nan, 0)):
        octree = Octree(0.1, struct.pack("<fB", value, 0), binary=False)
        assert len(octree.cuboids()[0]) == occupied


def test_an_octree_may_be_empty():
    for octree in (Octree(0.1, b"\0\0"), Octree(0.1, struct.pack("<fB", -1.0, 0), binary=False)):
        assert octree.cuboids()[0].shape == octree.cuboids()[1].shape == (0, 3)


def test_a_wall_of_many_leaves_is_one_cuboid():
    places = np.array([(0, y, z) for y in range(40) for z in range(30)], np.int32)
    low, edges = joined(places, np.ones_like(places))
    np.testing.assert_array_equal(low, [[0, 0, 0]])
    np.testing.assert_array_equal(edges, [[1, 40, 30]])


@given(st.sets(st.tuples(*[st.integers(0, 4)] * 3), max_size=60))
def test_joined_cubes_fill_the_same_space(cells):
    places = np.array(sorted(cells), np.int32).reshape(-1, 3)
    low, edges = joined(places, np.ones_like(places))
    count = np.zeros((5, 5, 5), int)
    for (x, y, z), (a, b, c) in zip(low, edges, strict=True):
        count[x : x + a, y : y + b, z : z + c] += 1
    wanted = np.zeros((5, 5, 5), int)
    wanted[tuple(places.T)] = 1
    np.testing.assert_array_equal(count, wanted)


def too_deep():
    return b"\x03\x00" * (DEPTH + 1)


@pytest.mark.parametrize(
    ("octree", "words"),
    [
        (Octree(0.0, b"\x02\0"), "resolution"),
        (Octree(0.1, b"\x02\0", kind="OcTre"), "did you mean 'OcTree'"),
        (Octree(0.1, b""), "at byte 0 is cut short"),
        (Octree(0.1, b"\x03\0\x02"), "at byte 2 is cut short"),
        (Octree(0.1, b"\x02\0\0"), "ends at byte 2"),
        (Octree(0.1, too_deep()), "deeper than 16 levels"),
        (Octree(0.1, struct.pack("<fB", 1.0, 1) * 18, binary=False), "deeper than 16 levels"),
        (Octree(0.1, struct.pack("<f", 1.0), binary=False), "cut short"),
        (Octree(0.1, b"\0" * ((64 << 20) + 1)), "more than 67,108,864"),
    ],
)
def test_damage_is_told(octree, words):
    with pytest.raises(FormatError, match=words):
        octree.cuboids()


def test_a_resolution_that_is_no_number_is_refused():
    with pytest.raises(FormatError, match="'resolution' must be a finite number"):
        Octree(float("nan"), b"\x02\0")


def test_too_many_leaves_are_told():
    def even(levels):
        return b"\xaa\xaa" if levels == 0 else b"\xff\xff" + even(levels - 1) * 8

    assert len(even(7)) < 64 << 20
    with pytest.raises(FormatError, match="more than 2,000,000 occupied leaves"):
        Octree(0.1, even(7)).cuboids()


@given(st.binary(max_size=64), st.booleans(), st.sampled_from([*RECORDS]))
def test_any_bytes_are_read_or_refused(data, binary, kind):
    try:
        middles, edges = Octree(0.1, data, binary=binary, kind=kind).cuboids()
    except FormatError:
        return
    assert (edges > 0).all()
    assert (np.abs(middles) + edges / 2 <= 0.1 * (1 << DEPTH - 1) + 1e-6).all()
