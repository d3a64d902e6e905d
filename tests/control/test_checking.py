"""Controllers are judged beside their robot: every problem with its line, and nothing about good ones."""

from __future__ import annotations

from pathlib import Path

import pytest
from PIL import Image

from gazelle.cli.main import main
from gazelle.control.checking import check_controllers, is_controllers
from gazelle.formats import check
from tests.control.arms import arm_text

ASSETS = Path(__file__).parents[2] / "gazelle" / "assets"
PID = "{p: 100.0, d: 10.0}"
JOINT_BY_PID = "effort_controllers/JointPositionController"


@pytest.fixture
def judge(tmp_path):
    """Return a function that checks the text of a file beside the two-link arm."""

    def run(text, **options):
        robot, file = tmp_path / "arm.urdf", tmp_path / "arm.yaml"
        robot.write_text(arm_text(**options), encoding="utf-8")
        file.write_text(text, encoding="utf-8")
        return check_controllers(file, robot)

    return run


GOOD = f"""arm:
  states: {{type: joint_state_controller/JointStateController, publish_rate: 50}}
  one:
    type: {JOINT_BY_PID}
    joint: shoulder
    pid: {PID}
"""


def test_good_ones_have_no_finding(judge):
    assert judge(GOOD) == []


CASES = [
    (GOOD.replace("shoulder", "sholder"), "controller-joint", 5, "shoulder"),
    (GOOD.replace("JointPositionController", "JointPositionControler"), "controller-type", 4, "Controller"),
    (GOOD.replace(f"    pid: {PID}\n", ""), "controller-gains", 3, None),
    (GOOD.replace("p: 100.0", "p: much"), "controller-gains", 6, None),
    (GOOD.replace("publish_rate", "publish_rat"), "controller", 2, "publish_rat"),
    (GOOD.replace(JOINT_BY_PID, "velocity_controllers/JointVelocityController"), "controller-interface", 3, None),
    (GOOD + "  gazebo_ros_control: {pid_gains: {elbw: {p: 1}}}\n", "controller-joint", 7, "elbow"),
    (GOOD + "  gazebo_ros_control/pid_gains:\n    elbw: {p: 1}\n", "controller-joint", 8, "elbow"),
    ("a: [1\n", None, 2, None),
]  # fmt: skip


@pytest.mark.parametrize(("text", "rule", "line", "hint"), CASES)
def test_each_fault_is_an_error_with_its_line(judge, text, rule, line, hint):
    (found,) = judge(text)
    assert (found.severity, found.rule, found.line) == ("error", rule, line)
    assert found.file.endswith("arm.yaml")
    assert hint is None or hint in found.hint


def test_all_missing_joints_are_named_at_once(judge):
    text = "c:\n  type: effort_controllers/JointGroupEffortController\n  joints:\n  - a\n  - elbow\n  - b\n"
    assert [each.line for each in judge(text)] == [4, 6]


def test_what_claims_what_another_claims_is_told_with_both_lines(judge):
    again = GOOD + f"  two: {{type: {JOINT_BY_PID}, joint: shoulder, pid: {PID}}}\n"
    (found,) = judge(again)
    assert (found.severity, found.rule, found.line) == ("warning", "controller-conflict", 7)
    assert "line 3" in found.message


def test_a_joint_without_an_effort_is_told(judge):
    (found,) = judge(GOOD, replace={'effort="60"': 'effort="0"'})
    assert (found.severity, found.rule, found.line) == ("warning", "no-effort", 3)


def test_a_joint_without_a_transmission_is_told_in_both_files(tmp_path, judge):
    text = arm_text()
    begin = text.index("<transmission")
    end = text.index("</transmission>") + len("</transmission>")
    (found,) = judge(GOOD, replace={text[begin:end].replace("Effort", "INTERFACE"): ""})
    assert (found.severity, found.rule, found.line) == ("error", "joint-transmission", 5)
    (told,) = [each for each in check(tmp_path / "arm.urdf") if each.rule == "joint-transmission"]
    assert "shoulder" in told.message
    assert told.line is not None


def test_an_unknown_type_of_transmission_is_told_once(tmp_path, judge):
    judge(GOOD, replace={"SimpleTransmission": "SimpleTransmision"})
    (told,) = [each for each in check(tmp_path / "arm.urdf") if each.rule == "transmission-type"]
    assert "'transmission_interface/SimpleTransmission'" in told.hint
    assert told.line is not None


@pytest.mark.parametrize(
    ("config", "robot"),
    [
        ("rrbot_control/config/rrbot_control.yaml", "rrbot_description/urdf/rrbot.urdf.xacro"),
        ("arm6_control/config/arm6_control.yaml", "arm6_description/urdf/arm6.urdf.xacro"),
    ],
)
def test_bundled_controllers_have_no_finding(config, robot):
    assert check_controllers(ASSETS / config, ASSETS / robot) == []


def test_the_command_judges_them(tmp_path, capsys):
    robot, file = tmp_path / "arm.urdf", tmp_path / "arm.yaml"
    robot.write_text(arm_text(), encoding="utf-8")
    file.write_text(GOOD.replace("shoulder", "sholder"), encoding="utf-8")
    assert main(["check", "--urdf", str(robot), str(file)]) == 1
    assert "did you mean 'shoulder'?" in capsys.readouterr().out
    assert main(["check", str(file)]) == 1
    assert "--urdf" in capsys.readouterr().err


def test_maps_and_other_files_are_no_controllers(tmp_path):
    for text in ("image: a.pgm\nresolution: 0.05\n", "type: none\n", "", "- 1\n"):
        (tmp_path / "map.yaml").write_text(text, encoding="utf-8")
        assert not is_controllers(tmp_path / "map.yaml")
    assert not is_controllers(tmp_path / "robot.urdf")


@pytest.mark.parametrize(
    ("more", "expected"),
    [
        ("ocupied_thresh: 0.5\n", "did you mean 'occupied_thresh'?"),
        ("---\nimage: b.png\n", "m.yaml:7: this is not valid YAML"),
        ("\torigin: [0, 0, 0]\n", "m.yaml:7: this is not valid YAML"),
    ],
)
def test_the_command_lists_what_is_wrong_with_a_map(tmp_path, capsys, more, expected):
    Image.new("L", (2, 2)).save(tmp_path / "a.png")
    text = "image: a.png\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n"
    (tmp_path / "m.yaml").write_text(text + "occupied_thresh: 0.6\nfree_thresh: 0.2\n" + more)
    main(["check", "--files-only", str(tmp_path / "m.yaml")])
    written = capsys.readouterr()
    assert expected in written.out
    assert not written.err
