"""Headers and import library of Python for Windows, for a compiler on another system."""

from __future__ import annotations

import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

LIMITED_API = (3, 11)
"""The oldest Python whose stable ABI is used; buffers are part of it since then."""


def headers(folder: Path) -> Path:
    """Copy the headers of this Python, with the configuration of Windows."""
    place = folder / "include"
    shutil.rmtree(place, ignore_errors=True)
    shutil.copytree(sysconfig.get_path("include"), place)
    shutil.copyfile(Path(__file__).parent / "windows" / "pyconfig.h", place / "pyconfig.h")
    return place


def import_library(folder: Path) -> Path:
    """Make the import library of python3.dll, which exports the stable ABI and nothing else."""
    from abi3info import DATAS, FUNCTIONS

    def names(symbols: object) -> list[str]:
        return sorted(
            each.symbol.name
            for each in symbols.values()
            if (each.added.major, each.added.minor) <= LIMITED_API
            and each.ifdef in {None, "MS_WINDOWS"}
        )

    lines = ["LIBRARY python3.dll", "EXPORTS", *names(FUNCTIONS)]
    lines += [f"{name} DATA" for name in names(DATAS)]
    folder.mkdir(parents=True, exist_ok=True)
    definition, library = folder / "python3.def", folder / "python3.lib"
    definition.write_text("\n".join(lines) + "\n")
    dlltool = [sys.executable, "-m", "ziglang", "dlltool", "-m", "i386:x86-64"]
    files = ["-D", "python3.dll", "-d", str(definition), "-l", str(library)]
    subprocess.run([*dlltool, *files], check=True)
    return library
