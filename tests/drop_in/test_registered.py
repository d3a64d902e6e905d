"""Modules under foreign names are registered as entry points."""

import subprocess
import sys
import tomllib
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

import gazelle.drop_in
import gazelle_ros.drop_in
from gazelle_ros.base import entry_points
from gazelle_ros.base.entry_points import entry_points_of
from gazelle_ros.compat import finder

HOMES = [Path(package.__file__).parent for package in (gazelle.drop_in, gazelle_ros.drop_in)]
PRIVATE = {"moveit_client", "shared"}
"""Parts that several of them use; no script imports these."""


def listed(home):
    """Return entry points in the pyproject.toml of a package of such modules, by name."""
    project = home.parents[1] / "pyproject.toml"
    if not project.exists():
        pytest.skip("there is no pyproject.toml: this is an installed package")
    groups = tomllib.loads(project.read_text(encoding="utf-8"))["project"]["entry-points"]
    return groups[finder.GROUP]


@pytest.mark.parametrize("home", HOMES)
def test_each_is_listed_and_is_there(home):
    names = {path.stem for path in home.glob("*.py")} | {
        p.parent.name for p in home.glob("*/__init__.py")
    }
    names -= {"__init__", *PRIVATE}
    assert listed(home) == {name: f"{home.parent.name}.drop_in.{name}" for name in names}


@pytest.mark.parametrize("home", HOMES)
def test_the_installation_has_them(home):
    assert listed(home).items() <= finder.substitutes().items()


@pytest.mark.parametrize(
    ("project", "expected"),
    [
        ('[project]\nname = "gazelle"\n[project.entry-points."a.group"]\nnew = "here"\n', "here"),
        ('[project]\nname = "gazelle"\n', None),  # it has none in that group any more
        ('[project]\nname = "other"\n', "recorded"),
        ("", "recorded"),
        (None, "recorded"),  # as in an installed wheel
    ],
)
def test_a_checkout_needs_no_new_installation(tmp_path, monkeypatch, project, expected):
    info = tmp_path / "gazelle-0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: gazelle\nVersion: 0\n")
    (info / "entry_points.txt").write_text("[a.group]\nnew = recorded\n")
    if project is not None:
        (tmp_path / "pyproject.toml").write_text(project)
    monkeypatch.setattr(entry_points, "_PROJECTS", [tmp_path / "pyproject.toml"])
    monkeypatch.setattr(sys, "path", [str(tmp_path)])
    entry_points_of.cache_clear()
    try:
        found = entry_points_of("a.group").get("new")
    finally:
        monkeypatch.undo()
        entry_points_of.cache_clear()
    assert (found.value if found else None) == expected


@pytest.mark.parametrize(
    ("name", "place"),
    [
        ("rospy.topics", "gazelle_ros.compat.rospy.topics"),
        ("gym.spaces", "gazelle.drop_in.gym.spaces"),
        ("gym", "gazelle.drop_in.gym"),
        ("other.deep.module", "elsewhere.inside.deep.module"),
        ("rosbag", "gazelle_ros.compat.rosbag"),
    ],
)
def test_a_module_is_where_its_entry_point_says_but_ours_of_ros_first(monkeypatch, name, place):
    points = {"gym": "gazelle.drop_in.gym", "other": "elsewhere.inside", "rosbag": "elsewhere.bag"}
    found = {name: EntryPoint(name, value, finder.GROUP) for name, value in points.items()}
    monkeypatch.setattr(finder, "entry_points_of", lambda group: found)
    finder.substitutes.cache_clear()
    try:
        assert finder.place_of(name) == place
    finally:
        monkeypatch.undo()
        finder.substitutes.cache_clear()


def test_entry_points_are_read_for_missing_modules_only():
    code = (
        "import gazelle_ros as ros, sys\n"
        "with ros.install():\n"
        "    import rospy, yaml, json.tool\n"
        "    assert 'importlib.metadata' not in sys.modules\n"
        "    import gym, moveit_ros_planning_interface\n"
        "    print(gym.__name__, moveit_ros_planning_interface.__name__)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout == "gazelle.drop_in.gym gazelle.drop_in.moveit_ros_planning_interface\n"


def test_a_list_that_an_old_build_left_in_the_checkout_hides_none(tmp_path, monkeypatch):
    for folder, group in (("old", "console_scripts"), ("new", "a.group")):
        info = tmp_path / folder / "some_package-1.0.dist-info"
        info.mkdir(parents=True)
        (info / "METADATA").write_text("Metadata-Version: 2.1\nName: some-package\nVersion: 1.0\n")
        (info / "entry_points.txt").write_text(f"[{group}]\nname = some_package\n")
    monkeypatch.setattr(sys, "path", [str(tmp_path / "old"), str(tmp_path / "new")])
    entry_points_of.cache_clear()
    try:
        assert entry_points_of("a.group")["name"].value == "some_package"
    finally:
        monkeypatch.undo()
        entry_points_of.cache_clear()
