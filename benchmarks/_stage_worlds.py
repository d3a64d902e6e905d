"""Stage files beside Stage itself, and a fleet on a ROS graph, for ``gazelle bench stage``."""

from __future__ import annotations

import gc
import math
import os
import subprocess
import sys
import tempfile
import time
import tracemalloc
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from _goals import Goals, shown
from _stage_office import places
from PIL import Image

from gazelle import assets, formats
from gazelle.stage import StageSimulation

HERE = Path(__file__).resolve().parent
FLEET = 72
MANY = 10_000
WINDOW_S = 0.2  # of processor time
WINDOWS = 3

# Where a world is in the corpus or in a folder of Stage's own, what Stage's robots looked through
# (beams of a sensor; None: all there are), and how many times real time it was.
CORPUS = (
    ("ros-simulation__stage_ros/world/willow-erratic.world", None, 227),
    ("ros-simulation__stage_ros/world/willow-four-erratics.world", None, 51),
    ("turtlebot__turtlebot_simulator/turtlebot_stage/maps/stage/maze.world", None, 400),
)
OWN = (
    ("simple.world", 180, 819),
    ("fasr.world", None, 134),
    ("fasr2.world", None, 41),
    ("pioneer_flocking.world", None, 64),
    ("benchmark/cave.world", 1, 35),
    ("benchmark/hospital.world", 1, 7.7),
)
# Robots, side of the office [m], and Stage with a kinect, a laser and no sensor.
OFFICES = (
    (1, 40.0, (711, 1660, 8000)),
    (72, 40.0, (6.9, 9.6, 183)),
    (1_000, 40.0, (0.31, 0.43, 9.3)),
    (10_000, 128.0, (0.029, 0.037, 0.66)),
)
SENSORS = (
    ("kinect", "fov 58 samples 640 range [0 6.5]"),
    ("laser", "fov 180 samples 180 range [0 8]"),
)

# Times real time that Stage files have to run, by robots and beams of each.
WANTED = {(72, 640): 300.0, (1_000, 640): 10.0, (1_000, 180): 10.0}


@dataclass(frozen=True)
class Case:
    """A file, what to look through, and Stage's real-time factor."""

    name: str
    file: Path
    beams: int | None
    stage: float


def worlds(threads: int, folder: Path | None, goals: Goals) -> None:
    """Print how much faster than real time, and than Stage, Stage files run."""
    print(
        f"\n{'Stage file':<20}{'robots':>7}{'beams':>6}{'load s':>7}{'bytes each':>11}"
        f"{'real time':>11}{'Stage 4.3':>10}{'times':>7}"
    )
    with tempfile.TemporaryDirectory() as home:
        for case in cases(Path(home), folder):
            measure(case, threads, goals)


def cases(home: Path, folder: Path | None) -> Iterator[Case]:
    """Yield all files that there are."""
    corpus = Path(os.environ.get("GAZELLE_CORPUS") or HERE.parent.parent / "shared" / "corpus")
    for root, table in ((corpus, CORPUS), (folder, OWN)):
        for path, beams, stage in table if root is not None else ():
            file = root / path
            if file.is_file():
                yield Case(file.stem, file, beams, stage)
    for count, side, figures in OFFICES:
        for (name, sensor), stage in zip((*SENSORS, ("", "")), figures, strict=True):
            text = f"office {count} {name}".strip()
            yield Case(text, write_office(home, count, side, sensor), None, stage)


def write_office(home: Path, count: int, side: float, sensor: str) -> Path:
    """Return robots spread over rooms of 8 m, drawn as a bitmap with pixels of 5 cm."""
    cells = round(side / 0.05)
    plan = np.full((cells, cells), 255, np.uint8)
    for at in range(0, cells + 1, 160):
        plan[max(at - 2, 0) : at + 2] = plan[:, max(at - 2, 0) : at + 2] = 0
    for middle in range(80, cells, 160):
        for at in range(160, cells, 160):
            plan[middle - 16 : middle + 16, at - 2 : at + 2] = 255
            plan[at - 2 : at + 2, middle - 16 : middle + 16] = 255
    Image.fromarray(plan).save(home / f"{side:g}.png")
    across = math.ceil(math.sqrt(count))
    rng = np.random.default_rng(1)
    mounted = f"ranger ( pose [0 0 -.1 0] sensor ( {sensor} ) )" if sensor else ""
    lines = [
        "interval_sim 100 resolution 0.02",
        f'model ( bitmap "{side:g}.png" size [{side} {side} 1] )',
        f'define robot position ( size [.2552 .2552 .4] drive "diff" {mounted} )',
    ]
    for i, (x, y) in enumerate(places(count, across, side / across)):
        lines.append(
            f'robot ( name "r{i}" pose [{x - side / 2:.3f} {y - side / 2:.3f} 0 {rng.uniform(-180, 180):.1f}] )'
        )
    file = home / f"{count}{len(sensor)}.world"
    file.write_text("\n".join(lines))
    return file


