"""Cost of reading each robot by itself from Python, for ``gazelle bench stage``."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

from _goals import Goals, shown
from _stage_worlds import FLEET, SENSORS, seconds_a_step, write_office

from gazelle.stage import StageSimulation

WANTED = 300.0  # times real time


def reads(threads: int, goals: Goals) -> None:
    """Print how much faster than real time a fleet runs that is read in each step."""
    print(
        f"\n{f'{FLEET} robots with 640 rays, read in each step':<45}{'us a step':>10}{'real time':>11}"
    )
    with tempfile.TemporaryDirectory() as home:
        file = write_office(Path(home), FLEET, 40.0, SENSORS[0][1])
        with StageSimulation(file, threads=threads, euler=True) as sim:
            for name, look in looks(sim).items():
                sim.reset()
                spent = seconds_a_step(sim, look)
                factor = sim.time_step / spent
                print(f"  {name:<43}{1e6 * spent:>10.0f}{shown(factor):>11}", flush=True)
                if look is not nothing:
                    goals.least(f"{FLEET} robots, {name}: times real time", factor, WANTED)


def looks(sim: StageSimulation) -> dict[str, Callable[[], object]]:
    """Return what may be read in each step."""
    robots = [robot for robot in sim.simulation.robots.values() if robot.sensors]
    sensors = [next(iter(robot.sensors.values())) for robot in robots]

    def both() -> None:
        for robot, sensor in zip(robots, sensors, strict=True):
            _ = robot.pose
            sensor.read()

    return {
        "nothing": nothing,
        "all at once": sim.scan,
        "pose of each": lambda: [robot.pose for robot in robots],
        "sensor.read() of each": lambda: [sensor.read() for sensor in sensors],
        "both of each": both,
    }


def nothing() -> None:
    """Read nothing."""
