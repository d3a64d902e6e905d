"""A user's own package with a task: found, trained, evaluated and resumed as typed in a shell."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

from gazelle.errors import PluginWarning, TaskError
from gazelle.training import find_task, list_tasks
from gazelle.training.importing import TaskModule, load_entry_points

TASK = '''
import gymnasium as gym
import numpy as np


class Reach(gym.Env):
    """Step towards a place on a line."""

    observation_space = gym.spaces.Box(-2.0, 2.0, (2,), np.float32)
    action_space = gym.spaces.Discrete(2)

    def __init__(self, width=1.0):
        self.width = width

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        self.place, self.goal = self.np_random.uniform(-self.width, self.width, 2)
        return self.look(), {"scenario": [self.place, self.goal]}

    def step(self, action):
        self.place += 0.1 * (2 * int(action) - 1)
        success = abs(self.place - self.goal) < 0.1
        lost = abs(self.place) > 1.9
        info = {"is_success": success, "is_collision": lost}
        return self.look(), float(success) - 0.01, success or lost, False, info

    def look(self):
        return np.array([self.place, self.goal], np.float32)


def register(name="%(id)s"):
    if name not in gym.registry:
        gym.register(name, entry_point=Reach, max_episode_steps=60)


%(call)s
'''
SHORT = ("--steps", "2048", "--num-envs", "8")


def gazelle(folder, *arguments, path=""):
    """Run a user's command in a folder, without anything of this test's on the path."""
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    if path:
        environment["PYTHONPATH"] = str(path)
    return subprocess.run(
        [str(Path(sys.executable).with_name("gazelle")), *map(str, arguments)],
        cwd=folder, env=environment, capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip


def package(folder, name="my_robots", env_id="my/Reach-v0", call="register()"):
    home = folder / name
    home.mkdir(parents=True)
    (home / "__init__.py").touch()
    (home / "tasks.py").write_text(TASK % {"id": env_id, "call": call})
    return home


def only_run(folder):
    (run,) = (folder / "runs").iterdir()
    return run


@pytest.mark.parametrize(
    ("task", "given"),
    [
        ("my/Reach-v0", ("--import", "my_robots.tasks")),
        ("my_robots.tasks:Reach", ()),
    ],
)
@pytest.mark.slow
def test_a_package_in_the_users_folder(tmp_path, task, given):
    """Trained in its folder; evaluated, resumed and extended from another."""
    home, elsewhere = tmp_path / "work", tmp_path / "elsewhere"
    elsewhere.mkdir()
    package(home)
    trained = gazelle(home, "train", task, *given, *SHORT)
    assert trained.returncode == 0, trained.stderr
    run = only_run(home)
    config = json.loads((run / "config.json").read_text())
    assert config["task"] == "my/Reach-v0"
    assert config["imports"] == [{"module": "my_robots.tasks", "folder": str(home)}]
    asked = gazelle(elsewhere, "eval", run, "--episodes", "20")
    assert asked.returncode == 1
    assert "imports code: 'my_robots.tasks' from the folder" in asked.stderr
    found = gazelle(elsewhere, "eval", run, "--episodes", "20", "--json", "--trust")
    assert found.returncode == 0, found.stderr
    assert json.loads(found.stdout)["distinct"] == 20
    more = gazelle(elsewhere, "train", "--resume", run, "--steps", "4096", "--trust")
    assert more.returncode == 0, more.stderr
    assert "2,048 control steps" in more.stdout


@pytest.mark.slow
def test_an_installed_package_with_an_entry_point(tmp_path):
    """As pip lays it out: the package and its metadata on the path; nothing is imported by hand."""
    site = tmp_path / "site"
    package(site, "reaching", "reaching/Reach-v0", call="")
    about = site / "reaching-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: reaching\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text("[gazelle.tasks]\nreach = reaching.tasks:register\n")
    listed = gazelle(tmp_path, "tasks", path=site)
    assert "reaching/Reach-v0" in listed.stdout
    trained = gazelle(tmp_path, "train", "reaching/Reach-v0", *SHORT, path=site)
    assert trained.returncode == 0, trained.stderr
    found = gazelle(tmp_path, "eval", only_run(tmp_path), "--episodes", "5", path=site)
    assert found.returncode == 0, found.stderr


@pytest.mark.parametrize(
    ("arguments", "complaint", "hint"),
    [
        (("my/Reach-v0",), "there is no task 'my/Reach-v0'", "--import MODULE"),
        (("my/Reech-v0", "--import", "my_robots.tasks"), "'my/Reech-v0'", "'my/Reach-v0'"),
        (("my/Reach-v0", "--import", "my_robot.tasks"), "no module 'my_robot'", "'my_robots'"),
        (
            ("my/Reach-v0", "--import", "my_robots.task"),
            "no module 'my_robots.task'",
            "robots.tasks'",
        ),
        (("my/Reach-v0", "--import", "my_robots/task.py"), "no file", "my_robots/tasks.py"),
        (("my/Reach-v0", "--import", "my robots"), "not the name of a module", "my_tasks.py"),
        (("my_robot.tasks:my/Reach-v0",), "no module 'my_robot'", "'my_robots'"),
        (("TurtleBot3Stge4",), "no task 'TurtleBot3Stge4'", "'TurtleBot3Stage4'"),
        (("my/X-v0", "--import", "broken"), "ZeroDivisionError", "import broken"),
        (("my/X-v0", "--import", "needy"), "needs the module 'not_there_at_all'", ""),
    ],
)
def test_mistakes_are_one_line_and_a_hint(cli, tmp_path, monkeypatch, arguments, complaint, hint):
    package(tmp_path)
    (tmp_path / "broken.py").write_text("1 / 0\n")
    (tmp_path / "needy.py").write_text("import not_there_at_all\n")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [p for p in sys.path if p not in ("", ".")])
    for name in ("my_robots", "my_robots.tasks", "broken", "needy"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    code, _, err = cli("train", *arguments)
    assert code == 1
    assert complaint in err
    assert hint in err
    assert "Traceback" not in err


@pytest.mark.parametrize("module", ["own_robots.tasks", "own_robots/tasks.py"])
def test_a_module_is_found_by_name_and_by_file(tmp_path, monkeypatch, module):
    package(tmp_path, "own_robots", "own/Reach-v0")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    found = TaskModule.find(module)
    assert found == TaskModule("own_robots.tasks", str(tmp_path))
    assert TaskModule.find(found.text()) == found
    assert find_task("own_robots.tasks:own/Reach-v0") == "own/Reach-v0"
    assert find_task("own/Reach-v0") == "own/Reach-v0"


def test_a_module_that_has_moved_is_named(tmp_path):
    gone = TaskModule("my_moved_tasks", str(tmp_path))
    with pytest.raises(TaskError, match="no module 'my_moved_tasks' in"):
        gone.load()


def test_the_module_of_a_file_begins_at_its_outermost_package(tmp_path):
    home = package(tmp_path, "outer")
    inner = home / "inner"
    inner.mkdir()
    (inner / "__init__.py").touch()
    (inner / "deep.py").touch()
    expected = TaskModule("outer.inner.deep", str(tmp_path))
    assert TaskModule.find(str(inner / "deep.py")) == expected
    assert expected.text() == str(inner / "deep.py")


def test_an_entry_point_that_fails_is_named_once_and_left_out(monkeypatch):
    point = metadata.EntryPoint("bad", "no_such_package.tasks", "gazelle.tasks")
    monkeypatch.setattr(metadata, "entry_points", lambda *, group: [point])
    with pytest.warns(PluginWarning, match="entry point 'bad'"):
        load_entry_points()
    load_entry_points()


def test_gazelles_own_tasks_are_found_as_ever():
    assert find_task("TurtleBot3Stage4") == "gazelle/TurtleBot3Stage4-v0"
    assert find_task("CartPole-v1") == "CartPole-v1"
    assert {"TurtleBot3Stage1", "AGVFleet"} <= {task.name for task in list_tasks()}