def measure(case: Case, threads: int, goals: Goals) -> None:
    """Print a line."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        began = time.process_time()
        sim = StageSimulation(case.file, threads=threads, euler=True, controllers=False)
        loaded = time.process_time() - began
    with sim:
        each = bytes_each(case.file) if len(sim.robots) >= FLEET else 0.0
        sizes = [sim.scan(k)[0].shape for k in range(sim.scanners)]
        seen = [k for k, (_, count) in enumerate(sizes) if case.beams in (None, count)]
        beams = sum(math.prod(sizes[k]) for k in seen)
        factor = sim.time_step / seconds_a_step(sim, lambda: [sim.scan(k) for k in seen])
        size = f"{each:>11,.0f}" if each else f"{'':>11}"
        if len(sim.robots) == MANY:
            goals.most(f"{case.name}: bytes a robot", each, 4096.0)
            goals.most(f"{case.name}: load [s]", loaded, 1.5)
        wanted = WANTED.get((len(sim.robots), beams // len(sim.robots)))
        if wanted is not None and case.name.startswith("office"):
            goals.least(f"{case.name}: times real time", factor, wanted)
        print(
            f"{case.name:<20}{len(sim.robots):>7,}{beams / len(sim.robots):>6.0f}{loaded:>7.2f}{size}"
            f"{shown(factor):>11}{shown(case.stage):>10}{factor / case.stage:>7.1f}",
            flush=True,
        )


def seconds_a_step(sim: StageSimulation, look: Callable[[], object]) -> float:
    """Return processor time of a step, and of a look when scans are due, while robots wander."""
    count, rng = len(sim.robots), np.random.default_rng(0)
    every = max(1, round(0.1 / sim.time_step))  # Stage's sensors look every 100 ms
    back, turn = np.zeros(count, np.int64), rng.uniform(-0.6, 0.6, count)
    best, steps = math.inf, 10 * every
    for _ in range(WINDOWS):
        spent = 0.0
        for step in range(steps):
            back[sim.stalled[0] & (back == 0)] = 10
            if step % (10 * every) == 0:
                turn = rng.uniform(-0.6, 0.6, count)
            sim.commands[0, :, 0] = np.where(back > 0, -0.2, 0.4)
            sim.commands[0, :, 2] = turn
            np.maximum(back - 1, 0, out=back)
            began = time.process_time()
            sim.step()
            if step % every == 0:
                look()
            spent += time.process_time() - began
        best = min(best, spent / steps)
        if spent < WINDOW_S:
            steps *= 2
    return best


def bytes_each(file: Path) -> float:
    """Return memory of a robot and its description, without the shared bitmap."""
    gc.collect()
    tracemalloc.start()
    sim = StageSimulation(file, threads=1, controllers=False)
    sim.step()
    gc.collect()
    used, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    shared = sum(m.bitmap.cells.nbytes for m in sim.description.models if m.bitmap is not None)
    count = len(sim.robots)
    sim.close()
    return (used - shared) / count


def graph(goals: Goals) -> None:
    """Print how the bundled fleet runs, alone and on a ROS graph with a subscriber a robot."""
    world = formats.load(assets.world("fleet"))
    with StageSimulation(world, threads=1) as sim:
        factor = sim.time_step / seconds_a_step(sim, sim.scan)
    print(f"\n{FLEET} AGVs with 640 rays, no window:{factor:>10,.0f} times real time")
    goals.least(f"{FLEET} AGVs, no window: times real time", factor, 70.0)
    import ros

    python = ros.DEBIAN if ros.has_rospy(ros.DEBIAN) else sys.executable
    who = ros.THEIRS if python == ros.DEBIAN else ros.OURS
    arguments = ros.argparse.Namespace(seconds=8.0)
    with ros.running(python, arguments) as bench:
        code = "import sys; from gazelle.cli.main import main; sys.exit(main())"
        words = [sys.executable, "-c", code, "run", "fleet", "--ros"]
        quiet = subprocess.DEVNULL
        server = subprocess.Popen(words, env=bench.env, stdout=quiet, stderr=quiet, cwd=HERE.parent)
        try:
            listener = bench.start(who, "fleet_in", FLEET, bench.seconds, server.pid)
            heard = bench.figures(listener)
        finally:
            server.terminate()
            server.wait()
    print(f"on ROS, a subscriber of {who} a robot: {heard['rate']:.1f} scans/s of each,")
    print(f"{heard['share']:.1f} % of a processor")
    goals.least(f"{FLEET} AGVs on ROS: scans/s of each", heard["rate"], 9.9)
    goals.most(f"{FLEET} AGVs on ROS: % of a processor", heard["share"], 50.0)
