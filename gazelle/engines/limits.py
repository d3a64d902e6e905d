"""Limits of all engines, checked once."""

from __future__ import annotations

import math
import operator
from typing import Any

import numpy as np

from gazelle.description import Model, World
from gazelle.errors import EngineError, Error
from gazelle.kinematics.tree import FARTHEST
from gazelle_ros.base.characters import can_be_written
from gazelle_ros.base.real_numbers import finite

NANOSECONDS = 1_000_000_000
"""Nanoseconds in a second."""

# Clocks count whole nanoseconds, and a step of weeks is a mistake [s].
SHORTEST_STEP, LONGEST_STEP = 1e-9, 1e6

# More does not fit into the numbers that native code counts with.
MOST = 2**31 - 1

# A solver that has not ended by then never does: forces are infinite, or no numbers.
MAX_ITERATIONS = 1000

# A world takes a kilobyte at the very least.
MAX_WORLDS = 2**20

MAX_COORDINATES = 24_000
"""Coordinates of motion of one world in space: the compiler's time grows with their square."""

MAX_CHAIN = 1_000
"""Moving links one on the other: MuJoCo compiles 1,023."""

MAX_MOVING = 8_000
"""Moving links of one model: the compiler takes 10 s for them."""

MAX_SOLIDS = 2_000
"""Links of one model that collide and move: MuJoCo needs a list of all pairs of them."""

MAX_RAYS = 4_000_000
"""Of one range finder, all rows together."""

MAX_VALUES = 1 << 28
"""Rays or pixels of one sensor in all worlds together."""


def integer(what: str, value: Any, least: int = 1, most: int = MOST) -> int:
    """Return a valid number of worlds, threads or steps.

    Raises:
        EngineError: It is not an int, or too small or large.
    """
    if isinstance(value, bool):
        raise _not_int(what, value)
    try:
        number = operator.index(value)
    except TypeError:
        raise _not_int(what, value) from None
    if not least <= number <= most:
        raise EngineError(f"{what} must be at least {least} and at most {most}, not {number}")
    return number


def physics_step(step: Any) -> float:
    """Return a valid physics step [s].

    Raises:
        EngineError: It is not a number, not positive, or of no length that a clock could count.
    """
    try:
        seconds = float(step)
    except (TypeError, ValueError, OverflowError):
        raise EngineError(f"the physics step must be a number [s], not {step!r}") from None
    if not seconds > 0.0 or seconds == math.inf:
        raise EngineError(f"the physics step must be positive and finite, not {seconds:g} s")
    if not SHORTEST_STEP <= seconds <= LONGEST_STEP:
        raise EngineError(
            f"a physics step of {seconds:g} s cannot be counted",
            hint=f"take {SHORTEST_STEP:g} to {LONGEST_STEP:g} s, such as 0.001",
        )
    return seconds


def name_fault(name: Any) -> str | None:
    """Return why no model, link or joint can be called so; None for a name that one can have."""
    if not isinstance(name, str) or not name:
        return "a name is text"
    if "::" in name:
        return "'::' parts the names of models and links"
    if not can_be_written(name):
        return "it holds what is not a character"
    return None


def check_world(world: World) -> None:
    """Check the laws, names and poses of a world.

    Raises:
        EngineError: Gravity, magnetic field or wind are not finite, a model's name holds what
            parts names, or a model is infinitely far off.
    """
    physics_step(world.profile.max_step_size)
    laws = {"gravity": world.gravity, "magnetic field": world.magnetic_field, "wind": world.wind}
    for name, values in laws.items():
        if np.shape(values) != (3,) or not all(finite(each) is not None for each in values):
            shown = " ".join(map(str, values)) if np.shape(values) else values
            raise EngineError(f"the {name} must be finite, three numbers, not {shown!s:.60}")
    for model in world.models:
        check_model(model)


def check_model(model: Model, error: type[Error] = EngineError) -> None:
    """Check the name and the pose of a model.

    Raises:
        Error: The name holds what parts names, or the pose is not finite or too far away; of the
            given class.
    """
    name, pose = model.name, model.pose
    why = name_fault(name)
    if why is not None:
        hint = f"call it '{name.replace('::', '_')}'" if "::" in str(name) else None
        raise error(
            f"a model cannot be called {str(name)!r:.60}: {why}", source=model.source, hint=hint
        )
    if not np.isfinite((*pose.position, *pose.quaternion)).all():
        raise error(f"the pose of model '{name}' must be finite, not {pose}", source=model.source)
    if not all(abs(each) <= FARTHEST for each in pose.position):
        raise error(
            f"model '{name}' cannot be at {pose}: that is too far away", source=model.source
        )


def _not_int(what: str, value: Any) -> EngineError:
    return EngineError(f"{what} must be an int, not {value!r:.60}")
