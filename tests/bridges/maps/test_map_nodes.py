"""``map_server`` and ``map_saver``, started as a launch file starts them."""

from __future__ import annotations

import itertools
import math

import pytest
from ros.graph import until

from gazelle.bridges.navigation.map_messages import grid_message, grid_of_message
from gazelle.bridges.navigation.map_server import read_map
from gazelle.errors import RosError
from gazelle.formats import save_map
from gazelle_ros import load_message, load_service


@pytest.fixture
def write_yaml(tmp_path):
    def run(levels, **settings):
        height, width = len(levels), len(levels[0])
        head = f"P5\n{width} {height}\n255\n".encode()
        (tmp_path / "m.pgm").write_bytes(head + bytes(itertools.chain(*levels)))
        known = {
            "image": "m.pgm",
            "resolution": 0.05,
            "origin": "[-1, -2, 0.5]",
            "negate": 0,
            "occupied_thresh": 0.65,
            "free_thresh": 0.196,
        } | settings
        path = tmp_path / "m.yaml"
        text = "\n".join(f"{key}: {value}" for key, value in known.items() if value is not None)
        path.write_text(text)
        return str(path)

    return run


LEVELS = [[0, 254, 205], [254, 254, 100]]


def test_maps_are_read_from_the_lowest_row(write_yaml):
    grid = read_map(write_yaml(LEVELS))
    assert grid.data.tolist() == [[0, 0, -1], [100, 0, -1]]
    assert (grid.resolution, grid.origin.x, grid.origin.y) == (0.05, -1.0, -2.0)
    assert grid.origin.yaw == pytest.approx(0.5)


def test_maps_have_modes(write_yaml):
    assert read_map(write_yaml(LEVELS, negate=1)).data.tolist() == [[100, 100, -1], [0, 100, 100]]
    scaled = read_map(write_yaml(LEVELS, mode="scale")).data.tolist()
    assert scaled[0] == [0, 0, int(1 + 98 * ((155 / 255 - 0.196) / (0.65 - 0.196)))]
    assert read_map(write_yaml(LEVELS, mode="raw")).data.tolist() == [[-2, -2, 100], [0, -2, -51]]


@pytest.mark.parametrize(
    "settings",
    [
        {"resolution": None},
        {"mode": "odd"},
        {"image": "no.pgm"},
        {"origin": "[1]"},
        {"negate": "x"},
    ],
)
def test_wrong_maps_are_refused(write_yaml, settings):
    path = write_yaml(LEVELS, **settings)
    with pytest.raises(RosError):
        read_map(path)


@pytest.mark.long
def test_maps_are_served(start, make_node, listen, write_yaml):
    path = write_yaml(LEVELS)
    start("map_server", "map_server", path, "_frame_id:=world", "map:=/plan")
    got = listen("/plan", load_message("nav_msgs/OccupancyGrid"))
    info = listen("/map_metadata", load_message("nav_msgs/MapMetaData"))
    until(lambda: got and info)
    assert got[0].header.frame_id == "world"
    assert list(got[0].data) == [0, 0, -1, 100, 0, -1]
    assert (info[0].width, info[0].height) == (3, 2)
    node, service = make_node("caller"), load_service("nav_msgs/GetMap")
    node.wait_for_service("/static_map", 60)
    answer = node.client("/static_map", service).call(service._request_class())
    assert answer.map.data == got[0].data
    assert answer.map.info.origin.orientation.z == pytest.approx(math.sin(0.25))


def test_maps_that_are_saved_read_the_same(write_yaml, tmp_path):
    grid = read_map(write_yaml(LEVELS))
    save_map(grid_of_message(grid_message(grid, "map", 0)), tmp_path / "saved")
    again = read_map(str(tmp_path / "saved.yaml"))
    assert again.data.tolist() == grid.data.tolist()
    assert again.origin.yaw == pytest.approx(grid.origin.yaw)
    assert (tmp_path / "saved.pgm").read_bytes().startswith(b"P5\n# CREATOR")


@pytest.mark.long
def test_another_map_can_be_loaded(start, make_node, write_yaml, listen, tmp_path):
    start("map_server", "map_server", write_yaml(LEVELS))
    got = listen("/map", load_message("nav_msgs/OccupancyGrid"))
    node, service = make_node("caller"), load_service("nav_msgs/LoadMap")
    node.wait_for_service("/change_map", 60)
    save_map(read_map(write_yaml([[0, 0], [254, 205]])), tmp_path / "other")
    client = node.client("/change_map", service)
    answer = client.call(service._request_class(map_url=str(tmp_path / "other.yaml")))
    assert answer.result == answer.RESULT_SUCCESS
    assert list(answer.map.data) == [0, -1, 100, 100]
    until(lambda: got and list(got[-1].data) == [0, -1, 100, 100])
    (tmp_path / "bad.yaml").write_text("image: none.pgm\n")
    (tmp_path / "lost.yaml").write_text(
        "image: none.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n"
        "occupied_thresh: 0.6\nfree_thresh: 0.2\n"
    )
    results = [
        client.call(service._request_class(map_url=str(tmp_path / name))).result
        for name in ("none.yaml", "bad.yaml", "lost.yaml")
    ]
    assert results == [
        answer.RESULT_MAP_DOES_NOT_EXIST,
        answer.RESULT_INVALID_MAP_METADATA,
        answer.RESULT_INVALID_MAP_DATA,
    ]


@pytest.mark.long
def test_a_picture_and_a_resolution_are_a_map_as_of_old(start, listen, write_yaml, tmp_path):
    write_yaml(LEVELS)
    picture = next(path for path in tmp_path.iterdir() if path.suffix in {".pgm", ".png"})
    start("map_server", "map_server", str(picture), "0.5")
    got = listen("/map", load_message("nav_msgs/OccupancyGrid"))
    until(lambda: got)
    assert list(got[0].data) == [0, 0, -1, 100, 0, -1]
    assert got[0].info.resolution == 0.5


@pytest.mark.long
def test_maps_are_saved_from_a_topic(start, make_node, write_yaml, tmp_path):
    message = grid_message(read_map(write_yaml(LEVELS)), "map", 0)
    make_node("slam").advertise("/map", type(message), latch=True).publish(message)
    start("map_server", "map_saver", "-f", "here").wait(60)
    assert (tmp_path / "here.yaml").exists()
