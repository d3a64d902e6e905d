"""Commands that give names to joint values: ``x = y``, ``x = [1 2 3]`` and ``x[1] = 2``."""

from __future__ import annotations

import re

from gazelle.drop_in.moveit_commander.group_commands import Answer, good, warn
from gazelle.drop_in.moveit_commander.move_group import MoveGroupCommander

_ASSIGNED = re.compile(r"(\w+)\s*=\s*(\w+)")
_VECTOR = re.compile(r"(\w+)\s*=\s*\[([\d.eE\-+\s]+)\]")
_ELEMENT = re.compile(r"(\w+)\s*\[\s*(\d+)\s*\]\s*=\s*([\d.eE\-+]+)")


def assignment(group: MoveGroupCommander, cmd: str) -> Answer | None:
    """Execute a line that is an assignment; None for other lines."""
    if same := _ASSIGNED.fullmatch(cmd):
        return _assign(group, same[1], same[2], cmd)
    if vector := _VECTOR.fullmatch(cmd):
        return _remember(group, vector[1], vector[2])
    if element := _ELEMENT.fullmatch(cmd):
        return _change(group, cmd, *element.groups())
    return None


def _assign(group: MoveGroupCommander, name: str, other: str, cmd: str) -> Answer:
    known = group.get_remembered_joint_values()
    if other not in known:
        return warn(f"Unknown command: '{cmd}'")
    group.remember_joint_values(name, known[other])
    return good(f"{name} is now the same as {other}")


def _remember(group: MoveGroupCommander, name: str, values: str) -> Answer:
    try:
        group.remember_joint_values(name, [float(each) for each in values.split()])
    except ValueError:
        return warn(f"Unable to parse joint value [{values}]")
    return good(f"Remembered joint values [{values}] under the name {name}")


def _change(group: MoveGroupCommander, cmd: str, name: str, index: str, value: str) -> Answer:
    known = group.get_remembered_joint_values()
    if name not in known:
        return warn(f"Unknown command: '{cmd}'")
    values = [*known[name]]
    try:
        values[int(index)] = float(value)
    except (ValueError, IndexError):
        return warn(f"Unable to parse index or value in '{cmd}'")
    group.remember_joint_values(name, values)
    return good(f"Updated {name}[{index}]")
