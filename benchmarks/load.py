"""Seconds to load a world, beside libsdformat's on the same file in the same run.

libsdformat runs as ``ign sdf -p FILE`` (Debian: libsdformat-dev and ignition-tools), which
starts a Ruby interpreter; its time on an empty world is shown too. Gazelle is timed in a
running interpreter, the first time and again, and as a fresh process of its own.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
import warnings
from collections.abc import Callable
from pathlib import Path

import gazelle
from gazelle import formats

CORPUS = Path(
    os.environ.get("GAZELLE_CORPUS", Path(__file__).parents[1].parent / "shared" / "corpus")
)
HOUSE = (
    "ROBOTIS-GIT__turtlebot3_simulations/turtlebot3_gazebo/worlds/turtlebot3_house.world",
    "ROBOTIS-GIT__turtlebot3_simulations/turtlebot3_gazebo/models",
)
WAREHOUSE = (
    "aws-robotics__aws-robomaker-small-warehouse-world/worlds/small_warehouse.world",
    "aws-robotics__aws-robomaker-small-warehouse-world/models",
)
EMPTY = "<sdf version='1.6'><world name='w'/></sdf>"
SHARED_MODELS = "osrf__gazebo_models"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="gazelle bench load", description=__doc__)
    parser.add_argument("files", nargs="*", type=Path, help="worlds (default: house, warehouse)")
    parser.add_argument("--runs", type=int, default=5, help="of which the best (default 5)")
    args = parser.parse_args()
    warnings.simplefilter("ignore")
    print(f"best of {args.runs} runs [ms]; first: with an empty memory, process: with its start")
    print(f"{'world':<28}{'first':>9}{'again':>9}{'process':>9}{'ign sdf':>9}")
    with tempfile.TemporaryDirectory() as folder:
        empty = Path(folder) / "empty.world"
        empty.write_text(EMPTY)
        for file, models in [(empty, []), *chosen(args.files)]:
            show(file, models, args.runs)


def chosen(files: list[Path]) -> list[tuple[Path, list[Path]]]:
    """Return the worlds to load, each with its folders of models."""
    if files:
        return [(file, [file.parent]) for file in files]
    if not CORPUS.is_dir():
        print("the corpus of public robot files is not here (set GAZELLE_CORPUS)")
        return []
    shared = CORPUS / SHARED_MODELS
    return [(CORPUS / file, [CORPUS / models, shared]) for file, models in (HOUSE, WAREHOUSE)]


def show(file: Path, models: list[Path], runs: int) -> None:
    """Print one row."""
    start = time.perf_counter()
    formats.load(file, paths=models)
    first = time.perf_counter() - start
    again = best(lambda: formats.load(file, paths=models), runs)
    fresh = best(lambda: process(file, models), runs)
    theirs = best(lambda: sdformat(file, models), runs) if shutil.which("ign") else None
    figures = "".join(f"{1e3 * seconds:>9.1f}" for seconds in (first, again, fresh))
    print(
        f"{file.name:<28}{figures}{'-' if theirs is None else f'{1e3 * theirs:.1f}':>9}", flush=True
    )


def best(call: Callable[[], object], runs: int) -> float:
    """Return the shortest time of several runs [s]."""
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def process(file: Path, models: list[Path]) -> None:
    """Load in a fresh interpreter."""
    code = "import sys, warnings; warnings.simplefilter('ignore'); import gazelle; "
    code += "gazelle.load(sys.argv[1], paths=sys.argv[2:])"
    root = Path(gazelle.__file__).parents[1]
    command = [sys.executable, "-c", code, str(file), *map(str, models)]
    subprocess.run(command, check=True, cwd=root)


def sdformat(file: Path, models: list[Path]) -> None:
    """Load with libsdformat, which prints what it read."""
    paths = ":".join(map(str, models))
    environment = {**os.environ, "SDF_PATH": paths, "GZ_SIM_RESOURCE_PATH": paths}
    environment["IGN_FILE_PATH"] = environment["IGN_GAZEBO_RESOURCE_PATH"] = paths
    run = subprocess.run(
        ["ign", "sdf", "-p", str(file)], check=False, capture_output=True, env=environment
    )
    if b"<sdf" not in run.stdout:
        print(f"{file.name}: libsdformat refuses it: {run.stderr.decode(errors='replace')[-200:]}")


if __name__ == "__main__":
    main()
