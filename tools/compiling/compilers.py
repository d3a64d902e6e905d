"""Find a C compiler: the system's, else Zig's, which is a package."""

from __future__ import annotations

import os
import platform
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

ZIG = "ziglang>=0.13"
OLDEST_GLIBC = "2.17"  # as manylinux2014 has it


def system_compiler() -> str | None:
    """Return the command of a suitable C compiler of this system; None without one."""
    if "GAZELLE_TARGET" in os.environ:
        return None  # for another machine only Zig's will do
    if sys.platform == "win32":
        return ""  # setuptools finds Visual Studio's by itself
    names = [os.environ.get("CC"), sysconfig.get_config_var("CC"), "cc", "gcc", "clang"]
    for name in dict.fromkeys(filter(None, names)):
        if _works(shlex.split(name)):
            return name
    return None


def _works(command: list[str]) -> bool:
    """Return whether it makes a shared library."""
    if shutil.which(command[0]) is None:
        return False
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder, "probe.c")
        source.write_text("#include <math.h>\ndouble f(double x) { return sqrt(x); }\n")
        line = [*command, "-shared", "-fPIC", str(source), "-o", str(Path(folder, "probe.so"))]
        if sys.platform == "darwin":
            line.append("-Wl,-undefined,dynamic_lookup")
        return subprocess.run(line, check=False, capture_output=True).returncode == 0


def zig_target() -> str:
    """Return this machine, or that of ``GAZELLE_TARGET``, by Zig's name."""
    named = os.environ.get("GAZELLE_TARGET")
    if named:
        return named
    machine = {"AMD64": "x86_64", "x86_64": "x86_64", "arm64": "aarch64", "aarch64": "aarch64"}
    cpu = machine.get(platform.machine(), platform.machine())
    if sys.platform == "darwin":
        return f"{cpu}-macos"
    if sys.platform == "win32":
        return f"{cpu}-windows-gnu"
    libc = f"gnu.{OLDEST_GLIBC}" if platform.libc_ver()[0] == "glibc" else "musl"
    return f"{cpu}-linux-{libc}"


def zig() -> list[str]:
    """Return the command of Zig's C compiler, for ``zig_target``."""
    return [sys.executable, "-m", "ziglang", "cc", "-target", zig_target()]


def is_x86() -> bool:
    """Return whether the target is 64-bit x86."""
    return zig_target().startswith("x86_64")


def is_macos() -> bool:
    """Return whether the target is macOS."""
    return "macos" in zig_target()


def is_windows() -> bool:
    """Return True if the build is for Windows."""
    return "windows" in zig_target()
