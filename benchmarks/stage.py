"""Robot updates a second of the planar engine, beside those of Stage 4.3.

Robots of 0.26 m roam an office of 8 m rooms at 0.4 m/s in steps of 100 ms, turn away from what
their rangers see, and back off where they stall. Stage's figures were measured on two virtual
processors of an AMD EPYC (Zen 5), in the same kind of world; where Stage runs beside Gazelle,
those of this run count. Rates are a second of processor time, so that other work on the machine
counts little. The last table says which goals are reached.
"""

from __future__ import annotations

import argparse
import math
import os
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from _goals import Goals

from gazelle.engines.planar import Body, Drive, Fan, Fleet, Mount, PlanarPart, Scanner
from gazelle.engines.planar.roaming import Roaming

SENSORS = {
    "none": None,
    "kinect 640 x 58°": Fan.spread(math.radians(58.0), 640, 6.5),
    "laser 180 x 180°": Fan.spread(math.pi, 180, 8.0),
}

# Robots, side of the world [m], steps without and with sensors, and robot updates a second of
# Stage 4.3 with each sensor; it could not load 100,000 robots in 24 GB.
SIZES = (
    (1, 40.0, 40_000, 8_000, (79_000, 7_110, 16_600)),
    (72, 40.0, 2_000, 300, (135_000, 4_970, 8_600)),
    (100, 40.0 / math.sqrt(10.0), 2_000, 200, (125_000, 5_200, 7_100)),
    (1_000, 40.0, 300, 30, (98_000, 3_200, 4_700)),
    (10_000, 128.0, 30, 4, (67_000, 2_900, 3_700)),
    (100_000, 405.0, 4, 1, None),
)
RIVALS = 1_000  # robots up to which Stage itself runs, unless it is asked for alone
BATCHES = (64, 1024, 4096)
PARTS = ("rival", "fleets", "growth", "batches", "worlds", "reads", "graph")


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(prog="gazelle bench stage", description=__doc__)
    parser.add_argument("--threads", type=int, default=1, help="default 1")
    parser.add_argument("--largest", type=int, default=10_000, help="most robots (10000)")
    parser.add_argument("--windows", type=int, default=2, help="of which the best (default 2)")
    parser.add_argument("--worlds", type=Path, help="a folder with Stage's own worlds")
    parser.add_argument("--stage", type=Path, help="the program of Stage, else the one on PATH")
    parser.add_argument("--only", choices=PARTS, help="a part of it alone")
    args = parser.parse_args()
    goals = Goals()
    print(f"{os.cpu_count()} processors, {args.threads} used, best of {args.windows} windows")
    if args.only in {None, "rival"}:
        rival(args, goals)
    if args.only in {None, "fleets"}:
        fleets(args, goals)
    if args.only in {None, "growth"}:
        import _stage_growth

        _stage_growth.growth(SENSORS, args.largest, args.threads, goals)
    if args.only in {None, "batches"}:
        batches(args, goals)
    files(args, goals)
    goals.show()


def files(args: argparse.Namespace, goals: Goals) -> None:
    """Measure Stage files: stepped and scanned, read robot by robot, and on a ROS graph."""
    if args.only in {None, "worlds"}:
        import _stage_worlds

        _stage_worlds.worlds(args.threads, args.worlds, goals)
    if args.only in {None, "reads"}:
        import _stage_reads

        _stage_reads.reads(args.threads, goals)
    if args.only in {None, "graph"}:
        import _stage_worlds

        _stage_worlds.graph(goals)


def rival(args: argparse.Namespace, goals: Goals) -> None:
    """Measure Stage itself, if it is installed."""
    import _stage_itself
    import _stage_rival

    try:
        stage = _stage_itself.find(args.stage)
    except _stage_itself.StageError as error:
        raise SystemExit(str(error)) from None
    if stage is None:
        print(_stage_rival.ABSENT)
    else:
        largest = args.largest if args.only == "rival" else min(args.largest, RIVALS)
        _stage_rival.rival(stage, largest, args.threads, goals)


def fleets(args: argparse.Namespace, goals: Goals) -> None:
    """Measure robots in an office."""
    print(
        f"\n{'robots':>8}  {'sensor':<17}{'updates/s':>12}{'Mrays/s':>9}{'Stage 4.3':>11}{'times':>7}"
    )
    ratios, rates = [], {}
    for count, side, blind, seeing, stage in SIZES:
        if count > args.largest:
            continue
        for column, (name, fan) in enumerate(SENSORS.items()):
            began = time.process_time()
            roaming = roam(count, side, fan, args.threads)
            loaded = time.process_time() - began
            steps = blind if fan is None else seeing
            rate = count * steps / best(lambda r=roaming, n=steps: r.run(n), args.windows)
            rays = 0.0 if fan is None else rate * fan.count / 1e6
            beside, rates[count, name] = f"{'-':>11}{'-':>7}", rate
            theirs = None if stage is None else stage[column]
            theirs = goals.stage.get((count, name.split()[0]), theirs)
            if theirs is not None:
                ratios.append(rate / theirs)
                beside = f"{theirs:>11,.0f}{ratios[-1]:>7.0f}"
            print(f"{count:>8,}  {name:<17}{rate:>12,.0f}{rays:>9.1f}{beside}", flush=True)
            if fan is None:
                size = memory(roaming.fleet) / count
                print(f"{'':>10}loaded in {loaded:.2f} s, {size:.0f} bytes a robot")
    goals.least("times Stage at all sizes, the least", min(ratios), 10.0)
    for name in SENSORS:
        costs = [1.0 / rate for (count, own), rate in rates.items() if own == name and count >= 100]
        if len(costs) > 1:
            print(f"cost a robot from 100 up, {name}: {max(costs) / min(costs):.2f} times")


