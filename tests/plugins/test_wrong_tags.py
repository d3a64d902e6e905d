"""Wrong values in the tags of plugins are errors of Gazelle's, whichever plugin and tag it is."""

import re
import tempfile
from dataclasses import replace
from typing import ClassVar

import pytest
from models import base, simulate

from gazelle import Error
from gazelle.description import Parameters, Plugin
from gazelle.plugins.table import TABLE
from gazelle.simulation import loading, registry, scheduled_plugin

WRONG = ("nan", "inf", "-1", "0", "1e308", "no such", "9" * 5000, "::")
PICTURE = "<image><width>4</width><height>4</height></image>"
SENSORS = f"""<sensor name="laser" type="ray"><ray><scan><horizontal><samples>4</samples>
</horizontal></scan><range><min>0.1</min><max>5</max></range></ray></sensor>
<sensor name="imu" type="imu"/><sensor name="sonar" type="sonar"/>
<sensor name="touch" type="contact"><contact><collision>c</collision></contact></sensor>
<sensor name="camera" type="camera"><camera>{PICTURE}</camera></sensor>
<sensor name="depth" type="depth"><camera>{PICTURE}</camera></sensor>
<sensor name="eyes" type="multicamera"><camera name="left">{PICTURE}</camera></sensor>"""
BY_WORD = {
    "joint": "joint0",
    "wheel_name": "joint0",
    "servo": "joint0",
    "link": "body",
    "body": "body",
    "frame": "body",
    "model": "base",
    "topic": "topic",
    "imu_": "imu",
    "name": "name",
    "type": "type",
}
"""Good texts of tags, by a word of the tag."""
SIMULATED = sorted(row.files[0] for row in TABLE if row.code)
INCOMPLETE = {
    *("ActorPlugin", "ContainPlugin", "DiffDrivePlugin", "LiftDragPlugin", "SkidSteerDrivePlugin"),
    *("TouchPlugin", "TransporterPlugin", "gazebo_grasp_fix", "gazebo_ros_control"),
    *("gazebo_ros_control_select_joints", "gazebo_ros_harness", "gazebo_ros_kobuki"),
    *("gazebo_ros_ray_sensor", "gazebo_ros_wheel_slip", "gazelle_go_to_goal", "gazelle_navigation"),
    *("hector_servo_plugin", "realsense_gazebo_plugin"),
}
"""They do not start with these tags alone: they need a child of a tag, or another plugin."""


class Asked(Parameters):
    """Tags that note which ones are asked for."""

    tags: ClassVar[set[str]] = set()

    def find(self, tag):
        self.tags.add(tag)
        return Parameters.find(self, tag)


class Starts:
    """Starts of a plugin in one simulation after another."""

    def __init__(self, monkeypatch, filename):
        model = base("").replace("</collision>", f"</collision>{SENSORS}", 1)
        self.sim, self.filename, self.failures = simulate(model, threads=1), filename, []
        self.robot = self.sim.robots["base"]
        for module in (loading, scheduled_plugin):
            monkeypatch.setattr(module, "warn_of_fault", self._note)

    def _note(self, _plugin, _name, _when, error, _source=None):
        self.failures.append(error)

    def start(self, texts):
        """Start the plugin wherever it may be, and make steps; return all errors."""
        self.failures = []
        parameters = Asked("plugin", children=tuple(Parameters(*pair) for pair in texts.items()))
        plugin = Plugin("p", self.filename, parameters)
        before, marks = list(self.sim.plugins), (self.robot.mark(), self.sim.ports.mark())
        self.sim.lock.changes += 1
        places = {vars(each).get("belongs_into") for each in registry.find(plugin).__mro__}
        if "world" in places:
            loading.load_world_plugin(self.sim, plugin)
        if "model" in places:
            model = replace(self.sim.world.models[-1], plugins=(plugin,))
            loading.start_plugins(self.sim, model, self.robot)
        for unit in self.robot.sensors.values() if "sensor" in places else ():
            loading._start(self.sim, "sensor", unit, plugin, self.robot)
        try:
            self.sim.step(2)
        except Error as error:
            self.failures.append(error)
        self.sim.lock.changes += 1
        self.sim.plugins[:] = before
        self.robot.back_to(marks[0])
        self.sim.ports.back_to(marks[1])
        return self.failures

    def good_tags(self):
        """Return texts of the tags that it reads, with which it starts, and what fails."""
        texts, failures = {}, [None]
        for _ in range(12):
            Asked.tags = set()
            failures = self.start(texts)
            for tag in sorted(Asked.tags - texts.keys()):
                found = (text for word, text in BY_WORD.items() if word in tag.lower())
                texts[tag] = next(found, "1")
            for error in failures:
                numbers = re.search(r"expected (\d+) numbers in <(.*)>", error.message)
                truth = re.search(r"expected true or false in <(.*)>", error.message)
                integer = re.search(r"expected an int in <(.*)>", error.message)
                if numbers:
                    texts[numbers[2]] = "1 " * int(numbers[1])
                if truth:
                    texts[truth[1]] = "true"
                if integer:
                    texts[integer[1]] = "1"
        return texts, failures


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_wrong_texts_of_tags(monkeypatch, tmp_path):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))  # what diverges is recorded
    foreign, refused, incomplete, count = [], [], set(), 0
    for name in SIMULATED:
        starts = Starts(monkeypatch, f"lib{name}.so")
        good, failures = starts.good_tags()
        if any("it needs a sensor of type" not in str(each) for each in failures):
            incomplete.add(name)
        for tag in good:
            for text in WRONG:
                count += 1
                for error in starts.start({**good, tag: text}):
                    said = f"<{tag}>{text:.20}</{tag}> of {name}: {error!r:.200}"
                    (refused if isinstance(error, Error) else foreign).append(said)
        starts.sim.close()
    assert not foreign
    assert incomplete <= INCOMPLETE
    assert len(refused) > 1000, len(refused)
    assert count > 4500, count
