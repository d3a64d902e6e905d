"""Arrays of a saved state, checked against those that they replace."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

_Scalar = TypeVar("_Scalar", bound=np.generic)


def saved_array(
    state: Mapping[Any, Any], name: object, like: npt.NDArray[_Scalar]
) -> npt.NDArray[_Scalar]:
    """Return a copy of an array of a saved state, with the type and shape of the present one.

    Raises:
        KeyError: The state has no such array.
        ValueError: It has another shape.
    """
    array = np.array(state[name], dtype=like.dtype)
    if array.shape != like.shape:
        raise ValueError(f"entry {name!r} has the shape {array.shape}, not {like.shape}")
    return array
