"""What range finders ask engines for."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle.array_types import Floats


@dataclass(frozen=True, slots=True)
class RangeRays:
    """Rays of a range finder, which asks for the same ones again and again.

    Attributes:
        link: Scoped name of the link that carries them.
        origins: In the link's frame [m], shape (rays, 3).
        directions: Unit vectors, likewise.
        reach: How far they go [m]; what is farther may be left out.
    """

    link: str
    origins: Floats
    directions: Floats
    reach: float = math.inf
