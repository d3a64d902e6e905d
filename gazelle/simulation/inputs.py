"""Judge what users hand in before it reaches the engine."""

from __future__ import annotations

import operator
import sys
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike

from gazelle.argument_checks import are_indices
from gazelle.array_types import Floats, Worlds
from gazelle.errors import SimulationError
from gazelle.kinematics.tree import FARTHEST
from gazelle.native.index_order import order_of
from gazelle.native.quaternion_rows import are_orientations, are_within

# Parameters of several numbers, which are not one an axis.
VECTORS = ("gravity", "link_centre", "link_inertia", "wheel_slip")

# Indices of world 0 alone.
FIRST_WORLD = np.zeros(1, np.intp)
FIRST_WORLD.setflags(write=False)

_MOST_STEPS = 2**31 - 1

# Nanoseconds of three centuries fit into 64 bits [s].
LONGEST_RUN = 9e9

# Characters of a value that a message shows.
_LONGEST = 60


def chosen(worlds: ArrayLike | None, nworld: int) -> Worlds | None:
    """Return indices of worlds, given as indices or a mask, in the order given; None stays None.

    Raises:
        SimulationError: There is no such world.
    """
    if worlds is None:
        return None
    if are_indices(worlds) and order_of(worlds, nworld) == 2:
        return worlds.copy()
    try:
        given = np.asarray(worlds)
    except ValueError:  # rows of different lengths
        given = np.zeros((0, 0))
    if not given.ndim:
        given = given.reshape(1)
    if given.dtype == np.bool_ and given.shape == (nworld,):
        return np.flatnonzero(given)
    whole = given.ndim == 1 and (given.size == 0 or given.dtype.kind in "iu")
    # What is below zero is large without a sign: one look is enough.
    if not whole or (given.size and not np.maximum.reduce(given.astype(np.uint64)) < nworld):
        raise SimulationError(
            f"worlds must be in 0 to {nworld - 1}, or a mask of {nworld}, not {_short(worlds)}"
        )
    indices: Worlds = given.astype(np.intp)
    if not is_ascending(indices) and len(np.unique(indices)) < len(indices):
        raise SimulationError(f"worlds must be named once each, not {_short(worlds)}")
    return indices


def is_ascending(worlds: Worlds) -> bool:
    """Return True if each world has a larger index than the one before."""
    return order_of(worlds, sys.maxsize) == 2


def one_world(world: int, nworld: int) -> int:
    """Return the index of a world.

    Raises:
        SimulationError: There is no such world, or it is not an int.
    """
    try:
        index = operator.index(world)
    except TypeError:
        index = -1
    if not 0 <= index < nworld:
        raise SimulationError(f"there is no world {_short(world)}; worlds are 0 to {nworld - 1}")
    return index


def size_of(worlds: Worlds | None, nworld: int) -> int:
    """Return the number of chosen worlds."""
    return nworld if worlds is None else len(worlds)


def finite(what: str, values: ArrayLike, width: int, count: int, *, alike: bool = False) -> Floats:
    """Return finite numbers of a known shape; see ``numbers``.

    Raises:
        SimulationError: They are not numbers, not finite, or too many or too few.
    """
    given = numbers(what, values, width, count, alike=alike)
    if np.count_nonzero(np.isfinite(given)) < given.size:
        raise SimulationError(f"{what} must be finite, not {_short(values)}")
    return given


def numbers(what: str, values: ArrayLike, width: int, count: int, *, alike: bool = False) -> Floats:
    """Return numbers of shape (width,) or (count, width); single ones may be () or (count,).

    Args:
        what: For the message.
        values: Values.
        width: Numbers for one world.
        count: Number of worlds.
        alike: Whether one number may stand for all of a world.

    Raises:
        SimulationError: They are not numbers, or too many or too few.
    """
    try:
        given = np.asarray(values, np.float64)
    except (TypeError, ValueError, OverflowError):
        raise SimulationError(f"{what} must be numbers, not {_short(values)}") from None
    if (width == 1 and given.ndim < 2) or (alike and given.shape in ((), (count,))):
        given = given.reshape(-1, 1)
    widths = ((width,), (1,)) if alike else ((width,),)
    if given.shape[-1:] not in widths or given.shape[:-1] not in ((), (1,), (count,)):
        one = "a number" if width == 1 else f"{width} numbers"
        rows = f", or a row of them for each of {count} worlds" if count > 1 else ""
        raise SimulationError(f"{what} must be {one}{rows}, not {_short(values)}")
    if given.shape[-1] == width:
        return given
    return np.broadcast_to(given, (*given.shape[:-1], width))


def placement(
    name: str, position: ArrayLike, quaternion: ArrayLike, count: int
) -> tuple[Floats, Floats]:
    """Return a valid position and quaternion for a given number of worlds.

    Raises:
        SimulationError: They are not finite, too far away, no orientation, or of another shape.
    """
    what = f"the position of '{name}'", f"the orientation of '{name}'"
    place, turn = numbers(what[0], position, 3, count), numbers(what[1], quaternion, 4, count)
    if are_within(np.atleast_2d(place), FARTHEST) and are_orientations(np.atleast_2d(turn)):
        return place, turn
    place, turn = finite(what[0], position, 3, count), finite(what[1], quaternion, 4, count)
    if not (np.abs(place) <= FARTHEST).all():
        raise SimulationError(f"the position of '{name}' is too far away: {_short(position)}")
    largest = np.abs(turn).max(axis=-1, keepdims=True)
    if not largest.all():
        raise SimulationError(
            f"the orientation of '{name}' must not be all zeros",
            hint="the identity is (0, 0, 0, 1): x, y, z, w",
        )
    return place, turn / largest  # so that numbers of any size have squares


def motion(name: str, linear: ArrayLike, angular: ArrayLike, count: int) -> tuple[Floats, Floats]:
    """Return a valid linear and angular velocity for a given number of worlds.

    Raises:
        SimulationError: They are not finite, or of another shape.
    """
    return (
        finite(f"the velocity of '{name}'", linear, 3, count),
        finite(f"the angular velocity of '{name}'", angular, 3, count),
    )


def number(what: str, value: object) -> float:
    """Return a single number.

    Raises:
        SimulationError: It is none.
    """
    if not isinstance(value, Real):
        raise SimulationError(f"{what} must be a number, not {value!r}")
    try:
        return float(value)
    except OverflowError:
        raise SimulationError(f"{what} is too large: {_short(value)}") from None


def steps(count: int) -> int:
    """Return a valid number of physics steps.

    Raises:
        SimulationError: It is negative, or no int.
    """
    try:
        whole = operator.index(count)
    except TypeError:
        raise SimulationError(f"cannot step {count} times: that is not an int") from None
    if whole < 0:
        raise SimulationError(f"cannot step {whole} times; time goes forward only")
    if whole > _MOST_STEPS:
        raise SimulationError(f"cannot step {whole} times at once, but {_MOST_STEPS} at most")
    return whole


def duration(seconds: float) -> float:
    """Return a valid duration [s].

    Raises:
        SimulationError: It is negative or not finite.
    """
    try:
        possible = 0.0 <= seconds <= LONGEST_RUN
    except TypeError:
        raise SimulationError(
            f"cannot run for {seconds!r}: that is not a time in seconds"
        ) from None
    if not possible:
        raise SimulationError(
            f"cannot run for {seconds} s; time goes forward only, and {LONGEST_RUN:g} s at most"
        )
    return seconds


def _short(values: object) -> str:
    """Return values as text of one line."""
    text = " ".join(str(values).split())
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]} ..."
