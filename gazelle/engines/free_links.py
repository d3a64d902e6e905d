"""Models whose floating joints between links are left out, as Gazebo leaves them out."""

from __future__ import annotations

import warnings
from dataclasses import replace

from gazelle.description import Joint, Model
from gazelle.errors import EngineWarning, located


def warn_of_free_links(model: Model) -> None:
    """Warn of floating joints between links, which do not exist in a simulation."""
    for placed in model.walk():
        for joint in filter(_holds_nothing, placed.model.joints):
            text = (
                f"joint '{placed.scope}::{joint.name}' is floating and left out: "
                f"'{joint.child}' is a free link"
            )
            warnings.warn(EngineWarning(located(text, joint.source)), stacklevel=2)


def with_free_links(model: Model) -> Model:
    """Return the model without floating joints between links, which hold nothing."""
    if not any(_holds_nothing(joint) for each in model.walk() for joint in each.model.joints):
        return model
    joints = tuple(joint for joint in model.joints if not _holds_nothing(joint))
    return replace(model, joints=joints, models=tuple(map(with_free_links, model.models)))


def _holds_nothing(joint: Joint) -> bool:
    return joint.type == "floating" and joint.parent != "world"
