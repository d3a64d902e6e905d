"""Deviation of contacts from the truth, by physics step; the table of docs/explanation/accuracy.md.

Every task runs at every step, with the contacts that the engine chooses for its world. What slides,
rolls and drives is compared with its closed form; what is held, parked and stacked should stay.
The cost is processor time of a physics step.

    python tools/contact_errors.py
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from gazelle import assets
from gazelle.description import Model, Pose, World
from gazelle.engines import make_engine
from gazelle.engines.engine import Engine
from gazelle.engines.laws import with_profile
from gazelle.formats import load

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
import scenes
from grips import gripper

STEPS = (0.0005, 0.001, 0.002, 0.004, 0.005, 0.02)
G = 9.8
Result = tuple[str, float]  # the error in words, and the cost of a step [us]


def main() -> None:
    """Print the table."""
    print(f"| task | {' | '.join(f'{1000.0 * step:g} ms' for step in STEPS)} |")
    print(f"|---|{'---|' * len(STEPS)}")
    for name, task in TASKS.items():
        cells = [task(step) for step in STEPS]
        print(f"| {name} | {' | '.join(f'{text} ({cost:.0f} us)' for text, cost in cells)} |")


def engine_of(
    *models: Model, step: float, slope: float = 0.0, contacts: str | None = None
) -> Engine:
    """Return an engine on level ground, or on a slope down x."""
    gravity = (G * math.sin(slope), 0.0, -G * math.cos(slope))
    world: World = scenes.world(scenes.ground(), *models, step=step, gravity=gravity)
    world = with_profile(world, replace(world.profile, contacts=contacts))
    return make_engine("mujoco", world, threads=1)


def timed(engine: Engine, seconds: float) -> float:
    """Run, and tell what a step cost [us]."""
    steps = round(seconds / engine.time_step)
    start = time.process_time()
    engine.step(steps)
    return (time.process_time() - start) / steps * 1e6


def sliding(step: float) -> Result:
    """Return a box thrown at 4 m/s, mu 0.5: its distance, with Euler's half step, and its hop."""
    engine = engine_of(scenes.box("box", (0.2, 0.2, 0.1), mu=0.5, pose=Pose(z=0.05)), step=step)
    engine.step(round(0.3 / step))
    start = engine.models["box"].placement().position[0].copy()
    engine.models["box"].set_motion((4.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    highest, far = start[2], 16.0 / G
    for _ in range(round(1.0 / step)):
        engine.step()
        highest = max(highest, engine.models["box"].placement().position[0, 2])
    way = engine.models["box"].placement().position[0, 0] - start[0]
    cost = timed(engine, 0.5)
    return f"{percent(way / far)}, hop {1000.0 * (highest - start[2]):.3f} mm", cost


def rolling(step: float) -> Result:
    """Return a ball down a slope of 0.2 for 2 s: 5/7 g sin a t²/2."""
    engine = engine_of(scenes.ball(pose=Pose(z=0.1)), step=step, slope=0.2)
    cost = timed(engine, 2.0)
    far = 5.0 / 7.0 * G * math.sin(0.2) * 2.0
    return percent(float(engine.models["ball"].placement().position[0, 0]) / far), cost


def gripping(step: float, contacts: str | None = None) -> Result:
    """Return half a kilogram between two fingers, mu 0.8, held with a margin of two."""
    thing = scenes.box("thing", (0.05, 0.05, 0.05), mass=0.5, mu=0.8, pose=Pose(z=0.5))
    engine = engine_of(gripper(), thing, step=step, contacts=contacts)
    for side in ("left", "right"):
        engine.joints[f"g::{side}_joint"].set_effort(0.5 * G / 0.8)
    return creep(engine, ["thing"])


def parking(step: float, contacts: str | None = None) -> Result:
    """Return a burger on a slope of 0.05, its motors holding."""
    robot = load(assets.robot("turtlebot3_burger")).models[0]
    engine = engine_of(robot, step=step, slope=0.05, contacts=contacts)
    for side in ("left", "right"):
        engine.add_motor(f"{robot.name}::wheel_{side}_joint", 10.0)
    return creep(engine, [robot.name])


def stacking(step: float) -> Result:
    """Return ten boxes on each other, put 5 mm aside by turns."""
    names = [f"b{index}" for index in range(10)]
    boxes = [
        scenes.box(name, (0.2, 0.2, 0.1), mu=0.6, pose=Pose(x=0.005 * (-1) ** i, z=0.05 + 0.1 * i))
        for i, name in enumerate(names)
    ]
    return creep(engine_of(*boxes, step=step), names)


def creep(engine: Engine, names: list[str]) -> Result:
    """Return how far the worst of some models moves in a minute, from 10 s."""
    engine.step(round(2.0 / engine.time_step))
    before = [engine.models[name].placement().position[0].copy() for name in names]
    cost = timed(engine, 10.0)
    after = [engine.models[name].placement().position[0] for name in names]
    worst = max(float(np.linalg.norm(a - b)) for a, b in zip(after, before, strict=True))
    return f"{6000.0 * worst:.3f} mm a minute", cost


def driving(
    linear: float, angular: float, contacts: str | None = None
) -> Callable[[float], Result]:
    """Return errors of a burger with wheels turning for 10 m, or ten turns, without the ramp."""

    def drive(step: float) -> Result:
        robot = load(assets.robot("turtlebot3_burger")).models[0]
        robot = replace(robot, plugins=(), pose=Pose())
        engine = engine_of(robot, step=step, contacts=contacts)
        base = f"{robot.name}::base_footprint"
        for side, sign in (("left", -1.0), ("right", 1.0)):
            joint = f"{robot.name}::wheel_{side}_joint"
            engine.add_motor(joint, 10.0)
            engine.joints[joint].set_motor_velocity((linear + sign * angular * 0.08) / 0.033)
        engine.step(round(1.0 / step))
        start, before, turned = engine.links[base].placement(), 0.0, 0.0
        before, cost = yaw(start.quaternion[0]), 0.0
        seconds = 10.0 / linear if linear else 20.0 * math.pi / angular
        for _ in range(round(seconds / 0.1)):
            cost = timed(engine, 0.1)
            now = yaw(engine.links[base].placement().quaternion[0])
            turned += math.remainder(now - before, 2.0 * math.pi)
            before = now
        way = engine.links[base].placement().position[0] - start.position[0]
        if angular:
            asked = angular * round(seconds / 0.1) * 0.1
            return f"{percent(turned / asked)}", cost
        heading = yaw(start.quaternion[0])
        aside = way[1] * math.cos(heading) - way[0] * math.sin(heading)
        return f"{percent(math.hypot(*way[:2]) / 10.0)}, {1000.0 * abs(aside):.1f} mm aside", cost

    return drive


def yaw(quaternion: np.ndarray) -> float:
    """Return the heading of a rotation (x, y, z, w)."""
    x, y, z, w = quaternion.tolist()
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def percent(ratio: float) -> str:
    """Return the deviation of a ratio from one."""
    return f"{100.0 * (ratio - 1.0):+.3f} %"


TASKS: dict[str, Callable[[float], Result]] = {
    "sliding: a box stops after v²/(2 μ g)": sliding,
    "rolling: a ball down a slope": rolling,
    "gripping: a box, margin of two": gripping,
    "the same, `fast`": partial(gripping, contacts="fast"),
    "parking: a burger on 0.05 rad": parking,
    "the same, `exact`": partial(parking, contacts="exact"),
    "stacking: ten boxes": stacking,
    "driving: a burger, 10 m": driving(0.2, 0.0),
    "driving: a burger, ten turns": driving(0.0, 1.0),
    "the same ten turns, `exact`": driving(0.0, 1.0, "exact"),
}


if __name__ == "__main__":
    main()
