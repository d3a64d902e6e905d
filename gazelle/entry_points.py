"""Entry points by which rooms and other packages extend Gazelle.

Gazelle's own parts are found through its rooms, so that a new one is there without installing
again. Only what stands on rooms above the one that looks for it, as `gazelle.drop_in` and
`gazelle.stage` do, is found by entry points too. In a checkout its `pyproject.toml` lists them: what
an installation recorded is as old as that.
"""

from __future__ import annotations

import functools
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.errors import Error

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

_OWN = "gazelle"
_PROJECT = Path(__file__).parents[1] / "pyproject.toml"


@functools.cache
def entry_points_of(group: str) -> dict[str, EntryPoint]:
    """Return all entry points of a group by name.

    Where two packages give one name, Gazelle has it, then the first on ``sys.path``.
    """
    return {**_installed(group, own=False), **_own(group)}


@functools.cache
def entry_points_of_others(group: str) -> dict[str, EntryPoint]:
    """Return entry points of a group by name, less those of Gazelle's own distribution."""
    return _installed(group, own=False)


def load(point: EntryPoint, what: str, error: type[Error]) -> Any:
    """Return the object of an entry point.

    Args:
        point: The entry point.
        what: What it is, in the text of an error.
        error: Class of the error.

    Raises:
        Error: It cannot be imported, of the given class.
    """
    try:
        return point.load()
    except (ImportError, AttributeError) as fault:
        raise error(f"{what} ({point.value}) cannot be loaded: {fault}") from fault


def _own(group: str) -> dict[str, EntryPoint]:
    """Return entry points of Gazelle's own distribution, or of its checkout if there is one."""
    if not _PROJECT.is_file():
        return _installed(group, own=True)
    import tomllib
    from importlib.metadata import EntryPoint

    project = tomllib.loads(_PROJECT.read_text(encoding="utf-8")).get("project", {})
    if project.get("name") != _OWN:
        return _installed(group, own=True)
    listed = project.get("entry-points", {}).get(group, {})
    return {name: EntryPoint(name, value, group) for name, value in listed.items()}


def _installed(group: str, *, own: bool) -> dict[str, EntryPoint]:
    """Return what installed distributions list; the first on ``sys.path`` that gives a name has it."""
    from importlib.metadata import distributions  # late, for it is slow to import

    found: dict[str, EntryPoint] = {}
    for distribution in distributions():
        for point in distribution.entry_points.select(group=group):
            if (point.dist is not None and point.dist.name == _OWN) == own:
                found.setdefault(point.name, point)
    return found
