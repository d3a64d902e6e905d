"""Assembled clouds against the walls of a room."""

from __future__ import annotations

import math

import numpy as np
import pytest
from ros.graph import Background, until

from gazelle_ros import Time
from gazelle_ros.base.errors import Error
from gazelle_ros.builtin.scans.assembler import (
    PointCloud2Assembler,
    PointCloudAssembler,
    ScanAssembler,
)
from gazelle_ros.clock import SECOND
from gazelle_ros.compat.sensor_msgs.point_cloud2 import create_cloud_xyz32, split_columns
from gazelle_ros.msgs import geometry_msgs, laser_assembler, sensor_msgs, std_msgs

SCAN = sensor_msgs.msg.LaserScan
HALF = np.array([3.0, 2.0])  # of the room [m]
BEAMS = 180
SWEEP_S = 0.1


def place(seconds):
    """Return the laser's pose in the room: a quarter of a circle in two seconds."""
    turn = 0.5 * math.pi * seconds / 2.0
    return 0.8 * math.cos(turn), 0.8 * math.sin(turn), turn


def range_of(x, y, angle):
    """Return the distance to the walls of the room."""
    ahead = np.array([math.cos(angle), math.sin(angle)])
    walls = [
        (math.copysign(half, way) - at) / way
        for half, way, at in zip(HALF, ahead, (x, y), strict=True)
        if way
    ]
    return float(min(walls))


def sweep(seconds, moving=False):
    """Return the scan that begins at a time."""
    step = 2.0 * math.pi / BEAMS
    ranges = []
    for beam in range(BEAMS):
        x, y, turn = place(seconds + (beam * SWEEP_S / BEAMS if moving else 0.0))
        ranges.append(range_of(x, y, turn + beam * step))
    return SCAN(
        header=std_msgs.msg.Header(stamp=Time(nsecs=round(seconds * SECOND)), frame_id="laser"),
        angle_max=(BEAMS - 1) * step,
        angle_increment=step,
        time_increment=SWEEP_S / BEAMS,
        range_min=0.1,
        range_max=10.0,
        ranges=ranges,
        intensities=list(range(BEAMS)),
    )


def from_walls(points):
    """Return how far points are from the walls, the worst one [m]."""
    return float(np.abs((HALF - np.abs(points[:, :2])).min(axis=1)).max())


