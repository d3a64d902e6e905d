"""ROS's commands as programs, for scripts that call ``rosservice`` or ``roslaunch`` by name.

They are small files in a folder of the user's cache, which `offer` puts in front of ``PATH``; the
folder's ``python`` is the one that runs now, and whatever it runs may ``import rospy``. Its terminals
run what they are given without a window where there is no display.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import sys
import tempfile
from collections.abc import Mapping, MutableMapping
from pathlib import Path

from gazelle_ros import tool_names
from gazelle_ros.builtin.terminal import TERMINALS

_PYTHONS = ("python", "python3")
_SITE = "site"

# Both a shell's program and Python's, because scripts also run "python $(which roscore)".
_PROGRAM = """#!/bin/sh
'''exec' {python} "$0" "$@" #'''
import runpy
import sys

from gazelle_ros.process_name import call_process

call_process({name!r})
sys.argv[1:1] = {words!r}
runpy.run_module({module!r}, run_name="__main__", alter_sys=True)
"""
_PYTHON = """#!/bin/sh
exec {python} "$@"
"""
_CUSTOMIZE = """import contextlib

with contextlib.suppress(ImportError):
    import gazelle_ros

    gazelle_ros.install()
"""


def offer(environment: MutableMapping[str, str] | None = None) -> Path | None:
    """Add ROS's commands and Python's modules to an environment's paths.

    An installed ROS comes after them. Where there is no place to write, nothing is changed.

    Args:
        environment: By default this process's.

    Returns:
        The folder; None where there is none: on Windows, too.
    """
    env = os.environ if environment is None else environment
    folder = _made(_files()) if os.name == "posix" else None
    if folder is not None:
        _put_first(env, "PATH", folder)
        _put_first(env, "PYTHONPATH", folder / _SITE)
    return folder


def _put_first(env: MutableMapping[str, str], name: str, folder: Path) -> None:
    rest = [each for each in env.get(name, "").split(os.pathsep) if each != str(folder)]
    env[name] = os.pathsep.join([str(folder), *filter(None, rest)])


def _files() -> dict[str, str]:
    """Return the contents of files by name."""
    python = _quoted(sys.executable)
    files = {name: _PYTHON.format(python=python) for name in _PYTHONS}
    for name, words in tool_names.COMMANDS.items():
        files[name] = _program(name, "gazelle_ros.cli.main", words)
    for name, words in tool_names.NODES.items():
        files[name] = _program(name, "gazelle_ros.builtin.start", words)
    for name in TERMINALS:
        files[name] = _program(name, "gazelle_ros.builtin.terminal", (name,))
    return files | {f"{_SITE}/sitecustomize.py": _CUSTOMIZE}


def _program(name: str, module: str, words: tuple[str, ...]) -> str:
    python = _quoted(sys.executable)
    return _PROGRAM.format(python=python, name=name, words=list(words), module=module)


def _quoted(path: str) -> str:
    """Return a path as one word of the shell; double quotes, as single ones are Python's here."""
    for special in '\\"$`':
        path = path.replace(special, f"\\{special}")
    return f'"{path}"'


def _made(files: Mapping[str, str]) -> Path | None:
    """Return a cache folder with these files; None if the cache is not writable."""
    key = hashlib.sha256(repr(sorted(files.items())).encode()).hexdigest()[:16]
    base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "gazelle" / "programs"
    folder = base / key
    if folder.is_dir():
        return folder
    try:
        base.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=base) as fresh:
            _write(files, Path(fresh) / key)
            with contextlib.suppress(FileExistsError):
                (Path(fresh) / key).rename(folder)
    except OSError:
        return folder if folder.is_dir() else None
    return folder


def _write(files: Mapping[str, str], folder: Path) -> None:
    for name, text in files.items():
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        file.chmod(0o755)
