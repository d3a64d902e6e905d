"""The table of ros_control's suites: its stand-ins are there, and its clients are found."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from rossuites import stacks
from rossuites.compiling import Client, clients_of
from rossuites.control import CONTROL

ROBOTS = Path(stacks.__file__).parent / "robots"
CMAKE = """
add_executable(arm test/arm.cpp)
add_executable(arm_test test/arm_test.cpp)
add_rostest_gtest(${PROJECT_NAME}_test
  test/first.test
  test/first_test.cpp test/common.cpp)
add_rostest_gtest(fast_test test/fast.test test/first_test.cpp)
target_compile_definitions(fast_test PRIVATE FAST=1)
add_rostest_gtest(own_classes_test test/own_classes.test test/own_classes_test.cpp)
catkin_add_gtest(unit_test test/unit_test.cpp)
"""


@pytest.mark.parametrize("suite", CONTROL, ids=lambda suite: suite.name)
def test_stand_ins_of_a_suites_robots_are_there(suite):
    assert suite.robots
    for command in suite.robots.values():
        file = ROBOTS / command.split()[0]
        ast.parse(file.read_text(encoding="utf-8"))


def test_clients_are_those_that_its_build_declares_for_the_files_that_are_run(tmp_path):
    package = tmp_path / "arm_controller"
    package.mkdir()
    (package / "CMakeLists.txt").write_text(CMAKE, encoding="utf-8")
    assert list(clients_of(package, {"test/first.test": 1, "test/fast.test": 2})) == [
        Client("arm", ("test/arm.cpp",)),
        Client("arm_test", ("test/arm_test.cpp",)),
        Client("arm_controller_test", ("test/first_test.cpp", "test/common.cpp")),
        Client("fast_test", ("test/first_test.cpp",), ("FAST=1",)),
    ]


def test_a_stand_in_is_started_with_its_arguments(tmp_path):
    stacks.put_robots({"robot": "diffbot.py 2"}, tmp_path)
    script = (tmp_path / "robot").read_text(encoding="utf-8")
    assert f'"{ROBOTS}/"diffbot.py 2 "$@"' in script
