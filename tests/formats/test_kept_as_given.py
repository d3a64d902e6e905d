"""Values that simulation changes are written as in the file, as libsdformat does."""

import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest

from gazelle import Simulation, formats
from gazelle.description import Box, Capsule, Cone, Cylinder, Ellipsoid, Empty, Sphere, World

pytestmark = pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")

SHAPES = {
    "box": ("<box><size>0 1 -2</size></box>", Box((1e-4, 1.0, 2.0))),
    "sphere": ("<sphere><radius>0</radius></sphere>", Sphere(1e-4)),
    "cylinder": (
        "<cylinder><radius>-0.5</radius><length>0</length></cylinder>",
        Cylinder(0.5, 1e-4),
    ),
    "capsule": ("<capsule><radius>0.5</radius><length>0</length></capsule>", Capsule(0.5, 1e-4)),
    "cone": ("<cone><radius>0</radius><length>2</length></cone>", Cone(1e-4, 2.0)),
    "ellipsoid": ("<ellipsoid><radii>1 0 2</radii></ellipsoid>", Ellipsoid((1.0, 1e-4, 2.0))),
}
URDF_SHAPES = {
    "box": '<box size="0 1 -2"/>',
    "sphere": '<sphere radius="0"/>',
    "cylinder": '<cylinder radius="-0.5" length="0"/>',
}
STATE = """<sdf version="1.7"><world name="w">
  <light name="lamp" type="point"><pose>1 1 1 0 0 0</pose></light>
  <model name="m"><pose>1 2 3 0 0 0.5</pose>
    <link name="a"><pose>0 0 1 0 0 0</pose></link>
    <model name="inner"><pose>0 0 2 0 0 0</pose><link name="b"/></model>
  </model>
  <model name="other"><pose>7 0 0 0 0 0</pose><link name="l"/></model>
  <state world_name="w">
    <model name="m"><pose>5 0 0 0 0 0</pose>
      <link name="a"><pose>5 0 4 0 0 0</pose></link>
      <model name="inner"><pose>5 5 5 0 0 0</pose></model>
    </model>
    <light name="lamp"><pose>9 9 9 0 0 0</pose></light>
  </state>
  <state world_name="w"><model name="m"><pose>8 0 0 0 0 0</pose></model></state>
</world></sdf>"""


def shaped(shape):
    return (
        '<sdf version="1.7"><world name="w"><model name="m"><link name="l"><collision name="c">'
        f"<geometry>{shape}</geometry></collision></link></model></world></sdf>"
    )


def shape_of(world):
    return world.models[0].links[0].collisions[0].geometry


def with_shape(world, shape):
    model = world.models[0]
    link = model.links[0]
    collision = replace(link.collisions[0], geometry=shape)
    link = replace(link, collisions=(collision,))
    return replace(world, models=(replace(model, links=(link,)),))


def numbers(text, path):
    return [[float(word) for word in each.text.split()] for each in ET.fromstring(text).iter(path)]


@pytest.mark.parametrize("name", SHAPES)
def test_a_length_that_is_not_greater_than_zero_is_written_as_it_was(name):
    text, taken = SHAPES[name]
    world = formats.load_string(shaped(text))
    assert shape_of(world) == taken
    saved = formats.to_string(world, "sdf")
    said, written = (ET.fromstring(each).find(f".//{name}") for each in (shaped(text), saved))
    for leaf in said:
        assert [float(n) for n in written.find(leaf.tag).text.split()] == [
            float(n) for n in leaf.text.split()
        ]
    assert formats.load_string(saved) == world


@pytest.mark.parametrize("name", SHAPES)
def test_a_length_that_was_changed_is_written_as_it_is_now(name):
    text, taken = SHAPES[name]
    world = formats.load_string(shaped(text))
    field = {"box": "size", "ellipsoid": "radii"}.get(name, "radius")
    value = (3.0, 4.0, 5.0) if field in {"size", "radii"} else 3.0
    other = replace(shape_of(world), **{field: value})
    assert other != taken
    again = formats.load_string(formats.to_string(with_shape(world, other), "sdf"))
    assert shape_of(again) == other


