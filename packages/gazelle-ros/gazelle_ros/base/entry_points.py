"""Entry points by which other packages, and packages of Gazelle itself, extend it.

Gazelle's own modules are imported by name where imports may go that way (`tests/test_imports.py`). Those of
packages above the one that looks for them, as `gazelle.drop_in` and `gazelle.stage`, are found by
entry points. In a checkout each `pyproject.toml` lists them, as an installation's record may be older.
"""

from __future__ import annotations

import functools
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle_ros.base.errors import Error

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

UNIMPORTABLE = (ImportError, TypeError, ValueError)
"""Errors of an import by name: the last two are for texts that no module is called, as ``.a`` and none."""

_OWN = ("gazelle", "gazelle-ros")
_PROJECTS = [folder / "pyproject.toml" for folder in Path(__file__).parents[2:5:2]]
"""Those of ``packages/gazelle-ros`` and of the checkout around it."""


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
        what: Subject of an error.
        error: Class of the error.

    Raises:
        Error: It cannot be imported, of the given class.
    """
    try:
        return point.load()
    except (*UNIMPORTABLE, AttributeError) as fault:
        raise error(f"{what} ({point.value}) cannot be loaded: {fault}") from fault


def _own(group: str) -> dict[str, EntryPoint]:
    """Return entry points of Gazelle's own distributions, or of their checkout if there is one."""
    found = _installed(group, own=True)
    for project in filter(None, map(_project, _PROJECTS)):
        found = {name: each for name, each in found.items() if _owner(each) != project["name"]}
        found |= _listed(project, group)
    return found


def _project(file: Path) -> dict[str, Any] | None:
    """Return the project that a file describes; None unless it is one of Gazelle's."""
    if not file.is_file():
        return None
    import tomllib

    project: dict[str, Any] = tomllib.loads(file.read_text(encoding="utf-8")).get("project", {})
    return project if project.get("name") in _OWN else None


def _listed(project: dict[str, Any], group: str) -> dict[str, EntryPoint]:
    from importlib.metadata import EntryPoint

    listed = project.get("entry-points", {}).get(group, {})
    return {name: EntryPoint(name, value, group) for name, value in listed.items()}


def _owner(point: EntryPoint) -> str | None:
    return None if point.dist is None else point.dist.name


def _installed(group: str, *, own: bool) -> dict[str, EntryPoint]:
    """Return what installed distributions list; the first on ``sys.path`` that gives a name has it."""
    from importlib.metadata import distributions  # late, for it is slow to import

    found: dict[str, EntryPoint] = {}
    for distribution in distributions():
        for point in distribution.entry_points.select(group=group):
            if (_owner(point) in _OWN) == own:
                found.setdefault(point.name, point)
    return found
