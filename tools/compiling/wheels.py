"""Build the wheels of a release with Zig's C compiler, and check them.

    python tools/compiling/wheels.py dist                          # all
    python tools/compiling/wheels.py dist x86_64-linux-gnu.2.17    # of one platform

They are built from a source distribution, which is made first. Each serves Python 3.11 and all
later versions, as modules use the stable ABI. Those for macOS and Windows are built but cannot be
run here; `.ci/fresh_machine` runs that for aarch64 in an emulator.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

import wheel_checks

ROOT = Path(__file__).parents[2]

TARGETS = {
    "x86_64-linux-gnu.2.17": "manylinux_2_17_x86_64",
    "aarch64-linux-gnu.2.17": "manylinux_2_17_aarch64",
    "x86_64-macos.11.0": "macosx_11_0_x86_64",
    "aarch64-macos.11.0": "macosx_11_0_arm64",
    "x86_64-windows-gnu": "win_amd64",
}
"""Zig's targets, and the platforms that pip knows."""


def main() -> None:
    """Write a source distribution and wheels to a folder."""
    parser = argparse.ArgumentParser(description="Build wheels, and check them.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("targets", nargs="*", default=list(TARGETS), metavar="TARGET")
    options = parser.parse_args()
    unknown = sorted(set(options.targets) - set(TARGETS))
    if unknown:
        parser.error(f"{', '.join(unknown)}: the targets are {', '.join(TARGETS)}")
    folder = options.folder.resolve()
    folder.mkdir(exist_ok=True)
    source = _made(folder, "gazelle-*.tar.gz", "--sdist", str(ROOT))
    shutil.rmtree(ROOT / "packages" / "gazelle-ros" / "build", ignore_errors=True)
    ros = _made(folder, "gazelle_ros-*.whl", "--wheel", str(ROOT / "packages" / "gazelle-ros"))
    with tempfile.TemporaryDirectory() as place:
        with tarfile.open(source) as archive:
            archive.extractall(place, filter="data")
        (tree,) = Path(place).iterdir()
        _share_what_is_compiled(tree)
        wheels = [_wheel(folder, tree, target) for target in options.targets]
        for wheel in wheels:
            wheel_checks.check(wheel, [str(ROOT), place])
    subprocess.run(
        [sys.executable, "-m", "twine", "check", "--strict", source, ros, *wheels], check=True
    )


def _share_what_is_compiled(tree: Path) -> None:
    """Share C files between platforms, and skip modules that are up to date."""
    (tree / "build").mkdir(exist_ok=True)
    for name in ("cython", "compiled"):
        kept = ROOT / "build" / name
        kept.mkdir(parents=True, exist_ok=True)
        (tree / "build" / name).symlink_to(kept, target_is_directory=True)


def _wheel(folder: Path, tree: Path, target: str) -> Path:
    platform = f"--config-setting=--build-option=--plat-name={TARGETS[target]}"
    ending = f"gazelle-*-{TARGETS[target]}.whl"
    return _made(folder, ending, "--wheel", platform, str(tree), GAZELLE_TARGET=target)


def _made(folder: Path, ending: str, *words: str, **environment: str) -> Path:
    """Run ``build``, and return what it has written to a folder."""
    for old in folder.glob(ending):
        old.unlink()
    command = [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(folder), *words]
    subprocess.run(command, env=os.environ | environment, check=True)
    (made,) = folder.glob(ending)
    return made


if __name__ == "__main__":
    main()
