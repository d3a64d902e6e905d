"""Pictures become heights and boxes."""

import struct

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


def tiff(folder, values, name="dem.tif", **options):
    Picture.fromarray(np.asarray(values)).save(folder / name, **options)
    return folder / name


def dem(file, height=10.0):
    return load_heights(Heightmap(file.name, file, size=(4.0, 2.0, height)))


@pytest.mark.parametrize("kind", [np.uint8, np.uint16, np.int32, np.float32])
@pytest.mark.parametrize("compression", [None, "tiff_lzw", "tiff_adobe_deflate"])
def test_elevations_keep_their_bits(tmp_path, kind, compression):
    """As Gazebo's: (elevation - lowest) * height / highest, the last row at the least y."""
    values = np.array([[20, 100, 50], [30, 40, 25]], kind)
    values[0, 1] = 250 if kind is np.uint8 else 40_001
    highest = float(values.max())
    options = {} if compression is None else {"compression": compression}
    heights = dem(tiff(tmp_path, values, **options))
    np.testing.assert_allclose(heights, (values[::-1].astype(float) - 20.0) * 10.0 / highest)


def test_nothing_lies_below_the_sea_and_what_is_not_known_is_at_it(tmp_path):
    values = np.array([[-9999.0, np.nan, 4.0], [-1.0, 0.0, 8.0]], np.float32)
    np.testing.assert_allclose(dem(tiff(tmp_path, values)), [[0, 0, 10], [0, 0, 5]])
    overturned = dem(tiff(tmp_path, values), -10.0)
    np.testing.assert_allclose(overturned[:, 2], [-10.0, -5.0])


def test_elevations_that_are_all_the_sea_are_flat(tmp_path):
    assert not dem(tiff(tmp_path, np.zeros((3, 3), np.float32))).any()
    assert not dem(tiff(tmp_path, np.full((3, 3), np.nan, np.float32))).any()


@pytest.mark.parametrize("order", ["<", ">"])
def test_elevations_of_64_bits_are_read(tmp_path, order):
    values = np.array([[1.0, 2.5], [3.25, 5.0]])
    file = tmp_path / "double.TIF"
    file.write_bytes(double_tiff(values, order))
    np.testing.assert_allclose(dem(file), (values[::-1] - 1.0) * 2.0)


def double_tiff(values, order):
    """Return a TIFF file of 64-bit numbers, which Pillow cannot write, in one strip."""
    height, width = values.shape
    tags = {256: width, 257: height, 258: 64, 259: 1, 262: 1, 273: 8, 277: 1, 278: height}
    tags |= {279: values.size * 8, 339: 3}
    head = {"<": b"II", ">": b"MM"}[order] + struct.pack(f"{order}HI", 42, 8 + values.size * 8)
    entries = b"".join(struct.pack(f"{order}HHII", tag, 4, 1, tags[tag]) for tag in sorted(tags))
    strip = values.astype(f"{order}f8").tobytes()
    return head + strip + struct.pack(f"{order}H", len(tags)) + entries + b"\0\0\0\0"


def test_tiff_in_colour_is_no_elevation(tmp_path):
    file = tiff(tmp_path, np.zeros((3, 3, 3), np.uint8))
    with pytest.raises(FormatError, match="one channel, this has 3 channels") as caught:
        dem(file)
    assert "save it as grey" in caught.value.hint
    Picture.new("P", (3, 3)).save(file)
    with pytest.raises(FormatError, match="a palette of colours"):
        dem(file)


@pytest.mark.parametrize("shape", [(1, 1), (1, 5), (5, 1)])
@pytest.mark.parametrize("name", ["dem.tif", "dem.png"])
def test_ground_has_two_heights_along_each_side(tmp_path, shape, name):
    source = Source("w.world", 7, "heightmap")
    file = tiff(tmp_path, np.zeros(shape, np.uint8), name)
    with pytest.raises(FormatError, match=f"has {shape[1]} x {shape[0]} pixels") as caught:
        load_heights(Heightmap(name, file, source=source))
    assert caught.value.line == 7


def test_a_tiff_with_too_many_pixels_is_refused_before_it_is_read(tmp_path, monkeypatch):
    monkeypatch.setattr("gazelle.formats.picture.MAX_PIXELS", 8)
    with pytest.raises(FormatError, match="more than 8 pixels"):
        dem(tiff(tmp_path, np.zeros((3, 3), np.uint16)))


