"""STL and OBJ files as programs write them, and as they get damaged on the way."""

import re

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from gazelle import FormatError
from gazelle.formats import stl, wavefront
from gazelle.formats.mesh import load_parts

FACET = (
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
)
SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
BOX = trimesh.creation.box((1, 2, 3))
BINARY = trimesh.exchange.stl.export_stl(BOX)
TEXT = trimesh.exchange.stl.export_stl_ascii(BOX)


def corners(vertices, faces):
    return vertices[faces]


def counted(header, count, tail):
    return header.ljust(80) + count.to_bytes(4, "little") + tail


@pytest.mark.parametrize(
    "data",
    [
        pytest.param(BINARY + b"made by x", id="bytes behind"),
        pytest.param(counted(b"x", 0, BINARY[84:]), id="count never filled in"),
        pytest.param(counted(b"solid x", 0, BINARY[84:]), id="the same, called solid"),
        pytest.param(counted(b"solid x", 12, BINARY[84:] + b"end"), id="solid, bytes behind"),
        pytest.param(TEXT.replace("\n", "\r\n").encode(), id="CRLF"),
        pytest.param(TEXT.replace("\n", "\r").encode(), id="CR"),
        pytest.param(TEXT.replace("\n", " ").encode(), id="one line"),
        pytest.param(("  " + TEXT.upper()).encode(), id="capitals"),
        pytest.param(TEXT.replace("endsolid", "").encode(), id="no endsolid"),
        pytest.param(TEXT.encode() + b"\x1a\x00", id="end of file of DOS"),
        pytest.param(TEXT.replace("solid", "solid vertex 1 2 3", 1).encode(), id="called vertex"),
        pytest.param(
            TEXT.replace("solid", "solid été".encode().decode("latin-1"), 1).encode(), id="name"
        ),
        pytest.param(TEXT.replace("endfacet", "end facet").encode(), id="end facet"),
    ],
)
def test_stl_files_of_all_programs(data):
    np.testing.assert_allclose(corners(*stl.parse(data)), BOX.triangles, atol=1e-6)


def test_several_solids_of_a_text_stl_are_one_mesh():
    vertices, faces = stl.parse(f"solid a\n{FACET}endsolid a\nsolid b\n{FACET}endsolid b".encode())
    assert (len(vertices), len(faces)) == (3, 2)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (BINARY[:400], "12 triangles, there are 6"),
        (BINARY[:100], "12 triangles, there are 0"),
        (b"solid".ljust(80) + BINARY[80:-1], "12 triangles, there are 11"),
        (b"rubbish", "not an STL file"),
        (TEXT.replace("vertex ", "vertex -x ", 1).encode(), "'-x' is not a number"),
        (TEXT.replace("vertex ", "vertex é ", 1).encode(), "is not a number"),
        (b"<html>not found</html>" * 20, "not an STL file"),
        (f"solid x\n{FACET}{FACET[:50]}".encode(), "cut short"),
        (f"solid x\n{FACET}{FACET[:58]}".encode(), "cut short"),
        (f"solid x\n{FACET}{FACET[:68]}".encode(), "cut short"),
        (f"solid x\n{FACET.replace('1 0 0', '1,5 0 0')}endsolid".encode(), "'1,5'"),
        (f"solid x\n{FACET.replace('1 0 0', '1 0')}endsolid".encode(), "'vertex'"),
        (f"solid x\n{FACET.replace('vertex 1 0 0', '')}endsolid".encode(), "three vertices"),
    ],
)
def test_damaged_stl_files_are_errors_that_say_what_to_do(data, message):
    with pytest.raises(FormatError, match=message) as caught:
        stl.parse(data)
    assert "export or download" in caught.value.hint


