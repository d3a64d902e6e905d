"""Pictures become heights and boxes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image as Picture

from gazelle import FormatError
from gazelle.description import Heightmap, Image, Source
from gazelle.formats.terrain import load_boxes, load_heights, rectangles


def saved(folder, pixels):
    Picture.fromarray(np.asarray(pixels, np.uint8)).save(folder / "p.png")
    return folder / "p.png"


def test_heights_grow_with_brightness_and_rows_with_y(tmp_path):
    file = saved(tmp_path, [[0, 50, 100], [200, 0, 0]])
    heights = load_heights(Heightmap("p.png", file, size=(4.0, 2.0, 3.0)))
    np.testing.assert_allclose(heights, [[3.0, 0, 0], [0, 0.75, 1.5]])


def test_a_negative_height_turns_the_ground_over(tmp_path):
    file = saved(tmp_path, [[0, 50], [100, 200]])
    heights = load_heights(Heightmap("p.png", file, size=(1.0, 1.0, -4.0)))
    np.testing.assert_allclose(heights, [[-1.0, -3.0], [1.0, 0.0]])


def test_black_is_flat(tmp_path):
    assert not load_heights(Heightmap("p", saved(tmp_path, np.zeros((3, 3))))).any()


def test_boxes_stand_where_the_picture_is_dark(tmp_path):
    file = saved(tmp_path, [[255, 255, 0, 0], [255, 255, 0, 0]])
    boxes = load_boxes(Image("p", file, scale=0.5))
    np.testing.assert_allclose(boxes, [[0.5, 0.0, 1.0, 1.0]])
    file = saved(tmp_path, [[0, 255], [255, 255]])
    np.testing.assert_allclose(load_boxes(Image("p", file)), [[-0.5, 0.5, 1, 1]])


def test_granularity_merges_pixels(tmp_path):
    file = saved(tmp_path, [[0, 255, 255, 255], [255, 255, 255, 255]])
    boxes = load_boxes(Image("p", file, granularity=2))
    np.testing.assert_allclose(boxes, [[-1.0, 0.0, 2.0, 2.0]])


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 12), st.integers(1, 12))
def test_rectangles_cover_each_cell_once(seed, height, width):
    cells = np.random.default_rng(seed).random((height, width)) < 0.6
    count = np.zeros(cells.shape, int)
    for left, top, right, bottom in rectangles(cells):
        count[top:bottom, left:right] += 1
    np.testing.assert_array_equal(count, cells)


@pytest.mark.parametrize("shape", [Heightmap, Image])
def test_pictures_that_cannot_be_used_name_the_place(tmp_path, shape):
    source = Source("w.world", 7, "heightmap")
    (tmp_path / "p.png").write_text("no picture")
    load = load_heights if shape is Heightmap else load_boxes
    for path in (None, tmp_path / "p.png", tmp_path / "q.png"):
        with pytest.raises(FormatError) as caught:
            load(shape("p.png", path, source=source))
        assert (caught.value.file, caught.value.line) == ("w.world", 7)


def test_elevation_models_are_refused_with_advice(tmp_path):
    file = tmp_path / "dem.tif"
    Picture.fromarray(np.full((3, 3), 812.5, np.float32)).save(file)
    with pytest.raises(FormatError, match="elevations") as caught:
        load_heights(Heightmap("dem.tif", file))
    assert "grey PNG" in caught.value.hint
