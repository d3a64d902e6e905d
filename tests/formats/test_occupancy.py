"""Maps hold the very values that map_server publishes."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image

from gazelle import Error, FormatError, Pose
from gazelle.errors import FormatWarning, ResolveError
from gazelle.formats import load_map, save_map
from gazelle.formats.occupancy import MapSettings, cells

YAML = """image: {image}
resolution: 0.05
origin: [-1.0, 2.0, 0.5]
negate: {negate}
occupied_thresh: 0.65
free_thresh: 0.196
mode: {mode}
"""


def saved(folder, pixels, *, name="m.png", mode="trinary", negate=0, image_mode=None):
    array = np.asarray(pixels, np.uint8)
    Image.fromarray(array, image_mode).save(folder / name)
    file = folder / "m.yaml"
    file.write_text(YAML.format(image=name, mode=mode, negate=negate))
    return file


def by_the_book(pixel, mode, negate, alpha=None):
    """Return map_server's rule for one grey pixel, written out."""
    average = 255 - pixel if negate else pixel
    if mode == "raw":
        return average if average < 128 else average - 256
    occ = (255 - average) / 255.0
    if occ > 0.65:
        return 100
    if occ < 0.196:
        return 0
    if mode == "trinary" or alpha == 0:
        return -1
    return int(1 + 98 * (occ - 0.196) / (0.65 - 0.196))


@pytest.mark.parametrize("name", ["m.png", "m.pgm", "m.bmp", "m.tif"])
@pytest.mark.parametrize("negate", [0, 1])
@pytest.mark.parametrize("mode", ["trinary", "scale", "raw"])
def test_every_grey_becomes_what_map_server_makes_of_it(tmp_path, mode, negate, name):
    ramp = np.arange(256, dtype=np.uint8).reshape(1, 256)
    found = load_map(saved(tmp_path, ramp, name=name, mode=mode, negate=negate))
    assert found.data.dtype == np.int8
    assert found.data.shape == (1, 256)
    assert found.data[0].tolist() == [by_the_book(i, mode, negate) for i in range(256)]


def test_rows_grow_upwards_from_the_origin(tmp_path):
    found = load_map(saved(tmp_path, [[0, 0, 0], [255, 255, 127]]))
    assert found.data.tolist() == [[0, 0, -1], [100, 100, 100]]
    assert (found.height, found.width) == (2, 3)
    assert found.size == pytest.approx((0.15, 0.1))
    assert found.resolution == 0.05
    assert found.origin == Pose(-1.0, 2.0, yaw=0.5)
    assert found.name == "m"


def test_jpeg_is_read(tmp_path):
    found = load_map(saved(tmp_path, np.zeros((16, 16)), name="m.jpg"))
    assert (found.data == 100).all()


def test_colours_are_averaged(tmp_path):
    found = load_map(saved(tmp_path, [[[0, 0, 255], [255, 255, 200], [30, 30, 30]]]))
    assert found.data.tolist() == [[100, 0, 100]]


def test_transparent_pixels_are_unknown_in_mode_scale(tmp_path):
    pixels = [[[127, 127, 127, 0], [127, 127, 127, 9], [0, 0, 0, 0]]]
    found = load_map(saved(tmp_path, pixels, mode="scale"))
    assert found.data.tolist() == [[-1, by_the_book(127, "scale", 0), 100]]


def test_transparency_counts_as_a_colour_in_mode_trinary(tmp_path):
    found = load_map(saved(tmp_path, [[[0, 0, 0, 255], [255, 255, 255, 0]]]))
    darkness = (255 - 255 / 4) / 255, (255 - 3 * 255 / 4) / 255
    assert found.data.tolist() == [[100 if darkness[0] > 0.65 else -1, -1]]


def test_without_transparency_the_last_byte_serves_for_it():
    settings = MapSettings("", 1.0, (0.0, 0.0, 0.0), False, 0.65, 0.196, "scale")
    pixels = np.array([[[200, 200, 0], [0, 200, 200]]], np.uint8)
    value = int(1 + 98 * ((255 - 400 / 3) / 255 - 0.196) / (0.65 - 0.196))
    assert cells(pixels, settings).tolist() == [[-1, value]]
    assert cells(pixels, settings, blue_first=True).tolist() == [[value, -1]]


