"""Launch files of the corpus whose robots ros_control moves: controllers run, joints follow commands."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from launch_table import HUSKY_INCLUDES
from launching import Launched, stub_packages
from ros.graph import until

from gazelle.errors import RosError
from gazelle_ros import Master, Node, load_message, load_service
from gazelle_ros.messages.yaml import fill_message_args

DATA = Path(__file__).parents[2] / "data"
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
        fields: Of its message.
        space: Namespace of the manager.
        description: File whose text is the parameter ``robot_description`` beforehand, where the
            launch files leave it to their user.
        under: Folder of the corpus in which packages are found; all of it if empty.
        stubs: Packages that the files name and do not use, with their files; the corpus has none.
    """

    files: tuple[str, ...]
    running: str
    topic: str
    joint: str
    by: float
    kind: str = "std_msgs/Float64"
    fields: Mapping[str, object] = field(default_factory=lambda: {"data": 0.5})
    space: str = ""
    description: str = ""
    under: str = ""
    stubs: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def __str__(self) -> str:
        """Return the name of the test."""
        return self.description.rpartition("/")[2] or self.files[-1]


TWIST = "geometry_msgs/Twist"
AHEAD = {"linear": {"x": 0.2}}
R2D2 = "r2d2_joint_state_controller r2d2_head_controller"
TRAJECTORY = "trajectory_msgs/JointTrajectory"


def _there(**targets):
    """Return a trajectory of one point, two seconds away."""
    point = {"positions": [*targets.values()], "time_from_start": {"secs": 2}}
    return {"joint_names": [*targets], "points": [point]}


def _arm(name):
    """Return an arm of Universal Robots with its own launch file and controllers."""
    wrists = {f"wrist_{number}_joint": 0.0 for number in (1, 2, 3)}
    return Controlled(
        (f"ur_gazebo {name}_bringup.launch gui:=false",),
        "joint_state_controller eff_joint_traj_controller",
        "eff_joint_traj_controller/command",
        "shoulder_pan_joint",
        0.4,
        TRAJECTORY,
        _there(shoulder_pan_joint=0.5, shoulder_lift_joint=-0.5, elbow_joint=0.0, **wrists),
    )


def _legs(file, name=""):
    """Return a walking robot, whose description its user puts on the parameter server."""
    joints = [
        f"{leg}_{part}_joint"
        for leg in ("lf", "rf", "lh", "rh")
        for part in ("hip", "upper_leg", "lower_leg")
    ]
    options = f"gazebo_world:=worlds/empty.world robot_name:=/{name}"
    return Controlled(
        (f"champ_gazebo gazebo.launch gui:=false {options}",),
        "joint_states_controller joint_group_position_controller",
        "joint_group_position_controller/command",
        "lf_lower_leg_joint",
        0.3,
        TRAJECTORY,
        _there(**{name: (0.0, 0.5, -1.0)[index % 3] for index, name in enumerate(joints)}),
        space=f"/{name}".rstrip("/"),
        description=f"chvmp__champ/champ_description/urdf/{file}",
    )


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
        {"data": [-0.1, 0.5, 0.5]},
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
    Controlled(
        ("husky_gazebo empty_world.launch gui:=false",),
        "husky_joint_publisher husky_velocity_controller",
        "husky_velocity_controller/cmd_vel",
        "front_left_wheel",
        1.0,
        TWIST,
        AHEAD,
        stubs=HUSKY_INCLUDES,
    ),
    Controlled(
        ("gazebo_ros empty_world.launch gui:=false", "rosbot_description rosbot_gazebo.launch"),
        "joint_state_controller",
        "cmd_vel",
        "front_left_wheel_hinge",
        1.0,
        TWIST,
        AHEAD,
        # A checkout of ros_controllers has its file elsewhere than where it is installed.
        under="husarion__rosbot_description",
    ),
    *(
        _arm(name)
        for name in ("ur3", "ur3e", "ur5", "ur5e", "ur10", "ur10e", "ur16e", "ur20", "ur30")
    ),
    _legs("champ.urdf"),
    _legs("champ_velodyne.urdf"),
    _legs("champ_arm.urdf", "champ"),
]


LIFT = ("lifting_arm lifting_arm.launch",)
ALL = "joints lifter turner spinner"
OWN = [
    Controlled(
        LIFT, ALL, "lifter/command", "lift", 0.15, TRAJECTORY, _there(lift=0.2), space="/lift"
    ),
    Controlled(
        ("lifting_arm lifting_arm.launch space:=/other/place",),
        ALL,
        "turner/command",
        "turn",
        0.4,
        space="/other/place",
    ),
    Controlled(
        LIFT,
        ALL,
        "spinner/command",
        "spin",
        1.0,
        "std_msgs/Float64MultiArray",
        {"data": [5.0]},
        "/lift",
    ),
]


def _driven(name, wheel):
    """Return a bundled base, in its own launch file."""
    return Controlled(
        (f"{name}_control {name}.launch gui:=false",),
        "joint_state_controller drive_controller",
        "drive_controller/cmd_vel",
        wheel,
        1.0,
        TWIST,
        AHEAD,
    )


