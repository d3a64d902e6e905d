"""Packages, programs and built-in nodes."""

from __future__ import annotations

import sys

import pytest
from whole import needs_gazelle

from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin import registry
from gazelle_ros.launch import LaunchError, MissingPackageError, Packages
from gazelle_ros.launch.finding import find_launch_file, require_name
from gazelle_ros.launch.programs import Program, Skipped, command_line, program_of


def test_scripts_are_found_and_run_as_gazelle_exec_does(script):
    path = script("talk.py", "#!/usr/bin/env python3\n")
    found = program_of("robot", "talk.py", Packages())
    assert isinstance(found, Program)
    assert found.command[0] == sys.executable
    assert found.command[-2:] == ("exec", str(path))
    assert found.folder == path.parent


def test_python_scripts_need_no_executable_bit(script):
    script("talk.py", "", executable=False)
    assert isinstance(program_of("robot", "talk.py", Packages()), Program)


def test_scripts_without_suffix_are_known_by_their_first_line(script):
    path = script("talk", "#!/usr/bin/python\n")
    assert program_of("robot", "talk", Packages()).command[-1] == str(path)
    assert "exec" in program_of("robot", "talk", Packages()).command


def test_other_programs_run_as_they_are(script):
    path = script("run.sh", "#!/bin/sh\n")
    assert program_of("robot", "run.sh", Packages()).command == (str(path),)


def test_programs_that_cannot_be_executed_say_so(script):
    script("run.sh", "#!/bin/sh\n", executable=False)
    with pytest.raises(LaunchError, match="chmod"):
        program_of("robot", "run.sh", Packages())


def test_a_missing_program_is_named_with_the_closest(script):
    script("talker.py", "#!/usr/bin/env python3\n")
    with pytest.raises(LaunchError, match=r"did you mean 'talker.py'"):
        program_of("robot", "talkr.py", Packages())


def test_a_missing_script_is_not_said_to_be_compiled(tmp_path):
    (tmp_path / "arm").mkdir()
    (tmp_path / "arm" / "package.xml").write_text("<package><name>arm</name></package>")
    packages = Packages({"ROS_PACKAGE_PATH": str(tmp_path)})
    assert "'scripts' folder" in str(packages.missing_program("arm", "move.py"))
    assert "C++" in str(packages.missing_program("arm", "move"))


def test_a_missing_package_says_where_it_is_looked_for(monkeypatch):
    with pytest.raises(MissingPackageError, match="ROS_PACKAGE_PATH, which is not set"):
        program_of("nowhere", "x", Packages({}))


def test_devel_spaces_come_before_sources(tmp_path, script):
    source = tmp_path / "src" / "arm"
    built = tmp_path / "devel" / "lib" / "arm"
    for folder in (source / "scripts", built):
        folder.mkdir(parents=True)
        (folder / "move").write_text("#!/bin/sh\n")
        (folder / "move").chmod(0o755)
    (source / "package.xml").write_text("<package><name>arm</name></package>")
    packages = Packages({"ROS_PACKAGE_PATH": str(tmp_path / "src")})
    assert packages.program("arm", "move") == built / "move"
    assert packages.locate("arm", "/scripts/move") == str(built / "move")


def test_install_spaces_hold_programs_beside_the_package(tmp_path):
    share, lib = tmp_path / "share" / "arm", tmp_path / "lib" / "arm"
    share.mkdir(parents=True)
    lib.mkdir(parents=True)
    (share / "package.xml").write_text("<package><name>arm</name></package>")
    (lib / "move").write_text("#!/bin/sh\n")
    (lib / "move").chmod(0o755)
    packages = Packages({"ROS_PACKAGE_PATH": str(tmp_path / "share")})
    assert packages.program("arm", "move") == lib / "move"


@pytest.mark.parametrize(
    ("package", "kind"),
    [
        pytest.param("map_server", "map_server", marks=needs_gazelle),
        ("tf", "static_transform_publisher"),
        ("tf2_ros", "static_transform_publisher"),
        ("topic_tools", "throttle"),
        ("rosbag", "record"),
        ("rostopic", "rostopic"),
    ],
)
def test_well_known_nodes_are_built_in(package, kind):
    found = program_of(package, kind, Packages({}))
    assert found.command[-2:] == (package, kind)
    assert callable(registry.main_of(package, kind))


@pytest.mark.parametrize(
    "package", ["rviz", "rqt_plot", "rviz_plugins", "plotjuggler", "moveit_setup_assistant"]
)
def test_windows_are_left_out(package):
    assert isinstance(program_of(package, package, Packages({})), Skipped)


def test_an_installed_package_comes_before_a_built_in_one(workspace):
    folder = workspace / "topic_tools"
    folder.mkdir()
    (folder / "package.xml").write_text("<package><name>topic_tools</name></package>")
    packages = Packages()
    assert program_of("topic_tools", "relay", packages).folder is None
    (folder / "relay").write_text("#!/bin/sh\n")
    (folder / "relay").chmod(0o755)
    assert program_of("topic_tools", "relay", packages).command == (str(folder / "relay"),)


def test_packages_can_be_added(monkeypatch, tmp_path):
    monkeypatch.setattr(registry, "_registered", {})
    registry.register(
        registry.BuiltinPackage(
            "my_sim", {"server": "ros.launch.test_packages:serve"}, folder=tmp_path
        )
    )
    packages = Packages({})
    assert packages.folder("my_sim") == tmp_path
    assert program_of("my_sim", "server", packages).command[-2:] == ("my_sim", "server")
    with pytest.raises(LaunchError, match="did you mean 'server'"):
        program_of("my_sim", "servr", packages)
    with pytest.raises(RosError):
        registry.main_of("my_sim", "nope")


def test_every_built_in_node_can_be_loaded():
    for name in registry.packages():
        for kind in registry.package(name).nodes:
            assert callable(registry.main_of(name, kind)), (name, kind)


@pytest.mark.parametrize(
    "words",
    [["xacro"], ["/opt/ros/lib/xacro/xacro.py", "-v"], ["rosrun", "xacro", "xacro"]],
)
def test_xacro_is_built_in(words):
    found = command_line([*words, "f.xacro"], Packages({}))
    assert found[:3] == [sys.executable, "-m", "gazelle_ros.builtin.start"]
    assert found[3:5] == ["xacro", "xacro"]
    assert found[-1] == "f.xacro"


def test_a_missing_command_is_an_error():
    with pytest.raises(LaunchError, match="no program 'nosuchprogram'"):
        command_line(["nosuchprogram"], Packages({}))


def test_launch_files_are_found_by_package_and_name(workspace):
    launch = workspace / "robot" / "launch"
    (launch / "a.launch").write_text("<launch/>")
    packages = Packages()
    assert find_launch_file("robot", "a.launch", packages) == launch / "a.launch"
    assert find_launch_file("robot", "launch/a.launch", packages) == launch / "a.launch"
    with pytest.raises(LaunchError, match=r"did you mean 'a.launch'"):
        find_launch_file("robot", "b.launch", packages)
    with pytest.raises(LaunchError, match=r"which launch file of the package 'robot'\?") as caught:
        require_name("robot", packages)
    assert caught.value.hint == "it has: a.launch"
    require_name("nobody", packages)
    (workspace / "robot" / "other").mkdir()
    (workspace / "robot" / "other" / "a.launch").write_text("<launch/>")
    with pytest.raises(LaunchError, match="several"):
        find_launch_file("robot", "a.launch", packages)
