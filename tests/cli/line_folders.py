"""Folders in which command lines with a wrong word run, and what limits these."""

from __future__ import annotations

import ctypes
import os
import resource
import shutil
import stat
from pathlib import Path

ADDRESSES = 16 * 2**30
"""Most memory that a command may ask for [bytes]."""


def limit() -> None:
    """Limit a child's memory, and let it read only what its user may, even as root."""
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESSES, ADDRESSES))
    if os.getuid() == 0:
        header = (ctypes.c_uint32 * 2)(0x20080522, 0)
        ctypes.CDLL(None).capset(header, (ctypes.c_uint32 * 6)())


def write_files(folder: Path, policy: Path) -> None:
    """Write a good file of each kind that commands read, and places that cannot be used."""
    folder.mkdir(parents=True)
    for file in (policy, policy.with_suffix(".json"), policy.with_name("a.bag")):
        shutil.copy(file, folder)
    (folder / "table.csv").write_text("a,b\n1,2\n2,3\n")
    (folder / "quick.py").write_text("def run(*, seed):\n    return {'twice': 2 * seed}\n")
    (folder / "a.yaml").write_text("a: 1\n")
    (folder / "a.launch").write_text('<launch><param name="a" value="1" /></launch>')
    (folder / "folder").mkdir()
    (folder / "locked").mkdir(mode=0o555)
    (folder / "unreadable").touch(mode=0)
    if os.getuid() == 0:  # who could remove the true one
        os.mknod(folder / "null", 0o666 | stat.S_IFCHR, os.makedev(1, 3))
    else:
        (folder / "null").symlink_to(os.devnull)


def contents(folder: Path) -> dict[Path, bytes | None]:
    """Return all that is in a folder."""
    return {
        each.relative_to(folder): each.read_bytes()
        if each.is_file() and each.name != "unreadable"
        else None
        for each in folder.rglob("*")
    }


def write_bag(file: Path) -> None:
    """Write a bag of one message."""
    from gazelle_ros import Time, load_message
    from gazelle_ros.bags import Bag

    with Bag(file, "w") as bag:
        bag.write("/words", load_message("std_msgs/String")("hello"), Time(1))
