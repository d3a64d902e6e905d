"""Registry of built-in packages and nodes, which other distributions can extend.

Another distribution replaces windows of rqt and rviz with an entry point of the group
``gazelle_ros.windows``, which leads to a table of ``module:function`` by package and program.

Another distribution adds a package with an entry point of the group ``gazelle_ros.nodes``: its name is
the package's, its value leads to a `BuiltinPackage`. It is loaded when the package is first asked for.
"""

from __future__ import annotations

import functools
import pkgutil
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle_ros.base.entry_points import entry_points_of, entry_points_of_others, load
from gazelle_ros.base.errors import RosError, did_you_mean
from gazelle_ros.base.path_texts import can_be_path
from gazelle_ros.builtin import bundled
from gazelle_ros.builtin.package import BuiltinPackage

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

    from gazelle_ros.builtin.arguments import NodeWork
    from gazelle_ros.node import Node

GROUP = "gazelle_ros.nodes"
WINDOW_GROUP = "gazelle_ros.windows"

Main = Callable[[Sequence[str]], int]
"""Runs a node until it ends: takes its command line without the program, returns an exit code."""


_SHARE = Path(__file__).parent / "share"
_NO_SCREEN = "it is a window for people"
_CMD_VEL_MUX = {"CmdVelMuxNodelet": "gazelle_ros.builtin.cmd_vel_mux:CmdVelMux"}

