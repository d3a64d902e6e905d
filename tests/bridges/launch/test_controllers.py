"""Launch files of the corpus whose robots ros_control moves: controllers run, joints follow commands."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from launching import Launched
from ros.graph import until

from gazelle.errors import RosError
from gazelle.ros import Master, load_message, load_service

pytestmark = [pytest.mark.corpus, pytest.mark.slow]
PATIENCE_S = 120.0


@dataclass(frozen=True)
class Controlled:
    """Launch files, and what they let move.

    Attributes:
        files: Packages, files and arguments.
        running: Controllers that run then.
        topic: Of a command.
        joint: That it moves.
        by: How far at least [rad or m].
        kind: Of the command.
        fields: Of its message; nested by ``.``.
        space: Namespace of the manager.
    """

    files: tuple[str, ...]
    running: str
    topic: str
    joint: str
    by: float
    kind: str = "std_msgs/Float64"
    fields: tuple[tuple[str, object], ...] = (("data", 0.5),)
    space: str = ""


TWIST = "geometry_msgs/Twist"
AHEAD = (("linear.x", 0.2),)
R2D2 = "r2d2_joint_state_controller r2d2_head_controller"
TABLE = [
    Controlled(
        ("rrbot_gazebo rrbot_world.launch gui:=false", "rrbot_control rrbot_control.launch"),
        "joint_state_controller joint1_position_controller joint2_position_controller",
        "joint1_position_controller/command",
        "joint1",
        0.3,
        space="/rrbot",
    ),
    Controlled(
        ("urdf_sim_tutorial 10-head.launch gui:=false",),
        R2D2,
        "r2d2_head_controller/command",
        "head_swivel",
        0.4,
    ),
    Controlled(
        ("urdf_sim_tutorial 12-gripper.launch gui:=false",),
        f"{R2D2} r2d2_gripper_controller",
        "r2d2_gripper_controller/command",
        "left_gripper_joint",
        0.4,
        "std_msgs/Float64MultiArray",
        (("data", [-0.1, 0.5, 0.5]),),
    ),
    Controlled(
        ("urdf_sim_tutorial 13-diffdrive.launch gui:=false",),
        f"{R2D2} r2d2_gripper_controller r2d2_diff_drive_controller",
        "r2d2_diff_drive_controller/cmd_vel",
        "left_front_wheel_joint",
        1.0,
        TWIST,
        AHEAD,
    ),
]


def fill(message, fields):
    for path, value in fields:
        *parents, last = path.split(".")
        part = message
        for each in parents:
            part = getattr(part, each)
        setattr(part, last, value)
    return message


class Watched:
    """The joints and controllers of a graph."""

    def __init__(self, node, case):
        self.node, self.case, self.positions = node, case, {}
        kind = load_message("sensor_msgs/JointState")
        node.subscribe(f"{case.space}/joint_states", kind, self._learn)
        self._service = load_service("controller_manager_msgs/ListControllers")

    def _learn(self, message):
        self.positions |= dict(zip(message.name, message.position, strict=True))

    def running(self):
        name = f"{self.case.space}/controller_manager/list_controllers"
        try:
            with_manager = self.node.client(name, self._service)
            found = with_manager.call(self._service._request_class(), timeout=10).controller
        except RosError:
            return set()
        return {each.name for each in found if each.state == "running"}


@pytest.mark.parametrize("case", TABLE, ids=lambda case: case.files[-1])
def test_controllers_of_a_launch_file_move_its_robot(case, corpus, tmp_path):
    first, *rest = case.files
    with Master(port=0) as master, Launched(master.uri, corpus, tmp_path, first) as launched:
        folders = [tmp_path / str(number) for number in range(len(rest))]
        for folder in folders:
            folder.mkdir()
        others = [
            Launched(master.uri, corpus, folder, file, f"/watcher_{folder.name}")
            for folder, file in zip(folders, rest, strict=True)
        ]
        try:
            watched = Watched(launched.node, case)
            until(lambda: set(case.running.split()) <= watched.running(), PATIENCE_S)
            until(lambda: case.joint in watched.positions, PATIENCE_S)
            start = watched.positions[case.joint]
            kind = load_message(case.kind)
            publisher = launched.node.advertise(f"{case.space}/{case.topic}", kind)

            def moved():
                publisher.publish(fill(kind(), case.fields))
                return abs(watched.positions[case.joint] - start) > case.by

            until(moved, PATIENCE_S)
            assert "Traceback" not in launched.said
        except BaseException:
            print(launched.said, *(each.said for each in others), sep="\n----\n")
            raise
        finally:
            for each in others:
                each.close()
