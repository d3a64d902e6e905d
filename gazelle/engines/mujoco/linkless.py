"""Models without links, such as one around an include that was not found."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description import Link, Model

_FRAME = "__model__"
"""The link of a model that has none; a reader refuses this name."""


def with_link(model: Model) -> Model:
    """The model; one without links with an empty one, which stands for its frame.

    Nothing moves such a model, but it has a pose, and can be put elsewhere.
    """
    if any(placed.model.links for placed in model.walk()):
        return model
    return replace(model, static=True, canonical_link="", links=(Link(_FRAME),))
