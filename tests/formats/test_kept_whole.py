"""Content of a file that nothing here simulates is written back unchanged."""

import xml.etree.ElementTree as ET

import pytest

from gazelle import formats

WORLD = """<sdf version="1.7">
  <world name="default">
    <physics name="fine" type="ode">
      <max_step_size>0.002</max_step_size>
      <ode>
        <solver><iters>40</iters><use_dynamic_moi_rescaling>true</use_dynamic_moi_rescaling></solver>
        <constraints><cfm>0.001</cfm></constraints>
      </ode>
      <bullet><solver><type>sequential_impulse</type></solver></bullet>
    </physics>
    <scene>
      <ambient>0.1 0.2 0.3 1</ambient>
      <sky><time>6.5</time><clouds><speed>12</speed></clouds></sky>
      <fog><type>linear</type><end>50</end></fog>
      <origin_visual>false</origin_visual>
    </scene>
    <actor name="walker">
      <pose>1 2 0 0 0 0.5</pose>
      <skin><filename>walk.dae</filename><scale>1.5</scale></skin>
      <animation name="walking"><filename>walk.dae</filename></animation>
      <script>
        <delay_start>2</delay_start>
        <trajectory id="0" type="walking" tension="0.4">
          <waypoint><time>0</time><pose>0 0 0 0 0 0</pose></waypoint>
          <waypoint><time>3</time><pose>2 0 0 0 0 0</pose></waypoint>
        </trajectory>
      </script>
    </actor>
    <model name="m">
      <link name="a">
        <collision name="c">
          <geometry><sphere><radius>0.1</radius></sphere></geometry>
          <surface>
            <friction>
              <ode><mu>0.4</mu></ode>
              <bullet><friction>0.3</friction><rolling_friction>0.1</rolling_friction></bullet>
            </friction>
            <contact>
              <poissons_ratio>0.3</poissons_ratio>
              <ode><kp>1000</kp></ode>
              <bullet><kp>2000</kp><split_impulse>false</split_impulse></bullet>
            </contact>
            <soft_contact><dart><stiffness>5</stiffness></dart></soft_contact>
          </surface>
        </collision>
        <visual name="v">
          <meta><layer>3</layer></meta>
          <geometry><sphere><radius>0.1</radius></sphere></geometry>
          <material>
            <ambient>1 0 0 1</ambient>
            <shader type="normal_map_object_space"><normal_map>bumps.png</normal_map></shader>
            <lighting>false</lighting>
            <pbr><metal><roughness>0.7</roughness></metal></pbr>
          </material>
        </visual>
      </link>
      <link name="b"/>
      <joint name="j" type="fixed">
        <parent>a</parent><child>b</child>
        <axis><xyz>0 1 0</xyz></axis>
      </joint>
    </model>
  </world>
</sdf>
"""


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    """Return the world above, and its saved text."""
    file = tmp_path_factory.mktemp("kept") / "all.world"
    file.write_text(WORLD)
    with pytest.warns(match="walk.dae"):
        world = formats.load(file)
    return world, formats.to_string(world, "sdf", folder=file.parent)


def leaves(node, path=""):
    """Yield each value and attribute of an element with its path."""
    yield from ((f"{path}/{node.tag}@{name}", value) for name, value in node.attrib.items())
    if len(node) == 0 and (node.text or "").strip():
        yield f"{path}/{node.tag}", node.text.strip()
    for child in node:
        yield from leaves(child, f"{path}/{node.tag}")


def test_every_value_of_the_file_is_in_what_is_written(saved):
    asked = set(leaves(ET.fromstring(WORLD)))
    asked -= {("/sdf/world/actor/pose", "1 2 0 0 0 0.5")}  # written as well, from the model's pose
    assert asked - set(leaves(ET.fromstring(saved[1]))) <= {("/sdf@version", "1.7")}


def test_what_is_written_reads_as_the_same_world(saved, tmp_path):
    world, text = saved
    again = tmp_path / "again.world"
    again.write_text(text)
    with pytest.warns(match="walk.dae"):
        assert formats.load(again) == world


def test_an_actor_is_written_where_it_is_now(saved):
    actor = ET.fromstring(saved[1]).find("world/actor")
    assert [float(word) for word in actor.findtext("pose").split()] == [1, 2, 0, 0, 0, 0.5]
    assert len(ET.fromstring(saved[1]).findall("world/model")) == 1
