"""Plugins by file name."""

import argparse
import dataclasses
import warnings
from importlib.metadata import EntryPoint

import pytest
import scenes

from gazelle.cli import plugins
from gazelle.description import Parameters, Plugin, Source
from gazelle.errors import SimulationWarning
from gazelle.simulation import ModelPlugin, Simulation, register, registry


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


def test_the_bundled_ones_are_found():
    assert {"libgazebo_ros_diff_drive.so", "libgazebo_ros_laser.so"} <= set(registry.names())


def test_a_broken_plugin_of_another_package_hides_none_in_the_list(monkeypatch, capsys):
    broken = EntryPoint("aaa_broken", "nowhere_at_all:X", "gazelle.plugins")
    known = {**registry._entry_points(), "aaa_broken": broken}
    monkeypatch.setattr(registry, "_entry_points", lambda: known)
    assert plugins.run(argparse.Namespace()) == 0
    listed = " ".join(capsys.readouterr().out.split())
    assert "libaaa_broken.so cannot be had: No module named 'nowhere_at_all'" in listed
    assert "libgazebo_ros_p3d.so" in listed
