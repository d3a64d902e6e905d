"""The node octomap_server: rays, likelihoods, OctoMap's formats, topics and services."""

from __future__ import annotations

import math
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import Background, until

from gazelle_ros import load_service
from gazelle_ros.base.errors import Error
from gazelle_ros.builtin.octomap import saver
from gazelle_ros.builtin.octomap.codec import binary_tree, full_tree
from gazelle_ros.builtin.octomap.morton import ORIGIN, decode, encode
from gazelle_ros.builtin.octomap.rays import crossed
from gazelle_ros.builtin.octomap.server import OctomapServer
from gazelle_ros.builtin.octomap.voxels import HitModel, VoxelMap
from gazelle_ros.compat.sensor_msgs.point_cloud2 import create_cloud_xyz32, read_points
from gazelle_ros.msgs import (
    geometry_msgs,
    nav_msgs,
    octomap_msgs,
    sensor_msgs,
    std_msgs,
    tf2_msgs,
    visualization_msgs,
)

CLOUD, GRID = sensor_msgs.msg.PointCloud2, nav_msgs.msg.OccupancyGrid
OCTOMAP, CUBES = octomap_msgs.msg.Octomap, visualization_msgs.msg.MarkerArray
PLACE = st.floats(-6.0, 6.0)
KEYS = st.lists(st.tuples(*[st.integers(0, 65535)] * 3), max_size=30)
NEAR = st.sets(st.tuples(*[st.integers(32760, 32775)] * 3), max_size=60)


@given(KEYS)
def test_codes_are_those_of_keys_bit_by_bit(keys):
    array = np.array(keys, np.int64).reshape(-1, 3)
    codes = encode(array)
    wanted = [
        sum((key[axis] >> bit & 1) << 3 * bit + axis for bit in range(16) for axis in range(3))
        for key in keys
    ]
    assert codes.tolist() == wanted
    assert np.array_equal(decode(codes), array)


@given(st.tuples(PLACE, PLACE, PLACE), st.tuples(PLACE, PLACE, PLACE))
def test_a_ray_crosses_the_cells_of_its_points_but_the_last(start, end):
    start, end = np.array(start), np.array(end)
    found = {tuple(each) for each in crossed(start, end[None]).tolist()}
    shares = np.linspace(0.0, 1.0, 4001)[:, None]
    seen = {tuple(each) for each in np.floor(start + shares * (end - start)).astype(int).tolist()}
    last = tuple(np.floor(end).astype(int).tolist())
    missed = seen - {last} - found
    # A sample may lie in a corner that the ray hardly touches, or by rounding beside an edge.
    assert len(missed) <= 2
    for cell in found:
        middle = np.array(cell) + 0.5
        way = end - start
        share = np.clip((middle - start) @ way / max(way @ way, 1e-12), 0.0, 1.0)
        assert np.abs(start + share * way - middle).max() < 1.0
    changes = np.abs(np.floor(end) - np.floor(start)).sum()
    assert len(found) <= changes + 1e-9


def test_many_rays_cross_what_each_of_them_crosses():
    ends = np.random.default_rng(4).uniform(-9.0, 9.0, (50, 3))
    start = np.array([0.3, 0.4, 0.5])
    alone = [crossed(start, each[None]) for each in ends]
    assert np.array_equal(crossed(start, ends), np.unique(np.concatenate(alone), axis=0))
    assert crossed(start, np.zeros((0, 3))).shape == (0, 3)


# Likelihoods ------------------------------------------------------------------------------


def value_at(tree, place):
    key = np.floor(np.array([place]) / tree.resolution).astype(np.int64) + ORIGIN
    (index,) = np.flatnonzero(tree.codes == encode(key)[0]).tolist() or [None]
    return None if index is None else float(tree.values[index])


