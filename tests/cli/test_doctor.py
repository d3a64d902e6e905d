"""``gazelle doctor``: findings about this machine."""

import importlib.metadata
import importlib.util
import os
import shutil
import socket

import pytest

from gazelle.cli import machine_checks
from gazelle.cli.machine_checks import EXTRAS, Grade, examine
from gazelle.cli.main import main
from gazelle.engines import mujoco
from gazelle.errors import EngineError
from gazelle_ros import Master

VARIABLES = (
    *("ROS_MASTER_URI", "ROS_HOSTNAME", "ROS_IP", "ROS_PACKAGE_PATH"),
    *("PYTHONPATH", "DISPLAY", "WAYLAND_DISPLAY"),
)


@pytest.fixture(autouse=True)
def plain_machine(monkeypatch):
    for name in VARIABLES:
        monkeypatch.delenv(name, raising=False)


def finding(name, part=""):
    """Return the only finding of a name whose text holds a part."""
    (found,) = [each for each in examine() if each.name == name and part in each.text]
    return found


def test_all_is_well_here(capsys):
    assert main(["doctor"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1] == "no problems"
    assert all(len(line) <= 80 for line in lines if "> " not in line and "/" not in line)


def test_each_problem_is_counted_and_has_a_command(monkeypatch, capsys):
    monkeypatch.setenv("ROS_MASTER_URI", "nonsense")
    monkeypatch.setenv("ROS_PACKAGE_PATH", "/no/such/folder")
    assert main(["doctor"]) == 1
    text = capsys.readouterr().out
    assert text.endswith("2 problems\n")
    assert "export ROS_MASTER_URI=http://localhost:11311" in text
    assert "export ROS_PACKAGE_PATH=" in text


@pytest.mark.parametrize(
    ("variable", "value", "grade", "hint"),
    [
        ("ROS_HOSTNAME", "no host is called so", Grade.PROBLEM, "export ROS_IP="),
        ("ROS_IP", "127.0.0.1", Grade.OK, ""),
        ("ROS_MASTER_URI", "http://127.0.0.1:11311", Grade.OK, ""),
        ("ROS_MASTER_URI", "ftp://localhost", Grade.PROBLEM, "export ROS_MASTER_URI="),
        ("ROS_PACKAGE_PATH", "/no/such/folder", Grade.PROBLEM, "export ROS_PACKAGE_PATH="),
    ],
)
def test_variables_of_ros(monkeypatch, variable, value, grade, hint):
    monkeypatch.setenv(variable, value)
    found = finding("ROS", variable)
    assert found.grade is grade
    assert found.hint.startswith(hint)


def test_packages_of_an_installed_ros(monkeypatch):
    monkeypatch.setenv("PYTHONPATH", "/opt/ros/noetic/lib/python3/dist-packages")
    assert finding("PYTHONPATH").hint == "unset PYTHONPATH"


def test_a_damaged_mujoco(monkeypatch):
    def fail():
        raise EngineError("MuJoCo is damaged", hint="pip install it again")

    monkeypatch.setattr(mujoco, "check_installation", fail)
    found = finding("MuJoCo")
    assert (found.grade, found.hint) == (Grade.PROBLEM, "pip install it again")


def test_missing_extras(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    found = [each for each in examine() if each.name == "extras"]
    assert [each.hint for each in found] == [f'pip install "gazelle[{each}]"' for each in EXTRAS]
    assert {each.grade for each in found} == {Grade.NOTE}


def test_modules_of_extras_are_those_of_the_project():
    requirements = importlib.metadata.requires("gazelle")
    for extra in EXTRAS:
        assert any(f'extra == "{extra}"' in each for each in requirements), extra


def test_a_taken_port(monkeypatch):
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        monkeypatch.setattr(machine_checks, "PORTS", {port: "gazelle master --port 0"})
        monkeypatch.setattr(machine_checks, "MASTER_TIMEOUT_S", 0.1)
        found = finding("ports")
    assert found.grade is Grade.NOTE
    assert found.text.startswith(f"{port} is taken")


def test_a_port_of_a_master(monkeypatch):
    with Master(port=0, rosout=False) as master:
        port = int(master.uri.rstrip("/").rpartition(":")[2])
        monkeypatch.setattr(machine_checks, "PORTS", {port: "gazelle master --port 0"})
        (found,) = machine_checks.ports()
    assert found.grade is Grade.OK
    assert found.text.startswith(f"{port}: a ROS master runs here, process {os.getpid()}")


def test_a_full_disk(monkeypatch):
    monkeypatch.setattr(shutil, "disk_usage", lambda place: shutil._ntuple_diskusage(1, 1, 0))
    found = [each for each in examine() if each.name == "disk"]
    assert {each.grade for each in found} == {Grade.PROBLEM}


def test_no_display(monkeypatch):
    assert finding("display").hint.startswith("ssh -L")
    monkeypatch.setenv("DISPLAY", ":0")
    assert finding("display").grade is Grade.OK
