"""The Python suites of MoveIt, against Gazelle's ``move_group`` with MoveIt's fake controllers.

Debian has no package of it: the sources are checkouts of ros-planning/moveit (master: Noetic) and of
ros-planning/moveit_resources (master). The tests run twice where they import ``moveit_commander``: on
the original package, and on Gazelle's own.

What is not run, and why:

======================================  ============================================================
``cleanup.test``, ``test_cpp``          its program is C++ and needs MoveIt's libraries; ``test_py`` is run
``python_moveit_commander_ros_...``     MoveIt does not run it any more: ``test_namespace_synchronous`` asks
                                        for an attribute that its own class has lost; the other one passes
``serialize_msg.py``                    tests how its C++ modules take Python's bytes
``*_cpp_test``, ``subframes_test``,     C++ clients that need MoveIt's libraries
``move_group_pick_place_test``,
``planning_scene_interface_test``
======================================  ============================================================
"""

from __future__ import annotations

from dataclasses import replace

from rossuites.catalogue import Suite

_ALONE = frozenset({"alone"})
_RESOURCES = tuple(
    f"moveit_resources_{name}"
    for name in (
        "fanuc_description",
        "fanuc_moveit_config",
        "panda_description",
        "dual_panda_moveit_config",
    )
)
_COMMANDER = "moveit_commander"

_ORIGINAL = (
    Suite(
        _COMMANDER,
        _COMMANDER,
        {
            "test/python_moveit_commander.test": 7,
            "test/python_moveit_commander_ns.test": 2,
            "test/python_moveit_commander_ros_namespace.test": 1,
            "test/python_time_parameterization.test": 1,
        },
        only=_ALONE,
        beside=_RESOURCES,
    ),
    Suite(
        "move_group",
        "moveit_ros_move_group",
        {
            "test/test_cancel_before_plan_execution.test": 3,
            "test/test_check_state_validity_in_empty_scene.test": 2,
        },
        only=_ALONE,
        beside=(*_RESOURCES, _COMMANDER),
    ),
    Suite(
        "planning_interface",
        "moveit_ros_planning_interface",
        {
            "test/python_move_group.test": 3,
            "test/python_move_group_ns.test": 5,
            "test/robot_state_update.test": 1,
            "test/dual_arm_robot_state_update.test": 1,
            "test/cleanup.test": 1,
        },
        only=_ALONE,
        beside=(*_RESOURCES, _COMMANDER),
    ),
)

MOVEIT = tuple(
    suite
    for original in _ORIGINAL
    for suite in (
        original,
        replace(original, name=f"{original.name}, own {_COMMANDER}", hidden=(f"{_COMMANDER}/src",)),
    )
)
