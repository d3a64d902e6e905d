"""Checks of a wheel before anybody gets it."""

from __future__ import annotations

import re
import subprocess
import sys
import zipfile
from collections.abc import Iterable
from pathlib import Path

LARGEST = 40.0
"""More is refused [MB]."""

ENDINGS = {"manylinux": ".abi3.so", "macosx": ".abi3.so", "win": ".pyd"}
"""Ends of compiled modules' names on each system."""

MAGIC = {
    "manylinux_2_17_x86_64": b"\x7fELF\x02\x01",
    "manylinux_2_17_aarch64": b"\x7fELF\x02\x01",
    "macosx_11_0_x86_64": b"\xcf\xfa\xed\xfe\x07\x00\x00\x01",
    "macosx_11_0_arm64": b"\xcf\xfa\xed\xfe\x0c\x00\x00\x01",
    "win_amd64": b"MZ",
}
"""First bytes of a compiled module."""

NEWEST_GLIBC = 17
"""Symbols of a later glibc 2 are refused in a manylinux wheel."""

ELF_MACHINES = {"manylinux_2_17_x86_64": 62, "manylinux_2_17_aarch64": 183}


def check(wheel: Path, folders: Iterable[str]) -> None:
    """Print a wheel's size, and refuse it where somebody else could not use it.

    Args:
        wheel: File.
        folders: Where it was built; no compiled module may name one of them.

    Raises:
        SystemExit: It is too large, holds modules of another system, names folders of this
            machine, or uses what the platform or the stable ABI does not have.
    """
    megabytes = wheel.stat().st_size / 1e6
    print(f"{wheel.name}: {megabytes:.1f} MB")
    if megabytes > LARGEST:
        raise SystemExit(f"{wheel.name} has {megabytes:.1f} MB; at most {LARGEST:.0f} are allowed")
    check_modules(wheel, folders)
    audit = [sys.executable, "-m", "abi3audit", "--strict", "--assume-minimum-abi3", "3.11"]
    subprocess.run([*audit, str(wheel)], check=True)
    if "manylinux" in wheel.name:
        check_manylinux(wheel)


def check_modules(wheel: Path, folders: Iterable[str]) -> None:
    """Raise an error for compiled modules of other systems, or with a folder's name inside."""
    tags, platform = wheel.stem.split("-")[-3:-1], wheel.stem.split("-")[-1]
    if tags != ["cp311", "abi3"]:
        raise SystemExit(f"{wheel.name} is not for cp311-abi3")
    ending = ENDINGS[platform.split("_")[0]]
    hidden = [each.encode() for each in folders]
    modules = 0
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            if name.endswith((".c", ".lib", ".pdb", ".o", ".obj")):
                raise SystemExit(f"{wheel.name} holds {name}, which is left of its building")
            if not name.endswith((".so", ".pyd", ".dylib", ".dll")):
                continue
            content = archive.read(name)
            if not (name.endswith(ending) and _is_for(platform, content)):
                raise SystemExit(f"{wheel.name} holds {name}, which is of another system")
            for folder in hidden:
                if folder in content:
                    raise SystemExit(f"{name} of {wheel.name} names {folder.decode()}")
            modules += 1
    if not modules:
        raise SystemExit(f"{wheel.name} holds no compiled module")


def _is_for(platform: str, module: bytes) -> bool:
    if not module.startswith(MAGIC[platform]):
        return False
    machine = ELF_MACHINES.get(platform)
    return machine is None or int.from_bytes(module[18:20], "little") == machine


def check_manylinux(wheel: Path) -> None:
    """Raise an error for a wheel that needs more of the system than its name says."""
    show = [sys.executable, "-m", "auditwheel", "show", str(wheel)]
    done = subprocess.run(show, check=True, capture_output=True, text=True)
    fits = re.search(r'platform tag:\s*"manylinux_2_(\d+)_', done.stdout)
    if fits is None or int(fits[1]) > NEWEST_GLIBC:
        raise SystemExit(f"{wheel.name} does not run with glibc 2.{NEWEST_GLIBC}:\n{done.stdout}")
