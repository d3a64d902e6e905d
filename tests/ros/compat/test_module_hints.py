"""A script that imports what is not there is told what to do."""

import os
import sys

import pytest
from whole import needs_gazelle

import gazelle_ros as ros
from gazelle_ros.base.errors import RosError
from gazelle_ros.compat.finder import own_modules, substitutes
from gazelle_ros.compat.module_hints import ADVICE, PIP, module_hint
from gazelle_ros.compat.script import run_script
from gazelle_ros.messages import load_message


@pytest.fixture
def run(monkeypatch):
    """Yield ``run_script``, without its effects in a process of its own."""
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
        ("from urdf_parser_py.urdf import URDF", "pip install urdfdom-py"),
        ("from pykdl_utils.kdl_kinematics import KDLKinematics", "kdl_parser_py"),
        ("import bondpy", "https://github.com/ros/bond_core"),
        ("from foo_msgs.msg import Foo", "'foo_msgs' are not bundled"),
        ("from python_qt_binding import QtGui", "gazelle view"),
        ("import netifaces", "pip install netifaces2"),
        ("import catkin", "rospkg"),
        ("import rospyy", "did you mean 'rospy'?"),
        ("import no_such_module_at_all", "ROS_PACKAGE_PATH"),
    ],
)
def test_a_missing_module_is_one_line_that_says_what_to_do(run, tmp_path, monkeypatch, line, hint):
    missing = line.split()[1].split(".")[0]
    monkeypatch.setitem(sys.modules, missing, None)
    script = tmp_path / "script.py"
    script.write_text(f"\n{line}")
    with pytest.raises(RosError, match=f"there is no module '{missing}") as caught:
        run(str(script))
    assert hint in caught.value.hint
    assert (caught.value.file, caught.value.line) == (str(script), 2)


@pytest.mark.parametrize(
    ("line", "message", "hint"),
    [
        ("from PyKDL import ChainDynParam", "'PyKDL' has no 'ChainDynParam'", "dynamics are not"),
        ("from std_msgs.msg import Strng", "'std_msgs.msg' has no 'Strng'", "'String'"),
        ("import std_msgs.srv", "no module 'std_msgs.srv'", "no definitions of services"),
        ("import tf.transformation", "no module 'tf.transformation'", "'transformations'"),
        ("from smach_ros import ActionServerWrapper", "has no 'Action", "executive_smach"),
        pytest.param(
            *("from gym.core import Rapper", "'gym.core' has no 'Rapper'", "'Wrapper'"),
            marks=needs_gazelle,
        ),
        ("import json.nothing", "no module 'json.nothing'", "'json' has no module 'nothing'"),
    ],
)
def test_what_a_module_lacks_is_one_line(run, tmp_path, line, message, hint):
    script = tmp_path / "script.py"
    script.write_text(line)
    with pytest.raises(RosError, match=message) as caught:
        run(str(script))
    assert hint in caught.value.hint


@pytest.mark.parametrize("debug", [False, True])
def test_other_failures_keep_their_traceback(run, tmp_path, capsys, debug):
    script = tmp_path / "script.py"
    script.write_text("import no_such_module_at_all" if debug else "from json import nothing")
    assert run(str(script), debug=debug) == 1
    assert "Traceback" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("statement", "advice"),
    [
        ("import sibling", "write 'from . import sibling'"),
        ("import sibling as other  # from here", "write 'from . import sibling'"),
        ("from sibling import X", "write 'from .sibling import ...'"),
        ("from folder.inner import X", "write 'from .folder.inner import ...'"),
        ("import folder", "write 'from . import folder'"),
    ],
)
def test_a_module_beside_the_importing_one_is_python_2(run, tmp_path, statement, advice):
    package = tmp_path / "some_package_of_mine"
    for file in ("__init__.py", "sibling.py", "folder/__init__.py", "folder/inner.py"):
        (package / file).parent.mkdir(exist_ok=True)
        (package / file).write_text("X = 1")
    (package / "user.py").write_text(f"\n\n{statement}")
    script = tmp_path / "script.py"
    script.write_text("import some_package_of_mine.user")
    with pytest.raises(RosError, match="written for Python 2") as caught:
        run(str(script))
    sys.modules.pop("some_package_of_mine")
    assert advice in caught.value.hint
    assert (caught.value.file, caught.value.line) == (str(package / "user.py"), 3)


@pytest.mark.parametrize("name", ["no_such_module_at_all", "foo.bar"])
def test_of_what_nobody_knows_nothing_is_said(name):
    assert module_hint(name) is None


def test_the_tables_name_nothing_that_is_here():
    assert not {*PIP, *ADVICE} & {*own_modules(), *substitutes()}
    assert not PIP.keys() & ADVICE.keys()


@pytest.mark.parametrize(
    ("name", "digest"),
    [
        ("costmap_2d/VoxelGrid", "48a040827e1322073d78ece5a497029c"),
        ("mav_msgs/Actuators", "25741daf38ed25442e3a66a855ee8d9c"),
        ("jsk_recognition_msgs/BoundingBoxArray", "c8f4a8bb1acd18ce778d183912bb472d"),
        ("jsk_recognition_msgs/RectArray", "e83b38fbaea3a641fa77f009f9bf492e"),
        ("apriltag_ros/AprilTagDetectionArray", "2b6c03434883a5c9897c13b5594dbd91"),
        ("ar_track_alvar_msgs/AlvarMarkers", "943fe17bfb0b4ea7890368d0b25ad0ad"),
        ("vision_msgs/Classification3D", "2c0fe97799b60ee2995363b3fbf44715"),
        ("vision_msgs/Detection2DArray", "402071f61477de256df9f1aa45e6e4c8"),
        ("vision_msgs/Detection3DArray", "05c51d9aea1fb4cfdc8effb94f197b6f"),
        ("vision_msgs/VisionInfo", "eee36f8dc558754ceb4ef619179d8b34"),
    ],
)
def test_definitions_are_those_of_ros(name, digest):
    assert load_message(name)._md5sum == digest
