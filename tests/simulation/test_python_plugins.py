"""Plugins that users write in Python and name in their files."""

import sys
from pathlib import Path

import pytest

import gazelle
from gazelle import formats
from gazelle.errors import PluginWarning
from gazelle.simulation import Placement

EXAMPLES = Path(__file__).parents[2] / "examples"
BOX = """<sdf version="1.6"><world name="w">
  <include><uri>model://ground_plane</uri></include>
  <model name="box"><pose>0 0 0.5 0 0 0</pose><link name="link">
    <collision name="c"><geometry><box><size>1 1 1</size></box></geometry>
      <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>
    </link>
    <plugin name="drive" filename="{filename}"/></model></world></sdf>"""


def world(filename):
    return formats.load_string(BOX.format(filename=filename))


@pytest.fixture
def modules(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.syspath_prepend(str(EXAMPLES))
    yield tmp_path
    for name in ("drive_plugin", "mine"):
        sys.modules.pop(name, None)


@pytest.mark.usefixtures("modules")
def test_the_example_plugin_drives_its_model_and_publishes_its_pose():
    with gazelle.Simulation(world("drive_plugin:VelocityDrive")) as sim:
        box = sim.robots["box"]
        poses = []
        box.outputs["pose"].subscribe(poses.append)
        box.inputs["cmd_vel"].send(linear=0.5, angular=0.2)
        sim.run(seconds=2.0)
        assert box.inputs["cmd_vel"].topic == "/box/cmd_vel"
        assert box.pose.x == pytest.approx(0.5 * 2 * 0.97, abs=0.05)
        assert box.pose.yaw == pytest.approx(0.4, abs=0.02)
        assert len(poses) == pytest.approx(60, abs=2)
        assert isinstance(poses[-1], Placement)  # geometry_msgs/Pose on a graph


def test_the_example_plugin_is_short():
    lines = (EXAMPLES / "drive_plugin.py").read_text(encoding="utf-8").splitlines()
    body = lines[next(i for i, line in enumerate(lines) if line.startswith("class ")) :]
    assert len(body) < 40


def test_a_module_that_is_not_there_is_named_with_what_to_do():
    with pytest.raises(PluginWarning, match=r"'drive' cannot be imported.*nowhere"):
        gazelle.Simulation(world("nowhere.at.all:Drive"))


def test_a_class_that_is_no_plugin_is_refused(modules):
    (modules / "mine.py").write_text("class Drive: pass\n", encoding="utf-8")
    with pytest.raises(PluginWarning, match="not a plugin class"):
        gazelle.Simulation(world("mine:Drive"))
