"""Robots and models open in a world with ground and sun, and stand on the ground."""

import math

import pytest

import gazelle
from gazelle import formats

INERTIAL = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
BASE = f"<link name='base'>{INERTIAL}</inertial>{{}}</link>"
WORLD_JOINT = (
    "<link name='world'/><joint name='fix' type='fixed'><parent link='world'/>"
    "<child link='base'/></joint>"
)


def urdf(tmp_path, collision, more=""):
    file = tmp_path / "robot.urdf"
    file.write_text(f"<robot name='robot'>{BASE.format(collision)}{more}</robot>")
    return file


def sdf(tmp_path, *models):
    file = tmp_path / "model.sdf"
    file.write_text(f"<sdf version='1.7'>{''.join(models)}</sdf>")
    return file


def box(name="box", pose="0 0 0 0 0 0", size="1 1 1", more=""):
    shape = f"<geometry><box><size>{size}</size></box></geometry>"
    link = f"<link name='link'><collision name='c'>{shape}</collision></link>"
    return f"<model name='{name}'>{more}<pose>{pose}</pose>{link}</model>"


def shape(text, origin=""):
    return f"<collision>{origin}<geometry>{text}</geometry></collision>"


TILTED = "<origin xyz='0 0 0.1' rpy='1.5707963267948966 0 0'/>"
TURNED = "<origin rpy='0.3 0.4 0.5'/>"


@pytest.mark.parametrize(
    ("collision", "height"),
    [
        (shape("<box size='1 2 3'/>"), 1.5),
        (shape("<sphere radius='0.2'/>", TURNED), 0.2),
        (shape("<cylinder radius='0.2' length='1'/>"), 0.5),
        (shape("<cylinder radius='0.2' length='1'/>", TILTED), 0.1),
        (shape("<box size='1 2 3'/>", TILTED), 0.9),
        ("", 0.0),
    ],
)
def test_a_robot_stands_on_the_ground(tmp_path, collision, height):
    world = formats.open_world(urdf(tmp_path, collision))
    assert [model.name for model in world.models] == ["ground_plane", "robot"]
    assert world.lights
    assert world.models[1].pose.z == pytest.approx(height)


@pytest.mark.parametrize(
    "geometry",
    [
        "<cylinder><radius>0.2</radius><length>0.6</length></cylinder>",
        "<capsule><radius>0.2</radius><length>0.6</length></capsule>",
        "<ellipsoid><radii>0.2 0.3 0.6</radii></ellipsoid>",
        "<cone><radius>0.3</radius><length>0.6</length></cone>",
        "<box><size>0.2 0.4 0.6</size></box>",
        "<polyline><point>0 0</point><point>1 0</point><point>0 1</point></polyline>",
        "<mesh><uri>tetrahedron.stl</uri><scale>1 1 -2</scale></mesh>",
    ],
)
@pytest.mark.parametrize("turn", ["0 0 0", "1 0.5 0.3", "3 -0.4 2"])
def test_the_lowest_point_touches_the_ground_however_it_is_turned(tmp_path, geometry, turn):
    corners = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"]
    facets = "".join(
        f"facet normal 0 0 0 outer loop {' '.join(f'vertex {corners[i]}' for i in face)} "
        "endloop endfacet "
        for face in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))
    )
    (tmp_path / "tetrahedron.stl").write_text(f"solid t {facets} endsolid t")
    link = f"<link name='l'><collision name='c'><geometry>{geometry}</geometry></collision></link>"
    file = sdf(tmp_path, f"<model name='m'><pose>1 2 -5 {turn}</pose>{link}</model>")
    with gazelle.Simulation(file, threads=1) as sim:
        collision = ["m::l::c"]
        assert sim.engine.contacts([collision]).named().depth.max(initial=0.0) < 1e-3
        sunk = sim.robots["m"].pose
        sim.robots["m"].set_pose((sunk.x, sunk.y, sunk.z - 0.002), sunk.quaternion)
        assert 1e-3 < sim.engine.contacts([collision]).named().depth.max(initial=0.0) < 3e-3


@pytest.mark.parametrize("pose", ["0 0 3 0 0 0", "0 0 0.5 0 0 0"])
def test_what_a_file_puts_above_the_ground_stays_there(tmp_path, pose):
    world = formats.open_world(sdf(tmp_path, box(pose=pose)))
    assert world.models[1].pose.z == float(pose.split()[2])


def test_models_of_one_file_are_lifted_together(tmp_path):
    world = formats.open_world(sdf(tmp_path, box("a"), box("b", "0 0 1 0 0 0")))
    assert [model.pose.z for model in world.models[1:]] == pytest.approx([0.5, 1.5])


def test_what_is_fixed_to_the_world_is_not_lifted(tmp_path):
    collision = shape("<box size='1 1 1'/>")
    world = formats.open_world(urdf(tmp_path, collision, WORLD_JOINT))
    assert world.models[0].name == "ground_plane"
    assert world.models[1].pose.z == 0.0
    world = formats.open_world(sdf(tmp_path, box(more="<static>1</static>")))
    assert world.models[1].pose.z == 0.0


def test_a_floor_needs_no_other_floor():
    world = formats.open_world("model://ground_plane")
    assert len(world.models) == 1
    assert world.lights


def test_a_world_stays_as_it_is(tmp_path):
    file = sdf(tmp_path, f"<world name='w'>{box()}</world>")
    assert formats.open_world(file) == formats.load(file)
    world = formats.load(sdf(tmp_path, box()))
    assert formats.open_world(world) is world


def test_ground_and_sun_can_be_left_out(tmp_path):
    file = sdf(tmp_path, box())
    assert formats.open_world(file, ground=False) == formats.load(file)


def test_a_simulation_takes_robots_by_file_name_and_description():
    for robot in ("turtlebot3_burger", formats.load_model("turtlebot3_burger")):
        with gazelle.Simulation(robot, threads=1) as sim:
            sim.run(1.0)
            assert abs(sim.robots["turtlebot3_burger"].pose.z) < 0.01
        with gazelle.Simulation(robot, threads=1, ground=False) as sim:
            sim.run(1.0)
            assert sim.robots["turtlebot3_burger"].pose.z == pytest.approx(-4.9, abs=0.1)


def test_a_missing_mesh_and_terrain_do_not_count(tmp_path):
    missing = (
        "<collision name='m'><geometry><mesh><uri>gone.stl</uri></mesh></geometry></collision>"
    )
    link = f"<link name='l'>{missing}</link>"
    file = sdf(tmp_path, f"<model name='m'>{link}</model>")
    with pytest.warns(gazelle.errors.FormatWarning, match=r"gone\.stl"):
        assert math.isfinite(formats.open_world(file).models[1].pose.z)
