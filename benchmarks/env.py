"""Control steps a second of TurtleBot3Stage4, beside IR-SIM's in the same run.

Both simulate the same robot, room and beams, 0.2 s a control step, with random commands. Beside
it a task and a drive that a user wrote from the docs, of as many beams and as long a step.
IR-SIM moves a disc; Gazelle simulates wheels, contacts and friction in MuJoCo, or wheels that
roll in the plane with the planar engine. Rates are of the wall clock; the last column is what a
control step took of all processors together, which other work on the machine changes less.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import gymnasium
import numpy as np
from _goals import Goals

import gazelle.envs  # noqa: F401  registers the environments

ENVIRONMENT = "gazelle/TurtleBot3Stage4-v0"
USERS_RAYS = 24  # of the robot in user_task.py

# Control steps a second in the plane on two quiet cores, by rays and worlds.
WANTED = {(24, 1024): 1_000_000.0, (360, 1024): 400_000.0, (24, 1): 10_000.0}
USERS_SHARE = 0.6  # of that for a user's own task and drive

# Stage 4: (x, y, yaw, length) of the walls, all 0.15 m thick, and (x, y) of the posts.
WALLS = (
    (0, 2.425, 0, 5),
    (0, -2.425, 0, 5),
    (2.425, 0, 1.5708, 5),
    (-2.425, 0, 1.5708, 5),
    (-1.937, -1.467, 0, 1),
    (-0.22, -1.866, -1.5708, 1),
    (1.195, -1.002, 1.5708, 1),
    (1.288, 1.93, -1.5708, 1),
    (1.91128, 0.4632, 0, 1),
    (0.204, 0.215, -1.5708, 1),
    (-1.064, 1.548, 0, 1),
    (-1.502, 0.092, -1.5708, 1),
)
POSTS = ((2, 2), (-2, -2))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="gazelle bench env", description=__doc__)
    parser.add_argument("--seconds", type=float, default=0.25, help="a window (default 0.25)")
    parser.add_argument("--windows", type=int, default=5, help="of which the best (default 5)")
    parser.add_argument("--engine", action="append", help="mujoco or planar (default both)")
    parser.add_argument(
        "--starts", default="published", help="of our task's episodes, such as training"
    )
    args = parser.parse_args()
    goals = Goals()
    print(f"{ENVIRONMENT}, random actions, {os.cpu_count()} processors, best of {args.windows}")
    print(f"{'simulator':<34}{'rays':>6}{'worlds':>8}{'control steps/s':>18}{'CPU us each':>13}")
    for rays in (24, 360):
        for engine in args.engine or ("mujoco", "planar"):
            for worlds in (1, 64, 1024):
                compare(rays, worlds, engine, args, goals)
        stepper = irsim_stepper(rays)
        if stepper is None:
            print("IR-SIM is not installed; get it with: pip install 'gazelle[bench]'")
        else:
            measure("IR-SIM", rays, 1, stepper, args)
    goals.show()


def compare(rays: int, worlds: int, engine: str, args: argparse.Namespace, goals: Goals) -> None:
    """Print our task's row, and the user's where it sees as many rays; note what is wanted."""
    stepper = gazelle_stepper(rays, worlds, engine, args.starts)
    ours = measure(f"Gazelle (engine {engine})", rays, worlds, stepper, args)
    wanted = WANTED.get((rays, worlds)) if engine == "planar" else None
    if wanted is not None:
        goals.least(f"planar, {rays} rays, worlds: {worlds:,}", ours, wanted)
    if rays != USERS_RAYS:
        return
    name = f"  a user's task and drive ({engine})"
    users = measure(name, rays, worlds, user_stepper(worlds, engine), args)
    if wanted is not None:
        goals.least(f"the user's, worlds: {worlds:,}", users, USERS_SHARE * wanted)
    else:
        goals.least(
            f"the user's over ours, {engine}, worlds: {worlds:,}", users / ours, USERS_SHARE
        )


def measure(
    name: str, rays: int, worlds: int, step: Callable[[], None], args: argparse.Namespace
) -> float:
    """Print one row; returns the rate."""
    rate, cost = best(step, worlds, args)
    print(f"{name:<34}{rays:>6}{worlds:>8}{rate:>18,.0f}{1e6 * cost:>13.2f}", flush=True)
    return rate


def best(step: Callable[[], None], worlds: int, args: argparse.Namespace) -> tuple[float, float]:
    """Return the highest rate of several windows [1/s].

    Also return the least processor time a control step [s].
    """
    step()
    rates, costs = zip(
        *(window(step, worlds, args.seconds) for _ in range(args.windows)), strict=True
    )
    return max(rates), min(costs)


def window(step: Callable[[], None], worlds: int, seconds: float) -> tuple[float, float]:
    """Control steps a second over one window, and processor time of each."""
    count, start, began = 0, time.perf_counter(), time.process_time()
    while time.perf_counter() - start < seconds:
        step()
        count += worlds
    spent = time.process_time() - began
    return count / (time.perf_counter() - start), spent / count


def gazelle_stepper(rays: int, worlds: int, engine: str, starts: str) -> Callable[[], None]:
    """Return one step of Gazelle's environment: single for one world, vectorised for more."""
    generator = np.random.default_rng(0)
    if worlds == 1:
        single = gymnasium.make(ENVIRONMENT, lidar_samples=rays, engine=engine, starts=starts)
        single.reset(seed=0)

        def step() -> None:
            _, _, terminated, truncated, _ = single.step(int(generator.integers(5)))
            if terminated or truncated:
                single.reset()

        return step
    vector = gymnasium.make_vec(
        ENVIRONMENT,
        num_envs=worlds,
        vectorization_mode="vector_entry_point",
        lidar_samples=rays,
        engine=engine,
        starts=starts,
    )
    vector.reset(seed=0)
    return lambda: vector.step(generator.integers(5, size=worlds)) and None


