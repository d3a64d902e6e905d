"""Checks of a machine: what Gazelle needs of it, and what may disturb."""

from __future__ import annotations

import importlib.util
import os
import shutil
import socket
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import Enum
from importlib.metadata import version
from pathlib import Path

from gazelle.errors import EngineError

GIGABYTE = 1 << 30
LEAST_FREE = GIGABYTE
"""Free space below which recordings and trainings soon fill a disk [byte]."""

EXTRAS = {
    "train": ("train, evaluate and deploy policies", ("stable_baselines3", "torch", "tqdm")),
    "web": ("view in a browser", ("viser",)),
    "film": ("films as MP4", ("av",)),
    "plots": ("plots", ("matplotlib",)),
    "planning": ("more planners for arms", ("ompl",)),
    "bridge": ("rosbridge", ("websockets", "cbor2")),
    "ros": ("bags compressed with lz4, bags for Foxglove", ("lz4", "mcap")),
}
"""Optional parts, their purposes, and the modules that they need."""

PORTS = {11311: "gazelle master --port 0", 9090: "gazelle bridge --port 0"}
"""Usual ports of a ROS master and of rosbridge, and the commands that take a free one."""

MASTER_TIMEOUT_S = 1.0
"""A ROS master on this machine answers within this time [s]."""


class Grade(Enum):
    """Result of a check."""

    OK = "ok"
    NOTE = "note"
    PROBLEM = "PROBLEM"


@dataclass(frozen=True, slots=True)
class Finding:
    """Result of one check, and what to type."""

    grade: Grade
    name: str
    text: str
    hint: str = ""


def examine() -> Iterator[Finding]:
    """Yield the findings of all checks, each when it is done."""
    for check in CHECKS:
        yield from check()


def python() -> Iterator[Finding]:
    """Yield the version of Python, and packages of ROS that its path holds."""
    version = ".".join(map(str, sys.version_info[:3]))
    where = "in a virtual environment" if sys.prefix != sys.base_prefix else sys.prefix
    yield Finding(Grade.OK, "Python", f"{version}, {where}")
    foreign = [each for each in os.environ.get("PYTHONPATH", "").split(os.pathsep) if each]
    installed = [each for each in foreign if each.startswith("/opt/ros/")]
    if installed:
        yield Finding(
            Grade.NOTE,
            "PYTHONPATH",
            f"holds Python packages of an installed ROS, which come before others: {installed[0]}",
            "unset PYTHONPATH",
        )


def compiled_modules() -> Iterator[Finding]:
    """Yield the build of the compiled modules, and the C compiler."""
    from gazelle.native import BUILD

    yield Finding(Grade.OK, "kernels", f"compiled modules for {BUILD}")
    compiler = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
    if compiler:
        yield Finding(Grade.OK, "C compiler", compiler)
    else:
        yield Finding(
            Grade.NOTE,
            "C compiler",
            "none; only compiled systems of your own and installing from a checkout need one",
            "apt install gcc",
        )


def physics() -> Iterator[Finding]:
    """Yield the version of MuJoCo; another package may have overwritten its files."""
    try:
        from gazelle.engines.mujoco import check_installation

        check_installation()
    except EngineError as error:
        yield Finding(Grade.PROBLEM, "MuJoCo", error.message, error.hint or "")
    else:
        yield Finding(Grade.OK, "MuJoCo", version("mujoco-core"))


def extras() -> Iterator[Finding]:
    """Yield which optional parts are installed, without importing them."""
    there, missing = [], {}
    for extra, (purpose, modules) in EXTRAS.items():
        if all(importlib.util.find_spec(module) for module in modules):
            there.append(extra)
        else:
            missing[extra] = purpose
    if there:
        yield Finding(Grade.OK, "extras", ", ".join(there))
    for extra, purpose in missing.items():
        yield Finding(
            Grade.NOTE, "extras", f"not installed: {purpose}", f'pip install "gazelle[{extra}]"'
        )


def processors() -> Iterator[Finding]:
    """Yield the number of processors, and what limits it."""
    from gazelle.native.processors import VARIABLE, processors

    count, limit = processors(), os.environ.get(VARIABLE, "")
    text = f"{count}, limited by {VARIABLE}={limit}" if limit else f"{count}"
    yield Finding(Grade.OK, "processors", text)