_OWN = {
    package.name: package
    for package in (
        BuiltinPackage("controller_manager", {
            "controller_manager": "gazelle_ros.builtin.controllers.command:main",
            "controller_group": "gazelle_ros.builtin.controllers.groups:main",
            "spawner": "gazelle_ros.builtin.controllers.spawner:main",
            "unspawner": "gazelle_ros.builtin.controllers.unspawner:main",
        }),
        BuiltinPackage("robot_state_publisher", {
            "robot_state_publisher": "gazelle_ros.builtin.robot:state_main",
            "state_publisher": "gazelle_ros.builtin.robot:state_main",
        }),
        BuiltinPackage("cmd_vel_mux", {"cmd_vel_mux": "gazelle_ros.builtin.cmd_vel_mux:main"}, _CMD_VEL_MUX),
        BuiltinPackage("depth_image_proc", nodelets={
            "convert_metric": "gazelle_ros.builtin.images.depth.metric:convert_metric",
            "crop_foremost": "gazelle_ros.builtin.images.depth.disparity:crop_foremost",
            "disparity": "gazelle_ros.builtin.images.depth.disparity:disparity",
            "point_cloud_xyz": "gazelle_ros.builtin.images.depth.points:point_cloud_xyz",
            "point_cloud_xyzi": "gazelle_ros.builtin.images.depth.points:point_cloud_xyzi",
            "point_cloud_xyzrgb": "gazelle_ros.builtin.images.depth.points:point_cloud_xyzrgb",
            "register": "gazelle_ros.builtin.images.depth.register:RegisterDepth",
        }),
        BuiltinPackage("depthimage_to_laserscan", {
            "depthimage_to_laserscan": "gazelle_ros.builtin.scans.depth_image:main",
        }, {"DepthImageToLaserScanNodelet": "gazelle_ros.builtin.scans.depth_image:DepthImageToLaserScan"}),
        BuiltinPackage("diagnostic_aggregator", {
            "aggregator_node": "gazelle_ros.builtin.diagnostic_aggregator:main",
        }),
        BuiltinPackage("image_proc", {"image_proc": "gazelle_ros.builtin.images.image_proc:main"}, {
            "rectify": "gazelle_ros.builtin.images.rectify:Rectify",
            "debayer": "gazelle_ros.builtin.images.debayer:Debayer",
            "crop_decimate": "gazelle_ros.builtin.images.crop_decimate:CropDecimate",
            "resize": "gazelle_ros.builtin.images.resize:Resize",
        }),
        BuiltinPackage("image_transport", {"republish": "gazelle_ros.builtin.images.republish:main"}),
        BuiltinPackage("image_view", {
            "extract_images": "gazelle_ros.builtin.images.saving:extract_main",
            "image_saver": "gazelle_ros.builtin.images.saving:save_main",
            "image_view": "gazelle_ros.builtin.images.view:main",
        }, {"image": "gazelle_ros.builtin.images.view:ImageView"}),
        BuiltinPackage("imu_complementary_filter", {
            "complementary_filter_node": "gazelle_ros.builtin.imu.node:complementary_main",
        }),
        BuiltinPackage("imu_filter_madgwick", {
            "imu_filter_node": "gazelle_ros.builtin.imu.node:madgwick_main",
        }, {"ImuFilterNodelet": "gazelle_ros.builtin.imu.node:MadgwickNode"}),
        BuiltinPackage("industrial_robot_client", {
            "joint_trajectory_action": "gazelle_ros.builtin.industrial.trajectory_action:main",
        }),
        BuiltinPackage("industrial_robot_simulator", {
            "industrial_robot_simulator": "gazelle_ros.builtin.industrial.simulator:main",
        }),
        BuiltinPackage("interactive_marker_twist_server", {
            "marker_server": "gazelle_ros.builtin.twist_marker_server:main",
        }),
        BuiltinPackage("joint_state_publisher", {
            "joint_state_publisher": "gazelle_ros.builtin.robot:joint_main",
        }),
        BuiltinPackage("joint_state_publisher_gui", {
            "joint_state_publisher_gui": "gazelle_ros.builtin.robot:sliders_main",
        }),
        BuiltinPackage("joy", {"joy_node": "gazelle_ros.builtin.joysticks.joy_node:main"}),
        BuiltinPackage("joy_teleop", dict.fromkeys(("joy_teleop", "joy_teleop.py"), "gazelle_ros.builtin.joysticks.joy_teleop:main")),
        BuiltinPackage("kobuki_bumper2pc", nodelets={
            "Bumper2PcNodelet": "gazelle_ros.builtin.kobuki.bumper_cloud:BumperCloud",
        }),
        BuiltinPackage("kobuki_controller_tutorial", nodelets={
            "BumpBlinkControllerNodelet": "gazelle_ros.builtin.kobuki.bump_blink:BumpBlink",
        }),
        BuiltinPackage("kobuki_random_walker", nodelets={
            "RandomWalkerControllerNodelet": "gazelle_ros.builtin.kobuki.random_walker:RandomWalker",
        }),
        BuiltinPackage("kobuki_safety_controller", nodelets={
            "SafetyControllerNodelet": "gazelle_ros.builtin.kobuki.safety_controller:KobukiSafety",
        }),
        BuiltinPackage("laser_assembler", {
            "laser_scan_assembler": "gazelle_ros.builtin.scans.assembler:scan_main",
            "point_cloud_assembler": "gazelle_ros.builtin.scans.assembler:cloud_main",
            "point_cloud2_assembler": "gazelle_ros.builtin.scans.assembler:cloud2_main",
        }),
        BuiltinPackage("laser_filters", {
            "scan_to_scan_filter_chain": "gazelle_ros.builtin.scans.filters.chain:main",
        }, {"scan_to_scan_filter_chain": "gazelle_ros.builtin.scans.filters.chain:ScanFilterChain"}),
        BuiltinPackage("nodelet", {"nodelet": "gazelle_ros.builtin.nodelets.command:main"}),
        BuiltinPackage("octomap_server", {
            "octomap_server_node": "gazelle_ros.builtin.octomap.server:main",
            "octomap_server_static": "gazelle_ros.builtin.octomap.static:main",
            "octomap_saver": "gazelle_ros.builtin.octomap.saver:main",
        }, {"OctomapServerNodelet": "gazelle_ros.builtin.octomap.server:OctomapServer"}),
        BuiltinPackage("pointcloud_to_laserscan", {
            "pointcloud_to_laserscan_node": "gazelle_ros.builtin.scans.pointcloud:scan_main",
            "laserscan_to_pointcloud_node": "gazelle_ros.builtin.scans.pointcloud:cloud_main",
        }, {
            "pointcloud_to_laserscan_nodelet": "gazelle_ros.builtin.scans.pointcloud:pointcloud_to_laserscan",
            "laserscan_to_pointcloud_nodelet": "gazelle_ros.builtin.scans.pointcloud:laserscan_to_pointcloud",
        }),
        BuiltinPackage("rosapi", {"rosapi_node": "gazelle_ros.rosbridge.nodes:rosapi_main"}),
        BuiltinPackage("rosbridge_server", dict.fromkeys(("rosbridge_websocket", "rosbridge_websocket.py"), "gazelle_ros.rosbridge.nodes:websocket_main"), folder=_SHARE / "rosbridge_server"),
        BuiltinPackage("rosbag", {
            "record": "gazelle_ros.builtin.bags:record",
            "play": "gazelle_ros.builtin.bags:play",
        }),
        BuiltinPackage("rostest", {
            name: f"gazelle_ros.builtin.rostest_nodes:{name}"
            for name in ("hztest", "paramtest", "publishtest", "advertisetest")
        }),
        BuiltinPackage("rostopic", {"rostopic": "gazelle_ros.builtin.commands:topic"}),
        BuiltinPackage("rosout", {"rosout": "gazelle_ros.builtin.rosout:main"}),
        BuiltinPackage("rospack", {"rospack": "gazelle_ros.builtin.rospack:main"}),
        BuiltinPackage("rosservice", {"rosservice": "gazelle_ros.builtin.commands:service"}),
        BuiltinPackage("rosparam", {"rosparam": "gazelle_ros.builtin.commands:param"}),
        BuiltinPackage("teleop_twist_joy", {"teleop_node": "gazelle_ros.builtin.joysticks.teleop_twist:main"}),
        BuiltinPackage("teleop_twist_keyboard", dict.fromkeys(("teleop_twist_keyboard", "teleop_twist_keyboard.py"), "gazelle_ros.builtin.teleop.twist:main")),
        BuiltinPackage("turtlebot_follower", nodelets={
            "TurtlebotFollower": "gazelle_ros.builtin.follower:Follower",
        }),
        BuiltinPackage("turtlebot3_teleop", {
            "turtlebot3_teleop_key": "gazelle_ros.builtin.teleop.turtlebot3:main",
        }, folder=_SHARE / "turtlebot3_teleop"),
        BuiltinPackage("tf", {
            "static_transform_publisher": "gazelle_ros.builtin.static_transform:main_tf",
            "tf_echo": "gazelle_ros.builtin.tf_tools:echo",
            "tf_monitor": "gazelle_ros.builtin.tf_tools:monitor",
            "view_frames": "gazelle_ros.builtin.tf_tools:frames",
        }),
        BuiltinPackage("tf2_ros", {
            "static_transform_publisher": "gazelle_ros.builtin.static_transform:main_tf2",
            "buffer_server": "gazelle_ros.builtin.buffer_server:main",
        }),
        BuiltinPackage("tf2_tools", {"view_frames.py": "gazelle_ros.builtin.tf_tools:frames"}),
        BuiltinPackage("tf2_web_republisher", {
            "tf2_web_republisher": "gazelle_ros.builtin.tf_republisher:main",
        }),
        BuiltinPackage("topic_tools", {
            "relay": "gazelle_ros.builtin.topic_tools:relay",
            "throttle": "gazelle_ros.builtin.topic_tools:throttle",
            "drop": "gazelle_ros.builtin.topic_tools:drop",
            "mux": "gazelle_ros.builtin.topic_tools:mux",
        }),
        BuiltinPackage("twist_mux", {
            "twist_mux": "gazelle_ros.builtin.twist_mux:main",
            "twist_marker": "gazelle_ros.builtin.twist_mux:marker",
            "joystick_relay": "gazelle_ros.builtin.joysticks.relay:main",
            "joystick_relay.py": "gazelle_ros.builtin.joysticks.relay:main",
        }),
        BuiltinPackage("web_video_server", {"web_video_server": "gazelle_ros.builtin.web_video.server:main"}),
        BuiltinPackage("xacro", {
            "xacro": "gazelle_ros.builtin.xacro:main",
            "xacro.py": "gazelle_ros.builtin.xacro:main",
        }, folder=_SHARE / "xacro"),
        BuiltinPackage("yocs_cmd_vel_mux", nodelets=_CMD_VEL_MUX),
        BuiltinPackage("yocs_diff_drive_pose_controller", nodelets={
            "DiffDrivePoseControllerNodelet": "gazelle_ros.builtin.pose_controller:PoseController",
        }),
        BuiltinPackage("yocs_safety_controller", nodelets={
            "SafetyControllerNodelet": "gazelle_ros.builtin.ranger_safety:RangerSafety",
        }),
        BuiltinPackage("yocs_velocity_smoother", nodelets={
            "VelocitySmootherNodelet": "gazelle_ros.builtin.velocity_smoother:VelocitySmoother",
        }),
    )
}  # fmt: skip
_WINDOWS = ("rqt", "rviz")
_OTHER_WINDOWS = {
    "create_dashboard",
    "fkie_node_manager",
    "kobuki_dashboard",
    "kobuki_qtestsuite",
    "mapviz",
    "moveit_setup_assistant",
    "node_manager_fkie",
    "open_manipulator_control_gui",
    "plotjuggler",
    "plotjuggler_ros",
    "pr2_dashboard",
    "smach_viewer",
    "stdr_gui",
    "swri_console",
    "turtlebot_dashboard",
}

