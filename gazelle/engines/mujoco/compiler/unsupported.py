"""Warnings about unsupported elements of links, one for all links of a world."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Sequence

import numpy as np

from gazelle.description import Collision
from gazelle.errors import EngineWarning, located
from gazelle.kinematics.tree import TreeLink

LEAST_MOMENT = 1e-12
"""A moment of inertia that is less is taken for this; MuJoCo refuses 1e-15 [kg m²]."""

_NAMED = 5


def warn_of_links(models: Iterable[Sequence[TreeLink]]) -> None:
    """Warn of links with too small an inertia to simulate, or with tags without effect."""
    moving = [body for bodies in models for body in bodies if body.root != "static"]
    _warn(
        [body for body in moving if _is_tiny(body)],
        f"a moment of inertia below {LEAST_MOMENT:g} kg m², which was used instead",
    )
    _warn(
        [body for body in moving if _decays(body)],
        "a <velocity_decay>, which has no effect; give their joints <damping>",
    )
    _warn(
        [body for body in moving if body.link.kinematic and body.root != "kinematic"],
        "<kinematic>, which has no effect: forces move it; say <static> of a model that stands",
    )


def warn_of_plane(body: TreeLink, collision: Collision) -> None:
    """Warn that the plane of a moving link does not move with it."""
    text = f"the plane '{collision.name}' of the link '{body.name}' stays where it is, as ODE's do"
    warnings.warn(EngineWarning(located(text, collision.source)), stacklevel=2)


def _is_tiny(body: TreeLink) -> bool:
    inertial = body.link.inertial
    return inertial is not None and bool(
        np.linalg.eigvalsh(inertial.inertia.matrix())[0] < LEAST_MOMENT
    )


def _decays(body: TreeLink) -> bool:
    return bool(body.link.velocity_decay_linear or body.link.velocity_decay_angular)


def _warn(bodies: Sequence[TreeLink], what: str) -> None:
    if not bodies:
        return
    names = ", ".join(f"'{body.name}'" for body in bodies[:_NAMED])
    more = f" and {len(bodies) - _NAMED} more" if len(bodies) > _NAMED else ""
    source = (bodies[0].link.inertial or bodies[0].link).source
    verb = "link {} has {}" if len(bodies) == 1 else "links {} have {}"
    text = located(verb.format(names + more, what), source)
    warnings.warn(EngineWarning(text), stacklevel=4)