def display() -> Iterator[Finding]:
    """Yield whether a browser of this machine can show pages."""
    if sys.platform != "linux" or os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"):
        yield Finding(Grade.OK, "display", "a browser here can show what 'gazelle view' serves")
        return
    yield Finding(
        Grade.NOTE,
        "display",
        "none is needed: pictures and films are drawn without; for the page of 'gazelle view' "
        "forward its port to a machine with a browser",
        f"ssh -L 8080:localhost:8080 {socket.gethostname()}   # and gazelle view --port 8080",
    )


def ros_variables() -> Iterator[Finding]:
    """Yield the variables of ROS that Gazelle follows, and those that cannot be right."""
    names = ("ROS_MASTER_URI", "ROS_HOSTNAME", "ROS_IP", "ROS_PACKAGE_PATH")
    found = {name: os.environ[name] for name in names if os.environ.get(name)}
    if not found:
        yield Finding(Grade.OK, "ROS", "no variables are set: nodes meet on this machine")
        return
    yield from _host(found)
    for folder in filter(None, found.get("ROS_PACKAGE_PATH", "").split(os.pathsep)):
        if not Path(folder).is_dir():
            yield Finding(
                Grade.PROBLEM,
                "ROS",
                f"ROS_PACKAGE_PATH names {folder}, which is not a folder",
                "export ROS_PACKAGE_PATH=/path/to/catkin_ws/src",
            )


def _host(found: dict[str, str]) -> Iterator[Finding]:
    """Yield whether the names of the master and of this machine can be resolved."""
    from gazelle_ros.errors import ProtocolError
    from gazelle_ros.net import find_address, split_uri

    uri = found.get("ROS_MASTER_URI", "")
    hosts: dict[str, str] = {}
    hosts |= {name: found[name] for name in ("ROS_HOSTNAME", "ROS_IP") if name in found}
    if uri:
        try:
            hosts["ROS_MASTER_URI"] = split_uri(uri)[0]
        except ProtocolError as error:
            yield Finding(
                Grade.PROBLEM,
                "ROS",
                f"ROS_MASTER_URI is {uri!r}: {error.message}",
                "export ROS_MASTER_URI=http://localhost:11311",
            )
    for name, host in hosts.items():
        try:
            address = find_address(host)
        except (OSError, UnicodeError):
            hint = "export ROS_IP=ADDRESS" if name == "ROS_HOSTNAME" else f"export {name}=..."
            yield Finding(Grade.PROBLEM, "ROS", f"{name}: there is no host '{host}'", hint)
        else:
            yield Finding(Grade.OK, "ROS", f"{name} is {address}")


def ports() -> Iterator[Finding]:
    """Yield which of the usual ports are taken on this machine."""
    for port, command in PORTS.items():
        with socket.socket() as sock:
            sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                sock.bind(("127.0.0.1", port))
            except OSError as error:
                yield _taken_port(port, error.strerror or str(error), command)
            else:
                yield Finding(Grade.OK, "ports", f"{port} is free")


def _taken_port(port: int, reason: str, command: str) -> Finding:
    """Return the finding about a port that a ROS master or another program has."""
    from gazelle_ros.errors import RosError
    from gazelle_ros.master.proxy import MasterProxy

    master = MasterProxy(f"http://127.0.0.1:{port}", "/doctor", MASTER_TIMEOUT_S)
    try:
        process = master.get_pid()
    except (RosError, ValueError):
        text = f"{port} is taken: {reason}"
        return Finding(Grade.NOTE, "ports", text, f"{command}   # or end the program that has it")
    finally:
        master.close()
    text = f"{port}: a ROS master runs here, process {process}; nodes will use it"
    return Finding(Grade.OK, "ports", text)


def disks() -> Iterator[Finding]:
    """Yield free space where files are written: here, temporary files, cached meshes."""
    from gazelle.geometry.piece_cache import folder

    places = {"this folder": Path.cwd(), "temporary files": Path(tempfile.gettempdir())}
    places["cached meshes"] = next(each for each in (folder(), *folder().parents) if each.exists())
    for purpose, place in places.items():
        free = shutil.disk_usage(place).free
        text = f"{purpose} ({place}): {free / GIGABYTE:.1f} GB free"
        if not os.access(place, os.W_OK):
            yield Finding(Grade.PROBLEM, "disk", f"{place} cannot be written to", "cd ~")
        elif free < LEAST_FREE:
            yield Finding(Grade.PROBLEM, "disk", text, f"du -sh {place}/* | sort -h")
        else:
            yield Finding(Grade.OK, "disk", text)


CHECKS: tuple[Callable[[], Iterator[Finding]], ...] = (
    python,
    compiled_modules,
    physics,
    extras,
    processors,
    display,
    ros_variables,
    ports,
    disks,
)
