"""Control steps a second of Fetch's tasks, beside Gymnasium-Robotics' in the same run.

Both take random actions, and begin episodes anew when they are over. Gymnasium-Robotics may be
installed for another Python than Gazelle is (`--peer PYTHON`), as its MuJoCo shares a folder with
Gazelle's. Rates are of the processor's time of one core, which other work on the machine changes less.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time

import gymnasium
import numpy as np
from _goals import Goals

import gazelle.envs  # noqa: F401  registers the environments

TASKS = ("Reach", "Push", "Slide", "PickAndPlace")
TIMES = 10.0
"""How often Gymnasium-Robotics' rate is wanted."""

PEER = """
import sys, time, warnings
warnings.filterwarnings("ignore")
import gymnasium, numpy, gymnasium_robotics
gymnasium.register_envs(gymnasium_robotics)
env = gymnasium.make(f"Fetch{sys.argv[1]}-v4")
env.reset(seed=0)
generator = numpy.random.default_rng(0)
for rounds in range(int(sys.argv[3])):
    count, start, spent = 0, time.process_time(), 0.0
    while spent < float(sys.argv[2]):
        *_, truncated, _ = env.step(generator.uniform(-1.0, 1.0, 4).astype(numpy.float32))
        if truncated:
            env.reset()
        count, spent = count + 1, time.process_time() - start
    print(count / spent, flush=True)
"""


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="gazelle bench fetch", description=__doc__)
    parser.add_argument("--seconds", type=float, default=0.5, help="a window (default 0.5)")
    parser.add_argument("--windows", type=int, default=3, help="of which the best (default 3)")
    parser.add_argument("--worlds", type=int, default=64, help="at once (default 64)")
    parser.add_argument("--task", action="append", choices=TASKS, help="default all")
    parser.add_argument(
        "--peer", metavar="PYTHON", help="a Python with gymnasium-robotics (default this one)"
    )
    args = parser.parse_args()
    goals = Goals()
    print(f"control steps/s of one core, {args.worlds} worlds, random actions")
    print(f"{'task':<14}{'gripper':>10}{'joint':>10}{'Gymnasium-Robotics':>22}{'times':>8}")
    for task in args.task or TASKS:
        ours = [rate(task, control, args) for control in ("gripper", "joint")]
        theirs = peer_rate(task, args)
        told = "-" if theirs is None else f"{theirs:,.0f}"
        times = "-" if theirs is None else f"{ours[0] / theirs:.1f}"
        print(f"{task:<14}{ours[0]:>10,.0f}{ours[1]:>10,.0f}{told:>22}{times:>8}", flush=True)
        if theirs is not None:
            goals.least(f"Fetch{task}, times Gymnasium-Robotics'", ours[0] / theirs, TIMES)
    goals.show()


def rate(task: str, control: str, args: argparse.Namespace) -> float:
    """Control steps a second of processor time, the best of several windows."""
    env = gymnasium.make_vec(
        f"gazelle/Fetch{task}-v0",
        num_envs=args.worlds,
        vectorization_mode="vector_entry_point",
        threads=1,
        control=control,
    )
    env.reset(seed=0)
    generator = np.random.default_rng(0)
    found = []
    for _ in range(args.windows):
        count, start, spent = 0, time.process_time(), 0.0
        while spent < args.seconds:
            env.step(generator.uniform(-1.0, 1.0, (args.worlds, 4)))
            count, spent = count + args.worlds, time.process_time() - start
        found.append(count / spent)
    env.close()
    return max(found)


def peer_rate(task: str, args: argparse.Namespace) -> float | None:
    """Return the rate of Gymnasium-Robotics; None where it is not installed."""
    command = [args.peer or sys.executable, "-c", PEER, task, str(args.seconds), str(args.windows)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        print(done.stderr.strip().splitlines()[-1], file=sys.stderr)
        return None
    return max(float(line) for line in done.stdout.split())


if __name__ == "__main__":
    main()
