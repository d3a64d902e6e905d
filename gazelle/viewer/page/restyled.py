"""Worlds with restyled links."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from gazelle.description import Link, Model, World


def restyled(world: World, change: Callable[[Link], Link]) -> World:
    """Return a world in which every link is changed, including nested models."""
    return replace(world, models=tuple(_model(model, change) for model in world.models))


def _model(model: Model, change: Callable[[Link], Link]) -> Model:
    return replace(
        model,
        links=tuple(change(link) for link in model.links),
        models=tuple(_model(nested, change) for nested in model.models),
    )
