"""Finds or fetches the repositories whose suites are run."""

from __future__ import annotations

import os
import shutil
import subprocess
import tarfile
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from xml.etree import ElementTree as ET

DEBIAN = ("ros-ros-comm", "ros-actionlib", "ros-geometry", "ros-geometry2")
_LIST = """Types: deb-src
URIs: http://deb.debian.org/debian
Suites: bookworm
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg
"""


def fetch(folder: Path) -> list[str]:
    """Fetch the source packages of Debian 12 with apt, and unpack them.

    The lists and caches of apt are kept in the folder too: the system's own are left as they are.

    Args:
        folder: Where they go.

    Returns:
        The packages that could not be had.
    """
    if shutil.which("apt-get") is None:
        return list(DEBIAN)
    options = _apt_options(folder)
    subprocess.run(["apt-get", *options, "-qq", "update"], check=False, timeout=300)
    missing = []
    for package in DEBIAN:
        place = folder / package
        place.mkdir(exist_ok=True)
        command = ["apt-get", *options, "-qq", "source", "--download-only", package]
        subprocess.run(command, cwd=place, check=False, timeout=300, capture_output=True)
        archives = list(place.glob("*.orig.tar.*"))
        for archive in archives:
            with tarfile.open(archive) as packed:
                packed.extractall(place, filter="data")
        if not archives:
            missing.append(package)
    return missing


def _apt_options(folder: Path) -> list[str]:
    for each in ("apt/parts", "apt/lists/partial", "apt/cache/archives/partial"):
        (folder / each).mkdir(parents=True, exist_ok=True)
    (folder / "apt/parts/sources.sources").write_text(_LIST)
    settings = {
        "Dir::Etc::SourceList": "/dev/null",
        "Dir::Etc::SourceParts": folder / "apt/parts",
        "Dir::State::Lists": folder / "apt/lists",
        "Dir::Cache": folder / "apt/cache",
        "APT::Sandbox::User": "root",
    }
    return [word for key, value in settings.items() for word in ("-o", f"{key}={value}")]


def packages(folder: Path) -> dict[str, Path]:
    """Return the folders of ROS packages below a folder, by the names in their manifests."""
    found: dict[str, Path] = {}
    for place, folders, files in os.walk(folder, followlinks=True):
        if "package.xml" in files:
            name = ET.parse(Path(place) / "package.xml").findtext("name", "").strip()
            found.setdefault(name, Path(place))
            folders.clear()
        folders[:] = sorted(name for name in folders if not name.startswith("."))
    return found


_OWN_NODES = "rostest"
"""A package whose nodes its tests start by name; those of the installed one would be found first."""


def overlay(found: dict[str, Path], names: Iterable[str], folder: Path, python: Path) -> None:
    """Make a folder with copies of some packages, whose scripts run with a given Python.

    A whole tree cannot be on ROS_PACKAGE_PATH: its rosbag_storage would hide the installed one,
    whose plugins rosbag then misses. PATH cannot say which Python it is: Debian's rostest puts its
    own in front.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for name in sorted(set(names)):
        if name in found:
            shutil.copytree(found[name], folder / name)
    if _OWN_NODES in found:
        _copy_as(found[_OWN_NODES], folder, f"{_OWN_NODES}_copy")
    for file in folder.rglob("*"):
        if file.is_file():
            _use_python(file, python)


@contextmanager
def hiding(folder: Path, names: Iterable[str]) -> Iterator[None]:
    """Hide folders below a folder for a while."""
    with ExitStack() as stack:
        for name in names:
            place = folder / name
            away = folder.parent / f"hidden-{name.replace('/', '-')}"
            place.rename(away)
            stack.callback(away.rename, place)
        yield


def build(source: Path) -> None:
    """Compile a node of one source file with roscpp, beside its source.

    Raises:
        subprocess.CalledProcessError: There is no compiler or no roscpp, or they refuse it.
    """
    question = ["pkg-config", "--cflags", "--libs", "roscpp"]
    flags = subprocess.run(question, check=True, capture_output=True, text=True).stdout.split()
    command = ["g++", "-std=c++17", str(source), "-o", str(source.with_suffix("")), *flags]
    subprocess.run(command, check=True, timeout=300)


def _copy_as(package: Path, folder: Path, name: str) -> None:
    """Copy a package under another name, and let the other packages' tests start its nodes."""
    shutil.copytree(package, folder / name)
    _replace(folder / name / "package.xml", f"<name>{package.name}<", f"<name>{name}<")
    for file in (*folder.glob("*/test/*.test"), *folder.glob("*/test/*.launch")):
        _replace(file, f'pkg="{package.name}"', f'pkg="{name}"')


def _replace(file: Path, old: str, new: str) -> None:
    file.write_text(file.read_text().replace(old, new))


def _use_python(script: Path, python: Path) -> None:
    first, line_end, rest = script.read_bytes().partition(b"\n")
    if first.startswith(b"#!") and b"python" in first:
        script.write_bytes(b"#!" + bytes(python) + line_end + rest)
