"""Other files on the search paths change no task, and hide nothing bundled."""

import subprocess
import sys
import warnings

import gymnasium as gym
import numpy as np
import pytest

import gazelle
import gazelle.envs  # registers the tasks
from gazelle import formats
from gazelle.errors import FormatWarning
from gazelle.formats import loader

CONFIG = "<model><name>x</name><sdf version='1.6'>model.sdf</sdf></model>"
BARE = "<sdf version='1.6'><model name='{}'><link name='theirs'/></model></sdf>"
WORLD = (
    "<sdf version='1.6'><world name='w'><include><uri>model://ground_plane</uri></include>"
    "<include><uri>model://turtlebot3_burger</uri></include></world></sdf>"
)


def crowd(folder):
    """Create models and packages with Gazelle's own names, and unlike them."""
    for name in ("turtlebot3_burger", "turtlebot3_square", "sun", "ground_plane", "empty"):
        place = folder / "sim" / "models" / name
        place.mkdir(parents=True)
        (place / "model.config").write_text(CONFIG)
        (place / "model.sdf").write_text(BARE.format(name))
    for name in ("turtlebot3_description", "turtlebot3_gazebo", "sim"):
        place = folder / name
        (place / "urdf").mkdir(parents=True, exist_ok=True)
        (place / "package.xml").write_text(
            f"<package><name>{name}</name><export><gazebo_ros "
            "gazebo_model_path='${prefix}/models'/></export></package>"
        )
        (place / "urdf" / "turtlebot3_burger.urdf.xacro").write_text("<robot/>")
    (folder / "turtlebot3_stage_1").mkdir()
    return folder


@pytest.fixture(params=["packages", "models", "both"])
def crowded(tmp_path, monkeypatch, request):
    """Return a full workspace on the search paths, and as the working folder."""
    folder = crowd(tmp_path)
    if request.param != "models":
        monkeypatch.setenv("ROS_PACKAGE_PATH", f"{folder}:{folder / 'sim'}")
    if request.param != "packages":
        monkeypatch.setenv("GAZEBO_MODEL_PATH", str(folder / "sim" / "models"))
    monkeypatch.chdir(folder)
    monkeypatch.setattr(loader, "_warned", set())
    return folder


def rollout():
    env = gym.make("gazelle/TurtleBot3Stage1-v0", engine="planar")
    seen = [env.reset(seed=3)[0]]
    seen += [env.step(2)[0] for _ in range(5)]
    env.close()
    return np.concatenate([np.ravel(each) for each in seen])


def test_a_task_is_the_same_in_any_company(tmp_path, monkeypatch):
    alone = rollout()
    folder = crowd(tmp_path)
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{folder}:{folder / 'sim'}")
    monkeypatch.setenv("GAZEBO_MODEL_PATH", str(folder / "sim" / "models"))
    monkeypatch.chdir(folder)
    assert rollout().tolist() == alone.tolist()


def test_bundled_worlds_are_made_of_bundled_models(crowded):
    world = formats.load("turtlebot3_stage_1")
    links = {link.name for model in world.models for link in model.links}
    assert "theirs" not in links


@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
def test_a_bundled_robot_can_be_spawned_and_driven(crowded):
    with gazelle.Simulation("empty") as sim:
        robot = sim.spawn("turtlebot3_burger")
        assert "cmd_vel" in robot.inputs
        assert "theirs" not in robot.links


def test_that_there_is_another_of_the_name_is_told_once(crowded, monkeypatch):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        for _ in "12":
            assert formats.load_model("turtlebot3_burger").plugins
    told = [each for each in said if "another is in" in str(each.message)]
    assert len(told) == 1
    assert str(crowded) in str(told[0].message)
    assert told[0].category is FormatWarning


def test_a_users_own_file_means_the_users_own_models(crowded):
    (crowded / "own").mkdir()
    (crowded / "own" / "w.world").write_text(WORLD)
    names = [[link.name for link in m.links] for m in formats.load(crowded / "own/w.world").models]
    assert names == [["theirs"], ["theirs"]]
    assert formats.load_model("model://turtlebot3_burger").links[0].name == "theirs"


def test_a_folder_given_by_name_goes_before_what_is_bundled(crowded):
    models = crowded / "sim" / "models"
    found = formats.load_model("turtlebot3_burger", paths=[models])
    assert found.links[0].name == "theirs"


@pytest.mark.long
@pytest.mark.corpus
def test_the_robots_makers_own_packages_do_not_matter(corpus, monkeypatch, tmp_path):
    theirs = corpus / "ROBOTIS-GIT__turtlebot3_simulations"
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{theirs}:{corpus / 'ROBOTIS-GIT__turtlebot3'}")
    monkeypatch.setenv("GAZEBO_MODEL_PATH", str(theirs / "turtlebot3_gazebo" / "models"))
    assert len(rollout()) > 6
    command = ["run", "empty", "--spawn", "turtlebot3_burger", "--for", "0.1", "--rate", "max"]
    run = subprocess.run(
        [sys.executable, "-m", "gazelle", *command],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
        cwd=tmp_path,
    )
    assert run.returncode == 0, run.stderr
    assert run.stderr.count("another is in") == 1
