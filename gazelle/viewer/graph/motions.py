"""Plans of arms on a graph: what ``move_group`` shows on ``display_planned_path``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.errors import Error
from gazelle.simulation.joint_motion import JointMotion
from gazelle.viewer.graph.robots import DescribedRobot
from gazelle.viewer.page.motion_ghost import MotionGhost
from gazelle_ros.msgs import moveit_msgs
from gazelle_ros.tf import FrameTree, TransformException

if TYPE_CHECKING:
    from viser import SceneApi

KIND = "moveit_msgs/DisplayTrajectory"

_Placed = tuple[Floats, Floats]


class MotionTopic:
    """The last plan of a topic, as a ghost of its robot.

    Args:
        scene: Of the page.
        root: Under which name it is.
        topic: Its name.
    """

    def __init__(self, scene: SceneApi, root: str, topic: str) -> None:
        self._scene, self._root, self._topic = scene, root, topic
        self._message: Any = None
        self._ghost: MotionGhost | None = None
        self._robot: DescribedRobot | None = None
        self._count = 0

    def take(self, message: moveit_msgs.msg.DisplayTrajectory) -> None:
        """Show another plan from now on; one without points is none."""
        if self._ghost is not None:
            self._ghost.remove()
        self._ghost, self._message = None, message

    def show(self, tree: FrameTree, fixed: str, robots: Mapping[str, DescribedRobot]) -> None:
        """Move the ghost to where the plan is now.

        Args:
            tree: Tree of the frames.
            fixed: The frame of the page.
            robots: By the parameters of their descriptions.

        Raises:
            Error: The plan is of joints that the robot has not, or is not well made.
        """
        if self._message is not None:
            robot = robot_of(self._topic, self._message.model_id, robots)
            if robot is None:
                return  # it may still come
            message, self._message = self._message, None
            motion = motion_of(message)
            if motion is None:
                return
            self._count += 1
            name = f"{self._root}/{self._count}"
            self._ghost = MotionGhost(self._scene, name, robot.model, motion)
            self._robot = robot
        ghost, robot = self._ghost, self._robot
        if ghost is None or robot is None:
            return
        base = _placed(tree, fixed, robot.prefix + ghost.base)
        if base is None:
            return
        links = [_placed(tree, fixed, robot.prefix + link) for link in ghost.links]
        known = [link for link in links if link is not None]
        if len(known) == len(links):
            at = np.array([place for place, _ in known]).reshape(-1, 3)
            ghost.compare(base, (at, np.array([turn for _, turn in known]).reshape(-1, 4)))
        ghost.show(*base)


def motion_of(message: moveit_msgs.msg.DisplayTrajectory) -> JointMotion | None:
    """Return a DisplayTrajectory as one motion, its parts one after the other.

    None without points.

    Raises:
        Error: A point has more or fewer positions than there are joints.
    """
    joint_state = message.trajectory_start.joint_state
    state = dict(zip(joint_state.name, joint_state.position, strict=False))
    parts = [part.joint_trajectory for part in message.trajectory]
    joints = tuple(dict.fromkeys(name for part in parts for name in part.joint_names))
    now, begin = dict(state), 0.0
    times, rows = list[float](), list[list[float]]()
    for part in parts:
        for point in part.points:
            if len(point.positions) != len(part.joint_names):
                raise Error(
                    f"a point of the trajectory has {len(point.positions)} positions for "
                    f"{len(part.joint_names)} joints"
                )
            now.update(zip(part.joint_names, point.positions, strict=True))
            when = begin + point.time_from_start.to_sec()
            times.append(max(when, times[-1] if times else 0.0))
            rows.append([now.get(name, 0.0) for name in joints])
        begin = times[-1] if times else 0.0
    if not rows:
        return None
    positions = np.array(rows, np.float64)
    if not np.isfinite(positions).all():
        raise Error("a point of the trajectory has a position that is not a number")
    return JointMotion(joints, np.array(times), positions, state)


def robot_of(topic: str, model: str, robots: Mapping[str, DescribedRobot]) -> DescribedRobot | None:
    """Return the robot of a plan by name; of several, by the longest common namespace."""
    named = {key: robot for key, robot in robots.items() if robot.model.name == model}

    def shared(key: str) -> int:
        own = key.strip("/").split("/")[:-1]
        above = topic.strip("/").split("/")
        return len(own) if above[: len(own)] == own else -1

    found = sorted(named or robots, key=lambda key: (-shared(key), key))
    return robots[found[0]] if found else None


def _placed(tree: FrameTree, fixed: str, frame: str) -> _Placed | None:
    try:
        found = tree.lookup(fixed, frame)
    except TransformException:
        return None
    return np.array(found.translation, np.float64), np.array(found.rotation, np.float64)
