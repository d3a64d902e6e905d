#!/usr/bin/env python3
"""Drive the 72 AGVs of the bundled world 'fleet' through way-points, and check that none collide.

gazelle exec fleet_stage drive_fleet.py             # starts the world in this process
gazelle run fleet --ros --rate 5                    # or it runs elsewhere, and
gazelle exec fleet_stage drive_fleet.py --connect   # this drives it over ROS 1
"""

import argparse
import contextlib
import sys
import threading
from collections.abc import Iterator

import numpy as np

from gazelle import Error
from gazelle.clients import AGVFleet
from gazelle.navigation import Limits
from gazelle_ros import Node, net

COUNT, PER_ROW, APART = 72, 12, 3.0


def main() -> None:
    """Drive every four neighbours around a ring, then all aside and back."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--connect", action="store_true", help="to a world that runs already")
    parser.add_argument("--rounds", type=int, default=4, help="changes of places (default 4)")
    parser.add_argument("--rate", type=float, default=8.0, help="speed of time (default 8)")
    words = [word for word in sys.argv[1:] if ":=" not in word]  # a launch file adds remappings
    args = parser.parse_args(words)
    with contextlib.ExitStack() as stack:
        uri = net.default_master_uri() if args.connect else stack.enter_context(world(args.rate))
        node = stack.enter_context(Node("drive_fleet", master_uri=uri, anonymous=True))
        fleet = stack.enter_context(
            AGVFleet(
                node, [f"/robot_{number}" for number in range(COUNT)], limits=Limits(linear=1.0)
            )
        )
        fleet.wait()
        drive(fleet, args.rounds)


def drive(fleet: AGVFleet, rounds: int) -> None:
    """Send waypoints to all, one after another."""
    home = fleet.poses[:, :2]
    total, nearest = 0.0, np.inf
    for number in range(rounds):
        goals = home + (ring(number + 1) - ring(0)) * APART
        total, nearest = leg(fleet, goals, f"round {number + 1}", total, nearest)
    here = fleet.poses[:, :2]
    for shift in ((2.0, 0.0), (2.0, 2.0), (0.0, 0.0)):
        total, nearest = leg(fleet, here + shift, f"shift to {shift}", total, nearest)
    print(f"done in {total:.1f} s of simulated time; nearest two AGVs: {nearest:.2f} m apart")


def leg(
    fleet: AGVFleet, goals: np.ndarray, name: str, total: float, nearest: float
) -> tuple[float, float]:
    """Send one waypoint to each, and return time and least distance of any two."""
    done = threading.Event()
    seen = [nearest]

    def watch() -> None:
        while not done.wait(0.02):
            x, y = fleet.poses[:, :2].T
            away = np.hypot(x[:, None] - x, y[:, None] - y) + np.diag(np.full(len(x), np.inf))
            seen.append(float(away.min()))

    watcher = threading.Thread(target=watch)
    watcher.start()
    try:
        way = goals - fleet.poses[:, :2]
        # All turn first, so that all set off together and none runs into a late one.
        took = fleet.move_ofsc(np.arctan2(way[:, 1], way[:, 0]), timeout=60.0).max()
        took = took + fleet.move_l(goals[:, 0], goals[:, 1], timeout=60.0)
    finally:
        done.set()
        watcher.join()
    print(f"{name}: {took.min():.1f} to {took.max():.1f} s")
    return total + float(took.max()), min(seen)


def ring(turn: int) -> np.ndarray:
    """Return the corner of its square of four neighbours that each AGV is at after some turns."""
    column, row = np.arange(COUNT) % PER_ROW % 2, np.arange(COUNT) // PER_ROW % 2
    corner = np.where(row == 0, column, 3 - column)  # counter-clockwise from the lower left
    corner = (corner + turn) % 4
    return np.stack(((corner == 1) | (corner == 2), corner >= 2), axis=1).astype(float)


@contextlib.contextmanager
def world(rate: float) -> Iterator[str]:
    """Run the bundled world on a graph of its own, in a thread; yields its master."""
    from gazelle import assets
    from gazelle.simulation import Simulation
    from gazelle.stage import stage_of
    from gazelle.stage.bridge import serve_stage
    from gazelle_ros import Master

    with Master(port=0) as master, Simulation(assets.world("fleet"), "planar") as simulation:
        stalls: set[int] = set()
        robots = stage_of(simulation)
        simulation.subscribe(lambda: stalls.update(np.flatnonzero(robots.stalled[0]).tolist()))
        with serve_stage(simulation, master.uri, rate=rate) as server:
            thread = threading.Thread(target=server.run, args=(1e9,))
            thread.start()
            try:
                yield master.uri
            finally:
                server.stop()
                thread.join()
    if stalls:
        raise SystemExit(f"AGVs that bumped into something on their way: {sorted(stalls)}")
    print("no AGV bumped into anything at any step")


if __name__ == "__main__":
    try:
        main()
    except Error as error:
        raise SystemExit(f"drive_fleet: {error}") from None
