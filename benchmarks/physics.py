"""Physics: real-time factors, batches, overhead over bare MuJoCo, and how cost grows.

All ratios come from one run on this machine, their two sides taking turns. The bare figures
step the model that Gazelle compiled with MuJoCo's own `mj_step`; the last peer is the same scene
written for MuJoCo by hand (benchmarks/turtlebot3_world.xml). The house and the warehouse are
ROBOTIS' and AWS RoboMaker's, found in the folder that GAZELLE_CORPUS names.
"""

from __future__ import annotations

import argparse
import os
import time
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np

import gazelle
from gazelle.description import (
    Box,
    Collision,
    Friction,
    Inertia,
    Inertial,
    Link,
    Model,
    Physics,
    Plane,
    Pose,
    Surface,
)
from gazelle.engines.mujoco.compiler.spec import CompilerInput, compile_world

STEP = 0.001
WINDOWS = 20
PLANES = 1024
COUNTS = (1, 3, 10, 30, 100, 300, 1000)
BY_HAND = Path(__file__).parent / "turtlebot3_world.xml"
CORPUS = Path(os.environ.get("GAZELLE_CORPUS", Path(__file__).parents[2] / "shared" / "corpus"))
SCENES = {
    "small warehouse": "aws-robotics__aws-robomaker-small-warehouse-world/worlds/"
    "no_roof_small_warehouse.world",
    "house": "ROBOTIS-GIT__turtlebot3_simulations/turtlebot3_gazebo/worlds/turtlebot3_house.world",
}
STARTS = {"small warehouse": (0.0, 0.0), "house": (-3.0, 1.0)}


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(prog="gazelle bench physics", description=__doc__)
    parser.add_argument("--seconds", type=float, default=3.0, help="a window (default 3)")
    args = parser.parse_args()
    step = f"physics step {STEP * 1000:g} ms"
    print(f"{os.cpu_count()} processors, {step}, best of {WINDOWS} windows of processor time")
    one_burger(args.seconds)
    many_worlds(args.seconds)
    many_planes(args.seconds)
    beside_mujoco(args.seconds)
    big_worlds(args.seconds)
    boxes(args.seconds / 3.0)
    friction_models(args.seconds / 3.0)


def rates(
    work: list[Callable[[], float]], seconds: float, clock: Callable[[], float]
) -> list[float]:
    """Return the highest rate of each, by windows in turns; ``work`` returns its count."""
    best = [0.0] * len(work)
    for each in work:
        each()
    for _ in range(WINDOWS):
        for i, each in enumerate(work):
            done, start = 0.0, clock()
            while clock() - start < seconds / WINDOWS:
                done += each()
            best[i] = max(best[i], done / (clock() - start))
    return best


def on_one_core(work: list[Callable[[], float]], seconds: float) -> list[float]:
    """Return rates by processor time, which other programs do not take away."""
    return rates(work, seconds, time.process_time)


def burger(nworld: int, threads: int | None, engine: str = "mujoco") -> gazelle.Simulation:
    """Return the burger driving in turtlebot3_world, its wheels turning."""
    sim = gazelle.Simulation(
        "turtlebot3_world", engine, nworld=nworld, threads=threads, time_step=STEP
    )
    add_burger(sim, -2.0, -0.5)
    return sim


def add_burger(sim: gazelle.Simulation, x: float, y: float) -> gazelle.Robot:
    """Return a burger that drives in a circle."""
    robot = sim.spawn("turtlebot3_burger", name="burger", pose=gazelle.Pose(x=x, y=y))
    robot.inputs["cmd_vel"].send(linear=0.1, angular=0.4)
    return robot


def listen(robot: gazelle.Robot) -> None:
    """Subscribe to a burger's 360-ray lidar at 5 Hz, and odometry and joints at 30 Hz."""
    robot.sensors["lds_lfcd_sensor"].subscribe(lambda _: None)
    robot.outputs["odom"].subscribe(lambda _: None)
    robot.outputs["joint_states"].subscribe(lambda _: None)


