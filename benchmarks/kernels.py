"""The pause for compiling the engines' kernels, at first use on a machine and later.

Each case runs in a process of its own with an empty cache, then again with what the first run
kept; the difference is the pause. Processor time counts little of what else a machine does.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time

FLEET = """
from gazelle.engines.planar import Body, Drive, Fan, Fleet, Mount, Part, Scanner
bodies = [Body((Part.circle(0.0, 0.0, 0.1),), (i, 0.0, 0.0), drive=Drive()) for i in range(9)]
fleet = Fleet(bodies, [Part.box(4.0, 4.0)])
fleet.step()
Scanner(fleet, Fan.spread(3.0, 180, 8.0), [Mount(0)]).scan()
"""
SINGLE = """
import gymnasium, gazelle.envs
env = gymnasium.make("gazelle/TurtleBot3Stage4-v0", engine="planar")
env.reset(seed=0)
env.step(2)
"""
MANY = """
import gymnasium, gazelle.envs
env = gymnasium.make_vec(
    "gazelle/TurtleBot3Stage4-v0", 1024, "vector_entry_point", engine="planar", lidar_samples=24
)
env.reset(seed=0)
env.step([2] * 1024)
"""
CASES = {
    "a Fleet's step and scan": ["-c", FLEET],
    "gazelle run fleet": ["-m", "gazelle", "run", "fleet", "--for", "1", "--rate", "max"],
    "TurtleBot3Stage4, engine planar": ["-c", SINGLE],
    "TurtleBot3Stage4 in 1,024 worlds": ["-c", MANY],
}


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="gazelle bench kernels", description=__doc__)
    parser.add_argument("--runs", type=int, default=3, help="of which the best (default 3)")
    args = parser.parse_args()
    print(f"best of {args.runs} runs [s]; in brackets: of processor time")
    print(f"{'case':<34}{'empty cache':>18}{'kept':>18}{'pause':>18}")
    for name, command in CASES.items():
        pairs = [pair(command) for _ in range(args.runs)]
        first = [min(p[0][k] for p in pairs) for k in range(2)]
        later = [min(p[1][k] for p in pairs) for k in range(2)]
        pause = [a - b for a, b in zip(first, later, strict=True)]
        print(f"{name:<34}" + "".join(f"{w:>9.2f} ({c:>6.2f})" for w, c in (first, later, pause)))


def pair(command: list[str]) -> tuple[tuple[float, float], tuple[float, float]]:
    """Seconds and processor seconds of a command with an empty cache, and then again."""
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "GAZELLE_CACHE_DIR": folder}
        return timed(command, environment), timed(command, environment)


def timed(command: list[str], environment: dict[str, str]) -> tuple[float, float]:
    """Seconds and processor seconds of a command."""
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(
        [sys.executable, *command], env=environment, check=True, stdout=subprocess.DEVNULL
    )
    after, wall = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter() - began
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


if __name__ == "__main__":
    main()
