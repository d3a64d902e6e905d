"""Worlds in the plane are drawn from above, without a screen."""

import sys

import numpy as np
import pytest
from PIL import Image

import gazelle
from gazelle import assets
from gazelle.errors import Error, MissingExtraError
from gazelle.simulation import Simulation
from gazelle.stage import stage_of
from gazelle.viewer import TopView, film_plan, take_picture, take_plan

ROOM = """
define robot position ( size [.4 .4 .4] drive "diff"
  ranger ( sensor ( range [0 4] fov 90 samples 46 ) ) )
model ( size [4 .2 1] pose [0 1.5 0 0] )
model ( size [4 .2 1] pose [0 -1.5 0 0] )
robot ( name "r" pose [-1 0 0 0] )
"""


@pytest.fixture
def room(tmp_path):
    file = tmp_path / "room.world"
    file.write_text(ROOM)
    with Simulation(file, "planar") as simulation:
        yield simulation


def test_a_picture_of_a_stage_world_shows_its_robot_and_what_that_sees(room, tmp_path):
    picture = take_plan(room, tmp_path / "room.png", size=(320, 240))
    assert picture.shape == (240, 320, 3)
    assert (np.asarray(Image.open(tmp_path / "room.png")) == picture).all()
    blind = take_plan(room, tmp_path / "blind.png", size=(320, 240), scans=False)
    assert (blind != picture).any()
    blue = (blind[..., 2] > 150) & (blind[..., 0] < 90)
    rows, columns = np.nonzero(blue)
    assert abs(rows.mean() - 120) < 3  # the robot is in the middle, on the left
    assert columns.mean() < 120


def test_a_robot_moves_in_the_picture_and_leaves_a_trail(room):
    view = TopView(room, size=(320, 240), scans=False)
    before = view.render()
    stage_of(room).commands[0, 0, 0] = 1.0
    room.run(2.0)
    with_trail = view.render()
    view.forget()
    without = view.render()
    assert (before != without).any()
    changed = (with_trail != without).any(axis=2)
    columns = np.nonzero(changed)[1]
    assert columns.size
    assert columns.max() - columns.min() > 40


def test_a_film_has_as_many_pictures_as_asked_for(room, tmp_path):
    stage_of(room).commands[0, 0, 0] = 0.5
    assert film_plan(room, tmp_path / "room.gif", 2.0, rate=5.0, speed=2.0) == 6
    assert room.time == pytest.approx(2.0)
    with Image.open(tmp_path / "room.gif") as film:
        assert film.n_frames == 6
        assert film.info["duration"] == 200


def test_an_mp4_is_a_film_that_can_be_read(room, tmp_path):
    av = pytest.importorskip("av", reason="the extra 'film' is not installed")
    stage_of(room).commands[0, 0, 0] = 0.5
    view = TopView(room, size=(161, 121))
    assert film_plan(room, tmp_path / "room.mp4", 2.0, view=view, rate=5.0) == 11
    with av.open(str(tmp_path / "room.mp4")) as film:
        frames = [frame.to_ndarray(format="rgb24") for frame in film.decode(video=0)]
        assert float(film.streams.video[0].average_rate) == pytest.approx(5.0)
    assert len(frames) == 11
    assert frames[0].shape == (122, 162, 3)
    assert np.abs(frames[0].astype(int) - frames[-1]).max() > 60


def test_without_its_extra_an_mp4_says_what_to_install(room, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "av", None)
    with pytest.raises(MissingExtraError) as caught:
        film_plan(room, tmp_path / "room.mp4", 1.0)
    assert "gazelle[film]" in caught.value.hint


def test_worlds_of_the_planar_engine_are_drawn_too_and_keep_their_random_numbers():
    with gazelle.Simulation("turtlebot3_stage_4", engine="planar", nworld=2) as simulation:
        robot = simulation.spawn("turtlebot3_burger", pose=gazelle.Pose(x=-0.7))
        before = simulation.snapshot()
        picture = TopView(simulation, world=1, size=(200, 200)).render()
        assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 5
        assert simulation.snapshot() == before
        assert robot.name in simulation.robots


def test_the_bundled_fleet_is_drawn():
    with Simulation(assets.world("fleet"), "planar") as simulation:
        picture = TopView(simulation, size=(480, 320)).render()
    assert (picture[..., 0] > 200).any()


def test_what_cannot_be_drawn_is_refused(room, tmp_path):
    with gazelle.Simulation("empty") as simulation, pytest.raises(Error, match="in the plane"):
        TopView(simulation)
    for attempt in (
        lambda: take_plan(room, tmp_path / "room.gif"),
        lambda: take_plan(room, tmp_path / "nowhere" / "room.png"),
        lambda: film_plan(room, tmp_path / "room.png", 1.0),
        lambda: film_plan(room, tmp_path / "room.gif", 0.0),
        lambda: TopView(room, world=1),
        lambda: TopView(room, size=(0, 10)),
        lambda: TopView(room, extent=(1.0, 0.0, 0.0, 1.0)),
    ):
        with pytest.raises(Error):
            attempt()
    assert callable(take_picture)
