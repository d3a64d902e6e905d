"""Commands of the interpreter for a group, with MoveIt's answers."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from gazelle.drop_in.moveit_commander import conversions
from gazelle.drop_in.moveit_commander.exception import MoveItCommanderException
from gazelle.drop_in.moveit_commander.move_group import MoveGroupCommander
from gazelle.planning import PlanOutcome
from gazelle_ros.msgs import moveit_msgs

__all__ = ["MoveGroupInfoLevel"]

RANDOM = ("rand", "random")
GO_DIRS = {
    "up": (2, 1), "down": (2, -1), "z": (2, 1),
    "left": (1, 1), "right": (1, -1), "y": (1, 1),
    "forward": (0, 1), "backward": (0, -1), "back": (0, -1), "x": (0, 1),
}  # fmt: skip
"""From a word to its axis and sign."""
_YES = ("1", "true", "T", "True")

Answer = tuple[int, str]


class MoveGroupInfoLevel:
    """Kinds of answers."""

    FAIL = 1
    WARN = 2
    SUCCESS = 3
    INFO = 4
    DEBUG = 5


OK: Answer = (MoveGroupInfoLevel.DEBUG, "OK")


def good(text: str) -> Answer:
    """Return the answer of a successful command."""
    return MoveGroupInfoLevel.SUCCESS, text


def info(text: str) -> Answer:
    """Return an answer with requested information."""
    return MoveGroupInfoLevel.INFO, text


def warn(text: str) -> Answer:
    """Return the answer of an invalid command."""
    return MoveGroupInfoLevel.WARN, text


def fail(text: str) -> Answer:
    """Return the answer of a failed command."""
    return MoveGroupInfoLevel.FAIL, text


def listed(values: Sequence[float]) -> str:
    """Return values as the interpreter writes and reads them."""
    return "[" + " ".join(map(str, values)) + "]"


# -- what is known -------------------------------------------------------------------------


def joints(group: MoveGroupCommander) -> Answer:
    """Return joints, numbered."""
    lines = [f"{number} = {name}" for number, name in enumerate(group.get_joints())]
    return info("\n" + "\n".join(lines) + "\n")


def remembered(group: MoveGroupCommander) -> Answer:
    """Return names and values of remembered postures."""
    known = group.get_remembered_joint_values()
    return info("\n".join(f"{name} = {listed(values)}" for name, values in known.items()))


def show(group: MoveGroupCommander, name: str) -> Answer:
    """Return the values remembered under a name."""
    known = group.get_remembered_joint_values()
    if name in known:
        return info(listed(known[name]))
    return warn(f"Joint values for {name} are not known")


def current(group: MoveGroupCommander) -> Answer:
    """Return the present joint values and the pose of the end effector."""
    text = f"joints = [{', '.join(map(str, group.get_current_joint_values()))}]"
    link = group.get_end_effector_link()
    if link:
        text += f"\n\n{link} pose = [\n{group.get_current_pose()} ]"
        text += f"\n{link} RPY = {group.get_current_rpy()}"
    return info(text)


def group_state(group: MoveGroupCommander) -> Answer:
    """Return the present joint values as SRDF."""
    variables = group.get_variables()
    values = zip(variables, group.get_current_joint_values(), strict=True)
    lines = [
        f'    <group_state name="custom_state" group="{group.get_name()}">',
        *(f'        <joint name="{name}" value="{value}"/>' for name, value in values),
        "    </group_state>",
    ]
    return info("\n".join(lines))


def end_effector(group: MoveGroupCommander) -> Answer:
    """Return the link that poses refer to."""
    return info(group.get_end_effector_link() or "There is no end effector defined")


def tolerance(group: MoveGroupCommander) -> Answer:
    """Return tolerances of goals."""
    values = group.get_goal_tolerance()
    return info("Joint = {:0.6g}, Position = {:0.6g}, Orientation = {:0.6g}".format(*values))


# -- settings ------------------------------------------------------------------------------


def record(group: MoveGroupCommander, name: str) -> Answer:
    """Store the present joint values under a name."""
    group.remember_joint_values(name)
    return good(f"Remembered current joint values under the name {name}")


def record_random(group: MoveGroupCommander, name: str) -> Answer:
    """Store random joint values under a name."""
    group.remember_joint_values(name, group.get_random_joint_values())
    return good(f"Remembered random joint values under the name {name}")


def forget(group: MoveGroupCommander, name: str) -> Answer:
    """Discard the values stored under a name."""
    group.forget_joint_values(name)
    return good(f"Forgot joint values under the name {name}")


def set_planner(group: MoveGroupCommander, name: str) -> Answer:
    """Choose a planner."""
    group.set_planner_id(name)
    return good(f"Planner is now {name}")


def set_tolerance(group: MoveGroupCommander, value: str) -> Answer:
    """Set all tolerances of goals."""
    return _with_number(group.set_goal_tolerance, value, "tolerance value")


def set_time(group: MoveGroupCommander, value: str) -> Answer:
    """Set the time to plan [s]."""
    return _with_number(group.set_planning_time, value, "planning duration value")


def _with_number(act: Callable[[float], object], value: str, what: str) -> Answer:
    try:
        act(float(value))
    except ValueError:
        return warn(f"Unable to parse {what} '{value}'")
    return good("OK")


def wait(_group: MoveGroupCommander, value: str) -> Answer:
    """Wait for some seconds."""
    try:
        time.sleep(float(value))
    except (ValueError, OverflowError):
        return warn(f"Unable to wait '{value}' seconds")
    return good(f"{value} seconds passed")


def clear_constraints(group: MoveGroupCommander) -> Answer:
    """Plan without path constraints."""
    group.clear_path_constraints()
    return good("Cleared path constraints")


def allow(group: MoveGroupCommander, what: str, value: str) -> Answer | None:
    """Allow looking around or planning again."""
    if what in ("look", "looking"):
        group.allow_looking(value in _YES)
    elif what in ("replan", "replanning"):
        group.allow_replanning(value in _YES)
    else:
        return None
    return OK


def stop(group: MoveGroupCommander) -> Answer:
    """Stop the group."""
    group.stop()
    return OK


# -- motions -------------------------------------------------------------------------------


def go(group: MoveGroupCommander, name: str) -> Answer:
    """Move to a remembered or named posture, or a random one."""
    if name in RANDOM:
        values = group.get_random_joint_values()
        group.set_joint_value_target(values)
        name = f"random target {listed(values)}"
    else:
        try:
            group.set_named_target(name)
        except MoveItCommanderException as error:
            return warn(f"Going to {name}: {error}")
    return good(f"Moved to {name}") if group.go() else fail(f"Failed while moving to {name}")


def go_along(group: MoveGroupCommander, direction: str, distance: str) -> Answer:
    """Move the end effector along an axis [m]."""
    try:
        offset = float(distance)
    except ValueError:
        return warn(f"Unable to parse distance '{distance}'")
    axis, factor = GO_DIRS[direction]
    return go_offset(group, offset, factor, axis, direction)


def go_offset(
    group: MoveGroupCommander, offset: float, factor: float, axis: int, direction: str
) -> Answer:
    """Move the end effector along an axis, in a named direction [m]."""
    if not group.has_end_effector_link():
        return warn(f"No known end effector. Cannot move {direction}")
    try:
        group.shift_pose_target(axis, factor * offset)
        arrived = group.go()
    except MoveItCommanderException as error:
        return warn(str(error))
    if arrived:
        return good(f"Moved {direction} by {offset} m")
    return fail(f"Failed while moving {direction}")


def go_to_pose(group: MoveGroupCommander, words: Sequence[str]) -> Answer:
    """Move to x, y, z, roll, pitch, yaw; a seventh word allows approximate solutions."""
    try:
        pose = conversions.list_to_pose([float(word) for word in words[:6]])
    except ValueError:
        return warn(f"Unable to parse pose '{' '.join(words)}'")
    try:
        if words[6:7] and words[6] in ("approx", "approximate"):
            group.set_joint_value_target(pose, True)
        else:
            group.set_pose_target(pose)
        arrived = group.go()
    except MoveItCommanderException as error:
        return warn(f"Going to pose target: {error}")
    if arrived:
        return good(f"Moved to pose target\n{pose}\n")
    return fail(f"Failed while moving to pose \n{pose}\n")


def rotate(group: MoveGroupCommander, *words: str) -> Answer:
    """Rotate the end effector to roll, pitch and yaw [rad]."""
    try:
        angles = [float(word) for word in words]
    except ValueError:
        return warn(f"Unable to parse X-Y-Z rotation  values '{' '.join(words)}'")
    try:
        group.set_rpy_target(angles)
        arrived = group.go()
    except MoveItCommanderException as error:
        return warn(str(error))
    return (
        good("Rotation complete")
        if arrived
        else fail(f"Failed while rotating to {' '.join(words)}")
    )


def plan(
    group: MoveGroupCommander, name: str
) -> tuple[Answer, moveit_msgs.msg.RobotTrajectory | None]:
    """Plan to a posture, as `go`; the answer, and a ``RobotTrajectory``, or None."""
    if name in RANDOM:
        values = group.get_random_joint_values()
        group.set_joint_value_target(values)
        name = listed(values)
    else:
        try:
            group.set_named_target(name)
        except MoveItCommanderException as error:
            return warn(f"Planning to {name}: {error}"), None
    found, trajectory, *_ = group.plan()
    if not found:
        return fail(f"Failed while planning to {name}"), None
    return good(f"Planned to {name}"), trajectory


def pick(group: MoveGroupCommander, name: str) -> Answer:
    """Pick a thing up."""
    if group.pick(name) == PlanOutcome.SUCCESS:
        return good(f"Picked object {name}")
    return fail(f"Failed while trying to pick object {name}")


def place(group: MoveGroupCommander, name: str) -> Answer:
    """Place an object anywhere."""
    if group.place(name):
        return good(f"Placed object {name}")
    return fail(f"Failed while trying to place object {name}")
