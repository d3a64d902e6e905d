"""Pictures and films that cannot be are refused before anything is drawn."""

import io
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

from gazelle import Error, Simulation
from gazelle.errors import RosError
from gazelle.viewer import TopView, film, film_files, film_plan, take_picture, take_plan, write_film
from gazelle.viewer.limits import check_picture, picture_count
from gazelle.viewer.plan import PlanFrame
from gazelle.viewer.sources import picture_of, pictures_of

BLACK = np.zeros((4, 6, 3), np.uint8)


@pytest.fixture(scope="module")
def room():
    with Simulation("fleet", "planar", threads=1) as simulation:
        yield simulation


@pytest.mark.parametrize("rate", [0.0, -1.0, 1e-320, 1e-3, 1e4, 1e300, float("nan"), float("inf")])
@pytest.mark.parametrize("name", ["a.gif", "a.mp4"])
def test_rates_of_films_that_cannot_be(tmp_path, name, rate):
    with pytest.raises(Error):
        write_film(tmp_path / name, [BLACK], rate)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("call", [film, film_plan])
@pytest.mark.parametrize(
    "options",
    [
        {"speed": 1e-320},
        {"speed": 1e-9},
        {"speed": 0.0},
        {"rate": 1e-320},
        {"rate": 1e300},
        {"seconds": 1e15},
        {"seconds": float("nan")},
    ],
)
def test_films_with_too_many_pictures_or_none(room, tmp_path, call, options):
    with pytest.raises(Error):
        call(room, tmp_path / "a.gif", **{"seconds": 1.0} | options)
    assert room.time == 0.0
    assert not list(tmp_path.iterdir())


def test_pictures_of_sources_are_limited_too():
    with pytest.raises(Error, match="more than the limit of 10,000,000 pictures"):
        list(pictures_of(SimpleNamespace(render=lambda: BLACK), 1.0, 1e-320))
    assert picture_count(1.0, 0.04) == 25
    assert picture_count(1.0, 1e15) == 1


@pytest.mark.parametrize(
    "other",
    [
        np.zeros((4, 8, 3), np.uint8),
        np.zeros((4, 6, 4), np.uint8),
        np.zeros((4, 6), np.uint8),
        np.zeros((0, 6, 3), np.uint8),
        np.zeros((4, 6, 3)),
        np.float64(1.0),
    ],
)
@pytest.mark.parametrize("name", ["a.gif", "a.mp4"])
def test_pictures_that_are_not_of_one_size_and_of_bytes(tmp_path, name, other):
    with pytest.raises(Error, match="picture"):
        write_film(tmp_path / name, [BLACK, other], 10.0)
    assert not list(tmp_path.iterdir())


def test_the_pixels_of_a_gif_are_limited(tmp_path, monkeypatch):
    monkeypatch.setattr(film_files, "MAX_GIF_PIXELS", 3 * 24)
    assert write_film(tmp_path / "a.gif", [BLACK] * 3, 10.0) == 3
    with pytest.raises(Error, match="limit of 72 pixels in 3 pictures"):
        write_film(tmp_path / "b.gif", [BLACK] * 4, 10.0)


@pytest.mark.parametrize("suffix", ["webp", "jpg", "gif", "mp4"])
def test_sides_that_a_format_cannot_hold(tmp_path, suffix):
    wide = np.zeros((1, 70_000, 3), np.uint8)
    with pytest.raises(Error, match="70000 x 1 pixels"):
        check_picture(wide, tmp_path / f"a.{suffix}")


@pytest.mark.parametrize("size", [(0, 1), (-1, 5), (2**31, 2**31), (10**400, 1), (8192, 8192)])
def test_views_from_above_that_have_too_many_pixels(room, tmp_path, size):
    for attempt in (
        lambda: TopView(room, size=size),
        lambda: take_plan(room, tmp_path / "a.png", size=size),
        lambda: PlanFrame((0.0, 0.0, 1.0, 1.0), size),
    ):
        with pytest.raises(Error):
            attempt()


@pytest.mark.parametrize(
    "options",
    [
        {"eye": (float("nan"), 0.0, 0.0)},
        {"eye": (1.0, 0.0)},
        {"eye": (1.0, 0.0, 0.0), "size": (10**5, 10**5)},
        {"eye": (1.0, 0.0, 0.0), "world": 1},
    ],
)
def test_pictures_from_nowhere(room, tmp_path, options):
    with pytest.raises(Error):
        take_picture(room, tmp_path / "a.png", **options)


def _image(**changed):
    fields = {"encoding": "rgb8", "width": 2, "height": 2, "step": 6, "is_bigendian": 0}
    return SimpleNamespace(**fields | {"data": bytes(12)} | changed)


def _compressed(data):
    return SimpleNamespace(format="png", data=data)


def test_images_of_bags_whose_data_do_not_fit():
    assert picture_of(_image()).shape == (2, 2, 3)
    whole = io.BytesIO()
    Image.fromarray(BLACK).save(whole, "png")
    for message in (
        _image(data=b""),
        _image(step=5, data=bytes(10)),
        _image(width=0),
        _image(height=2**31),
        _compressed(b""),
        _compressed(b"no image"),
        _compressed(whole.getvalue()[:40]),
    ):
        with pytest.raises(RosError):
            picture_of(message)