# Robots that come with Gazelle: one with a drive and one with an arm and a gripper among the quick
# tests, as each starts four processes.
BUNDLED = [
    Controlled(
        ("rrbot_control rrbot.launch gui:=false",),
        "joint_state_controller joint1_position_controller joint2_position_controller",
        "joint1_position_controller/command",
        "joint1",
        0.4,
        space="/rrbot",
    ),
    Controlled(
        ("arm6_control arm6.launch gui:=false",),
        "joint_state_controller arm_controller gripper_controller",
        "arm_controller/command",
        "axis_1",
        0.4,
        TRAJECTORY,
        _there(axis_1=0.5, axis_2=0.3, axis_3=0.8, axis_4=0.0, axis_5=0.5, axis_6=0.0),
    ),
    Controlled(
        ("fetch_gazebo simple_grasp.launch gui:=false",),
        "joint_state_controller arm_controller torso_controller head_controller gripper_controller",
        "gripper_controller/gripper_action/goal",
        "l_gripper_finger_joint",
        0.03,
        "control_msgs/GripperCommandActionGoal",
        {"goal": {"command": {"position": 0.1, "max_effort": 60.0}}},
    ),
    _driven("courier", "wheel_left_joint"),
    _driven("ackermann_base", "rear_wheel_joint"),
]
QUICK = ("l_gripper_finger_joint", "rear_wheel_joint")  # what moves in them
# Its two launch files one after the other, by the names that the tutorials use.
RRBOT = Controlled(
    ("rrbot_gazebo rrbot_world.launch gui:=false", "rrbot_control rrbot_control.launch"),
    BUNDLED[0].running,
    "joint2_position_controller/command",
    "joint2",
    0.4,
    space="/rrbot",
)
TORSO = Controlled(
    ("fetch_gazebo simulation.launch gui:=false",),
    "torso_controller",
    "torso_controller/command",
    "torso_lift_joint",
    0.1,
    TRAJECTORY,
    _there(torso_lift_joint=0.15),
)
GRIPPER = Controlled(
    ("arm6_control arm6.launch gui:=false",),
    "gripper_controller",
    "gripper_controller/gripper_cmd/goal",
    "finger_joint",
    0.02,
    "control_msgs/GripperCommandActionGoal",
    {"goal": {"command": {"position": 0.03, "max_effort": 30.0}}},
)


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


@pytest.mark.corpus
@pytest.mark.slow
@pytest.mark.parametrize("case", TABLE, ids=str)
def test_controllers_of_a_launch_file_move_its_robot(case, corpus, tmp_path):
    bring_up(case, corpus, tmp_path)


@pytest.mark.long
def test_those_of_a_small_package_do_too(tmp_path):
    bring_up(OWN[0], DATA, tmp_path)


@pytest.mark.long
@pytest.mark.parametrize(
    "case",
    [
        each if each.joint in QUICK else pytest.param(each, marks=pytest.mark.slow)
        for each in BUNDLED
    ],
    ids=str,
)
def test_those_of_a_bundled_robot_do_too(case, tmp_path):
    bring_up(case, DATA, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("case", [*OWN[1:], RRBOT, TORSO, GRIPPER], ids=lambda case: case.joint)
def test_its_other_joints_are_moved(case, tmp_path):
    bring_up(case, DATA, tmp_path)


def bring_up(case, folder, scratch):
    """Start the launch files among the packages of a folder, and look at what they do."""
    with Master(port=0) as master, contextlib.ExitStack() as stack:
        if case.description:
            text = (folder / case.description).read_text(encoding="utf-8")
            stack.enter_context(Node("user", master_uri=master.uri)).set_param(
                f"{case.space}/robot_description", text
            )
        packages = f"{stub_packages(scratch, case.stubs)}:{folder / case.under}"
        launched = []
        for number, file in enumerate(case.files):
            home = scratch / str(number)
            home.mkdir()
            name = f"/watcher_{number}"
            launched.append(stack.enter_context(Launched(master.uri, packages, home, file, name)))
        try:
            check(case, launched[0])
        except BaseException:
            print(*(each.said for each in launched), sep="\n----\n")
            raise


def check(case, launched):
    """Check that controllers run, joint states come, and a command moves the joint."""
    watched = Watched(launched.node, case)
    until(lambda: set(case.running.split()) <= watched.running(), PATIENCE_S)
    until(lambda: case.joint in watched.positions, PATIENCE_S)
    start = watched.positions[case.joint]
    kind = load_message(case.kind)
    message = kind()
    fill_message_args(message, [case.fields])
    publisher = launched.node.advertise(f"{case.space}/{case.topic}", kind)
    until(lambda: publisher.num_connections, PATIENCE_S)
    publisher.publish(message)

    def moved():
        if case.kind == TWIST:  # those of bases are soon too old
            publisher.publish(message)
        return abs(watched.positions[case.joint] - start) > case.by

    until(moved, PATIENCE_S)
    assert "Traceback" not in launched.said