def roam(count: int, side: float, fan: Fan | None, threads: int) -> Roaming:
    """Return robots spread over an office, roaming."""
    from _stage_office import office, places, roamers

    across = math.ceil(math.sqrt(count))
    return roamers(places(count, across, side / across), office(side), fan, threads, seed=1)


def memory(fleet: Fleet) -> int:
    """Return bytes of all arrays of a fleet."""
    return sum(v.nbytes for v in vars(fleet).values() if isinstance(v, np.ndarray))


def batches(args: argparse.Namespace, goals: Goals) -> None:
    """Measure many worlds of one robot among 12 walls and 4 pillars, step and scan."""
    print(
        f"\n{'worlds':>8}{'beams':>7}{'robot steps/s':>15}{'ns a step':>11}{'ns a scan':>11}{'worst beam':>14}"
    )
    rng = np.random.default_rng(0)
    walls, pillars = clutter(rng)
    statics = [PlanarPart((tuple(w[:2]), tuple(w[2:])), closed=False) for w in walls]
    statics += [PlanarPart.circle(*pillar) for pillar in pillars]
    worst = 0.0
    for beams, wanted in ((24, 2e6), (360, 2e5)):
        slowest = math.inf
        for nworld in BATCHES:
            body = Body((PlanarPart.circle(0.0, 0.0, 0.105),), drive=Drive())
            fleet = Fleet([body], statics, nworld=nworld, threads=args.threads)
            fleet.place(
                0, np.column_stack((rng.uniform(-2, 2, (nworld, 2)), rng.uniform(-3, 3, nworld)))
            )
            step = 2.0 * math.pi / beams
            scanner = Scanner(fleet, Fan(-math.pi, step, beams, 3.5), [Mount(0)])
            fleet.command[:, 0] = np.column_stack(
                (np.full(nworld, 0.2), np.zeros(nworld), rng.uniform(-1, 1, nworld))
            )
            repeats = max(2, 100_000 // nworld)
            moving = best(lambda f=fleet, n=repeats: [f.step() for _ in range(n)], args.windows)
            seeing = best(lambda s=scanner, n=repeats: [s.scan() for _ in range(n)], args.windows)
            total = nworld * repeats
            error = np.abs(scanner.scan()[:, 0] - exact(fleet, scanner.fan, walls, pillars)).max()
            worst, slowest = max(worst, error), min(slowest, total / (moving + seeing))
            print(
                f"{nworld:>8,}{beams:>7}{total / (moving + seeing):>15,.0f}"
                f"{1e9 * moving / total:>11.0f}{1e9 * seeing / total:>11.0f}{error:>12.1e} m",
                flush=True,
            )
        goals.least(f"robot steps/s with {beams} beams", slowest, wanted)
    goals.most("error of a beam [m]", worst, 1e-5)


def clutter(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Return 12 walls (x0, y0, x1, y1), 4 around the others, and 4 pillars (x, y, radius)."""
    corners = np.array([(-2.2, -2.2), (2.2, -2.2), (2.2, 2.2), (-2.2, 2.2)])
    room = np.hstack((corners, np.roll(corners, -1, axis=0)))
    start, angle = rng.uniform(-1.8, 1.8, (8, 2)), rng.uniform(0, 6.28, 8)
    inner = np.hstack((start, start + 0.8 * np.column_stack((np.cos(angle), np.sin(angle)))))
    return np.vstack((room, inner)), np.hstack(
        (rng.uniform(-1.8, 1.8, (4, 2)), np.full((4, 1), 0.15))
    )


def exact(fleet: Fleet, fan: Fan, walls: np.ndarray, pillars: np.ndarray) -> np.ndarray:
    """Return every beam against every wall and pillar in closed form, shape (nworld, beams)."""
    pose = fleet.pose[:, 0]
    angles = pose[:, 2:] + fan.angles
    dx, dy = np.cos(angles), np.sin(angles)
    nearest = np.full(dx.shape, fan.reach)
    for x0, y0, x1, y1 in walls:
        ax, ay, ex, ey = x0 - pose[:, :1], y0 - pose[:, 1:2], x1 - x0, y1 - y0
        along = (ax * ey - ay * ex) / (dx * ey - dy * ex)
        share = (ax * dy - ay * dx) / (dx * ey - dy * ex)
        met = (along >= 0.0) & (share >= 0.0) & (share <= 1.0)
        nearest = np.where(met, np.minimum(nearest, along), nearest)
    for x, y, radius in pillars:
        ax, ay = x - pose[:, :1], y - pose[:, 1:2]
        along, aside = dx * ax + dy * ay, dx * ay - dy * ax
        root = np.sqrt(np.maximum(radius**2 - aside**2, 0.0))
        reach = np.where(ax**2 + ay**2 > radius**2, along - root, along + root)
        met = (np.abs(aside) <= radius) & (reach >= 0.0)
        nearest = np.where(met, np.minimum(nearest, reach), nearest)
    return nearest


def best(work: Callable[[], object], windows: int) -> float:
    """Return least processor time of some calls [s]."""
    work()
    times = []
    for _ in range(windows):
        began = time.process_time()
        work()
        times.append(time.process_time() - began)
    return min(times)


if __name__ == "__main__":
    main()
