"""Looks from material scripts, OBJ and glTF files, and what lets see through."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from gazelle import formats
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
from gazelle.formats.mesh import load_mesh, load_mesh_parts
from gazelle.formats.ogre import parse_scripts
from gazelle.formats.wavefront_materials import parse_library
from gazelle.rendering import PinholeLens, Renderer
from gazelle.sensors import look_at

# Upright surfaces get three quarters of the light from all around, and so all of this one.
DARK = Light("sun", "directional", direction=(0.0, 0.0, -1.0), diffuse=(0.0, 0.0, 0.0, 1.0))
EVEN = Scene(ambient=(*[4.0 / 3.0] * 3, 1.0), background=(0.0, 0.0, 0.0, 1.0))
LENS = PinholeLens(40, 40, 0.8)
EYE = look_at((-3.0, 0.0, 0.0), (0.0, 0.0, 0.0))
SCRIPT = """
// beer, as a student writes it
material Beer/Base
{
  technique { pass {
    ambient 0.1 0.2 0.3
    diffuse 1 0.5 0.25 0.4  /* a comment
    over two lines */
    specular 0.9 0.8 0.7 1.0 30
    emissive 0.01 0.02 0.03
    scene_blend alpha_blend
    texture_unit { texture "beer one.png" scale 0.5 0.5
      texture beer.png
    }
  } }
}
material Beer/Diffuse : Beer/Base
{
  technique
  {
    pass
    {
      scene_blend replace
      diffuse vertexcolour
      set $grey 0.5
      texture_unit
      {
        texture other.png
      }
    }
  }
}
material Plain { set $shade 0.25
technique { pass { diffuse $shade $shade $shade 1 } } }
"""


def seen(models, want=("color",), eye=EYE, scene=EVEN):
    world = World("w", models=tuple(models), lights=(DARK,), scene=scene)
    return Renderer(world).render(
        LENS, np.array([eye.position]), np.array([eye.quaternion]), want=want
    )


def board(x, *, size=4.0, **look):
    """Return a square across the view, x before the origin."""
    visual = Visual("v", geometry=Box((0.02, size, size)), **look)
    return Model(f"at{x}", pose=Pose(x), links=(Link("link", visuals=(visual,)),))


def colored(*color):
    return Material(ambient=(*color, 1.0), diffuse=(*color, 1.0))


# Material scripts ------------------------------------------------------------------------------


def test_scripts_are_read_with_what_they_build_on():
    found = parse_scripts(SCRIPT)
    base = found["Beer/Base"]
    assert base.ambient == (0.1, 0.2, 0.3, 1.0)
    assert base.diffuse == (1.0, 0.5, 0.25, 0.4)
    assert base.specular == (0.9, 0.8, 0.7, 1.0)
    assert base.emissive == (0.01, 0.02, 0.03, 1.0)
    assert base.blended
    assert base.texture == "beer.png"
    other = found["Beer/Diffuse"]
    assert (other.diffuse, other.texture, other.blended) == (base.diffuse, "other.png", False)
    assert found["Plain"].diffuse == (0.25, 0.25, 0.25, 1.0)


@settings(max_examples=60)
@given(st.text(st.sampled_from('material technique pass{}\n :"/*0.5 texture_unit $'), max_size=200))
def test_no_script_breaks_the_reader(text):
    parse_scripts(text)
    parse_library(text)


@pytest.fixture
def model_folder(tmp_path, monkeypatch):
    """Return a model as Gazebo's database has it, with a script and its picture."""
    folder = tmp_path / "sign"
    (folder / "materials/scripts").mkdir(parents=True)
    (folder / "materials/textures").mkdir()
    Image.new("RGB", (4, 4), (200, 40, 20)).save(folder / "materials/textures/sign.png")
    (folder / "materials/scripts/sign.material").write_text(
        "material Sign/Face { technique { pass { texture_unit { texture sign.png } } } }\n"
        "material Sign/Glass { technique { pass { scene_blend alpha_blend\n"
        "diffuse 0 0 1 0.5\n} } }\n"
    )
    (folder / "model.config").write_text(
        "<model><name>sign</name><sdf version='1.7'>model.sdf</sdf></model>"
    )
    monkeypatch.setenv("GAZEBO_MODEL_PATH", str(tmp_path))
    return folder


def sdf_of(material):
    return (
        "<sdf version='1.7'><model name='sign'><static>true</static><link name='l'>"
        "<visual name='v'><geometry><box><size>0.02 4 4</size></box></geometry>"
        f"<material><script><uri>model://sign/materials/scripts</uri>"
        f"<uri>model://sign/materials/textures</uri><name>{material}</name></script></material>"
        "</visual></link></model></sdf>"
    )


