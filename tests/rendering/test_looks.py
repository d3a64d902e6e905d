"""Colours and pictures that mesh files and materials put on shapes."""

import struct
import zlib

import numpy as np
import pytest

from gazelle.description import (
    Box,
    Light,
    Link,
    Material,
    Mesh,
    Model,
    Plane,
    Pose,
    Scene,
    Sphere,
    Visual,
    World,
)
from gazelle.errors import EngineWarning
from gazelle.formats import collada
from gazelle.formats.mesh import load_mesh, load_mesh_parts
from gazelle.formats.mesh_materials import texture_file
from gazelle.rendering import PinholeLens, Renderer
from gazelle.sensors import look_at

DARK = Light("sun", "directional", direction=(0.0, 0.0, -1.0), diffuse=(0.0, 0.0, 0.0, 1.0))
EVEN = Scene(ambient=(1.0, 1.0, 1.0, 1.0), background=(0.0, 0.0, 0.0, 1.0))
QUARTERS = np.array(
    [[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 0]]], np.uint8
)  # red, green above blue, yellow


def png(path, pixels):
    """Write a picture with nothing but the standard library."""
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    height, width, _ = pixels.shape

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", head)
        + chunk(b"IDAT", zlib.compress(rows))
        + chunk(b"IEND", b"")
    )
    return path


DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_images><image id="img"><init_from>{image}</init_from></image></library_images>
<library_effects>
<effect id="plain"><profile_COMMON><technique sid="c"><lambert>
<diffuse><color>0.2 0.4 0.6 1</color></diffuse></lambert></technique></profile_COMMON></effect>
<effect id="worn"><profile_COMMON>
<newparam sid="s"><surface type="2D"><init_from>img</init_from></surface></newparam>
<newparam sid="p"><sampler2D><source>s</source></sampler2D></newparam>
<technique sid="c"><lambert><diffuse><texture texture="p" texcoord="UV"/></diffuse></lambert>
</technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m1"><instance_effect url="#plain"/></material>
<material id="m2"><instance_effect url="#worn"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="pos"><float_array id="pa" count="18">0 -1 0  0 0 0  0 0 1  0 -1 1  0 1 0  0 1 1
</float_array><technique_common><accessor source="#pa" count="6" stride="3"><param name="X"
type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source>
<source id="uv"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array><technique_common>
<accessor source="#ua" count="4" stride="2"><param name="S" type="float"/><param name="T"
type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#pos"/></vertices>
<triangles material="one" count="2"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 1 2 0 2 3</p></triangles>
<triangles material="two" count="2"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#uv" offset="1"/><p>1 0 4 1 5 2 1 0 5 2 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="sc"><node><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="one" target="#m1"/>
<instance_material symbol="two" target="#m2"/></technique_common></bind_material>
</instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#sc"/></scene></COLLADA>
"""


def dae(folder, image="../materials/textures/quarters.png"):
    path = folder / "model" / "meshes" / "sheet.dae"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(DAE.format(image=image))
    return Mesh("sheet.dae", path)


def seen(geometry, eye, target, *, material=None, lights=(DARK,), pose=Pose()):  # noqa: B008
    visual = Visual("v", geometry=geometry, material=material)
    model = Model("m", links=(Link("l", visuals=(visual,)),), pose=pose)
    world, at = World(models=(model,), lights=lights, scene=EVEN), look_at(eye, target)
    frames = Renderer(world).render(
        PinholeLens(40, 40, 0.6), np.array([at.position]), np.array([at.quaternion])
    )
    return frames.color[0].astype(int), frames.labels[0]


def test_pieces_of_a_mesh_have_the_colours_and_pictures_of_its_file(tmp_path):
    png(tmp_path / "model" / "materials" / "textures" / "quarters.png", QUARTERS)
    mesh = dae(tmp_path)
    # Seen from +x, +y is to the right: the plain half is left, the picture right. Level light
    # from all around is 3/4 on walls.
    color, labels = seen(mesh, (4.0, 0.0, 0.5), (0.0, 0.0, 0.5))
    assert set(np.unique(labels)) == {-1, 0}
    share = 0.75 * 255
    assert color[20, 12] == pytest.approx([0.2 * share, 0.4 * share, 0.6 * share], abs=1)
    upper, lower = 15, 25
    left, right = 23, 31
    for row, column, wanted in (
        (upper, left, (1, 0, 0)),
        (upper, right, (0, 1, 0)),
        (lower, left, (0, 0, 1)),
        (lower, right, (1, 1, 0)),
    ):
        assert list(color[row, column] > share / 2.0) == [bool(each) for each in wanted]


@pytest.mark.parametrize(
    ("whole", "broken"),
    [
        ("<init_from>{image}</init_from>", "<!-- none -->"),
        ('url="#worn"', 'url="#lost"'),
        ('target="#m2"', 'target="#lost"'),
    ],
)
def test_what_wears_a_broken_material_is_there_without_it(whole, broken):
    plain, bare = collada.parse(DAE.replace(whole, broken).encode())
    assert (len(plain[2]), len(bare[2])) == (2, 2)
    assert plain[3].color == (0.2, 0.4, 0.6)
    assert (bare[3].color, bare[3].texture) == (None, "")


def test_a_lamp_beside_lights_a_picture_as_the_sun_does(tmp_path):
    png(tmp_path / "model" / "materials" / "textures" / "quarters.png", QUARTERS)
    mesh = dae(tmp_path)
    bulb = Light("bulb", "point", pose=Pose(4.0, 0.0, 0.5), diffuse=(0.0, 0.0, 0.0, 1.0))
    plain, _ = seen(mesh, (4.0, 0.0, 0.5), (0.0, 0.0, 0.5))
    exact, _ = seen(mesh, (4.0, 0.0, 0.5), (0.0, 0.0, 0.5), lights=(DARK, bulb))
    assert np.abs(plain - exact).max() <= 1


def test_the_material_of_a_visual_goes_before_what_is_in_the_mesh_file(tmp_path):
    png(tmp_path / "model" / "materials" / "textures" / "quarters.png", QUARTERS)
    material = Material(diffuse=(1.0, 0.0, 1.0, 1.0))
    color, labels = seen(dae(tmp_path), (4.0, 0.0, 0.5), (0.0, 0.0, 0.5), material=material)
    assert (color[labels == 0][:, 1] == 0).all()
    assert (color[labels == 0][:, 0] > 180).all()


def test_a_mesh_has_the_same_triangles_with_and_without_looks(tmp_path):
    mesh = Mesh("sheet.dae", dae(tmp_path).path, scale=(2.0, -1.0, 0.5), center_submesh=True)
    whole, parts = load_mesh(mesh), load_mesh_parts(mesh)
    triangles = np.concatenate([part.vertices[part.faces] for part in parts])
    assert np.array_equal(whole.vertices[whole.faces], triangles)
    assert parts[0].material.color == (0.2, 0.4, 0.6)
    assert parts[1].material.uv.shape == (2, 3, 2)


def test_a_picture_that_is_missing_leaves_the_mesh_grey(tmp_path):
    color, labels = seen(dae(tmp_path), (4.0, 0.0, 0.5), (0.0, 0.0, 0.5))
    right = color[labels == 0][-1]
    assert right[0] == right[1] == right[2]


def test_a_picture_that_is_broken_is_told_once(tmp_path):
    path = tmp_path / "model" / "materials" / "textures" / "quarters.png"
    path.parent.mkdir(parents=True)
    path.write_bytes(b"no picture")
    with pytest.warns(EngineWarning, match="is not shown") as told:
        seen(dae(tmp_path), (4.0, 0.0, 0.5), (0.0, 0.0, 0.5))
    assert len(told) == 1


@pytest.mark.parametrize(
    "name",
    [
        "../materials/textures/quarters.png",
        "quarters.png",
        "file:///home/somebody/models/quarters.png",
        "C:\\\\work\\\\quarters.png",
    ],
)
def test_pictures_are_found_where_models_keep_them(tmp_path, name):
    path = png(tmp_path / "model" / "materials" / "textures" / "quarters.png", QUARTERS)
    assert texture_file(dae(tmp_path).path, name) == path


@pytest.mark.parametrize("name", ["", "../../secret.png", "/etc/passwd", "gone.png"])
def test_nothing_outside_of_the_model_is_read(tmp_path, name):
    png(tmp_path / "secret.png", QUARTERS)
    assert texture_file(dae(tmp_path).path, name) is None


def test_planes_and_boxes_show_a_whole_picture_and_round_shapes_its_mean(tmp_path):
    path = png(tmp_path / "quarters.png", QUARTERS)
    material = Material(texture=path)
    color, _ = seen(Plane(size=(1.0, 1.0)), (0.0, 0.0, 2.0), (0.001, 0.0, 0.0), material=material)
    # From above with +x ahead, +y is to the left.
    assert [int(np.argmax(color[row, column])) for row, column in ((8, 32), (8, 8))] != [0, 0]
    assert len({tuple(np.round(color[r, k] / 80.0)) for r in (9, 31) for k in (9, 31)}) == 4
    color, labels = seen(Box((1.0, 1.0, 1.0)), (3.0, 0.0, 0.0), (0.0, 0.0, 0.0), material=material)
    assert len({tuple(np.round(color[r, k] / 80.0)) for r in (15, 25) for k in (15, 25)}) == 4
    color, labels = seen(Sphere(0.5), (3.0, 0.0, 0.0), (0.0, 0.0, 0.0), material=material)
    ball = color[labels == 0]
    assert np.allclose(ball / ball[:, :1], [1.0, 1.0, 0.5], atol=0.03)
