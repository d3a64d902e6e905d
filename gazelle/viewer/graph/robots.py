"""Robots of a graph: descriptions from parameters, link poses from tf."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.description import Model, World
from gazelle.errors import Error, GazelleWarning
from gazelle.rotations import conjugate, multiply, rotate
from gazelle.viewer.page.shapes import ShapeBatches
from gazelle_ros.tf.core import FrameTree
from gazelle_ros.tf.errors import TransformException

if TYPE_CHECKING:
    from viser import SceneApi

_AROUND = 0.2  # size of a link around its origin [m]


class DescribedRobot:
    """A robot with the link poses that tf reports.

    Args:
        scene: Of the page.
        root: Under which name it is.
        text: Its URDF.
        prefix: Before the names of its frames, such as ``robot1/``.

    Attributes:
        text: Likewise.
        prefix: Likewise.
        model: Model of the description.
        placed: Whether tf knows any of its links.
        shown: Whether the user wants to see it.

    Raises:
        Error: The text describes no robot.
    """

    def __init__(self, scene: SceneApi, root: str, text: str, prefix: str) -> None:
        self.text, self.prefix = text, prefix
        self.placed, self.shown = False, True
        self.model = model = _model(text)
        self._batches = ShapeBatches(scene, root, World(models=(model,)), np.zeros((1, 3)))
        self._frames = [prefix + link.rpartition("::")[2] for link in self._batches.links]
        self._at = self._batches.rest[0][None].copy()
        self._turned = self._batches.rest[1][None].copy()

    @property
    def extent(self) -> Floats | None:
        """Lowest and highest corner around the links [m], shape (2, 3); None if it is not seen."""
        if not (self.placed and self.shown):
            return None
        at = self._at[0]
        return np.array([at.min(axis=0) - _AROUND, at.max(axis=0) + _AROUND])

    def show(self, tree: FrameTree, fixed: str) -> None:
        """Update the links from tf; unknown ones keep their pose relative to known ones."""
        known = np.zeros(len(self._frames), np.bool_)
        for number, frame in enumerate(self._frames):
            try:
                found = tree.lookup(fixed, frame)
            except TransformException:
                continue
            known[number] = True
            self._at[0, number], self._turned[0, number] = found.translation, found.rotation
        self.placed = bool(known.any())
        self._batches.hide(hidden=not (self.placed and self.shown))
        if self.placed:
            self._place_others(int(np.flatnonzero(known)[0]), ~known)
            self._batches.show(self._at, self._turned)

    def _place_others(self, base: int, others: Bools) -> None:
        """Move links along with a placed one, by their poses in the description."""
        at, turned = self._batches.rest
        turn = multiply(self._turned[0, base], conjugate(turned[base]))[None]
        moved = rotate(turn, at[others] - at[base])
        self._at[0, others] = self._at[0, base] + moved
        self._turned[0, others] = multiply(turn, turned[others])

    def remove(self) -> None:
        """Remove it from the page."""
        self._batches.remove()


def _model(text: str) -> Model:
    """Return the robot of a text, without the warnings of its first loading."""
    from gazelle import formats

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", GazelleWarning)
        try:
            return formats.load_model_string(text, name="robot_description")
        except (ValueError, OSError) as error:
            raise Error(f"robot_description cannot be read: {error}") from error
