"""Placements of many links read at once equal those read alone."""

import numpy as np
import pytest

from gazelle import EngineError, assets, formats
from gazelle.simulation import Simulation

ARM = """
<sdf version="1.6"><world name="w">
<model name="arm"><pose>1 2 0.5 0 0 0.7</pose>
 <link name="base"><visual name="v"><geometry><box><size>1 1 1</size></box></geometry></visual></link>
 <link name="a"><pose>0 0 1 0 0 0.3</pose></link>
 <link name="b"><pose>0.5 0 1 0 0.2 0</pose></link>
 <joint name="w" type="fixed"><parent>world</parent><child>base</child></joint>
 <joint name="j" type="revolute"><parent>base</parent><child>a</child>
  <axis><xyz>0 0 1</xyz></axis></joint>
 <joint name="k" type="prismatic"><parent>a</parent><child>b</child>
  <axis><xyz>1 0 0</xyz></axis></joint>
</model>
<model name="ball"><pose>0 0 3 0 0 0.4</pose><link name="l">
 <pose>0.2 0 0 0 0 0</pose>
 <collision name="c"><geometry><sphere><radius>0.2</radius></sphere></geometry></collision></link></model>
<model name="wall"><static>true</static><pose>4 0 0 0 0.1 0.2</pose><link name="l"><pose>0 1 0 0 0 0</pose>
 </link></model>
</world></sdf>
"""


def alone(engine, links, worlds=None):
    places = [engine.links[link].placement(worlds) for link in links]
    return (
        np.stack([place.position for place in places], axis=1),
        np.stack([place.quaternion for place in places], axis=1),
    )


def check(engine, worlds=None):
    links = engine.links.names
    found = engine.links[links].placement(worlds)
    place, turned = alone(engine, links, worlds)
    assert found.position == pytest.approx(place, abs=1e-12)
    sign = np.sign((found.quaternion * turned).sum(axis=-1, keepdims=True))
    assert found.quaternion * sign == pytest.approx(turned, abs=1e-12)


@pytest.mark.parametrize("engine", ["mujoco", "planar"])
def test_all_links_at_once_are_where_each_is(tmp_path, engine):
    file = tmp_path / "w.world"
    file.write_text(ARM)
    with Simulation(formats.load(file), engine, nworld=3, threads=1) as sim:
        check(sim.engine)
        sim.robots["arm"].set_configuration(["j"], [[0.1], [0.5], [-1.0]])
        sim.robots["ball"].set_pose((3.0, 3.0, 1.0), yaw=1.0, worlds=np.array([1]))
        check(sim.engine)
        sim.step(5)
        check(sim.engine)
        check(sim.engine, np.array([0, 2]))
        sim.spawn("turtlebot3_burger")
        check(sim.engine)
        sim.delete("ball")
        check(sim.engine)
        sim.reset()
        check(sim.engine)
        assert sim.engine.links[()].placement(None).position.shape == (3, 0, 3)
        with pytest.raises(EngineError, match="there is no link"):
            sim.engine.links[("arm::nothing",)].placement()


@pytest.mark.parametrize("engine", ["mujoco", "planar"])
def test_driven_wheels_are_followed(engine):
    with Simulation(assets.world("turtlebot3_stage_1"), engine, nworld=2, threads=1) as sim:
        robot = sim.spawn("turtlebot3_burger")
        robot.inputs["cmd_vel"].send(linear=0.2, angular=1.0)
        sim.run(0.5)
        check(sim.engine)


def test_the_fleet_of_a_stage_file_is_read_at_once():
    with Simulation(assets.world("fleet"), "planar") as sim:
        sim.run(0.5)
        check(sim.engine)
