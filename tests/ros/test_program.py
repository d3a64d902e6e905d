"""Messages and hints name the command that the user started."""

from __future__ import annotations

import importlib
import os
import subprocess
import sys

import pytest
from whole import needs_gazelle

from gazelle_ros.bags.errors import BagUnindexedError
from gazelle_ros.base.program import program_name, running
from gazelle_ros.compat.module_hints import module_hint
from gazelle_ros.master.proxy import taken_hint

PROGRAMS = [pytest.param("gazelle", marks=needs_gazelle), "gazelle-ros"]


def main_of(name):
    return importlib.import_module(f"{name.replace('-', '_')}.cli.main").main


@pytest.mark.parametrize("name", PROGRAMS)
@pytest.mark.parametrize("words", [["topc"], ["topic", "--nothing"], ["bag", "info", "/none.bag"]])
def test_an_error_begins_with_the_program(name, words, capsys):
    assert main_of(name)(words) != 0
    assert capsys.readouterr().err.startswith(f"{name}: error: ")


@pytest.mark.parametrize("name", PROGRAMS)
def test_programs_that_it_starts_name_it_too(name, tmp_path):
    with running(name):
        environment = dict(os.environ)
    command = [sys.executable, "-m", "gazelle_ros.cli.main", "exec", str(tmp_path / "none.py")]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.stderr.startswith(f"{name}: error: ")


def test_hints_name_it():
    with running("gazelle-ros"):
        hints = (BagUnindexedError("a.bag").hint, taken_hint(), module_hint("roswtf"))
    for hint, words in zip(hints, ("bag reindex a.bag", "master --port", "node info"), strict=True):
        assert f"gazelle-ros {words}" in hint


def test_a_script_names_what_is_installed(monkeypatch):
    monkeypatch.delenv("GAZELLE_PROGRAM", raising=False)
    whole = importlib.util.find_spec("gazelle") is not None
    assert program_name() == ("gazelle" if whole else "gazelle-ros")
    with running("gazelle-ros"), running("gazelle"):
        assert program_name() == "gazelle"
    assert "GAZELLE_PROGRAM" not in os.environ


@pytest.mark.parametrize(("given", "seen"), [(None, "noetic"), ("melodic", "melodic")])
def test_scripts_find_the_variables_that_ros_sets(tmp_path, monkeypatch, given, seen):
    script = tmp_path / "which.py"
    script.write_text("import os; print(os.environ['ROS_DISTRO'], os.environ['ROS_VERSION'])")
    for name in ("ROS_DISTRO", "ROS_VERSION"):
        monkeypatch.delenv(name, raising=False)
    if given is not None:
        monkeypatch.setenv("ROS_DISTRO", given)
    command = [sys.executable, "-m", "gazelle_ros", "exec", str(script)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.split() == [seen, "1"]


def test_launch_files_find_the_variables_that_ros_sets(tmp_path, monkeypatch):
    variables = ("PYTHONPATH", "ROS_PACKAGE_PATH")
    for name in variables:
        monkeypatch.delenv(name, raising=False)
    lines = [f'<param name="{name}" value="a$(env {name})"/>' for name in variables]
    file = tmp_path / "variables.launch"
    file.write_text(f"<launch>{''.join(lines)}</launch>")
    command = [sys.executable, "-m", "gazelle_ros", "launch", str(file), "--dump-params"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout == "/PYTHONPATH: a\n/ROS_PACKAGE_PATH: a\n"