def running(sim: gazelle.Simulation) -> Callable[[], float]:
    """Run half a second; returns the simulated time."""

    def work() -> float:
        sim.run(seconds=0.5)
        return 0.5

    return work


def one_burger(seconds: float) -> None:
    """Measure one burger with its lidar, odometry and joint states, on one core."""
    sim = burger(1, 1)
    listen(sim.robots["burger"])
    (rate,) = on_one_core([running(sim)], seconds)
    print(f"one burger, lidar, odometry, joint states: real-time factor {rate:,.0f} on one core")


def many_worlds(seconds: float) -> None:
    """Measure 256 worlds on one and on two threads."""
    work = []
    for threads in (1, 2):
        sim = burger(256, threads)

        def some(sim: gazelle.Simulation = sim) -> float:
            sim.step(20)
            return 256.0 * 20.0

        work.append(some)
    one, two = rates(work, seconds, time.perf_counter)
    print(
        f"256 worlds: {one:,.0f} world-steps/s on one thread, {two:,.0f} on two: "
        f"{two / one:.2f} times"
    )


def many_planes(seconds: float) -> None:
    """Measure 1,024 worlds in the plane with new commands and 360 rays every 0.2 s."""
    sim = burger(PLANES, None, "planar")
    robot, rng = sim.robots["burger"], np.random.default_rng(0)
    robot.sensors["lds_lfcd_sensor"].subscribe(lambda _: None)

    def control() -> float:
        robot.inputs["cmd_vel"].send(rng.uniform(0.05, 0.15, PLANES), rng.uniform(0.5, 1.5, PLANES))
        sim.run(seconds=0.2)
        return PLANES

    (rate,) = on_one_core([control], seconds)
    print(f"{PLANES:,} worlds in the plane, 360 rays: {rate:,.0f} control steps/s of 0.2 s")


def beside_mujoco(seconds: float) -> None:
    """Compare ``Simulation.step`` with ``mj_step``, on the compiled and a hand-made model."""
    sim = burger(1, 1)
    sim.run(seconds=0.5)
    ours = sim.engine.running.batch.model
    state = sim.engine.running.batch.get_data(0)
    model = mujoco.MjModel.from_xml_path(str(BY_HAND))
    data = mujoco.MjData(model)
    data.ctrl[:] = state.userdata[: model.nu]  # the velocities that its motors hold
    mujoco.mj_step(model, data, nstep=500)

    def simulation() -> float:
        sim.step(100)
        return 100.0

    def compiled() -> float:
        mujoco.mj_step(ours, state, nstep=100)
        return 100.0

    def by_hand() -> float:
        mujoco.mj_step(model, data, nstep=100)
        return 100.0

    full, bare, hand = on_one_core([simulation, compiled, by_hand], seconds)
    print(f"Simulation.step {full:,.0f} steps/s, mj_step {bare:,.0f}: {full / bare:.0%}")
    print(f"Simulation.step beside mj_step on a model by hand, {hand:,.0f}: {full / hand:.0%}")


def big_worlds(seconds: float) -> None:
    """Measure a burger with all its sensors in the small warehouse and in the house."""
    for name, path in SCENES.items():
        if not (CORPUS / path).exists():
            print(f"{name}: not here (set GAZELLE_CORPUS)")
            continue
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            start = time.process_time()
            sim = gazelle.Simulation(CORPUS / path, time_step=STEP, threads=1)
            listen(add_burger(sim, *STARTS[name]))
        load = time.process_time() - start
        (rate,) = on_one_core([running(sim)], seconds / 2.0)
        shapes = sim.engine.running.batch.model.ngeom
        print(f"{name}, {shapes} shapes: loads in {load:.1f} s, real-time factor {rate:,.0f}")