def test_deep_and_black_and_white_pictures(tmp_path):
    file = saved(tmp_path, np.zeros((1, 1)))
    Image.fromarray(np.array([[0, 65535, 32768]], np.uint16)).save(tmp_path / "m.png")
    assert load_map(file).data.tolist() == [[100, 0, -1]]
    Image.fromarray(np.array([[0, 255]], np.uint8)).convert("1").save(tmp_path / "m.png")
    assert load_map(file).data.tolist() == [[100, 0]]


def test_pgm_with_comments(tmp_path):
    file = saved(tmp_path, np.zeros((1, 1)), name="m.pgm")
    (tmp_path / "m.pgm").write_bytes(b"P5\n# CREATOR: me 0.05 m/pix\n2 1\n255\n\x00\xfe")
    assert load_map(file).data.tolist() == [[100, 0]]
    (tmp_path / "m.pgm").write_bytes(b"P2 # plain\n2 1\n# more\n255\n0 254\n")
    assert load_map(file).data.tolist() == [[100, 0]]


def test_maps_are_equal_by_content(tmp_path):
    file = saved(tmp_path, [[0, 255]])
    assert load_map(file) == load_map(file)
    assert hash(load_map(file)) == hash(load_map(file))
    other = load_map(file)
    saved(tmp_path, [[0, 0]])
    assert load_map(file) != other


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("resolution: 0.05", "resolution: 0", 2, "greater than zero"),
        ("resolution: 0.05", "resolution: nan", 2, "expected a number in 'resolution'"),
        ("resolution: 0.05", "resolution: [1]", 2, "found several"),
        ("resolution: 0.05", "resolutoin: 0.05", 1, "needs the key 'resolution'"),
        ("[-1.0, 2.0, 0.5]", "[1, 2]", 3, "expected 3 numbers in 'origin'"),
        ("[-1.0, 2.0, 0.5]", "[1, 2, x]", 3, "expected a number in 'origin', found 'x'"),
        ("[-1.0, 2.0, 0.5]", "5", 3, "expected 3 numbers"),
        ("negate: 0", "negate: maybe", 4, "expected 0 or 1"),
        ("mode: trinary", "mode: trinery", 7, "unknown mode 'trinery'; did you mean 'trinary'"),
        ("mode: trinary", "negate: 1", 7, "given twice"),
        ("image: m.png", "image: ''", 1, "must name a file"),
        ("image: m.png", "image: '", 8, "not valid YAML"),
        ("image: m.png", "image: m.yaml", 1, "not a picture"),
    ],
)
def test_errors_name_the_line(tmp_path, old, new, line, message):
    file = saved(tmp_path, [[0]])
    file.write_text(file.read_text().replace(old, new))
    with pytest.raises(FormatError, match=message) as caught:
        load_map(file)
    assert caught.value.file == str(file)
    assert caught.value.line == line


def test_a_missing_picture_is_named(tmp_path):
    file = saved(tmp_path, [[0]])
    (tmp_path / "m.png").unlink()
    with pytest.raises(ResolveError, match=r"'m\.png' is not found") as caught:
        load_map(file)
    assert caught.value.line == 1


def test_pictures_elsewhere_are_not_read(tmp_path):
    file = saved(tmp_path, [[0]])
    file.write_text(file.read_text().replace("m.png", "/etc/passwd"))
    with pytest.raises(ResolveError):
        load_map(file)


def test_unknown_keys_are_named(tmp_path):
    file = saved(tmp_path, [[0]])
    file.write_text(file.read_text() + "typ: x\n")
    with pytest.warns(FormatWarning, match="'typ' is not a key of a map"):
        load_map(file)


def test_thresholds_in_the_wrong_order_are_named(tmp_path):
    file = saved(tmp_path, [[80, 120]])  # between the thresholds
    file.write_text(file.read_text().replace("0.196", "0.9"))
    with pytest.warns(
        FormatWarning, match=r"m.yaml:6: .*free_thresh 0.9 is above occupied_thresh 0.65"
    ):
        found = load_map(file)
    assert found.data.tolist() == [[100, 0]]


