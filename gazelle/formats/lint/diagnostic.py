"""Diagnostics of the linter."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from gazelle.description import Link, Model, Source, World


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One judgement on a description that can be read.

    Attributes:
        rule: Short name of the rule.
        message: Description of the finding.
        why: Reason.
        hint: The change to make.
        source: Place in a file.
    """

    rule: str
    message: str
    why: str
    hint: str
    source: Source | None


@dataclass(frozen=True, slots=True)
class LinkPlace:
    """A link with the model it is in.

    Attributes:
        scope: Scoped name of its model.
        model: The model that has the link.
        top: The top-level model.
        link: The link.
    """

    scope: str
    model: Model
    top: Model
    link: Link


def links_of(world: World) -> Iterator[LinkPlace]:
    """Yield all links of a world, including nested models."""
    for top in world.models:
        for placed in top.walk():
            for link in placed.model.links:
                yield LinkPlace(placed.scope, placed.model, top, link)


def moving_links_of(world: World) -> Iterator[LinkPlace]:
    """Return all links with a mass that matters: not those of immovable or scripted models."""
    return (
        place
        for place in links_of(world)
        if not (place.top.static or place.link.kinematic or _is_scripted(place.top))
    )


def _is_scripted(model: Model) -> bool:
    return any("scripted_motion" in plugin.filename for plugin in model.plugins)
