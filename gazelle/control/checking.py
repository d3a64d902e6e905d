"""Check of a file of controllers against the robot that they are for."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from gazelle.control.hardware import RobotHardware
from gazelle.control.interfaces import (
    COMMAND_FIELDS,
    FORCE_TORQUE,
    IMU,
    SensorInterface,
)
from gazelle.control.limits import JointLimits
from gazelle.control.manager import ControllerManager
from gazelle.description import Joint, Model
from gazelle.errors import ControlError, Error, did_you_mean
from gazelle.formats import Problem, load_model
from gazelle_ros.base import bounded_yaml
from gazelle_ros.base.text_files import read_text

_PREFIX = "hardware_interface/"
_NAMES = re.compile(r"^(joints?|(left|right|front|rear)_.*|.*_(joint|wheel|steer)s?)$")
"""Parameters that name joints."""

_GAINS = "pid_gains"
"""Below ``gazebo_ros_control``: gains of joints, by their names."""


@dataclass(frozen=True, slots=True)
class _Entry:
    """A controller in a file.

    Attributes:
        name: Its name.
        values: Its parameters.
        node: YAML node of the parameters.
        line: Of its name, from 1.
    """

    name: str
    values: Mapping[str, Any]
    node: yaml.MappingNode
    line: int


def is_controllers(file: Path) -> bool:
    """Return whether a file is one of controllers: YAML with a ``type`` such as ``package/Class``.

    What is not valid YAML is none.
    """
    if file.suffix.lower() not in (".yaml", ".yml") or not file.is_file():
        return False
    try:
        root = _root(file)
    except (yaml.YAMLError, OSError, Error):
        return False
    return any(True for _ in _entries(root)) or any(True for _ in _gains(root))


def check_controllers(path: str | os.PathLike[str], robot: str | os.PathLike[str]) -> list[Problem]:
    """Load every controller of a YAML file for a robot, and list the problems by line.

    Args:
        path: Of the file, as ``rosparam load`` takes it.
        robot: URDF, xacro or SDF of the robot, with transmissions for its joints.
    """
    file = os.fspath(path)
    try:
        root = _root(Path(path))
        model = load_model(robot)
    except yaml.MarkedYAMLError as error:
        line = None if error.problem_mark is None else error.problem_mark.line + 1
        return [Problem("error", f"this is not valid YAML: {error.problem}", file, line)]
    except yaml.YAMLError as error:
        return [Problem("error", f"this is not valid YAML: {error}", file)]
    except Error as error:
        return [Problem.of(error, os.fspath(robot))]
    return _Checker(file, model).check(root)


class _Checker:
    """Loads controllers one by one.

    Args:
        file: File of the parameters.
        model: Of the robot.
    """

    def __init__(self, file: str, model: Model) -> None:
        self._file = file
        self._joints = {j.name: j for placed in model.walk() for j in placed.model.joints}
        self._driven = {name for each in model.transmissions for name, _ in each.joints}
        self._manager = ControllerManager(_hardware_of(model), model=model)

    def check(self, root: yaml.Node | None) -> list[Problem]:
        """Return all problems, errors first."""
        entries = list(_entries(root))
        found = [problem for node in _gains(root) for problem in self._unknown(node)]
        for entry in entries:
            named = list(self._of_joints(entry))
            found += named or self._load(entry)
        found += self._conflicts(entries)
        return sorted(found, key=lambda each: (each.severity != "error", each.line or 0))

    def _unknown(self, gains: yaml.MappingNode) -> Iterator[Problem]:
        """Yield problems with gains of unknown joints."""
        for key, _ in gains.value:
            if key.value not in self._joints:
                yield self._missing(key, f"'{_GAINS}'")

    def _of_joints(self, entry: _Entry) -> Iterator[Problem]:
        """Yield problems with unknown joints, and with joints that no controller can command."""
        reads_only = str(entry.values["type"]).startswith(("joint_state", "imu_", "force_torque"))
        for node in _joint_names(entry.node):
            if node.value not in self._joints:
                yield self._missing(node, f"controller '{entry.name}'")
            elif node.value not in self._driven and not reads_only:
                yield Problem(
                    "error",
                    f"joint '{node.value}' of controller '{entry.name}' has no transmission",
                    self._file,
                    _line(node),
                    hint="gazelle.builders.add_transmission writes one",
                    why="the robot offers it through no interface, so the controller does not load",
                    rule="joint-transmission",
                )

    def _missing(self, node: yaml.ScalarNode, owner: str) -> Problem:
        return Problem(
            "error",
            f"{owner} names the joint '{node.value}', which the robot does not have",
            self._file,
            _line(node),
            hint=did_you_mean(node.value, self._joints),
            rule="controller-joint",
        )

    def _load(self, entry: _Entry) -> list[Problem]:
        """Load a controller, as a manager does."""
        try:
            self._manager.load(entry.name, entry.values)
        except ControlError as error:
            rule, line = _rule_of(error.message), self._line_of(entry, error.message)
            return [Problem("error", error.message, self._file, line, hint=error.hint, rule=rule)]
        return self._weak(entry)

    def _line_of(self, entry: _Entry, message: str) -> int:
        """Return the line of what a message names: a parameter, or a value."""
        if _rule_of(message) == "controller-type":
            return _line(_child(entry.node, "type") or entry.node)
        named = (name for name in re.findall(r"'([^']+)'", message))
        below = next((n for n in named if n.startswith(f"{entry.name}/")), entry.name)
        node: yaml.Node | None = entry.node
        line = entry.line
        for part in below.split("/")[1:]:
            node = _child(node, part)
            if node is None:
                break
            line = _line(node)
        return line

    def _weak(self, entry: _Entry) -> list[Problem]:
        """Return problems with joints that have no effort."""
        claimed = self._manager[entry.name].claimed
        return [
            Problem(
                "warning",
                f"joint '{name}' of controller '{entry.name}' has an effort limit of 0",
                self._file,
                entry.line,
                hint="give its <limit> the largest force or torque of its actuator",
                why="a controller cannot move it",
                rule="no-effort",
            )
            for name in sorted({name for names in claimed.values() for name in names})
            if _effort(self._joints.get(name)) == 0.0
        ]

    def _conflicts(self, entries: list[_Entry]) -> Iterator[Problem]:
        """Yield problems with controllers that cannot run at once."""
        lines = {entry.name: entry.line for entry in entries}
        owner: dict[str, str] = {}
        for entry in self._manager.loaded:
            name = entry.controller.name
            taken: dict[str, list[str]] = {}
            for joint in {j for names in entry.controller.claimed.values() for j in names}:
                if joint in owner:
                    taken.setdefault(owner[joint], []).append(joint)
                owner.setdefault(joint, name)
            for other, joints in taken.items():
                yield Problem(
                    "warning",
                    f"controller '{name}' claims {_list(joints)}, as '{other}' of line {lines[other]} "
                    "does",
                    self._file,
                    lines[name],
                    hint="start one of them only, or load one with --stopped",
                    why="they cannot run at the same time",
                    rule="controller-conflict",
                )


def _rule_of(message: str) -> str:
    """Return the rule that an error of a manager belongs to."""
    if "controller type" in message:
        return "controller-type"
    if "could not find resource" in message or "hardware interface" in message:
        return "controller-interface"
    return "controller-gains" if re.search(r"pid/|gains/|no gains", message) else "controller"


def _hardware_of(model: Model) -> RobotHardware:
    """Return an idle robot with the interfaces of its transmissions and sensors."""
    hardware = RobotHardware()
    offered: dict[str, list[str]] = {}
    for each in model.transmissions:
        for name, interfaces in each.joints:
            for interface in interfaces[:1]:
                kind = interface if interface.startswith(_PREFIX) else _PREFIX + interface
                if kind in COMMAND_FIELDS and name not in offered.setdefault(kind, []):
                    offered[kind].append(name)
    names = [j.name for placed in model.walk() for j in placed.model.joints if j.axes]
    hardware.register_joints(list(dict.fromkeys(names)), {k: v for k, v in offered.items() if v})
    sensors = [s for placed in model.walk() for link in placed.model.links for s in link.sensors]
    sensors += [s for placed in model.walk() for j in placed.model.joints for s in j.sensors]
    for kind, word in ((IMU, "imu"), (FORCE_TORQUE, "force_torque")):
        known = {each.name: None for each in sensors if each.type == word}
        hardware.register(SensorInterface(kind, known))
    return hardware


def _effort(joint: Joint | None) -> float:
    return float("inf") if joint is None else JointLimits.of_joint(joint).effort


def _root(file: Path) -> yaml.Node | None:
    return bounded_yaml.compose(read_text(file))


def _entries(node: yaml.Node | None) -> Iterator[_Entry]:
    """Yield controllers, in namespaces or not."""
    if not isinstance(node, yaml.MappingNode):
        return
    for key, value in node.value:
        kind = _child(value, "type")
        if isinstance(kind, yaml.ScalarNode) and re.search(r"\w[/:]\w", kind.value):
            yield _Entry(str(key.value), _values(value), value, _line(key))
        else:
            yield from _entries(value)


def _gains(node: yaml.Node | None) -> Iterator[yaml.MappingNode]:
    """Yield the mappings with gains of the simulation."""
    if not isinstance(node, yaml.MappingNode):
        return
    for key, value in node.value:
        inner = _child(value, _GAINS) if key.value == "gazebo_ros_control" else None
        if key.value == f"gazebo_ros_control/{_GAINS}":
            inner = value
        if isinstance(inner, yaml.MappingNode):
            yield inner
        elif inner is None:
            yield from _gains(value)


def _joint_names(node: yaml.MappingNode) -> Iterator[yaml.ScalarNode]:
    """Yield the names of joints among the parameters of a controller."""
    for key, value in node.value:
        if not _NAMES.match(str(key.value)):
            continue
        listed = value.value if isinstance(value, yaml.SequenceNode) else [value]
        for each in listed:
            if isinstance(each, yaml.ScalarNode) and each.tag == "tag:yaml.org,2002:str":
                yield each


def _child(node: yaml.Node | None, name: str) -> yaml.Node | None:
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            if key.value == name:
                return value
    return None


def _values(node: yaml.MappingNode) -> Mapping[str, Any]:
    loader = bounded_yaml.bounded(yaml.SafeLoader)("")
    try:
        found: Mapping[str, Any] = loader.construct_document(node)
    finally:
        loader.dispose()
    return found


def _line(node: yaml.Node) -> int:
    return int(node.start_mark.line) + 1


def _list(names: list[str]) -> str:
    return ", ".join(f"'{name}'" for name in sorted(names))
