"""``gazelle check`` of launch files: each node and its program, worlds and robots."""

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


MOVE_BASE = """<launch>
  <node pkg="move_base" type="move_base" name="move_base" ns="robot">
    <rosparam>{{global_costmap: {{robot_radius: 0.2, plugins: []}}, local_costmap: {{plugins: []}}}}</rosparam>
    <param name="{name}" value="{value}"/>
  </node>
</launch>
"""


@pytest.mark.parametrize(
    ("name", "value", "row", "text"),
    [
        (
            "base_global_planner",
            "global_planner/GlobalPlaner",
            ("global_planner/GlobalPlaner", "missing"),
            ":4: there is no global planner of type 'global_planner/GlobalPlaner'\n  hint: did you mean",
        ),
        (
            "base_local_planner",
            "dwa_local_planner/DWAPlannerROS",
            ("dwa_local_planner/DWAPlannerROS", "built in"),
            ": ok",
        ),
        (
            "base_local_planner",
            "nowhere_to_be_found:Planner",
            ("nowhere_to_be_found:Planner", "your own"),
            ": ok",
        ),
        (
            "base_local_planner",
            "nav_core_adapter::LocalPlannerAdapter",
            ("nav_core_adapter::LocalPlannerAdapter", "missing"),
            ":4: there is no local planner of type 'nav_core_adapter::LocalPlannerAdapter'",
        ),
        (
            "controller_frequency",
            "0.0",
            ("navfn/NavfnROS", "built in"),
            ":2: /robot/move_base: 'controller_frequency' must be greater than zero",
        ),
        (
            "TrajectoryPlannerROS/sim_time",
            "long",
            ("base_local_planner/TrajectoryPlannerROS", "built in"),
            ":2: /robot/move_base: the parameter 'sim_time' must be of type float, not 'long'",
        ),
    ],
)
def test_planners_and_parameters_of_move_base_are_checked(cli, tmp_path, name, value, row, text):
    file = tmp_path / "move.launch"
    file.write_text(MOVE_BASE.format(name=name, value=value))
    _, out, _ = cli("check", str(file))
    rows = [line.split(maxsplit=2) for line in out.splitlines() if line.startswith("  move_base")]
    assert ["move_base/move_base", *row] in rows
    assert f"{file}{text}" in out


def test_warnings_of_costmaps_are_findings(cli, tmp_path):
    file = tmp_path / "move.launch"
    file.write_text(
        '<launch><node pkg="move_base" type="move_base" name="m">'
        '<param name="global_costmap/inflation_radius" value="0.3"/></node></launch>'
    )
    code, out, _ = cli("check", str(file))
    assert code == 0
    assert "warning: " in out
    assert "/m: global_costmap: pre-Hydro parameters" in out


WORLD = """<sdf version="1.6"><world name="default">
  <include><uri>model://nowhere</uri></include>
  <plugin name="odd" filename="libno_such_plugin.so"/>
</world></sdf>
"""
ROBOT = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="mesh" default="absent"/>
  <link name="base">
    <visual><geometry><mesh filename="package://none/$(arg mesh).stl"/></geometry></visual>
  </link>
</robot>
"""


def findings(cli, *words):
    """Return what is found, without the name of the file that was checked."""
    _, out, _ = cli("check", "--json", *words)
    return [{key: each[key] for key in each if key != "path"} for each in json.loads(out)]


def check_nodes(cli, tmp_path, *elements):
    """Return the findings about a launch file with these elements, one a line from line 2 on."""
    file = tmp_path / "loads.launch"
    file.write_text("\n".join(["<launch>", *elements, "</launch>"]))
    return findings(cli, str(file))


def places(found, tmp_path):
    """Return the file, relative to a folder, and line of each finding."""
    return [(each["file"].removeprefix(f"{tmp_path}/"), each["line"]) for each in found]


def test_the_world_of_a_launch_is_checked_as_by_itself(cli, tmp_path):
    world = tmp_path / "bad.world"
    world.write_text(WORLD)
    node = f'<node pkg="gazebo_ros" type="gzserver" name="gazebo" args="-u {world}"/>'
    found = check_nodes(cli, tmp_path, node)
    unknown = found.pop()  # said once a process
    assert f"{world}:3: plugin 'odd' (libno_such_plugin.so)" in unknown["message"]
    assert found == findings(cli, str(world))
    assert places(found[:1], tmp_path) == [("bad.world", 2)]
    assert "model://nowhere" in found[0]["message"]


def test_a_world_that_is_nowhere_is_an_error_of_the_launch_file(cli, tmp_path):
    node = '<node pkg="gazebo_ros" type="gzserver" name="gazebo" args="worlds/nowhere.world"/>'
    found = check_nodes(cli, tmp_path, node)
    assert places(found, tmp_path) == [("loads.launch", 2)]
    assert "there is no such world: 'worlds/nowhere.world'" in found[0]["message"]


def test_wrong_arguments_of_a_server_are_an_error_of_the_launch_file(cli, tmp_path):
    node = '<node pkg="gazebo_ros" type="gzserver" name="gazebo" args="--sed 3"/>'
    found = check_nodes(cli, tmp_path, node)
    assert places(found, tmp_path) == [("loads.launch", 2)]
    assert "the arguments of /gazebo are wrong" in found[0]["message"]


@pytest.mark.parametrize("source", ["command", "textfile"])
def test_a_spawned_robot_is_checked_with_the_lines_of_its_file(cli, tmp_path, source):
    robot = tmp_path / "robot.xacro"
    robot.write_text(ROBOT)
    value = {
        "command": f"$(find xacro)/xacro --inorder {robot} mesh:=other",
        "textfile": str(robot),
    }
    found = check_nodes(
        cli,
        tmp_path,
        f'<param name="ns/robot_description" {source}="{value[source]}"/>',
        '<node ns="ns" pkg="gazebo_ros" type="spawn_model" name="s"'
        ' args="-urdf -model r -param robot_description"/>',
    )
    assert places(found[:1], tmp_path) == [("robot.xacro", 4)]
    name = "other" if source == "command" else "absent"
    assert f"package://none/{name}.stl" in found[0]["message"]


def test_a_description_that_cat_reads_is_checked_as_its_file(cli, tmp_path):
    robot = tmp_path / "robot.urdf"
    robot.write_text('<robot name="r">\n<link/>\n</robot>')
    found = check_nodes(cli, tmp_path, f'<param name="robot_description" command="cat {robot}"/>')
    assert places(found, tmp_path) == [("robot.urdf", 2)]


def test_a_check_executes_no_command(cli, tmp_path):
    made = tmp_path / "made"
    parameter = f'<param name="robot_description" command="touch {made}"/>'
    assert check_nodes(cli, tmp_path, parameter) == []
    assert not made.exists()


def test_models_are_found_by_the_environment_of_their_node(cli, tmp_path):
    model = tmp_path / "models/crate"
    model.mkdir(parents=True)
    (model / "model.config").write_text("<model><sdf version='1.6'>model.sdf</sdf></model>")
    (model / "model.sdf").write_text(
        "<sdf version='1.6'><model name='crate'><static>1</static></model></sdf>"
    )
    words = "-sdf -database crate -model c"
    start = f'<node pkg="gazebo_ros" type="spawn_model" name="s" args="{words}"'
    assert places(check_nodes(cli, tmp_path, f"{start}/>"), tmp_path) == [("loads.launch", 2)]
    path = f'<env name="GAZEBO_MODEL_PATH" value="{tmp_path}/models"/>'
    assert check_nodes(cli, tmp_path, f"{start}>{path}</node>") == []
