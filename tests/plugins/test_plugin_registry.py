"""Plugins by file name."""

import argparse
import dataclasses
import os
import subprocess
import sys
import tomllib
import warnings
from importlib.metadata import EntryPoint
from pathlib import Path
from types import SimpleNamespace

import pytest
import scenes

from gazelle.cli import plugins
from gazelle.description import Box, Parameters, Plugin, Source, Visual
from gazelle.errors import SimulationWarning
from gazelle.plugins.table import TABLE
from gazelle.simulation import (
    KnownPlugin,
    ModelPlugin,
    SensorPlugin,
    Simulation,
    VisualPlugin,
    WorldPlugin,
    register,
    registry,
)


def with_plugin(filename):
    source = Source("robot.urdf", 7)
    plugin = Plugin("p", filename, Parameters("plugin"), source)
    return scenes.world(dataclasses.replace(scenes.ball(), plugins=(plugin,)))


def test_an_unknown_plugin_is_one_warning_that_names_it_and_says_where_all_are_listed():
    with pytest.warns(SimulationWarning) as caught:
        Simulation(with_plugin("libgazebo_ros_diff_drv.so"))
    assert len(caught) == 1
    text = str(caught[0].message)
    assert text.startswith("robot.urdf:7: plugin 'p' (libgazebo_ros_diff_drv.so)")
    assert "did you mean 'libgazebo_ros_diff_drive.so'" in text
    assert "'gazelle plugins' lists" in text
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        Simulation(with_plugin("libgazebo_ros_diff_drv.so"))


@pytest.mark.parametrize("row", [row for row in TABLE if row.missing], ids=lambda row: row.files[0])
def test_what_is_not_simulated_says_what_is_missing_and_where(row):
    for name in row.files:
        with pytest.warns(SimulationWarning) as caught:
            Simulation(with_plugin(f"lib{name}.so")).close()
        (warning,) = caught
        assert str(warning.message) == f"robot.urdf:7: plugin 'p' (lib{name}.so): {row.missing}"


def test_what_has_nothing_to_do_is_silent_in_any_element():
    every = [
        Plugin("p", f"lib{name}.so", Parameters("plugin"))
        for row in TABLE
        if row.done_by
        for name in row.files
    ]
    visual = Visual("v", Box((0.1, 0.1, 0.1)), plugins=tuple(every))
    ball = dataclasses.replace(scenes.ball(), plugins=tuple(every))
    links = (dataclasses.replace(ball.links[0], visuals=(visual,)),)
    world = scenes.world(dataclasses.replace(ball, links=links))
    with Simulation(dataclasses.replace(world, plugins=tuple(every))) as sim:
        assert sim.plugins == []


def test_the_table_has_each_name_once_and_one_thing_to_say_of_it():
    names = [name for row in TABLE for name in row.files]
    assert len(set(names)) == len(names)
    for row in TABLE:
        assert sum(map(bool, (row.code, row.missing, row.done_by))) == 1, row
        for name in row.files:
            assert registry._stem(f"lib{name}.so") == name


@pytest.mark.parametrize("row", [row for row in TABLE if row.code], ids=lambda row: row.files[0])
def test_what_is_simulated_is_a_class_that_some_element_takes(row):
    for name in row.files:
        found = registry.find(Plugin("p", f"some/where/lib{name}.so", Parameters("plugin")))
        assert issubclass(found, (ModelPlugin, SensorPlugin, VisualPlugin, WorldPlugin))


