"""A robot that can be seen through and moves as planned, and the path of its tip."""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Link, Material, Model, Pose, World
from gazelle.errors import PlanningError
from gazelle.kinematics import RobotModel
from gazelle.rotations import conjugate, from_matrices, multiply, rotate
from gazelle.simulation.joint_motion import JointMotion
from gazelle.viewer.page.restyled import restyled
from gazelle.viewer.page.shapes import ShapeBatches

if TYPE_CHECKING:
    from viser import SceneApi

_VIOLET = (0.55, 0.25, 0.85)
_OPACITY = 0.4
_RATE = 20.0  # moments of a motion a second that are shown
_MOST = 600  # of one motion
_REST = 1.0  # at its end before it begins again [s]
_NEAR, _ALIKE = 0.01, np.cos(0.02 / 2.0)  # when a link counts as being where it ends


class MotionGhost:
    """Shows a motion over and over until the robot has made it.

    Args:
        scene: Of the page.
        root: Under which name it is.
        model: The robot.
        motion: Planned motion.

    Attributes:
        motion: Likewise.
        base: Name of the link that it stands on.
        links: Names of the links that are shown: those that move, and are seen at all.
        made: Whether the robot has made it.
        line: Places of the tip along the motion, in the frame of the base [m], shape (n, 3).

    Raises:
        PlanningError: The robot is not a tree, or has none of the joints.
        FormatError: A mesh of it cannot be read.
    """

    def __init__(self, scene: SceneApi, root: str, model: Model, motion: JointMotion) -> None:
        robot = RobotModel(model)
        self.motion, self.base = motion, robot.root
        states = _states(robot, motion)
        moved = robot.moving([robot.column(name) for name in motion.joints if name in robot.names])
        world = restyled(
            World(models=(replace(model, pose=Pose()),)), lambda link: _see_through(link, moved)
        )
        self._frame = scene.add_frame(root, show_axes=False)
        self._batches = ShapeBatches(
            scene, f"{root}/shapes", world, np.zeros((1, 3)), opacity=_OPACITY
        )
        self.links = tuple(link.rpartition("::")[2] for link in self._batches.links)
        poses = robot.forward(states, self.links)
        self._at, self._turned = poses[..., :3, 3], from_matrices(poses[..., :3, :3])
        tip = motion.tip if motion.tip in robot.links else _tip(robot, motion.joints, states[0])
        self.line: Floats = robot.forward(states, tip)[:, :3, 3]
        if len(self.line) > 1:
            lines = np.stack((self.line[:-1], self.line[1:]), axis=1).astype(np.float32)
            scene.add_line_segments(
                f"{root}/path", lines, _VIOLET, thickness=3.0, thickness_units="screen"
            )
        self._begun = time.monotonic()
        self._left = False  # whether the robot has been elsewhere than at the end
        self.made = False

    def show(self, position: Floats, quaternion: Floats, now: float | None = None) -> None:
        """Show a moment of it.

        Args:
            position: Of the base [m], shape (3,).
            quaternion: x, y, z, w.
            now: Of ``time.monotonic`` [s]; the present if None.
        """
        self._frame.visible = not self.made
        if self.made:
            return
        self._frame.position, self._frame.wxyz = position, quaternion[[3, 0, 1, 2]]
        since = (time.monotonic() if now is None else now) - self._begun
        duration = float(self.motion.times[-1])
        share = min(since % (duration + _REST), duration) / duration if duration else 1.0
        moment = round(share * (len(self._at) - 1))
        self._batches.show(self._at[None, moment], self._turned[None, moment])

    def compare(self, base: tuple[Floats, Floats], links: tuple[Floats, Floats]) -> None:
        """Compare the robot with the motion: whether it was elsewhere, and is now at its end.

        Args:
            base: Position and quaternion of the base.
            links: Those of ``links`` where they are, shapes (links, 3) and (links, 4).
        """
        back = conjugate(base[1])[None]
        at, turned = rotate(back, links[0] - base[0]), multiply(back, links[1])
        off = np.linalg.norm(at - self._at[-1], axis=1)
        alike = np.abs((turned * self._turned[-1]).sum(axis=1))
        there = len(off) > 0 and bool((off < _NEAR).all() and (alike > _ALIKE).all())
        late = time.monotonic() - self._begun > float(self.motion.times[-1])
        self.made = self.made or (there and (self._left or late))
        self._left = self._left or not there

    def remove(self) -> None:
        """Remove it from the page."""
        self._frame.remove()  # and what hangs on it


def _states(robot: RobotModel, motion: JointMotion) -> Floats:
    """Return the positions of all variables at uniform times of a motion, shape (n, variables)."""
    columns = {name: column for column, name in enumerate(robot.names)}
    known = [k for k, name in enumerate(motion.joints) if name in columns]
    if not known or not len(motion.times):
        raise PlanningError(f"'{robot.model.name}' has none of the joints of the motion")
    count = int(np.clip(np.ceil(motion.times[-1] * _RATE) + 1, 2, _MOST))
    moments = np.linspace(0.0, motion.times[-1], count)
    state = robot.zero()
    for name, position in motion.start.items():
        if name in columns:
            state[columns[name]] = position
    states = np.tile(state, (count, 1))
    for k in known:
        column = np.interp(moments, motion.times, motion.positions[:, k])
        states[:, columns[motion.joints[k]]] = column
    return robot.complete(states)


def _tip(robot: RobotModel, joints: Iterable[str], state: Floats) -> str:
    """Return the link that most joints of a motion move, of several the outermost."""
    moves = dict.fromkeys(robot.links, 0)
    for name in joints:
        if name in robot.names:
            for link in robot.moving([robot.column(name)]):
                moves[link] += 1
    most = max(moves.values())
    ends = [link for link, count in moves.items() if count == most]
    places = robot.forward(state, ends)[:, :3, 3]
    inner = places.mean(axis=0) if most == 0 else robot.forward(state, _inner(robot, ends))[:3, 3]
    return ends[int(np.argmax(np.linalg.norm(places - inner, axis=1)))]


def _inner(robot: RobotModel, links: list[str]) -> str:
    """Return the first from the root of links that are fixed to each other, or nearly."""
    return min(links, key=lambda name: robot.links[name].joint)


def _see_through(link: Link, moved: frozenset[str]) -> Link:
    """Return a link in one transparent colour; without looks if it does not move."""
    look = Material(diffuse=(*_VIOLET, 1.0))
    visuals = link.visuals if link.name in moved else ()
    return replace(link, visuals=tuple(replace(each, material=look) for each in visuals))
