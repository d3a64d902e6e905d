"""A plugin's faults are named and end the plugin, never the simulation."""

import sys

import pytest

import gazelle
from gazelle import formats
from gazelle.errors import PluginWarning, SimulationWarning

WORLD = """<sdf version="1.6"><world name="w">{world}<model name="box"><link name="link">
<collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>
<sensor name="eye" type="ray"><update_rate>10</update_rate><ray><scan><horizontal>
<samples>3</samples></horizontal></scan><range><min>0.1</min><max>1</max></range></ray>{sensor}
</sensor></link>{model}</model></world></sdf>"""
HEAD = """
from gazelle.simulation import (
    Input, ModelPlugin, Output, SensorOutput, SensorPlugin, SystemPlugin, WorldPlugin
)
"""


def place(filename):
    return f'<plugin name="mine" filename="{filename}"/>'


def simulation(**places):
    texts = {name: place(filename) for name, filename in places.items()}
    text = WORLD.format(**{"world": "", "model": "", "sensor": "", **texts})
    return gazelle.Simulation(formats.load_string(text))


@pytest.fixture
def write(tmp_path, monkeypatch):
    """Write the module ``mine`` with a text."""
    monkeypatch.syspath_prepend(str(tmp_path))
    yield lambda text: (tmp_path / "mine.py").write_text(HEAD + text, encoding="utf-8")
    sys.modules.pop("mine", None)


def live(place):
    """Do all that asks a plugin for something, twice."""
    sim = simulation(**{place: "mine:Mine"})
    for _ in range(2):
        sim.run(seconds=0.01)
        sim.restore(sim.snapshot())
        sim.reset(seed=3)
    return sim


KINDS = [("world", "WorldPlugin"), ("model", "ModelPlugin"), ("sensor", "SensorPlugin")]
FAULTS = [
    ("load(self, entity, parameters)", "while loading and is left out"),
    ("on_update(self, time)", "at 0 s and is detached"),
    ("reset(self, worlds)", "at a reset and is detached"),
    ("reseed(self, seed, worlds)", "at a reset with a seed and is detached"),
    ("state(self)", "at a snapshot and is detached"),
    ("restore(self, state)", "while restoring a snapshot and is detached"),
]


@pytest.mark.parametrize(("place", "kind"), KINDS)
@pytest.mark.parametrize(("method", "when"), FAULTS)
def test_a_fault_anywhere_is_told_once_and_the_simulation_goes_on(write, place, kind, method, when):
    write(f"class Mine({kind}):\n    update_rate = 0.0\n    def {method}:\n        1 / 0\n")
    owner = "" if place == "world" else " of 'box'"
    with pytest.warns(PluginWarning) as told:
        sim = live(place)
    assert len(told) == 1
    text = str(told[0].message)
    assert f"plugin 'mine'{owner} failed {when}: ZeroDivisionError: division by zero" in text
    assert text.endswith("mine.py:8)")
    sim.run(seconds=0.01)
    assert sim.time == pytest.approx(0.01)
    sim.close()


def test_what_is_asked_of_the_library_in_vain_is_told_with_the_plugins_own_line(write):
    write("""class Mine(ModelPlugin):
    def load(self, robot, parameters):
        robot.outputs["x"] = Output("/x", float, lambda: 1.0)
        robot.joints["elbow"]
""")
    with pytest.warns(PluginWarning, match=r"string:5: plugin 'mine' of 'box'.*'elbow'.*py:8\)"):
        sim = simulation(model="mine:Mine")
    assert not sim.robots["box"].outputs  # what it opened before is closed
    sim.close()


@pytest.mark.parametrize("text", ["class Mine(\n", "1 / 0\n", "Mine = 3\n", ""])
def test_a_module_that_cannot_be_had_is_named(write, text):
    write(text)
    with pytest.warns(PluginWarning, match="plugin 'mine' of 'box' failed while loading"):
        simulation(model="mine:Mine").close()


def test_a_class_that_a_module_lacks_has_the_nearest_named(write):
    write("class Hop(ModelPlugin):\n    pass\n")
    with pytest.warns(PluginWarning, match="module 'mine' has no 'Hup'; did you mean 'Hop'"):
        simulation(model="mine:Hup").close()


@pytest.mark.parametrize(
    ("place", "kind", "wanted"),
    [
        ("model", "SensorPlugin", "a <sensor>"),
        ("sensor", "ModelPlugin", "a <model>"),
        ("world", "ModelPlugin", "a <model>"),
        ("model", "WorldPlugin", "a <world>"),
        ("world", "ModelPlugin, SensorPlugin", "a <model> or a <sensor>"),
    ],
)
def test_a_plugin_in_an_element_of_another_kind_is_named(write, place, kind, wanted):
    write(f"class Mine({kind}):\n    pass\n")
    text = rf"\(mine:Mine\) belongs into {wanted}, not into a <{place}>, and is left out"
    with pytest.warns(SimulationWarning, match=text):
        simulation(**{place: "mine:Mine"}).close()


def test_a_fault_in_reading_a_sensor_ends_the_topic_alone(write):
    write("""class Mine(SensorPlugin):
    def load(self, sensor, parameters):
        output = SensorOutput(sensor, "/mine", float, read=lambda: 1 / 0)
        sensor.robot.outputs["mine"] = output
""")
    sim, heard = simulation(sensor="mine:Mine"), []
    sim.robots["box"].outputs["mine"].subscribe(heard.append)
    with pytest.warns(PluginWarning, match=r"topic '/mine' of 'box::link::eye' failed") as told:
        sim.run(seconds=0.5)
    assert len(told) == 1
    assert not heard
    assert sim.time == pytest.approx(0.5)
    sim.close()


def test_a_system_plugin_is_given_besides_the_world(write):
    write("""class Mine(SystemPlugin):
    update_rate = 0.0
    def load(self, simulation, parameters):
        self.times = simulation.ports.times = []
    def on_update(self, time):
        self.times.append(time)
    def reset(self, worlds):
        self.times.clear()
""")
    with simulation() as sim:
        sim.load_plugin("mine:Mine")
        sim.run(seconds=0.005)
        assert sim.ports.times == pytest.approx([0.0, 0.001, 0.002, 0.003, 0.004])
        sim.reset()
        assert sim.ports.times == []


def test_a_system_plugin_that_is_not_there_is_named():
    with simulation() as sim, pytest.warns(PluginWarning, match="'nowhere:Mine' failed"):
        sim.load_plugin("nowhere:Mine")


def test_a_visuals_plugin_is_known_too(write):
    text = WORLD.format(world="", model="", sensor="").replace(
        "</link>",
        f"""<visual name="v"><geometry><box><size>1 1 1</size></box></geometry>
        {place("libgazebo_ros_video.so")}{place("mine:Mine")}</visual></link>""",
    )
    write("class Mine(ModelPlugin):\n    pass\n")
    with pytest.warns(SimulationWarning) as told:
        gazelle.Simulation(formats.load_string(text)).close()
    texts = [str(each.message) for each in told]
    assert "projected images are not shown" in texts[0]
    assert "belongs into a <model>, not into a <visual>" in texts[1]
    assert len(texts) == 2
    again = formats.load_string(formats.to_string(formats.load_string(text), "sdf"))
    kept = again.models[0].links[0].visuals[0].plugins
    assert [plugin.filename for plugin in kept] == ["libgazebo_ros_video.so", "mine:Mine"]
