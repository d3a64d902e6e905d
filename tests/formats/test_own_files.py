"""Bundled files are read once in a process."""

import os
import shutil
import warnings
from pathlib import Path

import pytest

from gazelle import Simulation, formats
from gazelle.errors import FormatWarning
from gazelle.formats.resolve import Resolver

WORLD = """<sdf version='1.7'><world name='{name}'><model name='box'><static>1</static>{more}
<link name='link'/></model></world></sdf>"""


@pytest.fixture
def own(tmp_path, monkeypatch):
    """Return a folder that replaces the bundled files."""
    folder = tmp_path / "assets"
    (folder / "worlds").mkdir(parents=True)
    monkeypatch.setattr(Resolver, "assets", folder)
    return folder


def write(folder: Path, name: str, more: str = "", *, age: int = 0) -> None:
    file = folder / "worlds" / "w.world"
    file.write_text(WORLD.format(name=name, more=more))
    os.utime(file, (1000 - age, 1000 - age))


def test_a_robot_is_read_once():
    assert formats.load_model("turtlebot3_burger") is formats.load_model("turtlebot3_burger")


def test_simulations_of_one_description_are_apart():
    with Simulation("empty") as first, Simulation("empty") as second:
        first.spawn("turtlebot3_burger").set_pose((1.0, 0.0, 0.0))
        assert second.spawn("turtlebot3_burger").position[0, 0] == 0.0


def test_arguments_and_folders_are_heeded(tmp_path):
    plain = formats.load_model("turtlebot3_burger")
    assert formats.load_model("turtlebot3_burger", xacro_args={"no_such": "1"}) is not plain
    assert formats.load_model("turtlebot3_burger", paths=[tmp_path]) is not plain


def test_a_file_that_was_written_anew_is_read_anew(own):
    write(own, "before", age=10)
    assert formats.load("w").name == "before"
    write(own, "after")
    assert formats.load("w").name == "after"


def test_remarks_come_each_time(own):
    write(own, "odd", "<self_colide>1</self_colide>")
    for _ in range(2):
        with pytest.warns(FormatWarning, match="self_colide"):
            formats.load("w")


def test_files_of_users_are_read_each_time(own, tmp_path):
    write(own, "own")
    shutil.move(own / "worlds" / "w.world", tmp_path / "w.world")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        first, second = (formats.load(tmp_path / "w.world") for _ in range(2))
    assert first is not second
    assert first == second


def test_own_files_do_not_ask_the_environment():
    asking = [
        path
        for path in Resolver().assets.rglob("*.xacro")
        if "$(env" in (text := path.read_text()) or "$(optenv" in text
    ]
    assert not asking