def test_a_script_puts_its_picture_on_a_box(model_folder):
    (model_folder / "model.sdf").write_text(sdf_of("Sign/Face"))
    model = formats.load_model(model_folder / "model.sdf")
    material = model.links[0].visuals[0].material
    assert material.diffuse is None  # what the file says stays what it says
    color = seen([model]).color[0]
    assert color[20, 20].tolist() == [200, 40, 20]


def test_a_script_lets_see_through(model_folder):
    (model_folder / "model.sdf").write_text(sdf_of("Sign/Glass"))
    glass = formats.load_model(model_folder / "model.sdf")
    color = seen([glass, board(2.0, material=colored(1.0, 0.0, 0.0), size=20.0)]).color[0]
    np.testing.assert_allclose(color[20, 20], [128, 0, 128], atol=1)


def test_a_script_that_is_not_there_changes_nothing(model_folder):
    (model_folder / "model.sdf").write_text(sdf_of("Sign/None"))
    color = seen([formats.load_model(model_folder / "model.sdf")]).color[0]
    assert np.ptp(color[20, 20]) == 0


# OBJ and glTF ------------------------------------------------------------------------------------

OBJ = """mtllib looks.mtl
v 0 -1 -1
v 0 0 -1
v 0 0 1
v 0 -1 1
v 0 1 -1
v 0 1 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
o board
usemtl red  # a comment
f 1 2 3 4
usemtl worn
f 2/1 5/2 6/3 3/4
"""
MTL = """# looks
newmtl red
Kd 0.8 0.1 0.1
d 1.0
newmtl worn
Ka 1 1 1
map_Kd -s 1 1 1 -blendu on picture with spaces.png
newmtl clear
Kd 0 0 1
Tr 0.75
"""


@pytest.fixture
def painted_obj(tmp_path):
    folder = tmp_path / "model/meshes"
    folder.mkdir(parents=True)
    (folder / "board.obj").write_text(OBJ)
    (folder / "looks.mtl").write_text(MTL)
    Image.new("RGB", (8, 8), (10, 220, 30)).save(folder / "picture with spaces.png")
    return Mesh("board", path=folder / "board.obj")


def mesh_model(mesh, **visual):
    link = Link("link", visuals=(Visual("v", geometry=mesh, **visual),))
    return Model("mesh", links=(link,))


def test_an_obj_file_wears_its_materials(painted_obj):
    parts = load_mesh_parts(painted_obj)
    assert sorted(part.material.texture for part in parts) == ["", "picture with spaces.png"]
    assert {part.name for part in parts} == {"board"}
    color = seen([mesh_model(painted_obj)]).color[0]
    # The camera looks along x: y is to the left.
    assert color[20, 25].tolist() == [204, 26, 26]
    assert color[20, 15].tolist() == [10, 220, 30]


def test_looks_do_not_change_the_shape(painted_obj):
    whole = load_mesh(painted_obj)
    parts = load_mesh_parts(painted_obj)
    corners = np.vstack([part.vertices[part.faces].reshape(-1, 9) for part in parts])
    wanted = whole.vertices[whole.faces].reshape(-1, 9)
    order = [np.lexsort(rows.T) for rows in (corners, wanted)]
    np.testing.assert_array_equal(corners[order[0]], wanted[order[1]])


def test_an_obj_file_without_its_library_is_grey(painted_obj):
    painted_obj.path.with_name("looks.mtl").unlink()
    color = seen([mesh_model(painted_obj)]).color[0]
    assert np.ptp(color[20, 25]) == 0


def test_a_visuals_material_goes_before_the_files(painted_obj):
    color = seen([mesh_model(painted_obj, material=colored(0.0, 0.0, 1.0))]).color[0]
    assert color[20, 25].tolist() == color[20, 15].tolist() == [0, 0, 255]


def test_libraries_with_everything():
    looks = parse_library(MTL)
    assert looks["red"].color == (0.8, 0.1, 0.1)
    assert looks["clear"].alpha == 0.25
    assert looks["worn"].texture == "picture with spaces.png"
    assert parse_library("Kd 1 1 1\nnewmtl a\nKd x\nd\nTr\nmap_Kd")["a"].color is None


