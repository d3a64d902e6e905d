"""``gazelle check`` of launch files: each node, and whether its program is there."""

from __future__ import annotations

import json

import pytest

LAUNCH = """<launch>
  <arg name="package"/>
  <node pkg="topic_tools" type="relay" name="one"/>
  <node pkg="topic_tools" type="relay" name="two"/>
  <node pkg="topic_tools" type="relai" name="three"/>
  <node pkg="$(arg package)" type="driver" name="four"/>
  <node pkg="rviz" type="rviz" name="five"/>
</launch>
"""


@pytest.fixture
def launch(tmp_path, monkeypatch):
    """Return a launch file beside a package with a driver."""
    driver = tmp_path / "src/laser/driver"
    driver.parent.mkdir(parents=True)
    (driver.parent / "package.xml").write_text("<package><name>laser</name></package>")
    driver.write_text("#!/bin/sh\n")
    driver.chmod(0o755)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "robot.launch").write_text(LAUNCH)
    return "robot.launch"


def test_each_program_is_listed_with_its_place(cli, launch, tmp_path):
    code, out, _ = cli("check", launch, "package:=laser")
    assert code == 1
    listed = [tuple(line.split(maxsplit=1)) for line in out.splitlines() if line.startswith("  ")]
    assert listed[:4] == [
        ("topic_tools/relay", "built in"),
        ("topic_tools/relai", "missing"),
        ("laser/driver", str(tmp_path / "src/laser")),
        ("rviz/rviz", "left out"),
    ]
    assert "error: robot.launch:5: package 'topic_tools' has no program 'relai'" in out
    assert "warning: robot.launch:7: /five is left out: it is a window for people" in out
    assert out.endswith("robot.launch: 1 error, 1 warning\n")


def test_a_missing_package_is_an_error_with_its_line(cli, launch):
    code, out, _ = cli("check", "--json", launch, "package:=lazer")
    errors = [each for each in json.loads(out) if each["severity"] == "error"]
    assert code == 1
    assert [(each["line"], each["message"]) for each in errors] == [
        (5, "package 'topic_tools' has no program 'relai'"),
        (6, "there is no package 'lazer'"),
    ]
    assert "did you mean 'laser'" in errors[1]["hint"]


def test_a_launch_file_that_cannot_be_read_is_an_error(cli, launch, tmp_path):
    code, out, _ = cli("check", launch)
    assert code == 1
    assert "error: robot.launch:6: the argument 'package' has no value" in out
    (tmp_path / "broken.launch").write_text("<launch><node></launch>")
    code, out, _ = cli("check", "broken.launch")
    assert code == 1
    assert "broken.launch:1" in out


def test_one_of_which_all_is_there_is_good(cli, tmp_path):
    file = tmp_path / "good.launch"
    file.write_text('<launch><node pkg="topic_tools" type="relay" name="a" args="/b"/></launch>')
    code, out, _ = cli("check", str(file))
    assert (code, out) == (0, f"  topic_tools/relay  built in\n{file}: ok\n")


def test_arguments_without_a_file_are_an_error(cli):
    code, _, error = cli("check", "model:=burger")
    assert code == 1
    assert "there is no file to check" in error


@pytest.mark.parametrize("command", ["load {} manager", "standalone {}"])
def test_a_nodelet_is_looked_for_by_its_class(cli, tmp_path, command):
    file = tmp_path / "nodelets.launch"
    nodes = [
        f'<node pkg="nodelet" type="nodelet" name="{name}" args="{command.format(kind)}"/>'
        for name, kind in (
            ("mux", "yocs_cmd_vel_mux/CmdVelMuxNodelet"),
            ("other", "yocs_cmd_vel_mux/CmdVelMux"),
        )
    ]
    file.write_text("\n".join(["<launch>", *nodes, "</launch>"]))
    code, out, _ = cli("check", str(file))
    assert code == 1
    assert "nodelet/nodelet yocs_cmd_vel_mux/CmdVelMuxNodelet  built in" in out
    assert "nodelets.launch:3: there is no nodelet 'yocs_cmd_vel_mux/CmdVelMux'" in out
    assert "did you mean 'yocs_cmd_vel_mux/CmdVelMuxNodelet'?" in out
