"""Test suites, and how many of their tests the real ROS 1 passes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rossuites.compiling import Client


@dataclass(frozen=True)
class Suite:
    """Some test files of a package.

    Attributes:
        name: What the table calls it.
        package: The ROS package that holds the files.
        files: Test files in it, each with the number of tests that the real stack of Debian 12
            (1.15.15) passes. Launch files go through rostest; Python files are run as they are.
        quick: The stacks with which CI runs it.
        uses: Which parts it exercises; a stack that replaces none of them does not run it.
        programs: C++ sources in the package that its tests start as nodes.
        less: For a stack, how many fewer pass there, and the reason.
        only: The stacks that run it; all if empty.
        robots: Nodes of the package that a stand-in takes the place of: its file in ``robots`` and
            arguments.
        compiled: Whether the clients that its ``CMakeLists.txt`` declares are compiled.
        clients: Further ones that it does not declare.
        beside: Other packages that its files name.
        hidden: Folders among the packages that are not there while it runs.
    """

    name: str
    package: str
    files: dict[str, int]
    quick: frozenset[str] = frozenset()
    uses: frozenset[str] = frozenset({"master", "clients"})
    programs: tuple[str, ...] = ()
    less: dict[str, tuple[int, str]] = field(default_factory=dict)
    only: frozenset[str] = frozenset()
    robots: Mapping[str, str] = field(default_factory=dict)
    compiled: bool = False
    clients: tuple[Client, ...] = ()
    beside: tuple[str, ...] = ()
    hidden: tuple[str, ...] = ()

    @property
    def reference(self) -> int:
        """How many tests the real stack passes."""
        return sum(self.files.values())


_MASTER, _CLIENTS, _ALONE = (frozenset({name}) for name in ("master", "clients", "alone"))
_RAW = frozenset({"master"})  # speaks XML-RPC itself, so no client library is tested
_LIBRARY = frozenset({"clients"})  # needs no master
_ROSPY = {
    "client-param-api-2": 1,
    "client-param-server": 4,
    "deregister": 3,
    "embed-msg": 1,
    "latch": 1,
    "latch_unsubscribe": 1,
    "node": 48,
    "on_shutdown": 1,
    "pubsub-order": 1,
    "rosout": 5,
    "services": 16,
    "statistics": 1,
    "sub_to_multiple_pubs": 1,
}
_ROSPY_SLOW = {"rospy": 13, "rospy_sim_time": 10}


def _rospy(files: dict[str, int]) -> dict[str, int]:
    return {f"test/rostest/{name}.test": count for name, count in files.items()}


SUITES = (
    Suite("rosmaster", "test_rosmaster", {"test/rosmaster.test": 15}, quick=_MASTER, uses=_RAW),
    Suite("paramserver", "test_rosmaster", {"test/paramserver.test": 7}, quick=_MASTER),
    Suite("masterapi", "test_rosgraph", {"test/masterapi.test": 19}, quick=_MASTER | _ALONE),
    Suite("rosparam", "test_rosparam", {"test/rosparam.test": 8}, quick=_MASTER | _ALONE),
    Suite("rospy", "test_rospy", _rospy(_ROSPY), quick=_ALONE),
    Suite("rospy, slow", "test_rospy", _rospy(_ROSPY_SLOW)),
    Suite(
        "roslaunch",
        "test_roslaunch",
        {"test/roslaunch.test": 2, "test/env.test": 2, "test/params_basic.test": 3},
    ),
    Suite("rosservice", "test_rosservice", {"test/rosservice.test": 1}),
    Suite("rosnode", "rosnode", {"test/rosnode.test": 1}),
    Suite("rostopic", "rostopic", {"test/rostopic.test": 1}),
    Suite(
        "rostest",
        "rostest",
        {
            "test/hztest0.test": 1,
            "test/hztest.test": 1,
            "test/publishtest.test": 1,
            "test/clean_master.test": 3,
            "test/distro_version.test": 1,
            "test/param.test": 3,
            "test/advertisetest.test": 2,
        },
    ),
    Suite("rostest, more", "test_rostest", {"test/publishtest.test": 1}),
    Suite(
        "rosbag",
        "test_rosbag",
        {
            "test/latched_pub.test": 1,
            "test/record_one_publisher_two_topics.test": 1,
            "test/record_sigint_cleanup.test": 1,
            "test/record_sigterm_cleanup.test": 1,
            "test/record_two_publishers.test": 1,
        },
        programs=("test/double_pub.cpp",),
    ),
    Suite(
        "actionlib",
        "actionlib",
        {
            "test/test_imports.launch": 1,
            "test/test_python_exercise_simple_client.launch": 7,
            "test/test_python_server2.launch": 1,
            "test/test_python_server3.launch": 4,
            "test/test_python_server_components.launch": 3,
            "test/test_python_simple_server.launch": 1,
            "test/test_simple_action_server_deadlock_python.launch": 1,
        },
    ),
    Suite("tf", "tf", {"test/testPython.py": 10}, quick=_CLIENTS | _ALONE, uses=_LIBRARY),
    Suite(
        "tf_conversions",
        "tf_conversions",
        {"test/posemath.py": 2},
        quick=_CLIENTS | _ALONE,
        uses=_LIBRARY,
    ),
    Suite(
        "tf2_sensor_msgs",
        "tf2_sensor_msgs",
        {"test/test_tf2_sensor_msgs.py": 2},
        uses=_LIBRARY,
    ),
    Suite("tf2_geometry_msgs", "tf2_geometry_msgs", {"test/test_python.launch": 1}),
    Suite(
        "message_filters",
        "message_filters",
        {"test/test_approxsync.py": 1, "test/test_message_filters_cache.py": 2},
        quick=_CLIENTS | _ALONE,
        uses=_LIBRARY,
    ),
)
