"""Meshes come out in metres, in the frame of the description, triangle by triangle."""

from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle import FormatError
from gazelle.description import Mesh, Source
from gazelle.formats import load_mesh, mesh, stl, wavefront

SOURCE = Source("r.urdf", 7, "robot/link/visual/geometry/mesh")


def saved(folder, name, data):
    file = folder / name
    file.write_bytes(data if isinstance(data, bytes) else data.encode())
    return Mesh(name, file, source=SOURCE)


def triangles(data):
    return {tuple(sorted(map(tuple, data.vertices[face].round(6)))) for face in data.faces}


BOX = trimesh.creation.box((1, 2, 3))


def binary_stl(header=b"made by a test"):
    return header.ljust(80) + trimesh.exchange.stl.export_stl(BOX)[80:]


@pytest.mark.parametrize("header", [b"made by a test", b"solid box", b"solid"])
def test_binary_stl_is_told_by_its_length(tmp_path, header):
    data = load_mesh(saved(tmp_path, "b.stl", binary_stl(header)))
    np.testing.assert_allclose(data.bounds, BOX.bounds)
    assert len(data.faces) == 12
    assert len(data.vertices) == 8


def test_text_stl(tmp_path):
    text = trimesh.exchange.stl.export_stl_ascii(BOX)
    data = load_mesh(saved(tmp_path, "b.STL", text))
    assert triangles(data) == triangles(BOX)


def test_obj_with_polygons_negative_indices_and_groups(tmp_path):
    text = "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1 2/2/2 3//3 4\ng b\nf -4 -3 -2\n"
    data = load_mesh(saved(tmp_path, "m.obj", text))
    assert len(data.faces) == 3
    part = Mesh("m.obj", tmp_path / "m.obj", submesh="b")
    assert len(load_mesh(part).faces) == 1


DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="cm" meter="0.01"/><up_axis>{up}</up_axis></asset>
<library_images><image id="i"><init_from>none.png</init_from></image></library_images>
<library_geometries><geometry id="g" name="tri"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 100 0 0 0 200 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node>
<translate>0 0 300</translate><scale>1 1 2</scale>
<node><translate>0 0 50</translate><instance_geometry url="#g"/></node>
<node><translate>100 0 0</translate><instance_geometry url="#g"/></node>
</node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


@pytest.mark.parametrize("up", ["Z_UP", "Y_UP"])
def test_dae_takes_unit_and_nodes_but_not_the_up_axis(tmp_path, up):
    data = load_mesh(saved(tmp_path, "m.dae", DAE.format(up=up)))
    np.testing.assert_allclose(data.bounds, [[0, 0, 3], [2, 2, 4]], atol=1e-12)
    assert len(data.faces) == 2


@pytest.mark.parametrize("metre", ["0", "-1", "inf"])
def test_a_dae_with_an_impossible_unit_is_refused(tmp_path, metre):
    text = DAE.format(up="Z_UP").replace('meter="0.01"', f'meter="{metre}"')
    with pytest.raises(FormatError, match="unit of the COLLADA file must be positive"):
        load_mesh(saved(tmp_path, "m.dae", text))


def test_scale_and_mirror(tmp_path):
    file = saved(tmp_path, "b.stl", binary_stl()).path
    data = load_mesh(Mesh("b.stl", file, scale=(2.0, 1.0, -1.0)))
    np.testing.assert_allclose(data.bounds, [[-1, -1, -1.5], [1, 1, 1.5]])
    volume = trimesh.Trimesh(data.vertices, data.faces, process=False).volume
    assert volume == pytest.approx(12.0)  # positive: faces still look outwards


def test_equal_content_is_read_once(tmp_path, monkeypatch):
    first = saved(tmp_path, "a.stl", binary_stl(b"once"))
    second = saved(tmp_path, "b.stl", binary_stl(b"once"))
    load_mesh(first)
    monkeypatch.setattr(stl, "parse", None)
    assert len(load_mesh(second).faces) == 12


def test_vertices_cannot_be_changed_by_accident(tmp_path):
    data = load_mesh(saved(tmp_path, "b.stl", binary_stl()))
    with pytest.raises(ValueError, match="read-only"):
        data.vertices[0, 0] = 1.0


def test_bounds_are_corners(tmp_path):
    low, high = mesh.bounds(saved(tmp_path, "b.stl", binary_stl()))
    assert (low, high) == ((-0.5, -1.0, -1.5), (0.5, 1.0, 1.5))


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("a.stl", b""),
        ("a.stl", b"rubbish"),
        ("a.stl", b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero"),
        ("a.stl", binary_stl()[:90]),
        ("a.dae", b"<COLLADA>"),
        ("a.dae", b"<COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema'/>"),
        ("a.dae", b"<!DOCTYPE a [<!ENTITY x 'y'>]><COLLADA>&x;</COLLADA>"),
        ("a.obj", b"v 0 0\nf 1 1 1"),
        ("a.obj", b"v 0 0 0\nf 1 2 3"),
        ("a.obj", b"v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3"),
        ("a.xyzzy", b"?"),
    ],
)
def test_broken_meshes_name_the_place_in_the_description(tmp_path, name, data):
    with pytest.raises(FormatError, match=r"a\.[a-z]+' cannot be used") as caught:
        load_mesh(saved(tmp_path, name, data))
    assert (caught.value.file, caught.value.line) == ("r.urdf", 7)
    assert caught.value.element == SOURCE.element


def test_a_mesh_that_was_not_found_is_an_error_when_it_is_needed():
    with pytest.raises(FormatError, match=r"'package://a/b\.stl' was not found") as caught:
        load_mesh(Mesh("package://a/b.stl", None, source=SOURCE))
    assert caught.value.line == 7


def test_an_unknown_submesh_lists_those_that_are_there(tmp_path):
    file = saved(tmp_path, "m.obj", "o arm\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").path
    with pytest.raises(FormatError) as caught:
        load_mesh(Mesh("m.obj", file, submesh="leg"))
    assert caught.value.hint == "there are: arm"


@settings(max_examples=100, deadline=None)
@given(st.binary(max_size=400))
def test_any_bytes_are_a_mesh_or_a_format_error(data):
    for parse in (stl.parse, wavefront.parse):
        try:
            parse(data)
        except FormatError:
            continue


@pytest.mark.corpus
def test_every_mesh_of_the_corpus_agrees_with_trimesh_in_number_of_triangles(corpus):
    files = [f for f in corpus.rglob("*.stl") if f.stat().st_size]
    assert len(files) > 30
    for file in files:
        theirs = trimesh.load_mesh(file, process=False)
        ours = load_mesh(Mesh(file.name, Path(file)))
        assert len(ours.faces) == len(theirs.faces)
        np.testing.assert_allclose(ours.bounds, theirs.bounds, atol=1e-6)
