"""Pictures of cameras: frames a core-second, beside rays of MuJoCo in the same scene.

Every figure is frames a second of processor time, so that it counts what one core does, also where
others work beside. Scenes are made here: a room with boxes and cylinders, and the same with balls
of many triangles. A frame has colour, depth and labels; the rival's rays give distances and normals,
which is less. With shadows the same lamp throws them. Where PyOpenGL and Debian's libosmesa6 are
there, MuJoCo's classic renderer draws the same triangles beside, colour, depth and labels one after
another. Cameras of Stage's robots, which have colour
and depth, are measured in a hall made here, all robots in one call.

    gazelle bench camera
"""

from __future__ import annotations

import argparse
import time
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from gazelle.description import Box, Cylinder, Link, Model, Plane, Pose, Sphere, Visual, World
from gazelle.engines.tracer import make_tracer
from gazelle.rendering import PinholeLens, Renderer
from gazelle.rendering.lamps import SUN
from gazelle.rendering.shape_meshes import triangles_of
from gazelle.sensors import View, look_at
from gazelle.sensors.rendering import directions_of_view

GOALS = {(5000, 320, 240): 1000.0, (5000, 84, 84): 10000.0, (40000, 320, 240): 200.0}
"""Frames a core-second that are wanted: triangles, width, height."""


LOOK = ((5.0, 4.0, 2.5), (0.0, 0.0, 0.3))
"""From where to where pictures are drawn."""

STAGE = ((10, 80, 60), (10, 320, 240), (72, 80, 60), (72, 320, 240))
"""Robots in a Stage world, and pixels of their cameras."""


def room(triangles: int) -> World:
    """Return a floor, walls, and as many things as have so many triangles, the same every time."""
    random = np.random.default_rng(0)
    shapes = [Plane(size=(12.0, 12.0))]
    poses = [Pose()]
    for turn in range(4):
        shapes.append(Box((12.0, 0.1, 1.5)))
        angle = turn * np.pi / 2.0
        poses.append(Pose(6.0 * np.sin(angle), -6.0 * np.cos(angle), 0.75, yaw=angle))
    count = sum(len(triangles_of(shape).faces) for shape in shapes)
    while count < triangles:
        kind = random.integers(3)
        size = random.uniform(0.1, 0.4)
        made = (Box((size, size, size)), Cylinder(size / 2.0, size), Sphere(size / 2.0))[kind]
        shapes.append(made)
        poses.append(Pose(*random.uniform(-4.0, 4.0, 2), random.uniform(0.1, 1.2)))
        count += len(triangles_of(made).faces)
    models = (
        Model(f"m{k}", pose=pose, links=(Link("l", visuals=(Visual("v", geometry=shape),)),))
        for k, (shape, pose) in enumerate(zip(shapes, poses, strict=True))
    )
    return World(models=tuple(models), lights=(replace(SUN, cast_shadows=True),))


def best(work, seconds: float) -> float:
    """Return processor time of the fastest of some calls [s]."""
    times, end = [], time.thread_time() + seconds
    while not times or time.thread_time() < end:
        begin = time.thread_time()
        work()
        times.append(time.thread_time() - begin)
    return min(times)


def ours(
    world: World, pose: Pose, width: int, height: int, seconds: float, *, shadows: bool = False
) -> float:
    """Return frames a core-second."""
    renderer, count = Renderer(world, threads=1, shadows=shadows), 8
    place, turn = np.tile(pose.position, (count, 1)), np.tile(pose.quaternion, (count, 1))
    lens, worlds = PinholeLens(width, height, 1.2), np.zeros(count, np.intp)
    return count / best(lambda: renderer.render(lens, place, turn, worlds), seconds)


def rays(world: World, pose: Pose, width: int, height: int, seconds: float) -> float:
    """Return frames a core-second of distances and normals by MuJoCo's rays."""
    tracer = make_tracer(world)
    ways = directions_of_view(View(pose, width, height, 1.2, samples=1), 1)
    eye = np.broadcast_to(np.asarray(pose.position), ways.shape)
    return 1.0 / best(lambda: tracer.trace(eye, ways), seconds)


def batch(worlds: int, steps: int, threads: int) -> float:
    """Control steps a second, of all worlds together, of burgers with a camera in the planar engine.

    A control step is 0.1 s of simulated time in steps of 10 ms, a command, and a picture of 84 x 84 of
    every world; wall time, as all threads work.
    """
    from gazelle import assets
    from gazelle.simulation import Simulation

    with Simulation(
        assets.world("turtlebot3_stage_4"), "planar", nworld=worlds, threads=threads, time_step=0.01
    ) as sim:
        robot = sim.spawn("turtlebot3_burger", pose=Pose(-0.7))
        lens, mount = PinholeLens(84, 84, 1.2, 0.05, 20.0), np.array([0.0, 0.0, 0.3])
        turns = np.linspace(-1.0, 1.0, worlds)

        def step() -> None:
            robot.inputs["cmd_vel"].send(linear=0.15, angular=turns)
            sim.run(0.1)
            place = robot.placement()
            sim.live_scene.render(lens, place.position + mount, place.quaternion, want=("color",))

        step()
        times = []
        for _ in range(steps):
            begin = time.perf_counter()
            step()
            times.append(time.perf_counter() - begin)
    return worlds / min(times)


