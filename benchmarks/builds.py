"""First builds: what 'gazelle run' takes for a file whose meshes it has never seen.

Each run is a process of its own with an empty cache, and simulates 10 ms.

    gazelle bench builds FILE...
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True, slots=True)
class Build:
    """A first build.

    Attributes:
        wall: Time until the process ends [s].
        processor: Processor time of the process [s].
        said: Time until it prints something [s].
        memory: Most memory it had [bytes].
        meshes: Meshes whose pieces were kept on disk.
        pieces: Number of these.
        gap: Largest distance of pieces beside the surface, as stated [m].
    """

    wall: float
    processor: float
    said: float
    meshes: int
    pieces: int
    gap: float


def first_build(file: Path) -> Build:
    """Build a file with an empty cache.

    Raises:
        SystemExit: Gazelle refuses the file.
    """
    command = [sys.executable, "-m", "gazelle", "run", str(file), "--for", "0.01", "--rate", "max"]
    with tempfile.TemporaryDirectory() as cache:
        environment = {**os.environ, "XDG_CACHE_HOME": cache, "PYTHONUNBUFFERED": "1"}
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        start = time.perf_counter()
        with subprocess.Popen(
            command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        ) as process:
            assert process.stdout is not None
            text = process.stdout.read(1)
            said = time.perf_counter() - start
            text += process.stdout.read()
        wall = time.perf_counter() - start
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if process.returncode:
            raise SystemExit(text.decode(errors="replace"))
        kept = [np.load(path) for path in Path(cache).rglob("*.npz")]
        return Build(
            wall,
            after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            said,
            len(kept),
            sum(len(each["ends"]) for each in kept),
            max((float(each["gap"]) for each in kept), default=0.0),
        )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="gazelle bench builds", description=__doc__)
    parser.add_argument("files", nargs="+", type=Path, help="worlds and robots")
    args = parser.parse_args()
    print(
        f"{'file':<40}{'wall [s]':>9}{'processor':>10}{'first line':>11}"
        f"{'meshes':>8}{'pieces':>8}{'gap [mm]':>9}"
    )
    for file in args.files:
        build = first_build(file)
        print(
            f"{file.name:<40}{build.wall:>9.1f}{build.processor:>10.1f}{build.said:>11.1f}"
            f"{build.meshes:>8}{build.pieces:>8}{1e3 * build.gap:>9.1f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