@pytest.mark.parametrize("kind", ["urdf", "sdf"])
@pytest.mark.parametrize("name", URDF_SHAPES)
def test_a_robots_shape_is_written_as_it_was(name, kind):
    text = (
        '<robot name="r"><link name="l"><inertial><mass value="1"/>'
        '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
        f"<collision><geometry>{URDF_SHAPES[name]}</geometry></collision></link></robot>"
    )
    model = formats.load_model_string(text)
    assert model.links[0].collisions[0].geometry == SHAPES[name][1]
    saved = formats.to_string(model, kind)
    shape = ET.fromstring(saved).find(f".//{name}")
    found = " ".join(shape.attrib.values()) if kind == "urdf" else " ".join(shape.itertext())
    expected = {"box": [0, 1, -2], "sphere": [0], "cylinder": [-0.5, 0]}[name]
    assert [float(word) for word in found.split()] == expected


def test_a_saved_state_moves_nothing_of_what_is_written():
    world = formats.load_string(STATE)
    placed = [world.models[0].pose.x, world.models[0].models[0].pose.y, world.lights[0].pose.z]
    assert placed == [5.0, 5.0, 9.0]
    saved = formats.to_string(world, "sdf")
    root = ET.fromstring(saved).find("world")
    assert [float(n) for n in root.find("model[@name='m']/pose").text.split()] == [
        *(1.0, 2.0, 3.0, 0.0, 0.0, 0.5)
    ]
    assert root.find("light/pose").text == "1 1 1 0 0 0"
    assert root.find("model[@name='m']/model/pose").text == "0 0 2 0 0 0"
    assert root.find("model[@name='m']/link/pose").text == "0 0 1 0 0 0"
    assert len(root.findall("state")) == 2
    assert formats.load_string(saved) == world


def test_what_else_was_changed_is_written_beside_the_state():
    world = replace(formats.load_string(STATE), gravity=(0.0, 0.0, -1.6), name="moon")
    again = formats.load_string(formats.to_string(world, "sdf"))
    assert again == world


def test_one_model_of_a_world_with_a_state_is_where_the_state_has_it():
    model = formats.load_string(STATE).models[0]
    saved = formats.load_model_string(formats.to_string(model, "sdf"))
    np.testing.assert_allclose(saved.pose.position, (5.0, 0.0, 0.0))


def test_a_light_of_a_lumped_link_stays_where_libsdformat_leaves_it():
    inertial = (
        '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
        "</inertial>"
    )
    text = (
        f'<robot name="r"><link name="a">{inertial}</link><link name="b">{inertial}</link>'
        '<joint name="j" type="fixed"><origin xyz="1 2 3" rpy="0 0 1"/><parent link="a"/>'
        '<child link="b"/></joint><gazebo reference="b"><light name="lamp" type="point">'
        '<pose>0.1 0 0 0 0 0</pose></light><sensor name="s" type="imu"/></gazebo></robot>'
    )
    link = formats.load_model_string(text).links[0]
    assert link.lights[0].pose.position == (0.1, 0.0, 0.0)
    assert link.sensors[0].pose.position == (1.0, 2.0, 3.0)


@pytest.mark.parametrize("kind", ["urdf", "sdf"])
def test_a_box_without_size_touches_nothing_and_is_written(kind):
    inertial = (
        '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
        "</inertial>"
    )
    frame = '<geometry><box size="0 0 0"/></geometry>'
    model = formats.load_model_string(
        f'<robot name="r"><link name="l">{inertial}<visual>{frame}</visual>'
        f"<collision>{frame}</collision></link></robot>"
    )
    link = model.links[0]
    assert [each.geometry for each in (*link.visuals, *link.collisions)] == [Empty(), Empty()]
    boxes = list(ET.fromstring(formats.to_string(model, kind)).iter("box"))
    assert [each.get("size") or each.find("size").text for each in boxes] == ["0 0 0"] * 2
    with Simulation(World(models=(model,))) as sim:
        sim.step()