_registered: dict[str, BuiltinPackage] = {}


def register(package: BuiltinPackage) -> None:
    """Add a package for this process, in place of one of the same name."""
    _registered[package.name] = package


def packages() -> list[str]:
    """Return names of all built-in packages."""
    return sorted({*_OWN, *bundled.folders(), *_registered, *entry_points_of_others(GROUP)})


def package(name: str) -> BuiltinPackage | None:
    """Return the built-in package of a name, or None.

    Raises:
        RosError: An entry point of that name does not lead to a package.
    """
    if name in _registered:
        return _registered[name]
    point = entry_points_of_others(GROUP).get(name)
    if point is not None:
        return _load(point)
    if name in _OWN:
        return _OWN[name]
    if name in bundled.folders():
        return bundled.package(name)
    if name.startswith(_WINDOWS) or name in _OTHER_WINDOWS:
        return BuiltinPackage(name, skipped=_NO_SCREEN, windows=_windows().get(name, {}))
    return None


def stand_in(name: str) -> Path | None:
    """Return a folder with the manifest of a package whose nodes are built in, or None.

    ``rospkg`` and ``$(find)`` find such packages by it, as they do where ROS is installed.
    """
    folder = _SHARE / name
    plain = name not in {"", ".", ".."} and "/" not in name and can_be_path(name)
    return folder if plain and (folder / "package.xml").is_file() else None


