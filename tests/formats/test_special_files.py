"""Pipes and devices in the place of files, scenes and numbers beyond bounds are one error."""

import os
from pathlib import Path

import pytest

import gazelle
from gazelle import formats
from gazelle.description import Inertia, Inertial, Link, Mesh, Model, World
from gazelle.errors import EngineError, FormatError, FormatWarning
from gazelle.formats import load_mesh
from gazelle.formats.elevations import READERS
from gazelle.formats.picture import read_picture


@pytest.mark.parametrize(
    "name",
    ["r.urdf", "w.sdf", "r.xacro", "m.stl", "m.dae", "m.obj", "p.png", "h.tif", "g.asc", "e.dem"],
)
def test_a_pipe_is_refused_at_once(tmp_path, name):
    file = tmp_path / name
    os.mkfifo(file)
    if name[0] in "rw":
        read = formats.load
    elif name[0] == "m":
        read = lambda path: load_mesh(Mesh(name, path))  # noqa: E731
    else:
        read = READERS.get(file.suffix, read_picture)
    with pytest.raises(FormatError, match="a pipe, a socket or a device"):
        read(file)


def test_a_device_is_no_mesh():
    with pytest.raises(FormatError, match="a pipe, a socket or a device"):
        load_mesh(Mesh("zero", Path("/dev/zero")))


COLLADA = """<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_geometries><geometry id="g"><mesh><source id="s"><float_array id="a" count="9">
0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source="#a" count="3" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries><library_nodes><node id="n0"><instance_geometry url="#g"/>
</node>{}</library_nodes><library_visual_scenes><visual_scene id="scene"><node>
<instance_node url="#n{}"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>"""


@pytest.mark.parametrize(("levels", "width"), [(8, 10), (20, 3), (40, 2)])
def test_nested_instances_are_counted(tmp_path, levels, width):
    nodes = "".join(
        f'<node id="n{level}">' + f'<instance_node url="#n{level - 1}"/>' * width + "</node>"
        for level in range(1, levels + 1)
    )
    file = tmp_path / "bomb.dae"
    file.write_text(COLLADA.format(nodes, levels))
    with pytest.raises(FormatError, match="more than the limit of 100,000 nodes"):
        load_mesh(Mesh("bomb.dae", file))


def test_instances_within_the_limit_are_all_there(tmp_path):
    node = '<node id="n1">' + '<instance_node url="#n0"/>' * 10 + "</node>"
    file = tmp_path / "some.dae"
    file.write_text(COLLADA.format(node, 1))
    assert len(load_mesh(Mesh("some.dae", file)).faces) == 10


SDF = """<sdf version='1.6'><model name='m'><link name='l'><inertial><mass>{0}</mass><inertia>
<ixx>{1}</ixx><iyy>{1}</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>{2}</iyz></inertia></inertial>
</link></model></sdf>"""


@pytest.mark.parametrize("numbers", [(1, 1, 1e308), (1, 1e308, 0), (1e308, 1, 0), (1, "inf", 0)])
@pytest.mark.filterwarnings("ignore::gazelle.errors.EngineWarning")
def test_a_mass_or_inertia_beyond_bounds_is_replaced_with_a_word(numbers):
    with pytest.warns(FormatWarning, match="was taken"):
        world = formats.load_string(SDF.format(*numbers))
    with gazelle.Simulation(world, threads=1) as sim:
        sim.step(3)


@pytest.mark.parametrize("inertial", [Inertial(1e300), Inertial(1.0, inertia=Inertia(1e300, 1, 1))])
def test_such_a_description_is_refused(inertial):
    world = World(models=(Model("m", links=(Link("l", inertial=inertial),)),))
    with pytest.raises(EngineError, match=r"'m::l' has a mass or a moment .* limit of 1e\+15"):
        gazelle.Simulation(world, threads=1)


@pytest.mark.parametrize("rpy", ["inf 0 0", "0 1e400 0", "0 0 -inf"])
def test_an_angle_that_is_not_finite_is_one_error(rpy):
    text = SDF.format(1, 1, 0).replace("<inertial>", f"<pose>0 0 0 {rpy}</pose><inertial>")
    with pytest.raises(FormatError, match="finite"):
        formats.load_string(text)
    inertial = "<mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
    for origin in ("inertial", "visual", "collision"):
        inner = f"<inertial>{inertial}</inertial>"
        place = f"<origin rpy='{rpy}'/>"
        if origin == "inertial":
            inner = inner.replace("<mass", f"{place}<mass")
        else:
            inner += f"<{origin}>{place}<geometry><sphere radius='1'/></geometry></{origin}>"
        with pytest.raises(FormatError, match="an origin must be finite"):
            formats.load_string(f"<robot name='r'><link name='a'>{inner}</link></robot>")


@pytest.mark.parametrize("engine", ["mujoco", "planar"])
def test_a_link_that_is_too_far_away_is_refused(engine):
    world = World(models=(Model("m", links=(Link("l", gazelle.Pose(x=1e300)),)),))
    with pytest.raises(EngineError, match=r"link 'm::l' cannot be at .* too far away"):
        gazelle.Simulation(world, engine, threads=1)


def test_a_launch_file_is_called_one():
    with pytest.raises(FormatError, match=r"this is a launch file.*'gazelle launch FILE' runs it"):
        formats.load_string("<launch/>")


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (World(models=(Model("m", links=(Link("l"),)),)), "not by a World;"),
        (
            "<robot name='r'>" + "<link name='l'/>" * 500 + "</robot>",
            "not by its text; load_string",
        ),
        ("\n<sdf version='1.6'/>", "not by its text; load_string"),
        ("x" * 300, "not by 300 characters;"),
        ("y/" * 3000, "not by 6,000 characters;"),
        (["robot.urdf"], r"not by \['robot.urdf'\];"),
    ],
)
def test_what_is_no_file_is_named_by_its_kind(given, said):
    with pytest.raises(FormatError, match=said) as caught:
        formats.load(given)
    assert len(str(caught.value)) < 200
    (problem,) = formats.check(given)
    assert problem.message == caught.value.message
