"""Plots of trainings, tables and bags: looked at by their lines, and written as pictures."""

from __future__ import annotations

import csv

import numpy as np
import pytest
from PIL import Image

from gazelle.cli.main import main
from gazelle.viewer.bag_plots import bag_map, bag_paths, bag_series
from gazelle.viewer.plots import read_table
from gazelle_ros import Time, load_message
from gazelle_ros.bags import Bag


@pytest.fixture
def bag(tmp_path):
    """Return a robot that drives a quarter of a circle of 2 m over a map."""
    path = tmp_path / "drive.bag"
    with Bag(str(path), "w") as out:
        grid = load_message("nav_msgs/OccupancyGrid")()
        grid.info.resolution, grid.info.width, grid.info.height = 0.5, 8, 6
        grid.info.origin.position.x, grid.info.origin.orientation.w = -1.0, 1.0
        grid.data = [0] * 47 + [100]
        out.write("/map", grid, Time(10, 0))
        for k in range(11):
            odometry = load_message("nav_msgs/Odometry")()
            angle = k / 10 * np.pi / 2
            odometry.pose.pose.position.x = 2.0 * np.sin(angle)
            odometry.pose.pose.position.y = 2.0 - 2.0 * np.cos(angle)
            odometry.twist.twist.linear.x = 0.1 * k
            out.write("/odom", odometry, Time(10 + k, 0))
    return path


def test_numbers_of_a_bag_are_those_that_were_recorded(bag):
    found = bag_series(bag, ["/odom/twist/twist/linear/x", "/map/data/47"])
    time, speed = found["/odom/twist/twist/linear/x"]
    np.testing.assert_allclose(time, np.arange(11))
    np.testing.assert_allclose(speed, 0.1 * np.arange(11))
    assert found["/map/data/47"][1].tolist() == [100.0]


def test_the_way_and_the_map_of_a_bag(bag):
    (way,) = bag_paths(bag).values()
    np.testing.assert_allclose(np.hypot(way[:, 0], way[:, 1] - 2.0), 2.0)
    grid = bag_map(bag)
    assert grid.data.shape == (6, 8)
    assert grid.data[5, 7] == 100
    assert grid.origin.position[0] == -1.0


@pytest.mark.long
@pytest.mark.parametrize("suffix", ["png", "svg", "pdf"])
def test_a_bag_becomes_a_picture(bag, tmp_path, suffix, capsys):
    out = tmp_path / f"way.{suffix}"
    assert main(["plot", str(bag), str(out)]) == 0
    assert f"wrote {out}" in capsys.readouterr().out
    start = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}[suffix]
    assert out.read_bytes().startswith(start)


@pytest.mark.long
def test_a_wall_of_the_map_is_dark_where_it_is(bag, tmp_path):
    out = tmp_path / "way.png"
    assert main(["plot", str(bag), str(out)]) == 0
    grey = np.asarray(Image.open(out).convert("L"), dtype=float)
    # The one cell is most of what is as dark; the rest is the edges of letters.
    dark = np.argwhere((grey > 55) & (grey < 75))
    top, left = np.median(dark, axis=0) / grey.shape
    assert len(dark) > 2000
    assert top < 0.3
    assert left > 0.5


def test_fields_of_a_bag_are_plotted(bag, tmp_path):
    out = tmp_path / "speed.png"
    words = ["--field", "/odom/twist/twist/linear/x", "--field", "/odom/pose/pose/position/y"]
    assert main(["plot", str(bag), str(out), *words]) == 0
    assert out.stat().st_size > 5000


def test_trainings_are_drawn_side_by_side(tmp_path):
    for name, last in (("a", 0.9), ("b", 0.4)):
        (tmp_path / name).mkdir()
        with (tmp_path / name / "progress.csv").open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["time/steps", "episodes/success_rate", "episodes/return", "train/std"])
            writer.writerows([k * 1000, last * k / 9, 10 * k, ""] for k in range(10))
    assert list(read_table(tmp_path / "a/progress.csv")) == [
        "time/steps",
        "episodes/success_rate",
        "episodes/return",
    ]
    out = tmp_path / "curves.svg"
    assert main(["plot", str(tmp_path / "a"), str(tmp_path / "b"), str(out)]) == 0
    assert "control steps" in out.read_text() or "<path" in out.read_text()


def test_a_training_of_one_update_is_a_point(tmp_path):
    (tmp_path / "progress.csv").write_text("time/steps,episodes/return\n1000,-5.0\n")
    out = tmp_path / "point.png"
    assert main(["plot", str(tmp_path), str(out)]) == 0
    with Image.open(out) as picture:
        colors = np.asarray(picture.convert("RGB"), int)
    assert (colors[..., 2] > colors[..., 0] + 80).sum() > 10


def test_columns_of_a_table(tmp_path):
    (tmp_path / "t.csv").write_text("wall,rtf,note\n0,1.0,a\n1,0.5,b\n")
    assert main(["plot", str(tmp_path / "t.csv"), str(tmp_path / "t.png")]) == 0
    words = ["plot", str(tmp_path / "t.csv"), str(tmp_path / "u.png"), "--field", "rtf"]
    assert main(words) == 0
    assert (tmp_path / "u.png").exists()


@pytest.mark.parametrize(
    "table",
    [
        "time,a$\\frac{$,b/x$^$,b/$_\n0,1,2,3\n1,2,3,4\n",
        "time,a,b\n0,1e308,inf\n1,-1e308,-1e400\n",
        f"{'t' * 5000},{'a' * 5000}\n0,1\n",
    ],
    ids=["formulas", "huge numbers", "long names"],
)
def test_odd_tables_are_plotted(tmp_path, table):
    (tmp_path / "t.csv").write_text(table)
    assert main(["plot", str(tmp_path / "t.csv"), str(tmp_path / "t.png")]) == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["drive.bag", "x.png", "--topic", "/odm"], "did you mean '/odom'?"),
        (["drive.bag", "x.png", "--field", "/odom/twist"], "/odom/twist is not a number"),
        (["drive.bag", "x.png", "--field", "/odom/pos/x"], "there is no 'pos' in it"),
        (["drive.bag", "x.png", "--field", "/speed"], "no topic of the bag"),
        (["drive.bag", "x.gif"], "a plot is written as .png, .svg, .pdf, not as '.gif'"),
        (["t.csv", "x.png", "--field", "rft"], "no column 'rft' of numbers"),
        (["none.csv", "x.png"], "cannot read it"),
        (["words.csv", "x.png"], "there is no column of numbers"),
        (["one.csv", "x.png"], "there is one column of numbers"),
        (["wide.csv", "x.png"], "60 columns are more than the 50"),
    ],
)
def test_what_cannot_be_plotted(bag, tmp_path, words, said, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "t.csv").write_text("wall,rtf\n0,1.0\n1,0.5\n")
    (tmp_path / "words.csv").write_text("a,b\nx,y\n")
    (tmp_path / "one.csv").write_text("a\n1\n")
    (tmp_path / "wide.csv").write_text(
        ",".join(f"c{n}" for n in range(61)) + "\n" + "1," * 60 + "1\n"
    )
    assert main(["plot", *words]) == 1
    assert said in capsys.readouterr().err
    assert not (tmp_path / "x.png").exists()
