"""Commands that come to controllers, judged before they are taken."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats
from gazelle.errors import ControlError


def rows_of(what: str, commands: ArrayLike, width: int, count: int) -> Floats:
    """Return numbers for a given number of worlds, shape (count, width).

    NaN and infinity pass, as in ros_control's forwarding controllers.

    Args:
        what: For the message.
        commands: Shape (width,) or (count, width); with a width of 1 also () or (count,).
        width: Numbers for one world.
        count: Worlds.

    Raises:
        ControlError: They are not numbers, or more or fewer.
    """
    try:
        values = np.asarray(commands, np.float64)
    except (TypeError, ValueError, OverflowError):
        raise ControlError(f"{what} must be numbers, not {commands!r}") from None
    if width == 1 and values.shape in ((), (count,)):
        values = values.reshape(-1, 1)
    if values.shape not in ((width,), (count, width), (1, width)):
        raise ControlError(
            f"dimension of {what} ({values.size}) does not match number of joints ({width}), "
            "not executing"
        )
    return np.array(np.broadcast_to(values, (count, width)))
