"""Numbers of NumPy in JSON: ``json.dumps(value, default=json_encode_np)``."""

from __future__ import annotations

from typing import Any

import numpy as np


def json_encode_np(obj: Any) -> Any:
    """Return an array as a list and a number of NumPy as Python's; others as they are."""
    return obj.tolist() if isinstance(obj, np.ndarray | np.generic) else obj
