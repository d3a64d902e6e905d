"""Physics: real-time factors, batches, overhead over bare MuJoCo, and how cost grows.

All ratios come from one run on this machine. The bare figures step the very model that
Gazelle compiled with MuJoCo's own `mj_step`.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable

import mujoco

import gazelle
from gazelle.description import Box, Collision, Inertia, Inertial, Link, Model, Physics, Plane, Pose

STEP = 0.001


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(prog="gazelle bench physics", description=__doc__)
    parser.add_argument("--seconds", type=float, default=3.0, help="a window (default 3)")
    args = parser.parse_args()
    print(f"{os.cpu_count()} processors, physics step {STEP * 1000:g} ms, best of 3 windows")
    one_burger(args.seconds)
    many_worlds(args.seconds)
    overhead(args.seconds)
    boxes(args.seconds / 3.0)


def best(work: Callable[[], float], seconds: float) -> float:
    """The highest rate of three windows; ``work`` does some and returns how much."""
    work()
    rates = []
    for _ in range(3):
        done, start = 0.0, time.perf_counter()
        while time.perf_counter() - start < seconds:
            done += work()
        rates.append(done / (time.perf_counter() - start))
    return max(rates)


def burger(nworld: int, threads: int | None) -> gazelle.Simulation:
    """The burger driving in turtlebot3_world, its wheels turning."""
    sim = gazelle.Simulation("turtlebot3_world", nworld=nworld, threads=threads, time_step=STEP)
    robot = sim.spawn("turtlebot3_burger", name="burger", pose=gazelle.Pose(x=-2.0, y=-0.5))
    robot.inputs["cmd_vel"].send(linear=0.1, angular=0.4)
    return sim


def one_burger(seconds: float) -> None:
    """One burger with its 360-ray lidar at 5 Hz, odometry and joint states, on one core."""
    sim = burger(1, 1)
    robot = sim.robots["burger"]
    robot.sensors["lds_lfcd_sensor"].subscribe(lambda _: None)
    robot.outputs["odom"].subscribe(lambda _: None)
    robot.outputs["joint_states"].subscribe(lambda _: None)

    def work() -> float:
        sim.run(seconds=0.5)
        return 0.5

    print(f"one burger, lidar, odometry: real-time factor {best(work, seconds):,.0f} on one core")


def many_worlds(seconds: float) -> None:
    """256 worlds on one and on two threads."""
    rates = {}
    for threads in (1, 2):
        sim = burger(256, threads)

        def work(sim: gazelle.Simulation = sim) -> float:
            sim.step(20)
            return 256.0 * 20.0

        rates[threads] = best(work, seconds)
    print(
        f"256 worlds: {rates[1]:,.0f} world-steps/s on one thread, {rates[2]:,.0f} on two: "
        f"{rates[2] / rates[1]:.2f} times"
    )


def overhead(seconds: float) -> None:
    """``Simulation.step`` beside ``mj_step`` on the compiled model, taking turns."""
    sim = burger(1, 1)
    sim.run(seconds=0.5)
    model = sim.engine._batch.model  # noqa: SLF001  the benchmark looks under the hood
    data = sim.engine._batch.get_data(0)  # noqa: SLF001

    def bare() -> float:
        mujoco.mj_step(model, data, nstep=100)
        return 100.0

    def ours() -> float:
        sim.step(100)
        return 100.0

    plain, full = best(bare, seconds), best(ours, seconds)
    print(f"bare mj_step {plain:,.0f} steps/s, Simulation.step {full:,.0f}: {full / plain:.0%}")


def boxes(seconds: float) -> None:
    """Resting boxes, 1 to 1,000."""
    print(f"{'boxes':>8}{'steps/s':>12}{'us a box':>12}")
    for count in (1, 10, 100, 1000):
        sim = gazelle.Simulation(grid(count), time_step=STEP)
        sim.step(200)

        def work(sim: gazelle.Simulation = sim) -> float:
            sim.step(10)
            return 10.0

        rate = best(work, seconds)
        print(f"{count:>8}{rate:>12,.0f}{1e6 / rate / count:>12.1f}")


def grid(count: int) -> gazelle.World:
    """Boxes in rows on the ground, apart from each other."""
    ground = Model("ground", static=True, links=(Link("l", collisions=(Collision("c", Plane()),)),))
    side = int(count**0.5) + 1
    inertial = Inertial(1.0, inertia=Inertia(0.0067, 0.0067, 0.0067))
    link = Link("l", inertial=inertial, collisions=(Collision("c", Box((0.2, 0.2, 0.2))),))
    models = [
        Model(f"box{i}", pose=Pose(0.5 * (i % side), 0.5 * (i // side), 0.1), links=(link,))
        for i in range(count)
    ]
    return gazelle.World(models=(ground, *models), physics=(Physics(max_step_size=STEP),))


if __name__ == "__main__":
    main()
