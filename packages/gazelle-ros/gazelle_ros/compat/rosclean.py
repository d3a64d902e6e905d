"""rosclean's interface: how much room logs take. Nothing is deleted here."""

from __future__ import annotations

from pathlib import Path

_UNITS = ("B", "K", "M", "G", "T")


class CleanupException(Exception):  # noqa: N818  # rosclean's name
    """A folder cannot be looked at."""


def get_disk_usage(d: str) -> int:
    """Return the size of the files below a folder [bytes].

    Raises:
        CleanupException: There is no such folder.
    """
    folder = Path(d)
    if not folder.is_dir():
        raise CleanupException(f"there is no folder {d}")
    return sum(file.lstat().st_size for file in folder.rglob("*") if file.is_file())


def get_human_readable_disk_usage(d: str) -> str:
    """Return the disk usage as text, such as ``1.5M``.

    Raises:
        CleanupException: There is no such folder.
    """
    size: float = get_disk_usage(d)
    for unit in _UNITS[:-1]:
        if size < 1024:
            return f"{size:.3g}{unit}"
        size /= 1024
    return f"{size:.3g}{_UNITS[-1]}"
