"""Names of files that are close to one that was not found."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from urllib.parse import unquote

from gazelle.errors import closest_of

_NAMED = {"model", "package"}


def near_miss(
    uri: str,
    base: Path | None,
    folder_of: Callable[[str], Path | None],
    names: Callable[[], Iterable[str]],
) -> str | None:
    """Return a hint for a URI or path that leads nowhere; None if nothing is close to it.

    Args:
        uri: As for ``Resolver.find``.
        base: Folder that a relative path starts from.
        folder_of: Returns the folder of a package or model.
        names: Returns the known packages and models.
    """
    if "$(" in uri:
        return "only xacro and launch files expand $(...)"
    scheme, separator, rest = uri.partition("://")
    if scheme in _NAMED and separator:
        name, _, inner = rest.partition("/")
        if not name:
            return f"the name of the {scheme} is missing: write {scheme}://NAME/FILE"
        folder = folder_of(name)
        if folder is None:
            return closest_of(name, names())
        return closest_below(folder, inner) or f"there is no such file in {folder}"
    if scheme == "file" and separator:
        return closest_below(Path("/"), rest) if rest.startswith("/") else None
    if separator or base is None or uri.startswith(("/", "~")):
        return None
    return closest_below(base, uri) or (None if "/" in uri else closest_of(uri, names()))


def closest_below(folder: Path, inner: str) -> str | None:
    """Return a hint with the path that is there below a folder, or the first part that is close."""
    found: list[str] = []
    for part in filter(None, unquote(inner).split("/")):
        names = _names_in(folder)
        there = [part] if part in {*names, ".", ".."} else [n for n in names if _alike(n, part)]
        if not there:
            return closest_of(part, names)
        found.append(there[0])
        folder /= there[0]
    return f"did you mean '{'/'.join(found)}'?" if "/".join(found) != inner else None


def describe_folder(file: Path) -> str:
    """Describe the folder in which a file was expected, for a message."""
    folder = file.absolute().parent
    if not folder.is_dir():
        return f"there is no folder {folder}"
    close = closest_of(file.name, _names_in(folder))
    return close or f"there is nothing of that name or a similar one in {folder}"


def _alike(one: str, other: str) -> bool:
    return one.casefold() == other.casefold()


def _names_in(folder: Path) -> list[str]:
    try:
        return sorted(entry.name for entry in folder.iterdir())
    except OSError:
        return []
