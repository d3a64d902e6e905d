"""Count how many description files load, build and run, and how long their first builds take.

Every SDF, URDF, xacro and Stage file below some folders is loaded, built with nothing in the cache
and run for two simulated seconds, one after the other in a process of its own that is ended
where it takes too long. Times are those of the processor. A share of many files is `--part 1/10`.

    python tools/survey.py ../shared/corpus
"""

from __future__ import annotations

import argparse
import collections
import multiprocessing
import os
import sys
import tempfile
import time
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "tests" / "formats"))

RAN, PART, REFUSED, FAILED, LATE = "runs", "has nothing to run", "refused", "failed", "too slow"
MACROS = "meant to be included"
"""What is said of xacro files without a robot, too: those do not count."""
SHOWN = 200
"""Characters shown of an error."""


@dataclass
class Outcome:
    """What became of a file; seconds of processor time."""

    said: str
    error: str = ""
    load: float = 0.0
    build: float = 0.0
    run: float = 0.0


def main() -> None:
    """Print what became of how many files, what went wrong, and what was slow."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="+", type=lambda text: Path(text).absolute())
    parser.add_argument("--part", default="1/1", metavar="K/N", help="only the Kth of N shares")
    parser.add_argument("--seconds", type=float, default=2.0, help="simulated (default 2)")
    parser.add_argument("--slow", type=float, default=5.0, help="first builds to name [s]")
    parser.add_argument("--limit", type=float, default=240.0, help="for one file, by the clock [s]")
    args = parser.parse_args()
    part, parts = map(int, args.part.split("/"))
    outcomes: dict[Path, Outcome] = {}
    with tempfile.TemporaryDirectory() as cache:
        os.environ["XDG_CACHE_HOME"] = cache
        for folder in args.folders:
            chosen = files(folder)[part - 1 :: parts]
            for path, outcome in judged(chosen, folder, args.seconds, args.limit):
                outcomes[path] = outcome
                if outcome.error or outcome.build > args.slow:
                    what = outcome.error or f"first build {outcome.build:.1f} s"
                    print(f"{outcome.said}: {path}\n    {what}", flush=True)
    show(list(outcomes.values()), args.slow)


def files(folder: Path) -> list[Path]:
    """Return the description files below a folder, Stage's worlds among them."""
    import corpus_table

    described = set(corpus_table.files(folder, "sdf", "urdf", "xacro"))
    return sorted(described | set(folder.rglob("*.world")))


def judged(
    paths: list[Path], folder: Path, seconds: float, limit: float
) -> Iterator[tuple[Path, Outcome]]:
    """Yield results of files, from a process that is started again whenever one ends it."""
    context = multiprocessing.get_context("spawn")
    worker: SpawnProcess | None = None
    ours: Connection | None = None
    for path in paths:
        if worker is None or ours is None:
            ours, theirs = context.Pipe()
            worker = context.Process(target=work, args=(theirs, str(folder), seconds), daemon=True)
            worker.start()
            theirs.close()
        ours.send(path)
        try:
            outcome = ours.recv() if ours.poll(limit) else Outcome(LATE, f"over {limit:g} s")
        except EOFError:
            outcome = Outcome(FAILED, "the process died")
        if outcome.said == LATE or outcome.error == "the process died":
            worker.kill()
            worker.join()
            worker = ours = None
        yield path, outcome
    if worker is not None:
        worker.kill()


def work(pipe: Connection, folder: str, seconds: float) -> None:
    """Process one file after the other."""
    roots = sorted({str(config.parent.parent) for config in Path(folder).rglob("model.config")})
    os.environ["GAZEBO_MODEL_PATH"] = os.pathsep.join(roots)
    os.environ["ROS_PACKAGE_PATH"] = folder
    warnings.simplefilter("ignore")
    while True:
        pipe.send(tried(pipe.recv(), seconds))


def tried(path: Path, seconds: float) -> Outcome:
    """Load a file, build its world, and run it."""
    import gazelle
    from gazelle import formats

    outcome = Outcome(REFUSED)
    start = time.process_time()
    try:
        world = formats.load(path)
        outcome.load, outcome.said = time.process_time() - start, PART
        if not any(placed.model.links for model in world.models for placed in model.walk()):
            return outcome
        outcome.said, start = FAILED, time.process_time()
        with gazelle.Simulation(world) as sim:
            sim.step(1)
            outcome.build, start = time.process_time() - start, time.process_time()
            sim.run(seconds)
            outcome.run = time.process_time() - start
        outcome.said = RAN
    except Exception as error:  # noqa: BLE001  # whatever goes wrong is what is counted
        if MACROS in str(error):
            return Outcome(MACROS)
        outcome.error = f"{type(error).__name__}: {error}"[:SHOWN].replace("\n", " ")
    return outcome


def show(outcomes: list[Outcome], slow: float) -> None:
    """Print the counts."""
    counted = collections.Counter(outcome.said for outcome in outcomes)
    total = sum(counted.values()) - counted[MACROS]
    for said in (RAN, PART, REFUSED, FAILED, LATE, MACROS):
        print(f"{counted[said]:>7}  {said}")
    if not total:
        return
    loaded, built = total - counted[REFUSED], total - counted[REFUSED] - counted[PART]
    print(f"{loaded / total:.1%} of {total} files load")
    if built:
        late = counted[LATE] + sum(outcome.build > slow for outcome in outcomes)
        print(f"{counted[RAN] / built:.1%} of {built} with something to run do")
        print(f"{late} first builds over {slow:g} s of processor time")


if __name__ == "__main__":
    main()
