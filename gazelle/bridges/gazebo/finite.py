"""Numbers that clients send must be finite: one that is not would spoil the whole world."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from gazelle.bridges.gazebo.answers import Answer, no
from gazelle.errors import RosError

Handler = Callable[[Any], Answer]


def not_finite(message: Any, path: str = "") -> str | None:
    """Return the path of the first number in a message that is infinite or NaN.

    None if there is none.
    """
    if isinstance(message, float):
        return None if math.isfinite(message) else path
    if isinstance(message, list | tuple):
        parts = [(f"{path}[{number}]", each) for number, each in enumerate(message)]
    else:
        names = getattr(message, "__slots__", ())
        parts = [(f"{path}.{name}".lstrip("."), getattr(message, name)) for name in names]
    return next((bad for inner, each in parts if (bad := not_finite(each, inner))), None)


def refusing(kind: str, handler: Handler) -> Handler:
    """Return a service handler that rejects requests with such numbers."""

    def checked(request: Any) -> Answer:
        bad = not_finite(request)
        return handler(request) if bad is None else no(f"{kind}: {bad} is not finite")

    return checked


def ignoring(topic: str, act: Handler) -> Handler:
    """Return a topic's callback that skips and logs messages with such numbers."""

    def checked(message: Any) -> Answer:
        bad = not_finite(message)
        if bad is not None:
            raise RosError(f"a message on {topic} is left out: {bad} is not finite")
        return act(message)

    return checked
