"""Packages that come with Gazelle as folders, and those that other distributions bring."""

import os
import subprocess
import sys

import pytest

from gazelle import assets
from gazelle_ros.base import bundled_packages
from gazelle_ros.builtin import bundled, registry
from gazelle_ros.launch.packages import Packages

MANIFEST = """<?xml version="1.0"?>
<package format="2"><name>lab_gazebo</name><export><gazelle>
<node type="lab" main="gazelle_ros.builtin.rosout:main"/>
<node type="lab_old" main="gazelle_ros.builtin.rosout:main" process="lab"/>
</gazelle></export></package>"""


@pytest.fixture
def data(tmp_path, monkeypatch):
    """Yield a folder of data in place of Gazelle's."""
    monkeypatch.setattr(bundled_packages, "roots", lambda: (tmp_path,))
    for cached in (bundled.folders, bundled.package):
        cached.cache_clear()
    yield tmp_path
    for cached in (bundled.folders, bundled.package):
        cached.cache_clear()


def test_every_folder_of_the_data_that_has_a_manifest_is_a_package():
    names = {path.parent.name for path in assets.root().glob("*/package.xml")}
    assert {"courier_gazebo", "fleet_stage", "gazebo_ros", "stage_ros"} <= names
    for name in names:
        assert Packages({}).folder(name) == assets.root() / name
        assert name in registry.packages()


def test_a_new_folder_is_a_package_with_the_nodes_of_its_manifest_at_once(data):
    folder = data / "lab_gazebo"
    folder.mkdir()
    (folder / "package.xml").write_text(MANIFEST)
    assert Packages({}).folder("lab_gazebo") == folder
    assert registry.main_of("lab_gazebo", "lab").__module__ == "gazelle_ros.builtin.rosout"
    assert registry.package("lab_gazebo").process_names == {"lab_old": "lab"}
    assert registry.package("stage_ros") is None


def test_a_simulator_is_killed_by_the_name_of_its_server():
    package = registry.package("gazebo_ros")
    assert {package.process_names[kind] for kind in ("gazebo", "debug", "perf")} == {"gzserver"}
    assert {"gzserver", "gz", "gzclient", "spawn_model"} <= set(package.nodes)


def test_robots_are_found_without_a_simulator_being_imported():
    code = """import sys
from gazelle_ros.launch.packages import Packages
Packages({}).folder('turtlebot3_description')
print([name for name in ('numpy', 'gazelle.simulation', 'gazelle.bridges') if name in sys.modules])
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_another_distribution_brings_packages_by_entry_points(tmp_path):
    about = tmp_path / "lab-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: lab\nVersion: 1.0\n")
    points = "lab = lab_nodes:LAB\ngazebo_ros = lab_nodes:GAZEBO\n"
    (about / "entry_points.txt").write_text(f"[gazelle_ros.nodes]\n{points}")
    (tmp_path / "lab_nodes.py").write_text(
        "from gazelle_ros.builtin import BuiltinPackage\n"
        "def main(arguments): print('lab runs', *arguments); return 0\n"
        "LAB = BuiltinPackage('lab', {'run': 'lab_nodes:main'})\n"
        "GAZEBO = BuiltinPackage('gazebo_ros', {'gzserver': 'lab_nodes:main'})\n"
    )
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    for package, kind in (("lab", "run"), ("gazebo_ros", "gzserver")):
        words = [sys.executable, "-m", "gazelle_ros", "exec", "rosrun", package, kind, "fast"]
        done = subprocess.run(words, capture_output=True, text=True, env=environment, check=False)
        assert done.stdout == "lab runs fast\n", done.stderr
