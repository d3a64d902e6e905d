"""The README works beside what its readers have installed already."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from test_documentation import ROOT, python_of

OPENAI = """<package format="2"><name>openai_ros</name><version>1.0.0</version>
<description>d</description><maintainer email="a@b.c">m</maintainer><license>MIT</license></package>"""


def robotis(corpus, folder):
    """Create ROBOTIS' own packages, whose burger has no plugins in its model."""
    theirs = [*corpus.glob("ROBOTIS-GIT__*")]
    models = corpus / "ROBOTIS-GIT__turtlebot3_simulations" / "turtlebot3_gazebo" / "models"
    return {
        "ROS_PACKAGE_PATH": os.pathsep.join(map(str, theirs)),
        "GAZEBO_MODEL_PATH": str(models),
        "TURTLEBOT3_MODEL": "waffle",
    }


def gazebo_models(corpus, folder):
    """Create the whole model database, with a ``sun`` and a ``ground_plane``."""
    return {"GAZEBO_MODEL_PATH": str(corpus / "osrf__gazebo_models")}


def old_home(corpus, folder):
    """Create a ``~/.gazebo`` of years ago, with downloaded models."""
    place = folder / "home" / ".gazebo"
    place.mkdir(parents=True)
    (place / "models").symlink_to(corpus / "osrf__gazebo_models")
    (place / "gui.ini").write_text("[geometry]\nx=0\n")
    return {"HOME": str(folder / "home")}


def learning_kits(corpus, folder):
    """Create a workspace with openai_ros, frobs_rl, arms and navigation, built and sourced."""
    package = folder / "ws" / "src" / "openai_ros"
    (package / "src" / "openai_ros" / "task_envs").mkdir(parents=True)
    (package / "package.xml").write_text(OPENAI)
    for place in ("", "task_envs"):
        (package / "src" / "openai_ros" / place / "__init__.py").write_text("HERE = True\n")
    names = ("jmfajardod__frobs_rl", "moveit__moveit_resources", "ros-planning__navigation")
    paths = [folder / "ws" / "src", *(corpus / name for name in names)]
    return {
        "ROS_PACKAGE_PATH": os.pathsep.join(map(str, paths)),
        "PYTHONPATH": str(package / "src"),
        "ROS_DISTRO": "melodic",
    }


BESIDE = (robotis, gazebo_models, old_home, learning_kits)


def run(command, environment, folder):
    folder = Path(folder) / "work"
    folder.mkdir(exist_ok=True)
    clean = {name: value for name, value in os.environ.items() if not name.startswith("ROS_")}
    done = subprocess.run(
        [sys.executable, *command],
        env=clean | environment,
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=400,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture
def everything(corpus, tmp_path):
    """Create all of it at once; search paths of a kind are joined."""
    joined = {}
    for lay in BESIDE:
        for name, value in lay(corpus, tmp_path).items():
            joined[name] = os.pathsep.join(filter(None, (joined.get(name), value)))
    return joined


@pytest.mark.long
@pytest.mark.corpus
def test_the_readme_works_beside_everything(everything, tmp_path):
    run(["-c", python_of(ROOT / "README.md")], everything, tmp_path)


@pytest.mark.long
@pytest.mark.corpus
def test_a_policy_is_trained_and_evaluated_beside_everything(everything, tmp_path):
    train(everything, tmp_path)


def train(environment, folder):
    brief = ["--engine", "planar", "--steps", "4096", "--out", "runs"]
    run(["-m", "gazelle", "train", "TurtleBot3Stage1", *brief], environment, folder)
    (made,) = (Path(folder) / "work" / "runs").iterdir()
    said = run(["-m", "gazelle", "eval", str(made), "--episodes", "8"], environment, folder)
    assert "success" in said


@pytest.mark.slow
@pytest.mark.corpus
@pytest.mark.parametrize("lay", BESIDE, ids=lambda lay: lay.__name__)
def test_the_readme_works_beside_each(lay, corpus, tmp_path):
    environment = lay(corpus, tmp_path)
    run(["-c", python_of(ROOT / "README.md")], environment, tmp_path)
    train(environment, tmp_path)
    run(["-m", "gazelle", "demo", "--steps", "8192"], environment, tmp_path)
