"""Control steps a second of TurtleBot3Stage4, beside IR-SIM's in the same run.

Both simulate the same robot, room and beams, 0.2 s a control step, with random commands. Beside
it a task and a drive that a user wrote from the docs, of as many beams and as long a step.
IR-SIM moves a disc; Gazelle simulates wheels, contacts and friction in MuJoCo, or wheels that
roll in the plane with the planar engine.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import gymnasium
import numpy as np

import gazelle.envs  # noqa: F401  registers the environments

ENVIRONMENT = "gazelle/TurtleBot3Stage4-v0"
USERS_RAYS = 24  # of the robot in user_task.py

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
    parser.add_argument("--seconds", type=float, default=1.0, help="a window (default 1)")
    parser.add_argument("--windows", type=int, default=12, help="of which the best (default 12)")
    parser.add_argument("--engine", action="append", help="mujoco or planar (default both)")
    args = parser.parse_args()
    sys.path.insert(0, str(Path(__file__).resolve().parent))
    print(f"{ENVIRONMENT}, random actions, {os.cpu_count()} processors, best of {args.windows}")
    print(f"{'simulator':<34}{'rays':>6}{'worlds':>8}{'control steps/s':>18}")
    for rays in (24, 360):
        for engine in args.engine or ("mujoco", "planar"):
            for worlds in (1, 64, 1024):
                rate = best(gazelle_stepper(rays, worlds, engine), worlds, args)
                show(f"Gazelle (engine {engine})", rays, worlds, rate)
                if rays == USERS_RAYS:
                    rate = best(user_stepper(worlds, engine), worlds, args)
                    show(f"  a user's task and drive ({engine})", rays, worlds, rate)
        stepper = irsim_stepper(rays)
        if stepper is None:
            print("IR-SIM is not installed; get it with: pip install 'gazelle[bench]'")
        else:
            show("IR-SIM", rays, 1, best(stepper, 1, args))


def show(name: str, rays: int, worlds: int, rate: float) -> None:
    """Print one row."""
    print(f"{name:<34}{rays:>6}{worlds:>8}{rate:>18,.0f}", flush=True)


def best(step: Callable[[], None], worlds: int, args: argparse.Namespace) -> float:
    """The highest rate of several windows."""
    step()
    return max(window(step, worlds, args.seconds) for _ in range(args.windows))


def window(step: Callable[[], None], worlds: int, seconds: float) -> float:
    """Control steps a second over one window."""
    count, start = 0, time.perf_counter()
    while time.perf_counter() - start < seconds:
        step()
        count += worlds
    return count / (time.perf_counter() - start)


def gazelle_stepper(rays: int, worlds: int, engine: str) -> Callable[[], None]:
    """One step of Gazelle's environment: single for one world, vectorised for more."""
    generator = np.random.default_rng(0)
    if worlds == 1:
        single = gymnasium.make(ENVIRONMENT, lidar_samples=rays, engine=engine)
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
    )
    vector.reset(seed=0)
    return lambda: vector.step(generator.integers(5, size=worlds)) and None


def user_stepper(worlds: int, engine: str) -> Callable[[], None]:
    """One step of a task and a drive that are a user's: ``user_task.py`` beside this file."""
    import user_task

    env, generator = user_task.make(worlds, engine), np.random.default_rng(0)
    env.reset(seed=0)
    return lambda: env.step(generator.uniform(-1.0, 1.0, (worlds, 2))) and None


def irsim_stepper(rays: int) -> Callable[[], None] | None:
    """One step of the same robot, room and beams in IR-SIM; None when it is not installed."""
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
    """Stage 4 in IR-SIM's language."""
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
