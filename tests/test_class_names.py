"""Every class name is used once, so that a name in an error, a log or a search means one thing."""

from __future__ import annotations

import ast
import functools
from collections import Counter
from pathlib import Path

import pytest

import gazelle
import gazelle_ros

PACKAGE = Path(gazelle.__file__).parent
ROS = Path(gazelle_ros.__file__).parent
ORIGINALS = (
    *("diagnostic_updater/", "frobs_rl/", "gym/", "interactive_markers/", "openai_ros/"),
    *("shared/", "shimmy.py", "six/", "smach/", "smach_ros/"),
)
COMPAT = ("compat/", *(f"drop_in/{name}" for name in ORIGINALS))
"""Modules with the names and interfaces of ROS's own packages, of openai_ros', frobs_rl's, smach's and gym's."""

GIVEN_BY_ROS = frozenset(
    [
        "ActionClient",
        "ActionServer",
        "Duration",
        "Frame",
        "Group",
        "Joint",
        "Master",
        "MasterProxy",
        "Node",
        "Publisher",
        "Rate",
        "Service",
        "State",
        "SimpleActionClient",
        "SimpleActionServer",
        "Subscriber",
        "Time",
        "TransformBroadcaster",
        "TransformListener",
        "Wrench",
    ]
)
"""Names that scripts import from those packages: these modules have them besides one of ours."""

OPENAI_ROS = "drop_in/openai_ros/"
"""Its environments have the names that openai_ros gave them; the native ones may have them too."""

SAME_PROGRAM = {"JointStatePublisher": 2}
"""ROS has a node and a Gazebo plugin of this name, and we have both."""


@functools.cache
def class_names(root, *, skip=("assets",)):
    """Return names of all classes under a folder, with their files."""
    return [
        (node.name, path.relative_to(root).as_posix())
        for path in sorted(root.rglob("*.py"))
        if path.relative_to(root).parts[0] not in skip
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.ClassDef)
    ]


def repeated(found):
    """Return names used more often than they may be, with their files."""
    own = [(name, file) for name, file in found if not file.startswith(COMPAT)]
    files = {}
    for name, file in own:
        files.setdefault(name, []).append(file)
    wrong = {name: where for name, where in files.items() if len(where) > SAME_PROGRAM.get(name, 1)}
    for name, file in found:
        given = name in GIVEN_BY_ROS or (file.startswith(OPENAI_ROS) and name.endswith("Env"))
        if file.startswith(COMPAT) and name in files and not given:
            wrong[name] = [*files[name], file]
    return wrong


@pytest.mark.long
def test_every_class_name_is_used_once():
    assert repeated([*class_names(PACKAGE), *class_names(ROS)]) == {}


@pytest.mark.long
def test_the_list_of_ros_names_holds_nothing_else():
    found = [*class_names(PACKAGE), *class_names(ROS)]
    everywhere = Counter(name for name, _ in found)
    assert [name for name in GIVEN_BY_ROS if everywhere[name] < 2] == []


@pytest.mark.parametrize(
    ("found", "expected"),
    [
        ([("Rope", "a.py"), ("Knot", "b.py")], set()),
        ([("Rope", "a.py"), ("Rope", "b.py")], {"Rope"}),
        ([("Rope", "a.py"), ("Rope", "a.py")], {"Rope"}),
        ([("Rope", "a.py"), ("Rope", "compat/rospy/rope.py")], {"Rope"}),
        ([("Node", "node.py"), ("Node", "compat/roslaunch/core.py")], set()),
        ([("Node", "node.py"), ("Node", "viewer/graph.py")], {"Node"}),
        ([("CartEnv", "envs/cart.py"), ("CartEnv", "drop_in/openai_ros/cart.py")], set()),
        ([("Cart", "envs/cart.py"), ("Cart", "drop_in/openai_ros/cart.py")], {"Cart"}),
    ],
)
def test_a_repeated_name_is_caught(found, expected):
    assert set(repeated(found)) == expected