def names_with_folders() -> set[str]:
    """Return names of packages that may have a folder: all built-in ones, and stand-ins."""
    return {*packages(), *(each.parent.name for each in _SHARE.glob("*/package.xml"))}


def main_of(name: str, kind: str) -> Main:
    """Return the function that runs a built-in node.

    Raises:
        RosError: There is no such node.
    """
    found = package(name)
    target = {**found.windows, **found.nodes}.get(kind) if found is not None else None
    if target is None:
        raise RosError(f"no built-in package '{name}' has a node '{kind}'")
    main: Main = pkgutil.resolve_name(target)
    return main


def nodelet(kind: str) -> Callable[[Node], NodeWork]:
    """Return the function that makes a built-in nodelet.

    Args:
        kind: Name of its class, such as ``depthimage_to_laserscan/DepthImageToLaserScanNodelet``.

    Raises:
        RosError: There is no such nodelet.
    """
    home, _, name = kind.partition("/")
    found = package(home)
    target = found.nodelets.get(name) if found is not None else None
    if target is None:
        raise RosError(
            f"there is no nodelet '{kind}'",
            hint=f"{did_you_mean(kind, nodelets())} Nodelets written in C++ are not run",
        )
    made: Callable[[Node], NodeWork] = pkgutil.resolve_name(target)
    return made


def nodelets() -> list[str]:
    """Return names of the classes of all built-in nodelets."""
    return [
        f"{found.name}/{name}"
        for found in map(package, packages())
        if found is not None
        for name in sorted(found.nodelets)
    ]


@functools.cache
def _windows() -> dict[str, dict[str, str]]:
    """Return the programs with a window that other distributions replace, by package."""
    found: dict[str, dict[str, str]] = {}
    for name, point in entry_points_of(WINDOW_GROUP).items():
        found |= load(point, f"the windows of '{name}'", RosError)
    return found


@functools.cache
def _load(point: EntryPoint) -> BuiltinPackage:
    try:
        found = point.load()
    except Exception as error:
        raise RosError(f"the built-in package '{point.name}' cannot be loaded: {error}") from error
    if not isinstance(found, BuiltinPackage):
        raise RosError(f"the entry point '{point.name}' of {GROUP} is not a BuiltinPackage")
    return found
