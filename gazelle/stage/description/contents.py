"""Stage's content of worlds and models that were read from Stage files."""

from __future__ import annotations

from gazelle.description import Model, World
from gazelle.stage.description.models import StageModel, StageWorld


def stage_world(world: World) -> StageWorld | None:
    """Return all that a Stage file says, which a world's models are made of; None of another file."""
    return world.content if isinstance(world.content, StageWorld) else None


def stage_model(model: Model) -> StageModel | None:
    """Return all that a Stage file says of a model; None of another file."""
    return model.content if isinstance(model.content, StageModel) else None