def hall(robots: int, width: int, height: int) -> str:
    """Return a Stage world of four walls and robots in a grid, each with a ranger and a camera."""
    text = "".join(
        f'model ( size [{x} {y} 1] pose [{at} 0 0] color "{color}" )\n'
        for x, y, at, color in (
            (30, 0.2, "0 8", "red"),
            (30, 0.2, "0 -8", "blue"),
            (0.2, 16, "15 0", "green"),
            (0.2, 16, "-15 0", "gray"),
        )
    )
    ring = [(-0.2, 0.12), (-0.2, -0.12), (-0.12, -0.26), (0.12, -0.26)]
    ring += [(-x, -y) for x, y in ring]
    points = " ".join(f"point[{k}] [{x} {y}]" for k, (x, y) in enumerate(ring))
    side = int(np.ceil(np.sqrt(robots)))
    for k in range(robots):
        text += (
            f"position ( size [.44 .38 .22] pose [{1.2 * (k % side) - 5:.1f} {1.2 * (k // side) - 5:.1f} 0 "
            f'{37 * k % 360}] color "random" block ( points 8 {points} z [0 1] ) '
            f"ranger ( sensor ( samples 9 ) ) camera ( resolution [{width} {height}] range [.2 20] "
            "fov [70 50] ) )\n"
        )
    return text


def stage(robots: int, width: int, height: int, seconds: float) -> float:
    """Return frames a core-second of Stage's cameras: colour with a fourth byte, and depth."""
    from gazelle.stage import StageSimulation

    with TemporaryDirectory() as folder:
        file = Path(folder) / "hall.world"
        file.write_text(hall(robots, width, height), encoding="utf-8")
        with StageSimulation(file, threads=1) as sim:
            return robots / best(sim.pictures, seconds)


def classic(seconds: float) -> None:
    """Print the classic renderer's figures beside ours, with shadows and without."""
    import _classic_renderer

    lack = _classic_renderer.missing()
    if lack:
        print(f"\nMuJoCo's classic renderer is not measured: {lack}")
        return
    print("\n| triangles | pixels | shadows | ours | MuJoCo's classic renderer | ratio |")
    print("|---|---|---|---|---|---|")
    pose = look_at(*LOOK)
    for triangles, width, height in GOALS:
        for shadows in (False, True):
            own = ours(room(triangles), pose, width, height, seconds, shadows=shadows)
            rival = _classic_renderer.measured(triangles, width, height, seconds, shadows=shadows)
            print(
                f"| {triangles:,} | {width} x {height} | {'yes' if shadows else 'no'} | {own:,.0f} | "
                f"{rival.whole:,.1f} | {own / rival.whole:,.0f} |",
                flush=True,
            )


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="gazelle bench camera", description=__doc__)
    parser.add_argument("--seconds", type=float, default=2.0, help="for each figure (%(default)s)")
    parser.add_argument("--steps", type=int, default=5, help="of the batch (%(default)s)")
    parser.add_argument("--threads", type=int, default=2, help="of the batch (%(default)s)")
    args = parser.parse_args()
    pose = look_at(*LOOK)
    print(
        "| triangles | pixels | frames a core-second | wanted | with shadows | MuJoCo's rays | ratio |"
    )
    print("|---|---|---|---|---|---|---|")
    for (triangles, width, height), goal in GOALS.items():
        world = room(triangles)
        own = ours(world, pose, width, height, args.seconds)
        shady = ours(world, pose, width, height, args.seconds, shadows=True)
        rival = rays(world, pose, width, height, args.seconds)
        print(
            f"| {triangles:,} | {width} x {height} | {own:,.0f} | {goal:,.0f}, "
            f"{'yes' if own >= goal else 'NO'} | {shady:,.0f} | {rival:,.1f} | {own / rival:,.0f} |"
        )
    classic(args.seconds)
    print("\n| robots of Stage | pixels | frames a core-second |\n|---|---|---|")
    for robots, width, height in STAGE:
        own = stage(robots, width, height, args.seconds)
        print(f"| {robots} | {width} x {height} | {own:,.0f} |")
    made = batch(1024, args.steps, args.threads)
    print(
        f"\n1,024 worlds with an 84 x 84 camera, planar engine, {args.threads} threads: {made:,.0f} control "
        f"steps a second (wanted 5,000: {'yes' if made >= 5000.0 else 'NO'})"
    )


if __name__ == "__main__":
    main()