@pytest.fixture
def assemble(make_node):
    """Return a function that runs an assembler in the room."""
    running = []

    def begin(kind, **parameters):
        node = make_node("assembler")
        for name, value in {"fixed_frame": "room", **parameters}.items():
            node.set_param(f"~{name}", value)
        made = kind(node)
        for stamp in range(0, 2 * SECOND + 1, SECOND // 20):
            x, y, turn = place(stamp / SECOND)
            half = (math.sin(0.5 * turn), math.cos(0.5 * turn))
            made.tree.place("room", "laser", stamp, (x, y, 0.0), (0.0, 0.0, *half))
        running.append(Background(made.run))
        return made

    yield begin
    for each in running:
        each.end()


def ask(node, service, begin, end):
    """Return the cloud of a period [s]."""
    kind = laser_assembler.srv
    kind = kind.AssembleScans2 if service.endswith("2") else kind.AssembleScans
    request = kind._request_class(begin=Time(begin), end=Time(end))
    return node.client(service, kind).call(request).cloud


def points_of(cloud):
    if cloud._type == "sensor_msgs/PointCloud":
        return np.array([(each.x, each.y, each.z) for each in cloud.points]).reshape(-1, 3)
    columns = split_columns(cloud)
    return np.stack([columns[axis].ravel() for axis in "xyz"], axis=-1)


def feed(made, make_node, topic, messages):
    sender = make_node("sender")
    publisher = sender.advertise(topic, type(messages[0]))
    until(lambda: publisher.num_connections)
    for number, each in enumerate(messages):
        publisher.publish(each)
        until(lambda number=number: len(made.history._parts) > number)
    return sender


def test_scans_of_a_moving_laser_are_the_walls_of_the_room(assemble, make_node):
    made = assemble(ScanAssembler)
    node = feed(made, make_node, "scan", [sweep(0.1 * each) for each in range(1, 19)])
    cloud = ask(node, "assemble_scans", 0.0, 10.0)
    points = points_of(cloud)
    assert len(points) == 18 * BEAMS
    assert from_walls(points) < 1e-5
    assert cloud.header.frame_id == "room"
    assert cloud.header.stamp.to_sec() == pytest.approx(1.8)  # that of the last scan
    assert [each.name for each in cloud.channels] == ["intensity", "index"]
    assert list(cloud.channels[0].values) == list(range(BEAMS)) * 18
    # Scans of the same place: each end of a single one is near assembled ends of all others.
    single = points_of(ask(node, "assemble_scans2", 0.95, 1.0))
    assert len(single) == 0  # the end is not part of the period
    single = points_of(ask(node, "assemble_scans2", 0.95, 1.05))
    others = np.concatenate([
        points_of(ask(node, "assemble_scans2", 0.0, 0.95)),
        points_of(ask(node, "assemble_scans2", 1.05, 2.0)),
    ])  # fmt: skip
    assert (len(single), len(others)) == (BEAMS, 17 * BEAMS)
    away = np.linalg.norm(single[:, None] - others, axis=2).min(axis=1)
    assert away.max() < 0.05


@pytest.mark.parametrize(("ignored", "most"), [(False, 1e-3), (True, 0.3)])
def test_beams_of_a_sweep_have_places_of_their_own_times(assemble, make_node, ignored, most):
    made = assemble(ScanAssembler, ignore_laser_skew=ignored)
    node = feed(made, make_node, "scan", [sweep(0.1 * each, moving=True) for each in range(1, 19)])
    cloud = ask(node, "build_cloud", 0.0, 10.0)
    error = from_walls(points_of(cloud))
    assert most / 20.0 < error < most
    names = [each.name for each in cloud.channels]
    assert names == ["intensity", "index", *(("distances", "stamps") if not ignored else ())]
    if not ignored:
        assert max(cloud.channels[3].values) == pytest.approx(SWEEP_S * (BEAMS - 1) / BEAMS)


def test_filters_the_limit_of_scans_and_downsampling(assemble, make_node):
    upper = {"lower_threshold": 0.0, "upper_threshold": 1.5}
    made = assemble(
        ScanAssembler,
        filters=[{"name": "near", "type": "laser_filters/LaserScanRangeFilter", "params": upper}],
        max_scans=5,
        downsample_factor=2,
    )
    scans = [sweep(0.1 * each) for each in range(1, 6)]
    node = feed(made, make_node, "scan", scans)
    points = points_of(ask(node, "assemble_scans", 0.0, 10.0))
    near = [sum(r <= 1.5 for r in scans[number].ranges) for number in (0, 2, 4)]
    assert len(points) == sum(math.ceil(each / 2) for each in near)
    publisher = node.advertise("scan", SCAN)
    until(lambda: publisher.num_connections)
    publisher.publish(sweep(0.6))
    until(lambda: made.history._parts[-1].stamp == 6 * SECOND // 10)
    assert made.history._parts[0].stamp == 2 * SECOND // 10


def test_clouds_of_both_kinds_keep_their_other_values(assemble, make_node):
    header = std_msgs.msg.Header(stamp=Time(1), frame_id="laser")
    ahead = [(1.0, 0.0, 0.5), (2.0, 0.0, 0.5)]
    point, channel = geometry_msgs.msg.Point32, sensor_msgs.msg.ChannelFloat32
    old = sensor_msgs.msg.PointCloud(
        header=header,
        points=[point(*each) for each in ahead],
        channels=[channel("warmth", [7.0, 8.0])],
    )
    x, y, turn = place(1.0)
    there = [
        (x + r * math.cos(turn), y + r * math.sin(turn), pytest.approx(0.5)) for r in (1.0, 2.0)
    ]
    made = assemble(PointCloudAssembler)
    node = feed(made, make_node, "cloud", [old])
    cloud = ask(node, "assemble_scans2", 0.0, 2.0)
    assert points_of(cloud).tolist() == [pytest.approx(each, abs=1e-6) for each in there]
    assert split_columns(cloud)["warmth"].ravel().tolist() == [7.0, 8.0]


def test_clouds_of_today(assemble, make_node):
    header = std_msgs.msg.Header(stamp=Time(1), frame_id="laser")
    made = assemble(PointCloud2Assembler, max_clouds=1)
    node = feed(made, make_node, "cloud", [create_cloud_xyz32(header, [(1.0, 0.0, 0.5)])])
    x, y, turn = place(1.0)
    found = points_of(ask(node, "build_cloud2", 0.0, 2.0))
    assert found.tolist() == [
        pytest.approx([x + math.cos(turn), y + math.sin(turn), 0.5], abs=1e-6)
    ]


def test_what_is_missing_or_wrong_is_said(make_node, caplog):
    node = make_node("assembler")
    with pytest.raises(Error, match="fixed_frame is not set"):
        ScanAssembler(node)
    node.set_param("~fixed_frame", "room")
    node.set_param("~filters", [{"name": "a", "type": "laser_filters/Nothing"}])
    with pytest.raises(Error, match="unknown type"):
        ScanAssembler(node)
    node.set_param("~filters", [])
    node.set_param("~downsample_factor", 0)
    node.set_param("~max_clouds", 3)
    made = ScanAssembler(node)
    assert made.history._every == 1
    assert "'downsample_factor' is at least 1, not 0: 1 is used" in caplog.text
    assert "max_clouds is an unknown parameter" in caplog.text