def test_cells_with_points_become_occupied_and_those_before_them_free():
    tree = VoxelMap(0.1, HitModel())
    origin = np.array([0.05, 0.05, 0.05])
    tree.insert(origin, np.array([[1.05, 0.05, 0.05], [1.06, 0.05, 0.05]]))
    assert value_at(tree, (1.05, 0.05, 0.05)) == pytest.approx(math.log(0.7 / 0.3))
    assert value_at(tree, (0.55, 0.05, 0.05)) == pytest.approx(math.log(0.4 / 0.6))
    assert value_at(tree, (1.15, 0.05, 0.05)) is None
    assert (len(tree.codes), tree.occupied.sum()) == (11, 1)
    for _ in range(20):
        tree.insert(origin, np.array([[1.05, 0.05, 0.05]]))
    assert value_at(tree, (1.05, 0.05, 0.05)) == pytest.approx(math.log(0.97 / 0.03))
    assert value_at(tree, (0.55, 0.05, 0.05)) == pytest.approx(math.log(0.12 / 0.88))


def test_points_beyond_the_range_free_what_is_before_it():
    tree = VoxelMap(0.1, HitModel(max_range=0.52))
    tree.insert(np.array([0.05, 0.05, 0.05]), np.array([[3.05, 0.05, 0.05]]))
    assert not tree.occupied.any()
    assert value_at(tree, (0.55, 0.05, 0.05)) is not None
    assert value_at(tree, (0.65, 0.05, 0.05)) is None


def test_points_nearer_than_the_range_are_left_out():
    tree = VoxelMap(0.1, HitModel(min_range=0.5))
    near, far = [[0.45, 0.05, 0.05]], [[0.05, 1.05, 0.05]]
    tree.insert(np.array([0.05, 0.05, 0.05]), np.array(near + far), np.array(near))
    assert value_at(tree, (0.45, 0.05, 0.05)) is None
    assert value_at(tree, (0.25, 0.05, 0.05)) is None
    assert tree.occupied.sum() == 1


def test_a_cell_alone_is_a_speckle():
    tree = VoxelMap(0.1, HitModel())
    points = np.array([[1.05, 0.05, 0.05], [1.15, 0.15, 0.05], [3.05, 0.05, 0.05]])
    tree.insert(np.array([0.05, 0.05, 2.05]), points)
    assert tree.centers(tree.isolated())[:, 0] == pytest.approx([3.05])


@pytest.mark.parametrize("fields", [{"hit": 0.4}, {"least": 0.5}, {"most": 1.0}])
def test_wrong_probabilities_are_refused(fields):
    with pytest.raises(Error, match="probabilities of a sensor_model"):
        HitModel(**fields)


# Formats ----------------------------------------------------------------------------------


