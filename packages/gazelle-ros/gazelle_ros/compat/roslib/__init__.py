"""roslib's interface: finding packages and types."""

from __future__ import annotations

import sys

from gazelle_ros.compat.roslib import message, names, packages

__all__ = ["is_interactive", "load_manifest", "message", "names", "packages", "set_interactive"]

_interactive = False


def load_manifest(package_name: str, bootstrap_version: str = "0.7") -> None:
    """Make the Python code of a package importable; a missing package is ignored."""
    del bootstrap_version
    from gazelle_ros.messages.search import find_packages

    folder = find_packages().get(package_name)
    if folder is not None and (folder / "src").is_dir() and str(folder / "src") not in sys.path:
        sys.path.insert(0, str(folder / "src"))


def is_interactive() -> bool:
    """Return whether the session is interactive."""
    return _interactive


def set_interactive(interactive: bool) -> None:  # noqa: FBT001  # roslib's interface
    """Set whether the commands are typed."""
    global _interactive  # noqa: PLW0603  # it is one of the process
    _interactive = interactive
