"""Stage itself beside Gazelle, in turns, on the same files, for ``gazelle bench stage``."""

from __future__ import annotations

import tempfile
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import _stage_worlds as worlds
import numpy as np
from _goals import Goals, shown
from _stage_itself import Spent, Stage

from gazelle import formats
from gazelle.engines.planar import Fleet, Scanner
from gazelle.engines.planar.roaming import Roaming
from gazelle.native.system import System
from gazelle.stage import FleetController, StageSimulation, register_controller
from gazelle.stage.layout import layout_of

ABSENT = """
Stage not found: its figures here are those of docs/explanation/benchmarks.md, measured once on a machine of
this kind. With a program 'stage' on PATH, or --stage PATH, it runs beside Gazelle, in turns."""

# Robots, side of the office [m], and seconds that Stage simulates without and with a sensor.
SIZES = (
    (1, 40.0, 2_000, 300),
    (72, 40.0, 60, 8),
    (1_000, 40.0, 6, 2),
    (10_000, 128.0, 2, 0.5),
)
SENSORS = (("none", ""), *worlds.SENSORS)
INTERVAL_S = 0.1
FIRST_S = 0.2  # what a run simulates that only shows how long loading takes
CHEAP = 100  # robots up to which Stage runs twice, and the better counts
OURS_S = 0.3  # of processor time a window, at least
WINDOWS = 3


@dataclass(frozen=True)
class Run:
    """How Stage does with a file: how many times real time, and what loading took."""

    factor: float
    loaded: Spent


def rival(stage: Stage, largest: int, threads: int, goals: Goals) -> None:
    """Print how all do, on files that differ in nothing but ``quit_time``."""
    print("\nthe same files in turns in Stage itself and here, each on one processor;")
    print("times real time of Stage, of StageSimulation with the same controllers, and of")
    print("a Fleet that roams by itself")
    print(
        f"{'robots':>7}  {'sensor':<7}{'Stage':>8}{'load s':>7}{'MB':>7}"
        f"{'StageSim':>10}{'load s':>7}{'times':>7}{'Fleet':>10}{'times':>7}"
    )
    alone: list[float] = []
    own: list[float] = []
    with tempfile.TemporaryDirectory() as home:
        for count, side, blind, seeing in SIZES:
            for name, sensor in SENSORS if count <= largest else ():
                if not sensor and stage.plugins is None:
                    continue  # Stage's own controllers need a sensor
                file = write(Path(home), count, side, sensor)
                theirs = of_stage(stage, file, seeing if sensor else blind, count)
                ours, loaded = of_simulation(file, threads)
                fleet = of_fleet(file, threads)
                goals.stage[count, name] = theirs.factor * count / INTERVAL_S
                alone.append(fleet / theirs.factor)
                own.append(ours / theirs.factor)
                print(
                    f"{count:>7,}  {name:<7}{shown(theirs.factor):>8}"
                    f"{theirs.loaded.seconds:>7.2f}{theirs.loaded.megabytes:>7,.0f}"
                    f"{shown(ours):>10}{loaded:>7.2f}{own[-1]:>7.1f}"
                    f"{shown(fleet):>10}{alone[-1]:>7.1f}",
                    flush=True,
                )
    goals.least("times Stage on its files, Fleet: the least", min(alone), 10.0)
    goals.least("times Stage on its files, StageSimulation", min(own), 10.0)
    if stage.plugins is not None:
        theirs_off, ours_off = box_errors(stage)
        print(f"rays in a 10 m box: Stage {theirs_off:.3g} mm off, Gazelle {ours_off:.1g} mm")
        goals.most("mean error in a 10 m box [mm]", ours_off, 4.0)


