"""Input of octomap_server: map files, and the ground in its clouds."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.octomap import server, static
from gazelle_ros.builtin.octomap.codec import binary_tree, full_tree
from gazelle_ros.builtin.octomap.ground import GroundFilter
from gazelle_ros.builtin.octomap.morton import encode
from gazelle_ros.builtin.octomap.reader import read_octomap
from gazelle_ros.builtin.octomap.saver import write_octomap
from gazelle_ros.builtin.octomap.server import OctomapServer
from gazelle_ros.builtin.octomap.static import StaticOctomap
from gazelle_ros.builtin.octomap.voxels import HitModel, VoxelMap
from gazelle_ros.msgs import octomap_msgs

NEAR = st.sets(st.tuples(*[st.integers(32764, 32771)] * 3), min_size=1, max_size=400)


def cells(keys, seed=0):
    codes = np.sort(encode(np.array(sorted(keys), np.int64)))
    return codes, np.random.default_rng(seed).normal(size=len(codes)).astype(np.float32)


def written(path, data, *, binary):
    tree = octomap_msgs.msg.Octomap(
        binary=binary, id="OcTree", resolution=0.25, data=np.frombuffer(data, np.int8).tolist()
    )
    write_octomap(path, tree)
    return path


@given(NEAR, st.integers(0, 99))
def test_files_are_read_as_they_were_written(tmp_path_factory, keys, seed):
    folder = tmp_path_factory.mktemp("maps")
    codes, values = cells(keys, seed)
    found = read_octomap(written(folder / "a.ot", full_tree(codes, values), binary=False))
    assert (found.resolution, found.codes.tolist()) == (0.25, codes.tolist())
    assert np.array_equal(found.values, values)
    found = read_octomap(written(folder / "a.bt", binary_tree(codes, values >= 0), binary=True))
    assert found.codes.tolist() == codes.tolist()
    assert np.array_equal(found.values, np.where(values >= 0, np.inf, -np.inf))


def test_a_leaf_of_many_cells_becomes_all_of_them(tmp_path):
    keys = np.stack(np.meshgrid(*[np.arange(32768, 32776)] * 3), axis=-1).reshape(-1, 3)
    codes = np.sort(encode(keys))
    data = binary_tree(codes, np.ones(512, np.bool_))
    assert len(data) == 2 * 13
    assert (
        read_octomap(written(tmp_path / "a.bt", data, binary=True)).codes.tolist() == codes.tolist()
    )


HEAD = b"# Octomap OcTree binary file\nid OcTree\nsize 1\nres 0.1\ndata\n"


@pytest.mark.parametrize(
    ("data", "text"),
    [
        (b"", "not a file of OctoMap's OcTree"),
        (HEAD.replace(b"OcTree binary", b"ColorOcTree"), "not a file of OctoMap's OcTree"),
        (HEAD.replace(b"res 0.1", b"res much"), "the head of the map is wrong"),
        (HEAD.replace(b"id OcTree", b"id Tree"), "the head of the map is wrong"),
        (HEAD + b"\x03", "ends in the middle"),
        (HEAD + b"\x03\x00", "ends in the middle"),
        (HEAD + b"\x03\x00" * 17, "inner nodes at depth 16"),
        (HEAD + b"\x02\x00", "and at most 50000000 are read"),
    ],
)
def test_damaged_files_are_errors(tmp_path, data, text):
    path = tmp_path / "a.bt"
    path.write_bytes(data)
    with pytest.raises(RosError, match=text):
        read_octomap(path)


@pytest.mark.parametrize("by_parameter", [True, False])
def test_a_server_begins_with_the_map_of_a_file(make_node, tmp_path, by_parameter):
    codes, values = cells({(32768, 32768, 32770), (32769, 32768, 32770)})
    path = written(tmp_path / "a.ot", full_tree(codes, values), binary=False)
    node = make_node("mapper")
    if by_parameter:
        node.set_param("~map_file", str(path))
    made = OctomapServer(node, *([] if by_parameter else [str(path)]))
    assert made.settings.resolution == made.map.resolution == 0.25
    assert made.map.codes.tolist() == codes.tolist()
    assert np.allclose(
        made.map.values, np.clip(values, math.log(0.12 / 0.88), math.log(0.97 / 0.03))
    )


def test_a_static_server_answers_with_the_map_of_its_file(make_node, tmp_path):
    codes, values = cells({(32768, 32768, 32770), (32769, 32768, 32770)})
    path = written(tmp_path / "a.ot", full_tree(codes, values), binary=False)
    node = make_node("octomap_server_static")
    node.set_param("~frame_id", "odom")
    StaticOctomap(node, str(path))
    kind = octomap_msgs.srv.GetOctomap
    for name, data in (
        ("octomap_binary", binary_tree(codes, values >= 0.0)),
        ("octomap_full", full_tree(codes, values)),
    ):
        found = make_node(f"asks_{name}").client(name, kind).call(kind._request_class(), 30.0).map
        assert (found.header.frame_id, found.resolution, found.id) == ("odom", 0.25, "OcTree")
        assert found.binary == (name == "octomap_binary")
        assert np.array(found.data, np.int8).tobytes() == data
    with pytest.raises(RosError, match="it takes one file"):
        static.main([])


def test_a_server_takes_one_file():
    with pytest.raises(RosError, match="it takes one file at most"):
        server.main(["a.bt", "b.bt"])


def scene(tilt=0.0, height=0.0):
    """Return points of a floor, of a table 0.7 m above it, and of a wall."""
    rng = np.random.default_rng(1)
    floor = np.column_stack((rng.uniform(-2, 2, (600, 2)), np.zeros(600)))
    table = np.column_stack((rng.uniform(0.5, 1.5, (900, 2)), np.full(900, 0.7)))
    wall = np.column_stack((np.full(300, 2.0), rng.uniform(-2, 2, 300), rng.uniform(0.1, 2, 300)))
    points = np.concatenate((floor, table, wall)) + np.array((0.0, 0.0, height))
    cos, sin = math.cos(tilt), math.sin(tilt)
    return points @ np.array([[cos, 0, -sin], [0, 1, 0], [sin, 0, cos]]), len(floor)


@pytest.mark.parametrize("tilt", [0.0, 0.05, -0.1])
def test_the_floor_is_ground_and_a_larger_table_is_not(tilt):
    points, count = scene(tilt)
    found = GroundFilter().ground(points)
    assert found[:count].all()
    assert not found[count : count + 900].any()
    assert found[count + 900 :].mean() < 0.1


def test_a_floor_too_steep_or_too_low_is_no_plane_of_the_ground(caplog):
    steep, _ = scene(0.3)
    near = np.abs(steep[:, 2]) < 0.07
    assert np.array_equal(GroundFilter(angle=0.05).ground(steep), near)
    low, _ = scene(height=-0.3)
    assert np.array_equal(GroundFilter().ground(low), np.abs(low[:, 2]) < 0.07)
    assert "there is no plane of the ground" in caplog.text
    assert not GroundFilter().ground(low[:20]).any()
    assert "20 points is too small" in caplog.text


def test_ground_frees_what_is_before_it_and_is_not_occupied():
    voxels = VoxelMap(0.1, HitModel())
    voxels.insert(np.array([0.05, 0.05, 0.55]), np.zeros((0, 3)), np.array([[0.05, 0.05, 0.05]]))
    assert not voxels.occupied.any()
    assert voxels.centers(~voxels.occupied)[:, 2] == pytest.approx([0.15, 0.25, 0.35, 0.45, 0.55])