@pytest.mark.parametrize("mode", ["OPAQUE", "BLEND"])
def test_a_glb_file_wears_what_is_inside_it(tmp_path, mode):
    box = trimesh.creation.box((4.0, 4.0, 4.0))
    picture = Image.new("RGB", (4, 4), (200, 100, 50))
    material = trimesh.visual.material.PBRMaterial(
        baseColorTexture=picture, baseColorFactor=[255, 128, 255, 128], alphaMode=mode
    )
    uv = np.random.default_rng(0).uniform(size=(len(box.vertices), 2))
    box.visual = trimesh.visual.TextureVisuals(uv=uv, material=material)
    path = tmp_path / "box.glb"
    path.write_bytes(box.export(file_type="glb"))
    eye = look_at((-5.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    color = seen([mesh_model(Mesh("box", path=path))], eye=eye).color[0]
    share = 128 / 255 if mode == "BLEND" else 1.0
    wanted = np.array([200, 100 * 128 / 255, 50]) * share
    np.testing.assert_allclose(color[20, 20], wanted, atol=2)


def test_vertex_colours_of_a_ply_file_give_their_mean(tmp_path):
    box = trimesh.creation.box((2.0, 2.0, 2.0))
    box.visual.vertex_colors = np.tile([10, 200, 30, 255], (len(box.vertices), 1))
    path = tmp_path / "box.ply"
    path.write_bytes(box.export(file_type="ply"))
    color = seen([mesh_model(Mesh("box", path=path))]).color[0]
    np.testing.assert_allclose(color[20, 20], [10, 200, 30], atol=1)


# What lets see through ---------------------------------------------------------------------------


@given(st.floats(0.05, 0.95), st.permutations([0, 1]))
@settings(max_examples=20, deadline=None)
def test_what_lets_see_through_mixes_into_what_is_behind(transparency, order):
    glass = board(0.0, material=colored(0.0, 1.0, 0.0), transparency=transparency)
    wall = board(1.0, material=colored(1.0, 0.0, 0.5), size=20.0)
    both = [(glass, wall)[number] for number in order]
    frames = seen(both, want=("color", "depth", "labels"))
    front = 1.0 - transparency
    wanted = 255 * (front * np.array([0, 1, 0]) + transparency * np.array([1.0, 0.0, 0.5]))
    np.testing.assert_allclose(frames.color[0, 20, 20], wanted, atol=1.5)
    assert frames.depth[0, 20, 20] == pytest.approx(2.99, abs=1e-4)  # it is there
    assert frames.labels[0, 20, 20] == order.index(0)


def test_what_lets_see_through_is_hidden_by_what_is_before_it():
    wall = board(-1.0, material=colored(1.0, 0.0, 0.0))
    glass = board(0.0, material=colored(0.0, 1.0, 0.0), transparency=0.5)
    frames = seen([glass, wall], want=("color", "labels"))
    assert frames.color[0, 20, 20].tolist() == [255, 0, 0]
    assert set(np.unique(frames.labels)) == {1}


def test_the_nearest_of_what_lets_see_through_is_shown():
    panes = [
        board(x, material=colored(*color), transparency=0.5)
        for x, color in ((0.0, (0, 1, 0)), (-1.0, (0, 0, 1)))
    ]
    pictures = [seen(order).color for order in itertools.permutations(panes)]
    np.testing.assert_array_equal(*pictures)
    np.testing.assert_allclose(pictures[0][0, 20, 20], [0, 0, 128], atol=1)


def test_pictures_without_it_are_as_before():
    """A part that nothing shows of changes no pixel of the rest."""
    ball = Model("b", links=(Link("l", visuals=(Visual("v", geometry=Sphere(0.5)),)),))
    ground = Visual("v", geometry=Plane((0, 0, 1), (9.0, 9.0)))
    floor = Model("f", pose=Pose(z=-1.0), links=(Link("l", visuals=(ground,)),))
    away = board(-9.0, transparency=0.5)  # behind the camera
    want = ("color", "depth", "labels")
    for one, other in zip(
        *(
            (f.color, f.depth, f.labels)
            for f in (seen([ball, floor], want), seen([ball, floor, away], want))
        ),
        strict=True,
    ):
        np.testing.assert_array_equal(one, other)


def test_textures_inside_files_are_kept_once():
    from gazelle.rendering.textures import TextureTable

    table = TextureTable()
    pixels = np.zeros((3, 4, 3), np.uint8)
    assert table.number(pixels) == table.number(pixels.copy()) == 0
    assert table.number(pixels + 1) == 1
    assert table.rows()[:, 1:].tolist() == [[4, 3], [4, 3]]