def boxes(seconds: float) -> None:
    """Measure boxes that slide, boxes that sleep, and the cost of one more."""
    print(f"{'boxes':>8}{'sliding: us/step':>18}{'asleep: us/step':>18}")
    table = []
    for count in COUNTS:
        work = [stepping(count, moving=True), stepping(count, moving=False)]
        table.append([1e6 / rate for rate in on_one_core(work, seconds)])
        print(f"{count:>8}{table[-1][0]:>18.1f}{table[-1][1]:>18.1f}")
    # Relative errors count: a box is a box in a small world, too.
    x, y = np.array(COUNTS, float), np.array(table)
    for name, column in zip(("that slides", "that sleeps"), y.T, strict=True):
        slope, offset = np.polyfit(x, column, 1, w=1.0 / column)
        off = np.abs((slope * x + offset) / column - 1.0).max()
        print(f"a box {name}: {slope:.3f} us a step; a line fits within {off:.0%}")
    asleep_in_mujoco(seconds)


def asleep_in_mujoco(seconds: float) -> None:
    """Measure a sleeping box in bare MuJoCo, part by part."""
    count = COUNTS[-1]
    model = compile_world(CompilerInput(grid(count, moving=False), STEP)).model
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=600)
    parts = {
        "mj_step": mujoco.mj_step,
        "collisions": mujoco.mj_collision,
        "kinematics": mujoco.mj_kinematics,
        "constraints": mujoco.mj_makeConstraint,
        "centres of mass": mujoco.mj_comPos,
    }

    def part(function: Callable[[mujoco.MjModel, mujoco.MjData], None]) -> Callable[[], float]:
        def work() -> float:
            for _ in range(20):
                function(model, data)
            return 20.0 * count

        return work

    found = on_one_core([part(function) for function in parts.values()], seconds)
    costs = [f"{name} {1e6 / rate:.3f}" for name, rate in zip(parts, found, strict=True)]
    print(f"a box that sleeps, of {count}, in bare MuJoCo, us: {', '.join(costs)}")


def friction_models(seconds: float) -> None:
    """Compare a cone with a pyramid: for a burger, and for boxes on the ground."""
    models = ("pyramid_model", "cone_model")
    driving, standing = [], []
    for model in models:
        sim = burger(1, 1)
        sim.physics.friction_model = model
        driving.append(running(sim))
        awake = grid(100, moving=False)
        sim = gazelle.Simulation(replace(awake, physics=(Physics(auto_disable=False),)))
        sim.physics.friction_model = model
        standing.append(running(sim))
    for name, work in (("burger", driving), ("100 boxes that stand", standing)):
        pyramid, cone = on_one_core(work, seconds)
        print(
            f"{name}: real-time factor {pyramid:,.1f} on a pyramid, {cone / pyramid:.0%} on a cone"
        )


def stepping(count: int, *, moving: bool) -> Callable[[], float]:
    """Step a number of boxes, ten steps a call."""
    sim = gazelle.Simulation(grid(count, moving=moving), time_step=STEP)
    if moving:
        for i in range(count):
            sim.engine.models[f"box{i}"].set_motion((0.2, 0.1, 0.0), (0.0, 0.0, 0.0))
    sim.step(200)

    def work() -> float:
        sim.step(10)
        return 10.0

    return work


def grid(count: int, *, moving: bool) -> gazelle.World:
    """Return boxes in rows on the ground, apart from each other; on ice if they move."""
    surface = Surface(Friction(0.0, 0.0) if moving else Friction())
    floor = Collision("c", Plane(), surface=surface)
    ground = Model("ground", static=True, links=(Link("l", collisions=(floor,)),))
    side = int(count**0.5) + 1
    inertial = Inertial(1.0, inertia=Inertia(0.0067, 0.0067, 0.0067))
    shape = Collision("c", Box((0.2, 0.2, 0.2)), surface=surface)
    link = Link("l", inertial=inertial, collisions=(shape,))
    models = [
        Model(f"box{i}", pose=Pose(0.5 * (i % side), 0.5 * (i // side), 0.1), links=(link,))
        for i in range(count)
    ]
    physics = Physics(max_step_size=STEP, auto_disable=not moving)
    return gazelle.World(models=(ground, *models), physics=(physics,))


if __name__ == "__main__":
    main()
