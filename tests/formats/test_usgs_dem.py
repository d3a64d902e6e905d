"""Elevation models of the USGS, made here by the standard's table of fields."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image as Picture
from scenes import solid, world

from gazelle import FormatError
from gazelle.description import Heightmap
from gazelle.engines import make_engine
from gazelle.formats.terrain import load_heights
from gazelle.formats.usgs_dem import read_usgs_dem


def fortran(value):
    return f"{value:24.15E}".replace("E", "D")


def head(profiles, dx, dy, unit):
    parts = ["a sheet of nothing".ljust(144)]
    parts += [f"{number:6d}" for number in (1, 1, 1, 10)]  # level, pattern, UTM, zone
    parts += [fortran(0.0)] * 15
    parts += [f"{number:6d}" for number in (2, 2, 4)]
    parts += [fortran(0.0)] * 11  # corners, least and greatest, angle
    parts += [f"{0:6d}", *(f"{each:12.6E}" for each in (dx, dy, unit))]
    parts += [f"{1:6d}{profiles:6d}"]
    return "".join(parts).ljust(1024)


def profile(number, x, y, values, datum=0.0):
    """Return the records of one profile, 146 values in the first and 170 in each further one."""
    text = f"{1:6d}{number:6d}{len(values):6d}{1:6d}"
    text += "".join(fortran(each) for each in (x, y, datum, min(values), max(values)))
    parts = [text + "".join(f"{value:6d}" for value in values[:146])]
    parts += [
        "".join(f"{value:6d}" for value in values[at : at + 170])
        for at in range(146, len(values), 170)
    ]
    return "".join(part.ljust(1024) for part in parts)


def sheet(columns, *, dx=30.0, dy=30.0, unit=1.0, starts=None, datum=0.0, x=500_000.0, y=4e6):
    starts = starts or [0] * len(columns)
    profiles = [
        profile(i + 1, x + i * dx, y + start * dy, list(map(int, values)), datum)
        for i, (values, start) in enumerate(zip(columns, starts, strict=True))
    ]
    return head(len(columns), dx, dy, unit) + "".join(profiles)


def saved(folder, text):
    (folder / "sheet.dem").write_text(text)
    return folder / "sheet.dem"


@settings(max_examples=30, deadline=None)
@given(
    st.integers(0, 2**32 - 1),
    st.integers(2, 7),
    st.sampled_from([2, 9, 145, 146, 147, 316, 317, 490]),
)
def test_it_is_what_was_written(tmp_path_factory, seed, columns, rows):
    values = np.random.default_rng(seed).integers(-400, 4000, (rows, columns))
    path = saved(tmp_path_factory.mktemp("dem"), sheet(values[::-1].T))
    np.testing.assert_array_equal(read_usgs_dem(path), values)


def test_heights_are_those_of_the_tiff_of_the_same(tmp_path):
    values = np.random.default_rng(3).integers(-50, 900, (20, 12))
    Picture.fromarray(values.astype(np.float32)).save(tmp_path / "same.tif")
    size = (30.0, 50.0, 10.0)
    ours = load_heights(Heightmap("s", saved(tmp_path, sheet(values[::-1].T)), size))
    np.testing.assert_allclose(ours, load_heights(Heightmap("t", tmp_path / "same.tif", size)))


def test_profiles_begin_where_they_say_and_the_rest_is_not_known(tmp_path):
    path = saved(tmp_path, sheet([[1, 2], [3, 4, 5], [6]], starts=[1, 0, 2]))
    expected = [[2, 5, 6], [1, 4, np.nan], [np.nan, 3, np.nan]]
    np.testing.assert_array_equal(read_usgs_dem(path), expected)


def test_units_datum_and_voids(tmp_path):
    path = saved(tmp_path, sheet([[10, -32767], [30, -32766]], unit=0.1, datum=100.0))
    np.testing.assert_allclose(read_usgs_dem(path), [[np.nan, np.nan], [101.0, 103.0]])


def test_degrees_and_records_on_lines(tmp_path):
    text = sheet([[1, 2], [3, 4]], dx=8.333e-4, dy=8.333e-4, x=-122.0, y=46.0)
    lines = "\n".join(text[i : i + 1024].rstrip() for i in range(0, len(text), 1024))
    for each in (text, lines + "\n"):
        np.testing.assert_array_equal(read_usgs_dem(saved(tmp_path, each)), [[2, 4], [1, 3]])


def test_a_world_stands_on_it(tmp_path):
    values = np.full((4, 4), 100)
    values[1, 1] = 200
    path = saved(tmp_path, sheet(values))
    ground = solid("ground", Heightmap("sheet.dem", path, (10.0, 10.0, 5.0)), static=True)
    engine = make_engine("mujoco", world(ground))
    assert float(np.ptp(load_heights(ground.links[0].collisions[0].geometry))) == 2.5
    engine.step(10)


GOOD = sheet([[1, 2], [3, 4]])


@pytest.mark.parametrize(
    "text",
    [
        "",
        "?",
        GOOD[:900],
        GOOD[:1500],
        GOOD.replace("3.000000E+01", "0.000000E+00"),
        GOOD.replace("3.000000E+01", "         NAN"),
        GOOD[:858] + "     0     0" + GOOD[870:],
        GOOD[:858] + "     x" + GOOD[864:],
        GOOD[:1036] + "999999" + GOOD[1042:],
        sheet([[1], [2]], x=0.0).replace(fortran(30.0), fortran(1e12)),
    ],
    ids=range(10),
)
def test_damaged_models_are_errors_that_say_what_to_do(tmp_path, text):
    with pytest.raises(FormatError, match="gdal_translate"):
        read_usgs_dem(saved(tmp_path, text))
    with pytest.raises(FormatError, match="No such file"):
        read_usgs_dem(tmp_path / "none.dem")


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_whatever_is_damaged_is_an_error_of_ours(tmp_path_factory, seed):
    chance = np.random.default_rng(seed)
    content = bytearray(sheet(chance.integers(0, 900, (4, 200))).encode())
    for place in chance.integers(0, len(content), 6):
        content[place] = chance.integers(0, 256)
    path = tmp_path_factory.mktemp("dem") / "sheet.dem"
    path.write_bytes(content[: chance.integers(0, len(content) + 1)])
    try:
        assert read_usgs_dem(path).ndim == 2
    except FormatError as error:
        assert str(path) in str(error)  # noqa: PT017  # either may be
