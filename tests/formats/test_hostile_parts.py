"""Meshes, pictures, maps, actors and merged files made to do harm."""

import mutations
import pytest
from test_hostile import laughs
from xml_samples import sdf

from gazelle import Error, FormatError, formats
from gazelle.description import Heightmap, Mesh
from gazelle.errors import FormatWarning
from gazelle.formats.terrain import load_heights

DEEP = "<node>" * 10_000 + "</node>" * 10_000


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("deep.dae", mutations.DAE.replace("<node>", DEEP + "<node>"), "nested more than"),
        ("laughs.dae", laughs("<COLLADA>{}</COLLADA>"), "entity"),
        ("many.stl", b"\0" * 80 + b"\xff\xff\xff\xff" + b"\0" * 50, "no triangle|STL"),
        ("far.obj", "v 1e999 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n", "not finite"),
        ("wrong.obj", "v 0 0 0\nf 1 2 99999999999999999999\n", "line 2"),
        ("loop.dae", mutations.DAE.replace('url="#g"/><node>', 'url="#none"/><node>'), ""),
    ],
)
def test_meshes_made_to_do_harm(tmp_path, name, content, message):
    (tmp_path / name).write_bytes(mutations.as_bytes(content))
    if not message:
        formats.load_mesh(Mesh(name, tmp_path / name))
        return
    try:
        found = formats.load_mesh(Mesh(name, tmp_path / name))
    except FormatError as error:
        assert any(each in error.message for each in message.split("|"))  # noqa: PT017
    else:
        assert len(found.faces) <= 1


def test_a_picture_larger_than_the_machine_is_refused(tmp_path):
    header = b"P5\n2000000 2000000\n255\n"
    (tmp_path / "p.pgm").write_bytes(header + b"\0" * 100)
    with pytest.raises(FormatError, match="pixels"):
        load_heights(Heightmap("p.pgm", tmp_path / "p.pgm"))


@pytest.mark.parametrize(
    "uri", ["file:///etc/passwd", "/etc/passwd", "../" * 12 + "etc/passwd", "out.png"]
)
def test_pictures_and_skins_elsewhere_are_as_good_as_missing(tmp_path, uri):
    home = tmp_path / "a/b/c/d/e"
    home.mkdir(parents=True)
    (home / "out.png").symlink_to("/etc/passwd")
    body = mutations.GROUND.replace("p.png", uri)
    actor = mutations.ACTOR.replace("m.dae", uri)
    for name, text in {"ground.world": body, "actor.world": actor}.items():
        (home / name).write_text(sdf(text))
        with pytest.warns(FormatWarning, match="not found"):
            world = formats.load(home / name)
        shapes = [
            part.geometry
            for link in world.models[0].links
            for part in (*link.collisions, *link.visuals)
            if hasattr(part.geometry, "path")
        ]
        assert shapes
        assert {shape.path for shape in shapes} == {None}
    (home / "map.yaml").write_text(mutations.MAP.replace("p.png", uri))
    with pytest.raises(Error, match="not found"):
        formats.load_map(home / "map.yaml")


@pytest.mark.parametrize("merge", ["", "merge='true'"])
def test_a_file_that_merges_itself_is_refused(tmp_path, merge):
    text = sdf(
        f"<model name='m'><link name='l'/><include {merge}><uri>own.sdf</uri></include></model>",
        "1.9",
    )
    (tmp_path / "own.sdf").write_text(text)
    with pytest.raises(FormatError, match="includes itself"):
        formats.load(tmp_path / "own.sdf")
