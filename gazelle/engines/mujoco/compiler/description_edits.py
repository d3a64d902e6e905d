"""Descriptions with the inertia of a link changed, or with a link for a model that has none."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from gazelle.description import Inertia, Inertial, Link, Model, Pose, World


def with_inertial(world: World, scoped: str, kind: str, values: NDArray[np.float64]) -> World:
    """Return the world with the centre of mass or the inertia of a link replaced.

    Args:
        world: World to change.
        scoped: Name of the link.
        kind: ``link_centre`` or ``link_inertia``.
        values: As the engine's parameter of that kind, in the axes of the link.
    """

    def change(link: Link) -> Link:
        inertial = link.inertial or Inertial()
        numbers = [float(value) for value in values]
        if kind == "link_centre":
            pose = Pose.from_quaternion(numbers, inertial.pose.quaternion)
            return replace(link, inertial=replace(inertial, pose=pose))
        upright = Pose(*inertial.pose.position)
        return replace(link, inertial=replace(inertial, pose=upright, inertia=Inertia(*numbers)))

    return with_link(world, scoped, change)


def with_link(world: World, scoped: str, change: Callable[[Link], Link]) -> World:
    """Return the world with a link, by scoped name, replaced by the result of ``change``."""
    top, _, inside = scoped.partition("::")
    models = tuple(
        _changed(model, inside, change) if model.name == top else model for model in world.models
    )
    return replace(world, models=models)


def _changed(model: Model, inside: str, change: Callable[[Link], Link]) -> Model:
    nested, _, rest = inside.partition("::")
    if rest:
        models = tuple(
            _changed(each, rest, change) if each.name == nested else each for each in model.models
        )
        return replace(model, models=models)
    links = tuple(change(link) if link.name == inside else link for link in model.links)
    return replace(model, links=links)


_FRAME = "__model__"
"""The link of a model that has none; a reader refuses this name."""


def with_frame_link(model: Model) -> Model:
    """Return the model; one without links gets an empty link, which stands for its frame.

    Nothing moves such a model, but it has a pose, and can be put elsewhere.
    """
    if any(placed.model.links for placed in model.walk()):
        return model
    return replace(model, static=True, canonical_link="", links=(Link(_FRAME),))
