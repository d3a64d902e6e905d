"""Compiles the C++ clients of a package's tests with Debian's roscpp."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from rossuites import definitions
from rossuites.generating import PYTHON

MESSAGES = ("control_msgs", "controller_manager_msgs", "four_wheel_steering_msgs")
"""What the clients of ros_control include, and Debian has no headers of."""

_GENERATOR = "/usr/lib/gencpp/gen_cpp.py"
_TEMPLATES = "/usr/share/gencpp"
_LIBRARIES = ("roscpp", "tf", "actionlib")
_TARGET = re.compile(r"(add_rostest_gtest|add_executable|target_compile_definitions)\(([^)]*)\)")


@dataclass(frozen=True)
class Client:
    """A program of a package's tests.

    Attributes:
        name: Of the program.
        sources: Below the package.
        defines: What it is compiled with.
    """

    name: str
    sources: tuple[str, ...]
    defines: tuple[str, ...] = ()


def clients_of(package: Path, files: Container[str]) -> Iterator[Client]:
    """Yield the declarations for some test files in a package's ``CMakeLists.txt``."""
    text = (package / "CMakeLists.txt").read_text(encoding="utf-8")
    words = [(kind, body.split()) for kind, body in _TARGET.findall(text)]
    defines = {
        body[0]: tuple(body[2:]) for kind, body in words if kind == "target_compile_definitions"
    }
    for kind, body in words:
        name = body[0].replace("${PROJECT_NAME}", package.name)
        sources = [word for word in body[1:] if word.endswith(".cpp")]
        if any(word.endswith(".test") and word not in files for word in body):
            continue
        # cm_test is a client that is declared as a plain program; so are robots, which have stand-ins.
        if sources and (kind == "add_rostest_gtest" or sources[0] == f"test/{name}.cpp"):
            yield Client(name, tuple(sources), defines.get(body[0], ()))


def write_headers(folder: Path) -> Path:
    """Make headers of `MESSAGES` below a folder; returns what to include."""
    source, target = folder / "source", folder / "include"
    if target.is_dir():
        return target
    definitions.write(MESSAGES, source)
    places = [*Path("/usr/share").glob("*/msg"), *source.glob("*/msg")]
    search = [f"-I{place.parent.name}:{place}" for place in places]
    for file in sorted((*source.glob("*/msg/*.msg"), *source.glob("*/srv/*.srv"))):
        package = file.parent.parent.name
        out = ["-p", package, "-o", str(target / package), "-e", _TEMPLATES, *search]
        subprocess.run([PYTHON, _GENERATOR, str(file), *out], check=True, timeout=60)
    return target


def build(
    package: Path,
    clients: Iterable[Client],
    found: Mapping[str, Path],
    folder: Path,
) -> dict[str, str]:
    """Compile clients, unless a folder has them already, and put them in their package.

    Args:
        package: Its copy, where its tests start them.
        clients: Of it.
        found: All packages, by name; headers of ``realtime_tools`` are taken from there.
        folder: Keeps what is built.

    Returns:
        What the compiler says of those that it refuses, by name.
    """
    flags = ["-std=c++17", "-O0", "-w", "-isystem", "/usr/include/angles"]
    flags += [f"-I{place}" for place in _headers(package, found, folder)]
    ask = subprocess.run(
        ["pkg-config", "--cflags", "--libs", *_LIBRARIES],
        check=True,
        capture_output=True,
        text=True,
    )
    flags += [*ask.stdout.split(), "-lgtest", "-lpthread", "-lboost_thread", "-lboost_system"]
    refused = {}
    for client in clients:
        program = folder / package.name / client.name
        program.parent.mkdir(parents=True, exist_ok=True)
        if not program.exists():
            defines = [f"-D{each}" for each in client.defines]
            files = [str(package / source) for source in client.sources]
            command = ["g++", *defines, *files, "-o", str(program), *flags]
            done = subprocess.run(command, check=False, capture_output=True, text=True, timeout=600)
            if done.returncode != 0:
                refused[client.name] = done.stderr
                continue
        _put(package / client.name, program)
    return refused


def _headers(package: Path, found: Mapping[str, Path], folder: Path) -> list[Path]:
    own = {file.parent for file in (package / "test").rglob("*.h")}
    tools = [found["realtime_tools"] / "include"] if "realtime_tools" in found else []
    return [write_headers(folder), package / "include", *sorted(own), *tools]


def _put(place: Path, program: Path) -> None:
    place.unlink(missing_ok=True)
    place.symlink_to(program.resolve())