@pytest.mark.parametrize("kind", ["glb", "ply"])
def test_damaged_files_of_other_kinds_are_errors_in_plain_words(kind, tmp_path):
    data = BOX.export(file_type=kind)
    file = tmp_path / f"a.{kind}"
    for end in range(1, len(data) - 1, max(1, len(data) // 23)):
        file.write_bytes(data[:end])
        with pytest.raises(FormatError) as caught:
            load_parts(file)
        assert caught.value.hint
        assert "Error" not in caught.value.message


@pytest.mark.parametrize(
    ("text", "area"),
    [
        (SQUARE + "f 1 2 3 4", 1.0),
        (SQUARE + "f 1 2 3 # a comment\nf 1 3 4 #", 1.0),
        ("v 9 9 9 # a comment\n" + SQUARE + "f 2 3 4 5", 1.0),
        (SQUARE + "f -4 -3 -2 -1\nv 9 9 9\nv 9 8 9\nv 8 9 9\nf -3 -2 -1", 1.5),
        ("f 1 2 3 4\n" + SQUARE, 1.0),
        ("# made in C:\\models\\\n" + SQUARE + "f 1 2 \\\n3 4", 1.0),
        ((SQUARE + "f 1 2 \\\n3 4").replace("\n", "\r\n"), 1.0),
        ((SQUARE + "f 1 2 3 4").replace(" ", "\t"), 1.0),
        ("  " + (SQUARE + "f 1 2 3 4").replace("\n", "\n  "), 1.0),
        (SQUARE + "f 1 2\nf 1\nf\nf 1 2 3 4", 1.0),
        (SQUARE + "f 1/7/8 2/7 3//8 4", 1.0),
        ("mtllib ../../../etc/passwd\n" + SQUARE + "usemtl a\nf 1 2 3 4", 1.0),
        (SQUARE.replace(" 0\n", " 0 1 0 0\n") + "f 1 2 3 4", 1.0),
    ],
)
def test_obj_files_of_all_programs(text, area):
    total = sum(
        trimesh.triangles.area(corners(vertices, faces)).sum()
        for _, vertices, faces in wavefront.parse(text.encode())
    )
    assert total == pytest.approx(area)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (SQUARE + "f 1 2 7", 5),
        (SQUARE + "f 1 2 3\nf 1 2 99999999999999999999", 6),
        (SQUARE + "f 0 1 2", 5),
        (SQUARE + "f -5 1 2", 5),
        (SQUARE + "# on \\\nf 1 2 3\n\nf 1 \\\n2 9", 8),
        (SQUARE + "f 1 2 a", 5),
        ("v 0,5 0 0\n" + SQUARE, 1),
        (SQUARE + "v 0 0", 5),
    ],
)
def test_damaged_obj_files_are_errors_with_the_line(text, line):
    with pytest.raises(FormatError, match=rf"^line {line} of the OBJ file is wrong: '") as caught:
        wavefront.parse(text.encode())
    assert "export the file again" in caught.value.hint


@pytest.mark.parametrize("kind", ["stl", "obj", "dae", "ply"])
def test_empty_files_and_pointers_of_git_lfs_say_so(tmp_path, kind):
    file = tmp_path / f"a.{kind}"
    pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:" + b"0" * 64 + b"\nsize 9\n"
    for data, message in ((b"", "is empty; export"), (pointer, "Git LFS.*; run 'git lfs pull'")):
        file.write_bytes(data)
        with pytest.raises(FormatError, match=message) as caught:
            load_parts(file)
        assert caught.value.file == str(file)


MESHES = st.integers(1, 12).flatmap(
    lambda count: arrays.arrays(
        np.float32, (count, 3, 3), elements=st.floats(-100, 100, width=32, allow_subnormal=False)
    )
)


@settings(max_examples=60, deadline=None)
@given(MESHES)
def test_triangles_come_in_the_order_of_the_file_as_trimesh_wrote_them(triangles):
    body = trimesh.Trimesh(**trimesh.triangles.to_kwargs(triangles.astype(float)), process=False)
    text = trimesh.exchange.stl.export_stl_ascii(body).encode()
    for data in (trimesh.exchange.stl.export_stl(body), text):
        vertices, faces = stl.parse(data)
        np.testing.assert_array_equal(corners(vertices, faces), triangles)
        assert len(vertices) == len(np.unique(triangles.reshape(-1, 3) + 0.0, axis=0))
    obj = re.sub(r"(?m)^f (.*)$", r"f \1 # t", trimesh.exchange.obj.export_obj(body, digits=17))
    ((_, vertices, faces),) = wavefront.parse(obj.encode())
    np.testing.assert_allclose(corners(vertices, faces), triangles, atol=1e-16)