def read_binary(data):
    """Return cells of OctoMap's binary data by its definition: corner, side in cells, and kind."""
    words, found = iter(struct.unpack(f"<{len(data) // 2}H", data)), []

    def node(corner, side):
        word = next(words)
        inner = []
        for child in range(8):
            place = tuple(corner[axis] + side // 2 * (child >> axis & 1) for axis in range(3))
            kind = word >> 2 * child & 3
            if kind == 3:
                inner.append(place)
            elif kind:
                found.append((place, side // 2, kind == 2))
        for place in inner:
            node(place, side // 2)

    node((0, 0, 0), 1 << 16)
    assert next(words, None) is None
    return found


def cells_of(leaves):
    """Return kinds of all cells of the smallest size."""
    return {
        tuple(int(each) for each in np.add(corner, step)): kind
        for corner, side, kind in leaves
        for step in np.ndindex(side, side, side)
    }


def read_full(data):
    """Return the log odds of the leaves of OctoMap's full data, and whether inner nodes have the greatest."""
    nodes, found = struct.iter_unpack("<fB", data), {}

    def node(corner, side):
        value, children = next(nodes)
        if not children:
            found[corner] = value
            return value
        values = []
        for child in range(8):
            if children >> child & 1:
                place = tuple(corner[axis] + side // 2 * (child >> axis & 1) for axis in range(3))
                values.append(node(place, side // 2))
        assert value == max(values)
        return value

    node((0, 0, 0), 1 << 16)
    assert next(nodes, None) is None
    return found


def sorted_cells(keys, seed):
    codes = np.sort(encode(np.array(sorted(keys), np.int64).reshape(-1, 3)))
    values = np.random.default_rng(seed).normal(size=len(codes)).astype(np.float32)
    return codes, values


@given(NEAR.filter(len), st.integers(0, 99))
def test_trees_are_read_as_they_were_written(keys, seed):
    codes, values = sorted_cells(keys, seed)
    places = [tuple(each) for each in decode(codes).tolist()]
    assert cells_of(read_binary(binary_tree(codes, values >= 0.0))) == dict(
        zip(places, (values >= 0.0).tolist(), strict=True)
    )
    assert read_full(full_tree(codes, values)) == dict(zip(places, values.tolist(), strict=True))


def test_eight_cells_of_a_kind_are_one():
    keys = np.stack(np.meshgrid(*[np.arange(32768, 32772)] * 3), axis=-1).reshape(-1, 3)
    codes = np.sort(encode(keys))
    leaves = read_binary(binary_tree(codes, np.ones(64, np.bool_)))
    assert leaves == [((32768, 32768, 32768), 4, True)]


def test_a_tree_without_cells_has_no_data():
    assert binary_tree(np.zeros(0, np.int64), np.zeros(0, np.bool_)) == b""
    assert full_tree(np.zeros(0, np.int64), np.zeros(0, np.float32)) == b""


# The node ---------------------------------------------------------------------------------

WALL = [(1.05, y, z) for y in np.arange(-0.45, 0.5, 0.1) for z in np.arange(0.05, 0.5, 0.1)]


class Mapping:
    """The node, and a camera 0.5 m above the origin of the map that sees a wall."""

    def __init__(self, node, driver):
        self.server = OctomapServer(node)
        self.cloud = driver.advertise("/cloud_in", CLOUD)
        header = std_msgs.msg.Header(frame_id="map")
        link = geometry_msgs.msg.TransformStamped(header=header, child_frame_id="camera")
        link.transform.translation.z, link.transform.rotation.w = 0.05, 1.0
        self.frames = driver.advertise("/tf_static", tf2_msgs.msg.TFMessage, latch=True)
        self.frames.publish(tf2_msgs.msg.TFMessage(transforms=[link]))

    def see(self, until_true):
        seen = create_cloud_xyz32(
            std_msgs.msg.Header(frame_id="camera"), [(x, y, z - 0.05) for x, y, z in WALL]
        )

        def done():
            self.cloud.publish(seen)
            return until_true()

        until(done)


@pytest.fixture
def mapping(make_node):
    running = []

    def start(**parameters):
        node = make_node("mapper")
        for name, value in {"resolution": 0.1, **parameters}.items():
            node.set_param(f"~{name}", value)
        made = Mapping(node, make_node("camera"))
        running.append(Background(made.server.run))
        return made

    yield start
    for each in running:
        each.end()


def test_a_wall_is_published_on_all_topics(mapping, listen):
    made = mapping()
    kinds = {
        "octomap_binary": OCTOMAP, "octomap_full": OCTOMAP, "octomap_point_cloud_centers": CLOUD,
        "projected_map": GRID, "occupied_cells_vis_array": CUBES, "free_cells_vis_array": CUBES,
    }  # fmt: skip
    got = {name: listen(f"/{name}", kind) for name, kind in kinds.items()}
    made.see(lambda: all(got.values()) and len(got["octomap_point_cloud_centers"][-1].data) > 0)
    until(
        lambda: all(each[-1].data if hasattr(each[-1], "data") else True for each in got.values())
    )
    centers = sorted(read_points(got["octomap_point_cloud_centers"][-1]))
    assert np.array(centers) == pytest.approx(np.array(sorted(WALL)), abs=1e-6)
    tree = got["octomap_binary"][-1]
    assert (tree.binary, tree.id, tree.resolution, tree.header.frame_id) == (
        True,
        "OcTree",
        0.1,
        "map",
    )
    cells = cells_of(read_binary(np.array(tree.data, np.int8).tobytes()))
    assert sum(cells.values()) == len(WALL)
    full = read_full(np.array(got["octomap_full"][-1].data, np.int8).tobytes())
    assert {key for key, value in full.items() if value >= 0.0} == {
        k for k, v in cells.items() if v
    }
    grid = got["projected_map"][-1]
    rows = np.array(grid.data).reshape(grid.info.height, grid.info.width)
    assert (rows[:, -1] == 100).all()
    assert rows[grid.info.height // 2, 0] == 0
    assert grid.info.origin.position.x == pytest.approx(0.0)
    until(lambda: got["occupied_cells_vis_array"][-1].markers[16].points)
    marker = got["occupied_cells_vis_array"][-1].markers[16]
    assert (len(marker.points), len(marker.colors), marker.scale.x) == (len(WALL), len(WALL), 0.1)
    assert got["occupied_cells_vis_array"][-1].markers[3].action == marker.DELETE


def test_clouds_that_cannot_be_mapped_in_time_are_left_out(make_node):
    server = OctomapServer(make_node("mapper"))
    for x in range(20):
        server.queue.add(
            create_cloud_xyz32(std_msgs.msg.Header(frame_id="map"), [(1.0, x + 1.0, 0)])
        )
    server.queue.work(server.find, server.use)
    places = server.map.centers(server.map.occupied)
    assert np.unique(places[:, 1].round()).tolist() == [16.0, 17.0, 18.0, 19.0, 20.0]


def test_limits_of_height_and_services(mapping, make_node):
    made = mapping(pointcloud_max_z=0.3, occupancy_min_z=0.11)
    made.see(lambda: len(made.server.map.codes) > 0)
    assert made.server.map.centers(made.server.map.occupied)[:, 2].max() < 0.3
    published = made.server._centers(occupied=True)
    assert published[:, 2].min() == pytest.approx(0.15)
    caller = make_node("caller")

    def call(name, kind, **fields):
        service = load_service(kind)
        return caller.client(name, service).call(service._request_class(**fields))

    tree = call("/octomap_binary", "octomap_msgs/GetOctomap").map
    assert len(tree.data) > 0
    point = geometry_msgs.msg.Point
    box = {"min": point(0.9, -9.0, -9.0), "max": point(1.2, 9.0, 9.0)}
    call("/mapper/clear_bbx", "octomap_msgs/BoundingBoxQuery", **box)
    assert not made.server.map.occupied.any()
    call("/mapper/reset", "std_srvs/Empty")
    assert len(made.server.map.codes) == 0


@pytest.mark.parametrize(
    ("words", "name", "first", "read"),
    [
        ([], "map.bt", "# Octomap OcTree binary file", read_binary),
        (["-f"], "map.ot", "# Octomap OcTree file", read_full),
    ],
)
def test_a_map_is_saved_as_a_file(mapping, master, monkeypatch, tmp_path, words, name, first, read):
    monkeypatch.setenv("ROS_MASTER_URI", master.uri)
    made = mapping()
    made.see(lambda: len(made.server.map.codes) > 0)
    assert saver.main([*words, str(tmp_path / name)]) == 0
    head, _, data = (tmp_path / name).read_bytes().partition(b"data\n")
    lines = head.decode().splitlines()
    assert (lines[0], lines[1], lines[3]) == (first, "id OcTree", "res 0.1")
    leaves = read(data)
    if name == "map.bt":
        assert sum(cells_of(leaves).values()) == len(WALL)
        assert int(lines[2].removeprefix("size ")) == len(leaves) + len(data) // 2
    else:
        assert len(leaves) == len(made.server.map.codes)
        assert int(lines[2].removeprefix("size ")) == len(data) // 5


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ([], "it takes one file"),
        (["map.ot"], "not a name of such a map"),
        (["-f", "a.bt"], "not a name"),
    ],
)
def test_a_wrong_line_of_the_saver_is_an_error(words, text):
    with pytest.raises(Error, match=text):
        saver.main(words)


@pytest.mark.parametrize(
    ("parameters", "text"),
    [
        ({"resolution": 0.0}, "'resolution' must be positive"),
        ({"colored_map": True}, "'colored_map' is not supported"),
        ({"ground_filter/angle": 2.0}, "'angle' of ground_filter must be from 0 to pi/2, not 2.0"),
        ({"map_file": "nowhere.bt"}, "the map cannot be read"),
        ({"sensor_model/hit": 0.2}, "probabilities of a sensor_model"),
        ({"sensor_model": 3}, "'sensor_model' must be a mapping"),
    ],
)
def test_wrong_parameters_are_refused(make_node, parameters, text):
    node = make_node("mapper")
    for name, value in parameters.items():
        node.set_param(f"~{name}", value)
    with pytest.raises(Error, match=text):
        OctomapServer(node)
