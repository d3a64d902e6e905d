"""Frames received on tf, in every world: where one is in another, by any way."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.rotations import conjugate, multiply, rotate
from gazelle.simulation import Transforms


@dataclass(slots=True)
class _ReceivedTransform:
    """Transform of a frame in its parent, in the worlds that it is known in.

    Attributes:
        parent: Name of the parent.
        static: Whether it is static.
        known: Shape (nworld,).
        position: [m], shape (nworld, 3).
        quaternion: (x, y, z, w), shape (nworld, 4).
    """

    parent: str
    static: bool
    known: NDArray[np.bool_]
    position: Floats
    quaternion: Floats


class ReceivedFrames:
    """The last transforms that were received, by child.

    Args:
        nworld: Number of worlds.
    """

    def __init__(self, nworld: int) -> None:
        self._nworld = nworld
        self._steps: dict[str, _ReceivedTransform] = {}

    @property
    def any(self) -> bool:
        """True if any transform was received."""
        return bool(self._steps)

    def receive(
        self, transforms: Transforms, worlds: Worlds | None, *, static: bool = False
    ) -> None:
        """Store received transforms."""
        rows = slice(None) if worlds is None else worlds
        for each in transforms.transforms:
            child, parent = each.child_frame.lstrip("/"), each.frame.lstrip("/")
            step = self._steps.get(child)
            if step is None or step.parent != parent:
                step = self._steps[child] = self._fresh(parent, static=static)
            step.static = static
            step.known[rows] = True
            step.position[rows], step.quaternion[rows] = each.position, each.quaternion

    def _fresh(self, parent: str, *, static: bool) -> _ReceivedTransform:
        upright = np.tile([0.0, 0.0, 0.0, 1.0], (self._nworld, 1))
        known = np.zeros(self._nworld, np.bool_)
        return _ReceivedTransform(parent, static, known, np.zeros((self._nworld, 3)), upright)

    def find(self, frame: str, base: str) -> tuple[NDArray[np.bool_], Floats, Floats]:
        """Find the transform of a frame in another one, and the worlds in which it is known.

        Returns:
            Whether it is known (nworld,), position (nworld, 3), quaternion (nworld, 4).
        """
        found = self._find(frame, base)
        if found is None:
            upright = np.tile([0.0, 0.0, 0.0, 1.0], (self._nworld, 1))
            return np.zeros(self._nworld, np.bool_), np.zeros((self._nworld, 3)), upright
        return found

    def turn(self, target: str, source: str) -> Floats | None:
        """Return the orientation of a source frame in a target frame, shape (nworld, 4).

        None if no way leads from one to the other. In worlds without a transform of a frame it is
        as its parent.
        """
        found = self._find(source, target)
        return None if found is None else found[2]

    def _find(self, frame: str, base: str) -> tuple[NDArray[np.bool_], Floats, Floats] | None:
        root, known, position, quaternion = self._climb(frame.lstrip("/"))
        other, also, origin, turn = self._climb(base.lstrip("/"))
        if root != other:
            return None
        back = conjugate(turn)
        return known & also, rotate(back, position - origin), multiply(back, quaternion)

    def _climb(self, frame: str) -> tuple[str, NDArray[np.bool_], Floats, Floats]:
        """Return the root above a frame, and the frame's pose in it."""
        known = np.ones(self._nworld, np.bool_)
        position = np.zeros((self._nworld, 3))
        quaternion = np.tile([0.0, 0.0, 0.0, 1.0], (self._nworld, 1))
        passed: set[str] = set()
        while (step := self._steps.get(frame)) is not None and frame not in passed:
            passed.add(frame)
            known = known & step.known
            position = step.position + rotate(step.quaternion, position)
            quaternion = multiply(step.quaternion, quaternion)
            frame = step.parent
        return frame, known, position, quaternion

    def forget(self, worlds: Worlds | None) -> None:
        """Discard all but static transforms."""
        rows = slice(None) if worlds is None else worlds
        for step in self._steps.values():
            if not step.static:
                step.known[rows] = False

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all received transforms."""
        steps = list(self._steps.values())
        shape = (len(steps), self._nworld)
        return {
            "frames": np.asarray([*self._steps], np.str_),
            "parents": np.asarray([step.parent for step in steps], np.str_),
            "static": np.asarray([step.static for step in steps], np.bool_),
            "known": np.array([step.known for step in steps]).reshape(shape),
            "positions": np.array([step.position for step in steps]).reshape(*shape, 3),
            "quaternions": np.array([step.quaternion for step in steps]).reshape(*shape, 4),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._steps = {
            str(frame): _ReceivedTransform(
                str(state["parents"][i]),
                bool(state["static"][i]),
                np.array(state["known"][i], np.bool_),
                np.array(state["positions"][i], np.float64),
                np.array(state["quaternions"][i], np.float64),
            )
            for i, frame in enumerate(state["frames"])
        }
