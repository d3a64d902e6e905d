"""Entry points by which other packages, and packages of Gazelle itself, extend it.

Gazelle's own modules are imported by name where imports may go that way (`tests/test_imports.py`). Those of
packages above the one that looks for them, as `gazelle.drop_in` and `gazelle.stage`, are found by
entry points. In a checkout its `pyproject.toml` lists them, as an installation's record may be older.
"""

from __future__ import annotations

import functools
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle_ros.base.errors import Error

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
