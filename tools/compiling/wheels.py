"""Build the wheels of a release with Zig's C compiler, whatever machine this is.

    python tools/compiling/wheels.py dist

From a source distribution, which is made first, each in a folder of its own. macOS's are made
but cannot be run here; Windows's need Python's import library and are made on Windows.
"""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[2]

TARGETS = {
    "x86_64-linux-gnu.2.17": ("manylinux_2_17_x86_64", "x86_64-linux-gnu.so"),
    "aarch64-linux-gnu.2.17": ("manylinux_2_17_aarch64", "aarch64-linux-gnu.so"),
    "x86_64-macos.11.0": ("macosx_11_0_x86_64", "darwin.so"),
    "aarch64-macos.11.0": ("macosx_11_0_arm64", "darwin.so"),
}
"""Of Zig's targets the platform that pip knows, and how modules' names end."""


def main(folder: Path) -> None:
    """Write a source distribution and all wheels to a folder."""
    folder.mkdir(exist_ok=True)
    _run("build", "--sdist", "--outdir", str(folder), str(ROOT), environment={})
    (source,) = sorted(folder.glob("*.tar.gz"), key=lambda path: path.stat().st_mtime)[-1:]
    for target, (platform, ending) in TARGETS.items():
        suffix = f".{sysconfig.get_config_var('SOABI').rsplit('-', 3)[0]}-{ending}"
        with tempfile.TemporaryDirectory() as place:
            with tarfile.open(source) as archive:
                archive.extractall(place, filter="data")
            (tree,) = Path(place).iterdir()
            _run(
                *["build", "--wheel", "--outdir", str(folder), str(tree)],
                f"--config-setting=--build-option=--plat-name={platform}",
                environment={"GAZELLE_TARGET": target, "SETUPTOOLS_EXT_SUFFIX": suffix},
            )


def _run(*words: str, environment: dict[str, str]) -> None:
    subprocess.run([sys.executable, "-m", *words], env=os.environ | environment, check=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