def user_stepper(worlds: int, engine: str) -> Callable[[], None]:
    """Return one step of a user's task and drive: ``user_task.py`` beside this file."""
    import user_task

    env, generator = user_task.make(worlds, engine), np.random.default_rng(0)
    env.reset(seed=0)
    return lambda: env.step(generator.uniform(-1.0, 1.0, (worlds, 2))) and None


def irsim_stepper(rays: int) -> Callable[[], None] | None:
    """Return one step of the same robot, room and beams in IR-SIM.

    None when it is not installed.
    """
    os.environ.setdefault("MPLBACKEND", "Agg")
    try:
        with contextlib.redirect_stdout(io.StringIO()):  # it tries windows, and says which it lacks
            import irsim
    except ImportError:
        return None
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "stage4.yaml"
        file.write_text(irsim_world(rays))
        env = irsim.make(str(file), headless=True, log_level="ERROR")
    generator = np.random.default_rng(0)
    speeds = (1.5, 0.75, 0.0, -0.75, -1.5)

    def step() -> None:
        env.step(np.array([[0.15], [speeds[generator.integers(5)]]]))
        env.get_lidar_scan()
        if env.robot.collision:
            env.reset()

    return step


def irsim_world(rays: int) -> str:
    """Return Stage 4 in IR-SIM's language."""
    lines = [
        "world: {height: 6, width: 6, offset: [-3, -3], step_time: 0.2, sample_time: 0.2,",
        "  control_mode: auto, collision_mode: stop}",
        "robot:",
        "  - kinematics: {name: diff}",
        "    shape: {name: circle, radius: 0.105}",
        "    state: [-0.7, 0, 0]",
        "    vel_max: [0.22, 2.84]",
        "    vel_min: [-0.22, -2.84]",
        "    sensors:",
        "      - {type: lidar2d, range_min: 0.12, range_max: 3.5, angle_range: 6.28319,",
        f"         number: {rays}, noise: True, std: 0.01}}",
        "obstacle:",
    ]
    for x, y, yaw, length in WALLS:
        shape = f"{{name: rectangle, length: {length}, width: 0.15}}"
        lines.append(f"  - {{shape: {shape}, state: [{x}, {y}, {yaw}]}}")
    for x, y in POSTS:
        lines.append(f"  - {{shape: {{name: circle, radius: 0.12}}, state: [{x}, {y}, 0]}}")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()
