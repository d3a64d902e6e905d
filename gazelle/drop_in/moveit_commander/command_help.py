"""Help texts and completion of the interpreter of commands."""

from __future__ import annotations

from collections.abc import Iterable

from gazelle.drop_in.moveit_commander.move_group import MoveGroupCommander

_HELP = (
    ("help", "these lines"),
    ("use NAME", "work with a group from now on; 'use previous' with the one before"),
    ("use | groups", "groups that were used"),
    ("id | which", "the group that is used"),
    ("joints", "its joints"),
    ("eef", "its end effector's link"),
    ("current", "where its joints and its end effector are"),
    ("group_state", "where its joints are, to paste into an SRDF"),
    ("go NAME", "go to a remembered posture, or one of the SRDF"),
    ("go rand", "go to a random posture"),
    ("go DIRECTION DISTANCE", "up, down, left, right, forward, backward [m]"),
    ("go X Y Z R P Y [approx]", "bring the end effector to a pose"),
    ("rotate R P Y", "turn the end effector [rad]"),
    ("plan NAME | plan rand", "plan as 'go' would"),
    ("plan", "show the last plan"),
    ("execute", "follow the last plan"),
    ("stop", "stop the group"),
    ("pick NAME, place NAME", "pick up or place a thing of the scene"),
    ("ground", "let the robot's root hold a ground that nothing may touch"),
    ("record NAME", "remember where the joints are"),
    ("rand NAME", "remember a random posture"),
    ("NAME = [V1 V2 ...]", "remember values"),
    ("NAME = OTHER", "remember the same"),
    ("NAME[I] = VALUE", "change a value that is remembered"),
    ("vars, show, show NAME", "what is remembered"),
    ("delete NAME", "forget it"),
    ("save [FILE], load [FILE]", "write what is remembered; run a file of commands"),
    ("planner NAME", "choose a planner"),
    ("time [SECONDS]", "the time to plan"),
    ("tolerance [VALUE]", "tolerances of goals"),
    ("constrain", "plan without path constraints"),
    ("allow looking|replanning true|false", "what move_group may do"),
    ("wait SECONDS", "do nothing"),
    ("trace on|off", "show the lines of files that are loaded"),
)
_PLAIN = (
    "help", "wait", "database", "group_state", "current", "load", "save", "pick", "place", "vars",
    "joints", "tolerance", "time", "eef", "execute", "ground", "id",
)  # fmt: skip


def help_text() -> str:
    """Return the list of commands, one a line."""
    return "\n".join(["Known commands:", *(f"  {form:<38}{text}" for form, text in _HELP)])


def keywords(groups: Iterable[str], group: MoveGroupCommander | None) -> dict[str, list[str]]:
    """Return first words of commands, and their completions.

    Args:
        groups: Names of the robot's groups.
        group: Group in use.
    """
    known = [*group.get_remembered_joint_values()] if group is not None else []
    directions = ["up", "down", "left", "right", "backward", "forward", "random"]
    return {
        "go": [*directions, *known],
        "use": [*groups],
        "allow": ["replanning", "looking"],
        "constrain": list(group.get_known_constraints()) if group is not None else [],
        **dict.fromkeys(("record", "show", "delete", "plan"), known),
        **{word: [] for word in _PLAIN},
    }
