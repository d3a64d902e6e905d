"""Bags without pictures, seen from above."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.cli.main import main
from gazelle.errors import RosError
from gazelle.viewer.bag_top_view import BagTopView, bag_source
from gazelle.viewer.sources import BagSource, pictures_of
from gazelle_ros import Time, load_message
from gazelle_ros.bags import Bag

SIZE = (200, 150)
RED, BLUE, GREEN, BLACK = (206, 62, 52), (55, 110, 175), (40, 140, 70), (60, 60, 66)


def message(kind, **fields):
    return load_message(kind)(**fields)


def stamped(kind, frame, now, **fields):
    made = message(kind, **fields)
    made.header.frame_id, made.header.stamp = frame, now
    return made


def transform(parent, child, now, x, yaw=0.0):
    made = stamped("geometry_msgs/TransformStamped", parent, now, child_frame_id=child)
    made.transform.translation.x = x
    made.transform.rotation.z, made.transform.rotation.w = np.sin(yaw / 2), np.cos(yaw / 2)
    return message("tf2_msgs/TFMessage", transforms=[made])


def write(path, *, tf=True, grid=True, odometry=True):
    """Write a bag of a robot that drives along x at 1 m/s for 2 s towards a wall at 3 m."""
    with Bag(str(path), "w") as bag:
        if grid:
            cells = np.full((40, 80), -1, np.int8)
            cells[4:36, 4:76] = 0
            cells[4:36, 70] = 100
            made = stamped("nav_msgs/OccupancyGrid", "map", Time(100), data=cells.ravel().tolist())
            made.info.width, made.info.height, made.info.resolution = 80, 40, 0.1
            made.info.origin.position.x, made.info.origin.position.y = -4.0, -2.0
            made.info.origin.orientation.w = 1.0
            bag.write("/map", made, Time(100))
        if tf:
            bag.write("/tf_static", transform("base_link", "laser", Time(100), 0.1), Time(100))
            bag.write("/tf", transform("map", "odom", Time(100), 0.0), Time(100))
        for number in range(11):
            now = Time.from_sec(100.0 + 0.2 * number)
            x = 0.2 * number
            if tf:
                bag.write("/tf", transform("map", "odom", now, 0.0), now)
                bag.write("/tf", transform("odom", "base_link", now, x), now)
            if odometry:
                told = stamped("nav_msgs/Odometry", "odom", now, child_frame_id="base_link")
                told.pose.pose.position.x, told.pose.pose.orientation.w = x, 1.0
                bag.write("/odom", told, now)
            scan = stamped("sensor_msgs/LaserScan", "laser", now, angle_min=-0.1)
            scan.angle_increment, scan.range_min, scan.range_max = 0.1, 0.1, 10.0
            away = 3.0 - x - (0.1 if tf else 0.0)
            scan.ranges = [away / np.cos(0.1), away, away / np.cos(0.1)]
            bag.write("/scan", scan, now)
    return path


def where(picture, colour):
    """Return columns of the pixels that have about a colour."""
    near = np.abs(picture.astype(int) - colour).max(axis=-1) < 25
    return np.flatnonzero(near.any(axis=0))


def metres(view, column):
    """Return x of a column of the small picture."""
    return float(view._frame.middles()[0, 2 * int(column), 0])


def test_scans_robot_and_map_are_where_they_are(tmp_path):
    with BagTopView(write(tmp_path / "drive.bag"), SIZE) as view:
        first = view.render()
        assert metres(view, where(first, RED).mean()) == pytest.approx(3.0, abs=0.1)
        assert metres(view, where(first, BLUE).mean()) == pytest.approx(0.0, abs=0.15)
        assert metres(view, where(first, BLACK).mean()) == pytest.approx(3.05, abs=0.2)
        assert view.advance(1.0)
        assert not view.advance(2.5)
        last = view.render()
        assert metres(view, where(last, RED).mean()) == pytest.approx(3.0, abs=0.1)
        robot = where(last, BLUE)
        assert metres(view, robot.max()) == pytest.approx(2.15, abs=0.15)
        assert metres(view, robot.min()) == pytest.approx(0.0, abs=0.15)  # its way
        assert last.shape == (150, 200, 3)


def test_scans_are_placed_by_odometry_where_there_is_no_tf(tmp_path):
    with BagTopView(write(tmp_path / "drive.bag", tf=False, grid=False), SIZE) as view:
        view.advance(2.0)
        assert metres(view, where(view.render(), RED).mean()) == pytest.approx(3.0, abs=0.1)


def test_a_scanner_without_odometry_leaves_a_way(tmp_path):
    with BagTopView(write(tmp_path / "drive.bag", odometry=False), SIZE) as view:
        view.advance(2.0)
        assert metres(view, where(view.render(), BLUE).max()) == pytest.approx(2.25, abs=0.15)


def test_plans_are_drawn(tmp_path):
    path = stamped("nav_msgs/Path", "map", Time(1))
    for x in (0.0, 2.0):
        pose = stamped("geometry_msgs/PoseStamped", "map", Time(1))
        pose.pose.position.x = x
        path.poses.append(pose)
    with Bag(str(tmp_path / "plan.bag"), "w") as bag:
        bag.write("/plan", path, Time(1))
    with BagTopView(tmp_path / "plan.bag", SIZE) as view:
        drawn = where(view.render(), GREEN)
        assert metres(view, drawn.min()) == pytest.approx(0.0, abs=0.1)
        assert metres(view, drawn.max()) == pytest.approx(2.0, abs=0.1)


def test_a_map_that_is_turned_lies_as_it_should(tmp_path):
    """A quarter turn: what is along its rows goes along y."""
    cells = np.zeros((10, 20), np.int8)
    cells[:, 15] = 100
    made = stamped("nav_msgs/OccupancyGrid", "map", Time(1), data=cells.ravel().tolist())
    made.info.width, made.info.height, made.info.resolution = 20, 10, 0.1
    made.info.origin.orientation.z = made.info.origin.orientation.w = np.sqrt(0.5)
    with Bag(str(tmp_path / "map.bag"), "w") as bag:
        bag.write("/map", made, Time(1))
    with BagTopView(tmp_path / "map.bag", SIZE) as view:
        black = np.abs(view.render().astype(int) - BLACK).max(axis=-1) < 25
        rows, columns = np.nonzero(black)
        places = view._frame.middles()[2 * rows, 2 * columns]
    assert places[:, 1].mean() == pytest.approx(1.55, abs=0.05)
    assert places[:, 0].min() == pytest.approx(-1.0, abs=0.05)


@pytest.mark.long
def test_films_choose_what_there_is_to_see(tmp_path, capsys):
    bag = write(tmp_path / "drive.bag")
    with bag_source(bag) as source:
        assert isinstance(source, BagTopView)
        assert len(list(pictures_of(source, None, 0.5))) == 5
    with pytest.raises(RosError, match="no images on '/said'"):
        bag_source(bag, "/said")
    image = message("sensor_msgs/Image", height=2, width=2, step=6, encoding="rgb8", data=b"x" * 12)
    with Bag(str(bag), "a") as more:
        more.write("/camera", image, Time(101))
    with bag_source(bag) as source:
        assert isinstance(source, BagSource)
    with bag_source(bag, top=True) as source:
        assert isinstance(source, BagTopView)
    out = tmp_path / "drive.gif"
    words = ["film", str(bag), str(out), "--top", "--fps", "4", "--size", "160x120"]
    assert main(words) == 0
    assert "9 pictures" in capsys.readouterr().out
    with Bag(str(tmp_path / "words.bag"), "w") as empty:
        empty.write("/said", message("std_msgs/String", data="x"), Time(1))
    with pytest.raises(RosError, match="nothing that can be seen"):
        bag_source(tmp_path / "words.bag")
