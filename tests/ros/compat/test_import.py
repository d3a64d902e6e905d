"""Modules that `install` makes importable, without a trace afterwards."""

import importlib
import sys
import types

import pytest
from whole import needs_gazelle

import gazelle_ros as ros
from gazelle_ros.compat.finder import own_modules
from gazelle_ros.messages import search

MODULES = [
    "actionlib",
    "dynamic_reconfigure.client",
    "dynamic_reconfigure.server",
    "genpy.message",
    "message_filters",
    "rosbag",
    "rosgraph.names",
    "roslib.packages",
    "rosnode",
    "rosparam",
    "rospkg",
    "rosservice",
    "rospy.rostime",
    "rostopic",
    "tf.transformations",
    "tf2_geometry_msgs",
    "tf2_ros.buffer",
    "std_msgs.msg",
    "std_msgs.msg._String",
    "std_srvs.srv",
    "tf2_msgs.msg",
    "geometry_msgs",
]


@pytest.mark.parametrize("name", MODULES)
def test_modules_of_ros_can_be_imported(name):
    with ros.install():
        module = importlib.import_module(name)
        assert sys.modules[name] is module


def test_nothing_is_left_behind(monkeypatch):
    foreign = types.ModuleType("rospy")
    monkeypatch.setitem(sys.modules, "rospy", foreign)
    before, there = list(sys.meta_path), dict(sys.modules)
    with ros.install():
        import rospy

        assert rospy is not foreign
        assert rospy.Time(1).secs == 1
    assert sys.modules["rospy"] is foreign
    assert sys.meta_path == before
    for name in {"std_msgs.msg"} | own_modules():
        assert sys.modules.get(name) is there.get(name)


def test_installing_twice_takes_uninstalling_twice():
    ros.install()
    ros.install()
    ros.uninstall()
    import rospy

    assert rospy.__name__ == "gazelle_ros.compat.rospy"
    ros.uninstall()
    with pytest.raises(ImportError):
        importlib.import_module("rospy.core")
    ros.uninstall()


def test_a_module_is_the_same_by_each_of_its_names():
    with ros.install():
        import rospy
        import rospy.core
        import rospy.exceptions

        assert rospy.core is sys.modules["rospy.core"]
        assert rospy.exceptions.ROSException is rospy.ROSException
        assert rospy.__spec__.name == "gazelle_ros.compat.rospy"


def test_star_brings_the_classes_of_a_package():
    with ros.install():
        space = {}
        exec("from std_msgs.msg import *\nfrom std_srvs.srv import *", space)
        assert space["String"](data="x").data == "x"
        assert space["SetBool"]._request_class is space["SetBoolRequest"]
        assert "Int32" in dir(importlib.import_module("std_msgs.msg"))


def test_unknown_classes_are_import_errors():
    with ros.install():
        with pytest.raises(ImportError, match="Strin"):
            exec("from std_msgs.msg import Strin", {})
        with pytest.raises(ModuleNotFoundError):
            importlib.import_module("std_msgs.msg._Strin")
        with pytest.raises(ModuleNotFoundError):
            importlib.import_module("nothing_msgs.msg")


def test_packages_of_the_user_bring_messages_and_code(tmp_path, monkeypatch):
    package = tmp_path / "my_robot"
    (package / "msg").mkdir(parents=True)
    (package / "srv").mkdir()
    (package / "action").mkdir()
    (package / "src" / "my_robot").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>my_robot</name></package>")
    (package / "msg" / "Wheel.msg").write_text("float64 speed\n")
    (package / "srv" / "Stop.srv").write_text("---\nbool done\n")
    (package / "action" / "Go.action").write_text(
        "float64 far\n---\nbool there\n---\nfloat64 left\n"
    )
    (package / "src" / "my_robot" / "__init__.py").write_text("from my_robot.tools import two\n")
    (package / "src" / "my_robot" / "tools.py").write_text(
        "from my_robot.msg import Wheel\ntwo = Wheel(2.0)\n"
    )
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    with ros.install():
        import rospkg

        my_robot = importlib.import_module("my_robot")
        assert my_robot.two.speed == 2.0
        assert importlib.import_module("my_robot.srv").StopResponse(True).done
        assert importlib.import_module("my_robot.msg").GoActionGoal().goal.far == 0.0
        assert rospkg.RosPack().get_path("my_robot") == str(package)
        with pytest.raises(rospkg.ResourceNotFound):
            rospkg.RosPack().get_path("no_robot")
    for name in [name for name in sys.modules if name.startswith("my_robot")]:
        del sys.modules[name]


def openai_ros(folder):
    """Create a package whose messages Gazelle has too, with Python code of its own."""
    code = folder / "src" / "openai_ros"
    (code / "robot_envs").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>openai_ros</name></package>")
    (code / "__init__.py").write_text("own = True\n")
    (code / "robot_envs" / "__init__.py").write_text("")
    (code / "robot_envs" / "cube.py").write_text(
        "from openai_ros.msg import RLExperimentInfo\nname = RLExperimentInfo.__name__\n"
    )
    return code.parent


@pytest.mark.parametrize("where", ["ROS_PACKAGE_PATH", "PYTHONPATH"])
def test_the_code_of_a_package_whose_messages_are_bundled_is_the_users(
    where, tmp_path, monkeypatch
):
    source = openai_ros(tmp_path / "deep" / "openai_ros")
    if where == "PYTHONPATH":
        monkeypatch.syspath_prepend(str(source))
    else:
        monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    search.forget()
    with ros.install():
        assert importlib.import_module("openai_ros").own
        assert importlib.import_module("openai_ros.robot_envs.cube").name == "RLExperimentInfo"
        assert importlib.import_module("openai_ros.msg").RLExperimentInfo
    for name in [each for each in sys.modules if each.startswith("openai_ros")]:
        del sys.modules[name]
    search.forget()


def test_a_package_without_code_still_has_its_messages():
    with ros.install():
        assert importlib.import_module("openai_ros.msg").RLExperimentInfo


@needs_gazelle
@pytest.mark.parametrize("where", ["ROS_PACKAGE_PATH", "PYTHONPATH", None])
def test_the_users_own_moveit_commander_comes_before_ours(where, tmp_path, monkeypatch):
    package = tmp_path / "deep" / "moveit_commander"
    code = package / "src" / "moveit_commander"
    code.mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>moveit_commander</name></package>")
    (code / "__init__.py").write_text("from .robot import *\nown = True\n")
    (code / "robot.py").write_text(
        "from moveit_ros_planning_interface import _moveit_robot_interface as below\n"
    )
    if where == "PYTHONPATH":
        monkeypatch.syspath_prepend(str(code.parent))
    elif where is not None:
        monkeypatch.setenv(where, str(tmp_path))
    search.forget()
    with ros.install():
        found = importlib.import_module("moveit_commander")
        below = importlib.import_module("moveit_ros_planning_interface._moveit_robot_interface")
        assert below.RobotInterface.__module__.startswith("gazelle.")
        if where is None:
            assert found.RobotCommander.__module__.startswith("gazelle.")
        else:
            assert found.own
            assert found.below is below
    for name in [each for each in sys.modules if each.startswith("moveit_commander")]:
        del sys.modules[name]
    search.forget()
