"""Files that let a robot be controlled: they load without a finding, and the robot does what it is told."""

from __future__ import annotations

import re

import pytest
import yaml

import gazelle
from gazelle import builders, formats
from gazelle.cli.main import main
from gazelle.control.checking import check_controllers
from gazelle.control.values import JointTarget, JointTargets, JointTrajectory, TrajectoryPoint
from gazelle.description import World
from gazelle.errors import Error
from tests.control.arms import JOINTS, arm_text

TARGETS = (0.4, -0.3)


def bare_text():
    """Return the two-link arm without any preparation."""
    text = re.sub(r"<transmission.*?</transmission>", "", arm_text(), flags=re.DOTALL)
    return re.sub(r"<gazebo>.*?</gazebo>", "", text, flags=re.DOTALL)


def send(robot, name, kind):
    manager = robot.controllers
    if kind == "trajectory":
        point = TrajectoryPoint(time=1.0, positions=TARGETS, velocities=(0.0, 0.0))
        manager[name].inputs["command"].send(JointTrajectory(tuple(JOINTS), (point,)))
    elif kind == "group":
        manager[name].inputs["command"].send(JointTargets(TARGETS))
    else:
        for joint, target in zip(JOINTS, TARGETS, strict=True):
            manager[f"{joint}_controller"].inputs["command"].send(JointTarget(target))


@pytest.mark.parametrize("kind", ["trajectory", "group", "joint"])
@pytest.mark.parametrize("interface", ["effort", "position", "velocity"])
def test_the_robot_does_what_it_is_told(tmp_path, interface, kind):
    files = builders.control_files(bare_text(), interface=interface, kind=kind)
    urdf, config, launch = files.write(tmp_path)
    assert check_controllers(config, urdf) == []
    assert formats.check(urdf) == []
    sim = gazelle.Simulation(World("w"))
    robot = sim.spawn(formats.load_model(urdf))
    given = yaml.safe_load(files.controllers)
    for name, values in given.items():
        robot.controllers.load(name, values)
    robot.controllers.start(*given)
    send(robot, list(given)[1], kind)
    sim.run(4.0)
    if interface == "velocity" and kind != "trajectory":
        reached = [robot.joints[name].velocity for name in JOINTS]
    else:
        reached = [robot.joints[name].position for name in JOINTS]
    assert reached == pytest.approx(TARGETS, abs=0.02)
    for part in (*given, urdf.name, config.name):
        assert part in launch.read_text(encoding="utf-8")


def test_gains_are_those_of_the_inertia_that_a_joint_moves():
    """A rod on a hinge: I = m l² / 3, p = 400 I, d = 40 I; turned frames make no difference."""
    rod = """<robot name="rod"><link name="world"/><link name="rod"><inertial>
    <origin xyz="0 0 -0.5" rpy="0.3 0 0"/><mass value="3"/>
    <inertia ixx="0.25" iyy="0.25" izz="0.25" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="hinge" type="continuous"><parent link="world"/><child link="rod"/>
    <origin xyz="1 2 3" rpy="0 0 1.2"/><axis xyz="1 0 0"/><limit effort="9" velocity="1"/></joint></robot>"""
    files = builders.control_files(rod, kind="joint")
    pid = yaml.safe_load(files.controllers)["hinge_controller"]["pid"]
    assert pid == {"p": 400.0, "i": 400.0, "d": 40.0, "i_clamp": 9.0}


def test_what_is_there_stays_and_mixed_interfaces_get_a_controller_each():
    one = builders.add_transmission(
        bare_text(), "elbow", interface="hardware_interface/PositionJointInterface"
    )
    files = builders.control_files(one)
    given = yaml.safe_load(files.controllers)
    assert given["effort_trajectory_controller"]["joints"] == ["shoulder"]
    assert given["position_trajectory_controller"]["joints"] == ["elbow"]
    again = builders.control_files(files.urdf)
    assert again.urdf == files.urdf
    assert again.controllers == files.controllers


def test_faults_are_told_and_nothing_is_written_over(tmp_path):
    still = '<robot name="still"><link name="a"><inertial><mass value="1"/>'
    still += '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>'
    with pytest.raises(Error, match="nothing in 'still' moves"):
        builders.control_files(still)
    with pytest.raises(Error, match="xacro"):
        builders.control_files('<robot xmlns:xacro="http://www.ros.org/wiki/xacro"/>')
    files = builders.control_files(bare_text())
    files.write(tmp_path)
    with pytest.raises(Error, match="there already"):
        files.write(tmp_path)


def test_the_command_writes_files_of_a_robot_and_of_xacro(tmp_path, capsys):
    (tmp_path / "bare.urdf").write_text(bare_text(), encoding="utf-8")
    out = tmp_path / "out"
    assert main(["new", "control", str(tmp_path / "bare.urdf"), "--out", str(out)]) == 0
    said = capsys.readouterr().out
    written = re.findall(r"wrote (.*)", said)
    assert len(written) == 3
    assert main(["check", "--urdf", *written[:2]]) == 0
    source = bare_text().replace("<robot ", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" ')
    (tmp_path / "arm.urdf.xacro").write_text(source, encoding="utf-8")
    more = ["new", "control", str(tmp_path / "arm.urdf.xacro"), "--out", str(tmp_path / "x")]
    assert main([*more, "--interface", "position", "--controller", "group"]) == 0
    text = next((tmp_path / "x" / "config").iterdir()).read_text(encoding="utf-8")
    assert yaml.safe_load(text)["group_controller"]["joints"] == JOINTS
