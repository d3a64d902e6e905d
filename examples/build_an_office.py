"""Build an office, furnish it by hand, let a robot stand in it, take a picture, write a file.

    python examples/build_an_office.py --seed 3 --out /tmp/office

Writes ``office.world`` (for ``gazelle run``, or for Gazebo) and ``office.png``.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from PIL import Image

import gazelle
from gazelle.builders import (
    WorldBuilder,
    desk,
    door,
    office,
    office_chair,
    plant,
    random_obstacles,
    shelf,
    window,
)
from gazelle.formats import save
from gazelle.sensors import View, look_at

PLAN = """
    #################
    #     #         #
    # cd  #  cd  cd #
    #               #
    #     #         #
    #     #  cd  cd #
    #  p  #       p #
    ######## ########
"""


def small_office(seed: int) -> gazelle.World:
    """Return two rooms from a drawing; the letters are the places of furniture."""
    return (
        WorldBuilder("small_office", seed=seed)
        .ground()
        .sun()
        .plan(PLAN, {"d": desk, "c": office_chair, "p": plant}, cell=0.5)
        .obstacles(2, radius=(0.15, 0.2))
        .physics("real-time")
        .build()
    )


def one_room(seed: int) -> gazelle.World:
    """Return a room with a door and a window, a shelf at its wall, and boxes to drive around."""
    builder = WorldBuilder("one_room", seed=seed).ground().sun()
    builder.room(6.0, 4.0, openings=[door(0, 2.0), window(2, 3.0)])
    builder.place(shelf, -2.8, 0.0).place(desk, 2.2, 1.0)
    builder.add(*random_obstacles(3, seed=seed, keep_clear=builder.taken, gap=0.4))
    return builder.build()


def main() -> None:
    """Build all three, and show the large one."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, default=Path())
    parser.add_argument("--width", type=int, default=640, help="of the picture, in pixels")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)

    for world in (small_office(args.seed), one_room(args.seed)):
        save(world, args.out / f"{world.name}.world")

    world = office(seed=args.seed, movable=True)
    save(world, args.out / "office.world")
    with gazelle.Simulation(args.out / "office.world") as sim:
        robot = sim.spawn("turtlebot3_burger", name="robot")
        sim.run(seconds=1.0)
        view = View(look_at((-5.0, -10.0, 8.5), (0.2, 0.0, 0.3)), args.width, args.width * 3 // 4)
        Image.fromarray(sim.render(view)).save(args.out / "office.png")
        print(f"{len(world.models)} models; after {sim.time:.1f} s the robot is at {robot.pose}")


if __name__ == "__main__":
    main()