def box_errors(stage: Stage) -> tuple[float, float]:
    """Return mean error of 20 scans of 361 rays in a 10 m box of both [mm]."""
    rng = np.random.default_rng(1)
    poses = rng.uniform((-4.9, -4.9, -180.0), (4.9, 4.9, 180.0), (20, 3))
    sensor = "ranger ( sensor ( range [0 20] fov 360 samples 361 ) )"
    lines = ["interval_sim 100 resolution 0.02 quit_time 1 model ( size [10 10 1] )"]
    for i, (x, y, yaw) in enumerate(poses.tolist()):
        lines.append(
            f'position ( name "r{i}" size [.1 .1 .1] ranger_return -1 obstacle_return 0'
            f' pose [{x:.6f} {y:.6f} 0 {yaw:.6f}] {sensor} ctrl "stage_probe drive 0 0 0" )'
        )
    with tempfile.TemporaryDirectory() as home:
        file, log = Path(home) / "box.world", Path(home) / "log"
        file.write_text("\n".join(lines), encoding="utf-8")
        stage.run(file, log)
        said = [line.split() for line in log.read_text(encoding="utf-8").splitlines()]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            sim = StageSimulation(file, threads=1)
    theirs = {name: rest[1:] for kind, name, *rest in said if kind == "ranges"}
    errors: list[list[float]] = []
    for i, (x, y, yaw) in enumerate(np.round(poses, 6)):
        angles = np.radians(yaw + np.linspace(-180.0, 180.0, 361))
        across = (np.where(np.cos(angles) > 0, 5.0, -5.0) - x) / np.cos(angles)
        along = (np.where(np.sin(angles) > 0, 5.0, -5.0) - y) / np.sin(angles)
        true = np.minimum(across, along)
        found = (np.array(theirs[f"r{i}"], float), sim.scan_of(f"r{i}"))
        errors.append([1000.0 * float(np.abs(each - true).mean()) for each in found])
    first, second = np.mean(errors, axis=0).tolist()
    return first, second


def write(home: Path, count: int, side: float, sensor: str) -> Path:
    """Return an office whose robots Stage's ``wander`` drives, or blindly without a sensor."""
    file = worlds.write_office(home, count, side, sensor)
    control = "wander" if sensor else "stage_probe roam"
    text = file.read_text(encoding="utf-8").replace(
        'drive "diff"', f'drive "diff" ctrl "{control}"'
    )
    file.write_text(text, encoding="utf-8")
    return file


def of_stage(stage: Stage, file: Path, seconds: float, count: int) -> Run:
    """Run it briefly and long: the difference is what simulating takes."""
    best = Run(0.0, Spent(0.0, 0.0))
    for _ in range(2 if count <= CHEAP else 1):
        briefly = stage.run(until(file, FIRST_S))
        longer = stage.run(until(file, FIRST_S + seconds))
        spent = max(longer.seconds - briefly.seconds, 1e-3)
        loaded = Spent(briefly.seconds, longer.megabytes)
        best = max(best, Run(seconds / spent, loaded), key=lambda run: run.factor)
    return best


def until(file: Path, seconds: float) -> Path:
    """Return the same world that ends after some simulated seconds."""
    ending = file.with_name(f"until_{seconds:g}_{file.name}")
    text = file.read_text(encoding="utf-8")
    ending.write_text(f"quit_time {seconds:g}\nthreads 1\n{text}", encoding="utf-8")
    return ending


class Roam(FleetController):
    """What ``stage_probe roam`` does, in native code here as there."""

    def __init__(self, sim: StageSimulation) -> None:
        self._sim, self._law = sim, Roaming(sim.fleet).law

    def update(self) -> None:
        """Choose the commands of all robots."""
        self._law.choose(self._sim.steps)

    def systems(self) -> list[System]:
        """Return its systems, for native code."""
        return [self._law]


def of_simulation(file: Path, threads: int) -> tuple[float, float]:
    """Return the real-time factor of StageSimulation with the file's controllers, and load [s]."""
    register_controller("stage_probe", lambda sim, _: [Roam(sim)])
    began = time.process_time()
    with StageSimulation(file, threads=threads, euler=True) as sim:
        loaded = time.process_time() - began
        sim.step(5)
        return sim.time_step / seconds_each(sim.step), loaded


def of_fleet(file: Path, threads: int) -> float:
    """Return the real-time factor of a fleet of the same robots and walls that roams by itself."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        world = formats.load(file)
    layout = layout_of([model for model in world.models if model.kind == "stage"])
    step = world.content.interval_sim
    fleet = Fleet(layout.bodies, layout.statics, time_step=step, euler=True, threads=threads)
    scanner = Scanner(fleet, layout.fans[0], layout.mounts[0]) if layout.fans else None
    roaming = Roaming(fleet, scanner)
    roaming.run(5)
    return step / seconds_each(roaming.run)


def seconds_each(work: Callable[[int], object]) -> float:
    """Return processor time of a step [s], the best of three windows that are long enough."""
    count, times = 4, []
    while len(times) < WINDOWS:
        began = time.process_time()
        work(count)
        spent = time.process_time() - began
        if spent >= OURS_S:
            times.append(spent / count)
        else:
            count *= 2
    return min(times)
