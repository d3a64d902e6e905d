"""A script that imports what is not there is told what to do."""

import builtins
import os
import sys

import pytest

import gazelle.ros as ros
from gazelle.ros.compat.finder import own_modules
from gazelle.ros.compat.module_hints import ADVICE, PIP, module_hint
from gazelle.ros.compat.script import run_script
from gazelle.ros.messages import load_message


@pytest.fixture
def run(monkeypatch):
    """``run_script``, without what it leaves behind in a process of its own."""
    monkeypatch.setitem(sys.modules, "__main__", sys.modules["__main__"])
    monkeypatch.setattr(sys, "argv", sys.argv)
    monkeypatch.setattr(sys, "path", list(sys.path))
    for name in ("PATH", "PYTHONPATH"):
        monkeypatch.setenv(name, os.environ.get(name, ""))
    yield run_script
    ros.uninstall()


@pytest.mark.parametrize(
    ("line", "hint"),
    [
        ("import psutil", "pip install psutil"),
        ("import serial", "pip install pyserial"),
        ("from serial.tools import list_ports", "pip install pyserial"),
        ("import em", "pip install empy==3.3.4"),
        ("from catkin_pkg.package import parse_package", "pip install catkin_pkg"),
        ("from urdf_parser_py.urdf import URDF", "pip install urdf-parser-py"),
        ("from pykdl_utils.kdl_kinematics import KDLKinematics", "kdl_parser_py"),
        ("import smach_ros", "executive_smach"),
        ("from foo_msgs.msg import Foo", "'foo_msgs' are not bundled"),
        ("from python_qt_binding import QtGui", "gazelle view"),
        ("from PyKDL import ChainDynParam", "dynamics are not there"),
    ],
)
def test_the_last_line_says_what_to_do(run, tmp_path, capsys, monkeypatch, line, hint):
    missing = line.split()[1].split(".")[0]
    real = builtins.__import__

    def without(name, *rest, **more):
        if name.split(".")[0] == missing and missing != "PyKDL":
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        return real(name, *rest, **more)

    script = tmp_path / "script.py"
    script.write_text(line)
    monkeypatch.setattr(builtins, "__import__", without)
    assert run(str(script)) == 1
    last = capsys.readouterr().err.splitlines()[-1]
    assert last.startswith("hint: ")
    assert hint in last


@pytest.mark.parametrize("name", ["no_such_module_at_all", "foo.bar"])
def test_of_what_nobody_knows_nothing_is_said(name):
    assert module_hint(name) is None


def test_the_tables_name_nothing_that_is_here():
    assert not {*PIP, *ADVICE} & own_modules()
    assert not PIP.keys() & ADVICE.keys()


@pytest.mark.parametrize(
    ("name", "digest"),
    [
        ("costmap_2d/VoxelGrid", "48a040827e1322073d78ece5a497029c"),
        ("mav_msgs/Actuators", "25741daf38ed25442e3a66a855ee8d9c"),
        ("jsk_recognition_msgs/BoundingBoxArray", "c8f4a8bb1acd18ce778d183912bb472d"),
        ("jsk_recognition_msgs/RectArray", "e83b38fbaea3a641fa77f009f9bf492e"),
    ],
)
def test_definitions_are_those_of_ros(name, digest):
    assert load_message(name)._md5sum == digest
