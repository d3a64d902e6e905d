"""`gazelle convert`."""

from __future__ import annotations

import mujoco
import pytest

from gazelle import formats


def test_xacro_to_sdf_to_urdf_to_mjcf(cli, tmp_path):
    sdf, urdf, mjcf = (tmp_path / f"burger.{kind}" for kind in ("sdf", "urdf", "xml"))
    code, out, _ = cli("convert", "turtlebot3_burger", sdf)
    assert code == 0
    assert out == f"wrote {sdf} (SDF, 1 model)\n"
    assert cli("convert", sdf, urdf)[0] == 0
    assert cli("convert", urdf, mjcf)[0] == 0
    robot = formats.load_model("turtlebot3_burger")
    assert formats.load_model(sdf) == robot
    assert formats.load_model(urdf).joints == robot.joints
    assert mujoco.MjModel.from_xml_path(str(mjcf)).njnt == 3


def test_a_world_stays_a_world_and_a_robot_a_model(cli, tmp_path):
    assert cli("convert", "turtlebot3_stage_4", tmp_path / "w.sdf")[0] == 0
    assert "<world " in (tmp_path / "w.sdf").read_text()
    assert formats.load(tmp_path / "w.sdf") == formats.load("turtlebot3_stage_4")
    assert cli("convert", "turtlebot3_burger", tmp_path / "r.sdf")[0] == 0
    assert "<world " not in (tmp_path / "r.sdf").read_text()
    assert cli("convert", "turtlebot3_burger", tmp_path / "r.world")[0] == 0
    assert "<world " in (tmp_path / "r.world").read_text()


def test_a_dash_writes_to_the_terminal(cli):
    code, out, _ = cli("convert", "turtlebot3_burger", "-", "--to", "urdf")
    assert code == 0
    assert formats.load_model_string(out).name == "turtlebot3_burger"


def test_one_model_of_a_world_can_be_taken(cli, tmp_path):
    assert cli("convert", "furnished_room", tmp_path / "m.sdf", "--model", "sofa")[0] == 0
    assert formats.load_model(tmp_path / "m.sdf").name == "sofa"
    code, _, err = cli("convert", "furnished_room", tmp_path / "n.sdf", "--model", "sofaa")
    assert code == 1
    assert "did you mean 'sofa'?" in err


@pytest.mark.parametrize(
    ("target", "message"),
    [
        ("robot.urdf.xacro", "xacro can be read, but not written"),
        ("robot.step", "there are: .sdf"),
        ("-", "--to"),
        ("missing/robot.sdf", "cannot be written"),
    ],
)
def test_what_cannot_be_written_is_said(cli, tmp_path, target, message):
    code, _, err = cli(
        "convert", "turtlebot3_burger", target if target == "-" else tmp_path / target
    )
    assert code == 1
    assert message in err
    assert list(tmp_path.iterdir()) == []


def test_the_file_that_is_read_is_never_written(cli, tmp_path):
    file = tmp_path / "robot.sdf"
    assert cli("convert", "turtlebot3_burger", file)[0] == 0
    before = file.read_text()
    code, _, err = cli("convert", file, file)
    assert code == 1
    assert "this is the file that is read" in err
    assert file.read_text() == before


def test_xacro_arguments_are_passed_on(cli, tmp_path):
    (tmp_path / "robot.xacro").write_text(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
        '<xacro:arg name="link" default="a"/><link name="$(arg link)"/></robot>'
    )
    arguments = ("convert", tmp_path / "robot.xacro", "-", "--to", "sdf")
    assert '<link name="a"' in cli(*arguments)[1]
    assert '<link name="b"' in cli(*arguments, "--arg", "link:=b")[1]
    assert cli(*arguments, "--arg", "link=b")[0] == 2


def test_what_urdf_cannot_hold_is_one_line(cli, tmp_path):
    code, _, err = cli("convert", "furnished_room", tmp_path / "room.urdf")
    assert code == 1
    assert "a URDF holds one model" in err.splitlines()[0]
    assert list(tmp_path.iterdir()) == []