@pytest.mark.filterwarnings("ignore::UserWarning")  # Pillow's
@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_damaged_tiff_files_are_errors_of_ours(tmp_path_factory, seed):
    chance = np.random.default_rng(seed)
    file = tiff(tmp_path_factory.mktemp("dem"), chance.integers(0, 2**16, (9, 9)).astype(np.uint16))
    content = bytearray(file.read_bytes())
    for place in chance.integers(0, len(content), 4):
        content[place] = chance.integers(0, 256)
    file.write_bytes(content[: chance.integers(0, len(content))])
    try:
        assert np.isfinite(dem(file)).all()
    except FormatError as error:
        assert str(file) in str(error)  # noqa: PT017  # either may be


def test_pictures_of_elevations_are_no_boxes(tmp_path):
    file = tiff(tmp_path, np.full((3, 3), 812.5, np.float32))
    with pytest.raises(FormatError, match="elevations") as caught:
        load_boxes(Image("dem.tif", file))
    assert "grey PNG" in caught.value.hint


def grid_text(values, **head):
    rows, columns = values.shape
    head = {
        "ncols": columns,
        "nrows": rows,
        "xllcorner": 7.5,
        "yllcorner": 47,
        "cellsize": 1,
    } | head
    lines = [f"{name} {value}" for name, value in head.items()]
    return "\n".join([*lines, *(" ".join(map(repr, row)) for row in values.tolist()), ""])


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(2, 9), st.integers(2, 9))
def test_a_grid_of_text_is_as_high_as_the_tiff_of_the_same(tmp_path_factory, seed, rows, columns):
    folder = tmp_path_factory.mktemp("grid")
    values = np.random.default_rng(seed).uniform(-20.0, 90.0, (rows, columns)).astype(np.float32)
    wanted = dem(tiff(folder, values))
    (folder / "grid.ASC").write_text(grid_text(values))
    np.testing.assert_allclose(dem(folder / "grid.ASC"), wanted, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("shape", [(2, 2), (5, 5), (1201, 1201), (3601, 1801)])
def test_a_tile_of_srtm_is_as_high_as_the_tiff_of_the_same(tmp_path, shape):
    values = np.random.default_rng(1).integers(-100, 3000, shape).astype(np.int16)
    (tmp_path / "N47E007.hgt").write_bytes(values.astype(">i2").tobytes())
    wanted = dem(tiff(tmp_path, values.astype(np.int32)))
    np.testing.assert_array_equal(dem(tmp_path / "N47E007.hgt"), wanted)


def test_what_is_not_known_is_at_the_sea_in_tiles_and_grids(tmp_path):
    values = np.array([[-32768, 4], [2, 8]], np.int16)
    (tmp_path / "a.hgt").write_bytes(values.astype(">i2").tobytes())
    np.testing.assert_allclose(dem(tmp_path / "a.hgt"), [[2.5, 10.0], [0.0, 5.0]])
    for missing, head in ((-9999, {}), (-1, {"NODATA_value": -1})):
        text = grid_text(np.where(values < -999, missing, values), **head)
        (tmp_path / "a.asc").write_text(text.replace("ncols", "NCOLS"))
        np.testing.assert_allclose(dem(tmp_path / "a.asc"), [[2.5, 10.0], [0.0, 5.0]])


@pytest.mark.parametrize(
    ("name", "data", "said"),
    [
        ("a.hgt", b"", "0 bytes"),
        ("a.hgt", b"123456789", "9 bytes"),
        ("a.hgt", b"123456", "6 bytes"),
        ("a.asc", b"", "'ncols'"),
        ("a.asc", b"ncols 2\n1 2 3 4", "'nrows'"),
        ("a.asc", b"ncols 2 nrows -2 1 2 3 4", "'nrows'"),
        ("a.asc", b"ncols 2 nrows 2 1 2 3", "3 values, expected 2 x 2"),
        ("a.asc", b"ncols 2 nrows 2 1 2 3 x", "not a number"),
        ("a.asc", b"ncols 2 nrows 2 nodata_value x 1 2 3 4", "not a number"),
        ("a.asc", b"ncols 99999999999 nrows 2 1", "'ncols'"),
        ("a.asc", b"\x00\xff\xfe", "'ncols'"),
    ],
)
def test_damaged_elevations_are_errors(tmp_path, name, data, said):
    (tmp_path / name).write_bytes(data)
    with pytest.raises(FormatError, match=said):
        dem(tmp_path / name)


def test_missing_elevations_are_errors(tmp_path):
    for name in ("none.hgt", "none.asc"):
        with pytest.raises(FormatError, match="No such file"):
            dem(tmp_path / name)
