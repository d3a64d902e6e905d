"""What engines have that look at many links at once, for parts of many robots updated together."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, runtime_checkable

from gazelle.array_types import Floats
from gazelle.engines.engine import Engine


@runtime_checkable
class TableEngine(Protocol):
    """What it gives of many is the same bits as one by one, in all worlds."""

    @property
    def nworld(self) -> int:
        """Number of worlds."""

    def cast_ranges_together(
        self, links: Sequence[str], origins: Floats, directions: Floats
    ) -> tuple[Floats, float]:
        """Follow the rays of many range finders; see ``cast_ranges``.

        Args:
            links: That carry them, n in all; one may carry several.
            origins: In the links' frames [m], shape (n, rays, 3).
            directions: Unit vectors, likewise.

        Returns:
            Distances from somewhat behind the origins [m], shape (nworld, n, rays), infinite for
            nothing, minus infinite from inside; and how far behind [m].
        """


def as_table_engine(engine: Engine) -> TableEngine:
    """An engine that is one of these.

    Raises:
        TypeError: It looks at one link at a time.
    """
    if not isinstance(engine, TableEngine):
        raise TypeError(f"{type(engine).__name__} looks at one link at a time")
    return engine
