"""Makes the real client's message classes for packages that only the suites have."""

from __future__ import annotations

import subprocess
from pathlib import Path

PYTHON = "/usr/bin/python3"
_GENPY = Path("/usr/lib/genpy")
_ACTIONS = Path("/usr/lib/actionlib_msgs/genaction.py")
_SHARE = Path("/usr/share")


def generate(source: Path, target: Path) -> None:
    """Make genpy's classes for every package in a folder that Debian has none for.

    Args:
        source: Holds packages with ``msg``, ``srv`` and ``action`` folders.
        target: What goes on PYTHONPATH.

    Raises:
        subprocess.CalledProcessError: A definition cannot be read.
    """
    wanted = [each for each in sorted(source.iterdir()) if _has_own_definitions(each)]
    messages = {each.name: [each / "msg"] for each in wanted}
    for package in wanted:
        messages[package.name] += _actions(package, target)
    for folder in sorted(_SHARE.glob("*/msg")):
        messages.setdefault(folder.parent.name, [folder])
    search = [f"-I{name}:{place}" for name, places in messages.items() for place in places]
    for package in wanted:
        out = target / package.name
        out.mkdir(parents=True, exist_ok=True)
        (out / "__init__.py").touch()
        files = [file for place in messages[package.name] for file in place.glob("*.msg")]
        _run("genmsg_py.py", package.name, search, out / "msg", files)
        _run("gensrv_py.py", package.name, search, out / "srv", [*package.glob("srv/*.srv")])


def _has_own_definitions(package: Path) -> bool:
    installed = Path("/usr/lib/python3/dist-packages") / package.name
    kinds = ("msg", "srv", "action")
    return any((package / kind).is_dir() for kind in kinds) and not installed.is_dir()


def _actions(package: Path, target: Path) -> list[Path]:
    """Return the folder with the seven messages of each action, if there is any."""
    actions = sorted(package.glob("action/*.action"))
    folder = target / ".actions" / package.name
    for action in actions:
        folder.mkdir(parents=True, exist_ok=True)
        command = [PYTHON, _ACTIONS, action, "-o", folder]
        subprocess.run(command, check=True, capture_output=True, timeout=60)
    return [folder] if actions else []


def _run(program: str, package: str, search: list[str], out: Path, files: list[Path]) -> None:
    if not files:
        return
    command = [PYTHON, _GENPY / program, "-p", package, *search, "-o", out, *sorted(files)]
    subprocess.run(command, check=True, capture_output=True, timeout=600)
    # Both folders get their __init__ from the messages' program.
    command = [PYTHON, _GENPY / "genmsg_py.py", "--initpy", "-o", out]
    subprocess.run(command, check=True, capture_output=True, timeout=60)
