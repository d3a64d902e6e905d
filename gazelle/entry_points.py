"""Entry points by which other packages extend Gazelle.

Gazelle's own parts are found through its rooms, so that a new one is there without installing
again. Lists of them that an older installation left behind are passed over. Only what stands on rooms
above the one that looks for it, as `gazelle.drop_in` does, is found by entry points too.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

_OWN = "gazelle"


@functools.cache
def entry_points_of(group: str) -> dict[str, EntryPoint]:
    """Return all entry points of a group by name.

    Where two packages give one name, the first on ``sys.path`` has it. Of a package that is listed
    twice both lists count: an old build may have left one in a checkout, before that of the
    installation.
    """
    from importlib.metadata import distributions  # late, for it is slow to import

    found: dict[str, EntryPoint] = {}
    for distribution in distributions():
        for point in distribution.entry_points.select(group=group):
            found.setdefault(point.name, point)
    return found


def entry_points_of_others(group: str) -> dict[str, EntryPoint]:
    """Return entry points of a group by name, less those of Gazelle's own distribution."""
    return {
        name: point
        for name, point in entry_points_of(group).items()
        if point.dist is None or point.dist.name != _OWN
    }