def test_gazelle_needs_no_entry_points_of_its_own_but_for_rooms_above_those_that_look():
    text = (Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8")
    points = tomllib.loads(text)["project"]["entry-points"]
    rooms = {value.split(".")[1] for group in points.values() for value in group.values()}
    assert rooms == {"assets", "drop_in", "stage", "viewer"}


def test_a_row_is_all_that_a_plugin_needs(monkeypatch):
    row = KnownPlugin(("nudge",), "nudges", code=f"{__name__}:Nudge")
    monkeypatch.setattr(registry, "known_plugins", lambda: {"nudge": row})
    monkeypatch.setitem(sys.modules, __name__, SimpleNamespace(Nudge=Nudge))
    with Simulation(with_plugin("libnudge.so")) as sim:
        sim.run(0.5)
        assert sim.robots["ball"].position[0, 1] == pytest.approx(0.5, rel=0.01)


class Nudge(ModelPlugin):
    """Sends its model off to the left."""

    def load(self, robot, parameters):
        robot.set_twist((0.0, 1.0, 0.0), (0.0, 0.0, 0.0))


PACKAGE = """
from gazelle.simulation import ModelPlugin

class Shove(ModelPlugin):
    \"\"\"Shoves its model.\"\"\"

    def load(self, robot, parameters):
        robot.set_twist((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))

class Control(Shove):
    \"\"\"Does what Gazelle does not.\"\"\"

class Drive(Shove):
    \"\"\"Does what Gazelle does too.\"\"\"

NOT_A_PLUGIN = 3
"""
USER = """
import sys, warnings
import gazelle
from gazelle import formats

world = '<sdf version="1.6"><world name="w"><gravity>0 0 0</gravity><model name="m"><link name="l"/>'
world += f'<plugin name="p" filename="{sys.argv[1]}"/></model></world></sdf>'
with gazelle.Simulation(formats.load_string(world)) as sim:
    sim.run(seconds=0.5)
    print(round(float(sim.robots["m"].position[0, 0]), 2))
"""


def install(site, name, points, source=PACKAGE):
    """Install a package as pip does: its modules and its metadata on the path."""
    about = site / f"{name}-1.0.dist-info"
    about.mkdir(parents=True)
    (site / f"{name}_plugins.py").write_text(source)
    (about / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text(f"[gazelle.plugins]\n{points}\n")


def run(site, *words):
    environment = {**os.environ, "PYTHONPATH": str(site)}
    return subprocess.run(
        [sys.executable, *words], capture_output=True, text=True, env=environment, check=False
    )


POINTS = """shove = shoving_plugins:Shove
gazebo_ros_control = shoving_plugins:Control
gazebo_ros_diff_drive = shoving_plugins:Drive
odd = shoving_plugins:NOT_A_PLUGIN"""


@pytest.mark.long
def test_an_installed_package_brings_plugins_by_entry_points(tmp_path):
    """New ones, and such as go before Gazelle's own, simulated or not."""
    install(tmp_path, "shoving", POINTS)
    for name in ("libshove.so", "shove", "libgazebo_ros_control.so", "libgazebo_ros_diff_drive.so"):
        done = run(tmp_path, "-c", USER, name)
        assert (done.stdout, done.stderr) == ("0.5\n", ""), name
    listed = " ".join(run(tmp_path, "-m", "gazelle", "plugins").stdout.split())
    assert "Shoves its model." in listed
    assert "Does what Gazelle does not." in listed
    assert "'odd' (shoving_plugins:NOT_A_PLUGIN) is not a plugin" in listed
    near = run(tmp_path, "-c", USER, "libshov.so").stderr
    assert "did you mean 'libshove.so'?" in near


@pytest.mark.long
def test_a_list_that_an_older_installation_of_gazelle_left_is_passed_over(tmp_path):
    install(tmp_path, "gazelle", "gazebo_ros_api_plugin = gazelle.plugins.nowhere:Silent")
    done = run(tmp_path, "-c", USER, "libgazebo_ros_api_plugin.so")
    assert (done.stdout, done.stderr) == ("0.0\n", "")


def test_a_program_can_register_its_own():
    class Kick(ModelPlugin):
        update_rate = 0.0

        def load(self, robot, parameters):
            self.robot = robot

        def on_update(self, time):
            self.robot.set_twist((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))

    register("libkick.so", Kick)
    assert "libkick.so" in registry.names()
    with Simulation(with_plugin("libkick.so")) as sim:
        sim.run(0.5)
        assert sim.robots["ball"].position[0, 0] == pytest.approx(0.5, rel=0.01)


def test_a_broken_plugin_of_another_package_hides_none_in_the_list(monkeypatch, capsys):
    broken = EntryPoint("aaa_broken", "nowhere_at_all:X", "gazelle.plugins")
    monkeypatch.setattr(registry, "entry_points_of_others", lambda _: {"aaa_broken": broken})
    assert plugins.run(argparse.Namespace()) == 0
    listed = " ".join(capsys.readouterr().out.split())
    assert "libaaa_broken.so cannot be had: No module named 'nowhere_at_all'" in listed
    assert "libgazebo_ros_p3d.so the true pose of a body" in listed
    assert "libgazebo_ros_video.so images projected on models (not simulated: " in listed
    assert "libgazebo_ros_api_plugin.so services, topics" in listed
