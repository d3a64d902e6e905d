"""Bodies: blocks and bitmaps stretched to a model's size, boundaries."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from stage_samples import SQUARE, draw, read

from gazelle import FormatError, ResolveError
from gazelle.errors import FormatWarning

lengths = st.floats(0.01, 100.0)


def one(folder, text):
    (model,) = read(folder, text).models
    return model


def box(model):
    """Return the box around all of a body: least and greatest x, y, z."""
    corners = [(*point, z) for block in model.blocks for point in block.points for z in block.z]
    if model.bitmap is not None:
        corners += [(*model.bitmap.low, model.bitmap.z[0]), (*model.bitmap.high, model.bitmap.z[1])]
    return np.min(corners, axis=0), np.max(corners, axis=0)


def test_a_model_is_a_box_unless_it_says_otherwise(tmp_path):
    (block,) = one(tmp_path, "model ( size [2 4 3] )").blocks
    assert set(block.points) == {(-1.0, -2.0), (1.0, -2.0), (1.0, 2.0), (-1.0, 2.0)}
    assert block.z == (0.0, 3.0)


@pytest.mark.parametrize("kind", ["ranger", "fiducial", "blobfinder"])
def test_sensors_have_no_body_unless_they_say_so(tmp_path, kind):
    assert one(tmp_path, f"{kind} ( )").blocks == ()
    assert len(one(tmp_path, f"{kind} ( size [1 1 1] block ( {SQUARE} ) )").blocks) == 1


def test_a_model_can_say_that_it_has_none(tmp_path):
    assert one(tmp_path, "model ( noblocks 1 )").blocks == ()
    assert len(one(tmp_path, f"model ( noblocks 1 block ( {SQUARE} ) )").blocks) == 1


def test_blocks_are_stretched_to_the_size_and_centred(tmp_path):
    model = one(tmp_path, f"model ( size [4 4 1] block ( {SQUARE} ) )")
    assert set(model.blocks[0].points) == {(-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0)}


def test_all_blocks_are_stretched_together(tmp_path):
    text = """
    model ( size [4 2 10]
      block ( points 4 point[0] [0 0] point[1] [1 0] point[2] [1 1] point[3] [0 1] z [0 2] )
      block ( points 4 point[0] [1 0] point[1] [2 0] point[2] [2 1] point[3] [1 1] z [2 5] ) )
    """
    model = one(tmp_path, text)
    low, high = box(model)
    assert low.tolist() == [-2.0, -1.0, 0.0]
    assert high.tolist() == [2.0, 1.0, 10.0]
    assert [block.z for block in model.blocks] == [(0.0, 4.0), (4.0, 10.0)]


def test_heights_are_stretched_by_the_height_of_all_blocks_but_not_moved(tmp_path):
    model = one(tmp_path, f"model ( size [1 1 1] block ( {SQUARE} z [2 4] ) )")
    assert model.blocks[0].z == (1.0, 2.0)


@pytest.mark.long
@given(
    points=st.lists(st.tuples(lengths, lengths), min_size=3, max_size=8, unique=True),
    size=st.tuples(lengths, lengths, lengths),
)
def test_a_body_is_as_large_as_its_size(tmp_path_factory, points, size):
    folder = tmp_path_factory.getbasetemp()
    listed = " ".join(f"point[{i}] [{x!r} {y!r}]" for i, (x, y) in enumerate(points))
    block = f"block ( points {len(points)} {listed} )"
    low, high = box(one(folder, f"model ( size [{size[0]!r} {size[1]!r} {size[2]!r}] {block} )"))
    extent = np.ptp(points, axis=0)
    wanted = np.where(extent > 0.0, size[:2], 0.0)
    assert np.allclose((high - low)[:2], wanted, rtol=1e-9)
    assert np.allclose((high + low)[:2], 0.0, atol=1e-9 * max(size))


def test_blocks_of_stage_3_are_understood(tmp_path):
    text = """
    model ( size [2 2 2] blocks 2
      block[0].points 3 block[0].point[0] [0 0] block[0].point[1] [2 0] block[0].point[2] [0 2]
      block[0].z [0 1]
      block[1].points 3 block[1].point[0] [2 2] block[1].point[1] [0 2] block[1].point[2] [2 0]
      block[1].z [1 2] )
    """
    model = one(tmp_path, text)
    assert [len(block.points) for block in model.blocks] == [3, 3]
    assert [block.z for block in model.blocks] == [(0.0, 1.0), (1.0, 2.0)]


def test_a_block_may_have_a_colour_of_its_own(tmp_path):
    model = one(tmp_path, f'model ( block ( {SQUARE} color "blue" ) block ( {SQUARE} ) )')
    assert [block.color for block in model.blocks] == [(0.0, 0.0, 1.0, 1.0), None]


@pytest.mark.parametrize(
    ("block", "said"),
    [
        ("points 2 point[0] [0 0] point[1] [1 1]", "3 points at least"),
        ("", "3 points at least"),
        (f"{SQUARE} z [2 1]", "top of a block is below"),
        ("points 1000000", "more than"),
        (SQUARE.replace("[2 0]", "[2]"), "must have 2 numbers"),
    ],
)
def test_a_block_that_cannot_be_is_refused(tmp_path, block, said):
    with pytest.raises(FormatError, match=said):
        read(tmp_path, f"model ( block ( {block} ) )")


def test_a_wrong_count_of_points_is_said(tmp_path):
    with pytest.warns(FormatWarning, match="'points' is 5, but 4 are given"):
        model = one(tmp_path, f"model ( block ( {SQUARE.replace('points 4', 'points 5')} ) )")
    assert len(model.blocks[0].points) == 4


def test_a_bitmap_is_cut_to_its_walls_and_stretched(tmp_path):
    draw(tmp_path, ["......", ".#....", ".##...", "......"])
    model = one(tmp_path, 'model ( bitmap "map.png" size [4 6 2] )')
    bitmap = model.bitmap
    assert bitmap.cells.tolist() == [[True, True], [True, False]]
    assert (bitmap.low, bitmap.high, bitmap.z) == ((-2.0, -3.0), (2.0, 3.0), (0.0, 2.0))
    assert bitmap.cell_size == (2.0, 3.0)
    assert model.blocks == ()


@pytest.mark.parametrize(("grey", "wall"), [(0, True), (127, True), (128, False), (255, False)])
def test_a_wall_is_a_pixel_not_brighter_than_127(tmp_path, grey, wall):
    Image.fromarray(np.array([[0, grey, 0]], np.uint8)).save(tmp_path / "map.png")
    bitmap = one(tmp_path, 'model ( bitmap "map.png" )').bitmap
    assert bitmap.cells.tolist() == [[True, wall, True]]


def test_only_the_first_channel_counts(tmp_path):
    pixels = np.zeros((1, 3, 3), np.uint8)
    pixels[0, 1] = (255, 0, 0)
    Image.fromarray(pixels).save(tmp_path / "map.png")
    bitmap = one(tmp_path, 'model ( bitmap "map.png" )').bitmap
    assert bitmap.cells.tolist() == [[True, False, True]]


@pytest.mark.parametrize("suffix", ["png", "pgm", "jpg", "bmp", "gif", "ppm"])
def test_any_usual_picture_will_do(tmp_path, suffix):
    pixels = np.full((16, 24), 255, np.uint8)
    pixels[:, :12] = 0
    mode = Image.fromarray(pixels).convert("RGB" if suffix == "ppm" else "L")
    mode.save(tmp_path / f"map.{suffix}")
    cells = one(tmp_path, f'model ( bitmap "map.{suffix}" )').bitmap.cells
    assert cells.shape == (16, 12)
    assert cells.all()


def test_a_boundary_is_four_thin_walls_inside_of_the_box(tmp_path):
    draw(tmp_path, ["#..", "..#"])
    model = one(tmp_path, 'model ( bitmap "map.png" size [4 6 2] boundary 1 )')
    low, high = box(model)
    assert (low.tolist(), high.tolist()) == ([-2.0, -3.0, 0.0], [2.0, 3.0, 2.0])
    assert len(model.blocks) == 4
    widths = [np.ptp(block.points, axis=0).min() for block in model.blocks]
    assert np.allclose(widths, 0.01)
    assert model.boundary


def test_a_picture_is_read_once_for_all_who_use_it(tmp_path):
    draw(tmp_path, ["##"])
    first, second = read(
        tmp_path, 'model ( bitmap "map.png" ) model ( bitmap "map.png" mass 2 )'
    ).models
    assert first.bitmap.cells is second.bitmap.cells
    assert first.bitmap == second.bitmap
    assert hash(first.bitmap) == hash(second.bitmap)


def test_a_picture_may_stand_beside_the_included_file(tmp_path):
    (tmp_path / "sub").mkdir()
    draw(tmp_path / "sub", ["##"])
    (tmp_path / "sub/a.inc").write_text('define wall model ( bitmap "map.png" )')
    assert one(tmp_path, 'include "sub/a.inc"\nwall ( )').bitmap.path == tmp_path / "sub/map.png"


def test_a_missing_picture_is_an_error(tmp_path):
    with pytest.raises(ResolveError) as caught:
        read(tmp_path, '\nmodel ( bitmap "gone.png" )')
    assert (caught.value.line, caught.value.element) == (2, "bitmap")


@pytest.mark.parametrize(
    ("content", "said"),
    [(b"no picture", "this is not a picture"), (b"P5 3 3 255\n\0", "cannot be read")],
)
def test_a_broken_picture_is_an_error_with_the_line(tmp_path, content, said):
    (tmp_path / "map.pgm").write_bytes(content)
    with pytest.raises(FormatError, match=said) as caught:
        read(tmp_path, '\n\nmodel ( bitmap "map.pgm" )')
    assert caught.value.line == 3


def test_a_picture_without_walls_is_an_error(tmp_path):
    draw(tmp_path, ["..", ".."])
    with pytest.raises(FormatError, match="shows no walls"):
        read(tmp_path, 'model ( bitmap "map.png" )')


def test_a_picture_too_large_is_an_error(tmp_path, monkeypatch):
    monkeypatch.setattr("gazelle.formats.picture.MAX_PIXELS", 3)
    draw(tmp_path, ["##", "##"])
    with pytest.raises(FormatError, match="more than 3 pixels"):
        read(tmp_path, 'model ( bitmap "map.png" )')


def test_a_bitmap_without_a_name_is_an_error(tmp_path):
    with pytest.raises(FormatError, match="names no picture"):
        read(tmp_path, 'model ( bitmap "" )')


def test_cells_are_squares_of_the_stretched_picture(tmp_path):
    draw(tmp_path, ["#" * 10] * 5)
    bitmap = one(tmp_path, 'model ( bitmap "map.png" size [5 5 1] )').bitmap
    assert math.isclose(bitmap.cell_size[0], 0.5)
    assert math.isclose(bitmap.cell_size[1], 1.0)