@pytest.mark.parametrize("text", ["", "a", "[1, 2]", "[" * 5000, "a: &a [*a]", "\x00", "a: \udcff"])
def test_any_text_is_a_map_or_an_error(tmp_path, text):
    file = tmp_path / "m.yaml"
    file.write_bytes(text.encode(errors="surrogateescape"))
    with pytest.raises(FormatError):
        load_map(file)


@settings(
    max_examples=100, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(st.binary(max_size=200), st.sampled_from(["png", "pgm", "bmp", "jpg"]))
def test_any_bytes_are_a_picture_or_an_error(tmp_path, data, kind):
    file = saved(tmp_path, [[0]])
    magic = {"png": b"\x89PNG\r\n\x1a\n", "pgm": b"P5\n", "bmp": b"BM", "jpg": b"\xff\xd8\xff"}
    (tmp_path / "m.png").write_bytes(magic[kind] + data)
    try:
        load_map(file)
    except Error as error:
        assert error.line == 1  # noqa: PT017


def test_a_billion_pixels_are_refused(tmp_path):
    file = saved(tmp_path, [[0]], name="m.pgm")
    (tmp_path / "m.pgm").write_bytes(b"P5\n40000 40000\n255\n")
    with pytest.raises(FormatError):
        load_map(file)


@pytest.mark.corpus
def test_maps_of_the_corpus(corpus):
    broken = {"invalid_image.yaml"}
    files = [f for f in corpus.rglob("*.yaml") if "occupied_thresh:" in f.read_text()]
    assert len(files) > 10
    for file in files:
        named = file.read_text().partition("image:")[2].split()[0].strip("\"'")
        if file.name in broken or not (file.parent / named).is_file():
            with pytest.raises(FormatError):
                load_map(file)
            continue
        found = load_map(file)
        assert set(np.unique(found.data)) <= {-1, 0, 100}
        assert (found.data == 0).any()


@pytest.mark.corpus
def test_the_same_map_in_three_kinds_of_picture(corpus, tmp_path):
    folder = corpus / "ros-navigation__navigation2/nav2_map_server/test"
    text = (folder / "testmap.yaml").read_text()
    maps = []
    for kind in ("png", "pgm", "bmp"):
        (tmp_path / f"testmap.{kind}").write_bytes((folder / f"testmap.{kind}").read_bytes())
        (tmp_path / "m.yaml").write_text(text.replace("testmap.png", f"testmap.{kind}"))
        maps.append(load_map(tmp_path / "m.yaml"))
    assert maps[0] == maps[1] == maps[2]
    # the figures of map_server's own test of this map
    assert (maps[0].width, maps[0].height) == (10, 10)
    assert maps[0].data[0, 0] in {0, 100}
    assert maps[0].origin.is_close(Pose(2.0, 3.0, yaw=1.0))
    assert math.isclose(maps[0].resolution, 0.1)


@pytest.mark.parametrize("name", ["{a", "a: b", "- a", "'", "#a", "é\u2028", "yes", "1", "a" * 200])
def test_a_map_of_any_name_is_read_again(tmp_path, name):
    file = saved(tmp_path, [[0, 255]])
    settings_file, _ = save_map(load_map(file), tmp_path / name)
    assert load_map(settings_file).width == 2


@pytest.mark.parametrize("name", ["\udcff", "\x00", "a" * 300])
def test_a_name_that_no_map_can_have(tmp_path, name):
    grid = load_map(saved(tmp_path, [[0, 255]]))
    with pytest.raises(FormatError, match="'name' must be"):
        save_map(grid, tmp_path / name)


@pytest.mark.parametrize("name", ["..", ".", "../..", "folder/", ".yaml"])
def test_a_folder_is_no_name_of_a_map(tmp_path, monkeypatch, name):
    grid = load_map(saved(tmp_path, [[0, 255]]))
    monkeypatch.chdir(tmp_path)
    with pytest.raises(FormatError, match="this is a folder"):
        save_map(grid, name)
