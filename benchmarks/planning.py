"""Plans of Fetch's arm among obstacles: how many are found within a second, and the time they take.

From one state that is free to another, both drawn, between a table with two things on it and a shelf.
Each is planned, shortened and given times; then every trajectory is checked for collisions at a tenth of
the planner's resolution, and for limits. Times are of the processor, so that others who work beside
do not count.

    gazelle bench planning
"""

from __future__ import annotations

import argparse
import time

import numpy as np

from gazelle import assets
from gazelle.array_types import Floats
from gazelle.description import Box, Cylinder, Pose
from gazelle.formats import load_model, load_srdf
from gazelle.kinematics import JointModelGroup, RobotModel
from gazelle.planning import (
    MotionPlanner,
    NoPlanError,
    PlanningScene,
    PlanOptions,
    ompl_planners,
)
from gazelle.planning.state_validity import StateValidity


def kitchen() -> tuple[PlanningScene, JointModelGroup]:
    """Return the scene, and the arm."""
    root = assets.root()
    robot = RobotModel(
        load_model(root / "fetch_description" / "robots" / "fetch.urdf"),
        load_srdf(root / "fetch_moveit_config" / "config" / "fetch.srdf"),
    )
    scene = PlanningScene(robot)
    scene.add("table", Box((0.6, 1.4, 0.05)), Pose(0.85, 0.0, 0.55))
    scene.add("box", Box((0.15, 0.15, 0.35)), Pose(0.75, 0.1, 0.75))
    scene.add("can", Cylinder(0.08, 0.4), Pose(0.65, -0.35, 0.78))
    scene.add("shelf", Box((0.4, 1.2, 0.04)), Pose(0.9, 0.0, 1.25))
    return scene, robot.group("arm")


def queries(
    scene: PlanningScene, group: JointModelGroup, count: int
) -> list[tuple[Floats, Floats]]:
    """Return pairs of positions that are free."""
    valid, random = StateValidity(scene, group, scene.state), np.random.default_rng(0)
    found: list[Floats] = []
    while len(found) < 2 * count:
        drawn = group.sample(random, 1)[0]
        if valid(drawn):
            found.append(drawn)
    return list(zip(found[::2], found[1::2], strict=True))


def measure(count: int, *, use_ompl: bool) -> str:
    """Return one line of the table."""
    scene, group = kitchen()
    spent, bad, late = [], 0, 0
    for number, (first, second) in enumerate(queries(scene, group, count)):
        start = scene.state.copy()
        start[group.columns] = first
        options = PlanOptions(seed=number, use_ompl=use_ompl, time=10.0)
        begun = time.process_time()
        try:
            plan = MotionPlanner(scene, group, options).plan(second, start=start)
        except NoPlanError:
            late += 1
            continue
        spent.append(time.process_time() - begun)
        late += spent[-1] > 1.0
        fine, timed = StateValidity(scene, group, start), plan.trajectory
        free = fine.path(timed.positions, fine.resolution / 10.0)
        within = (np.abs(timed.velocities) <= group.max_velocity * (1 + 1e-9)).all()
        bad += not (free and within)
    median, ninetieth, most = np.percentile(spent, [50, 90, 100]) * 1e3
    return f"{count - late:>9}{median:>11.1f}{ninetieth:>9.1f}{most:>9.1f}{bad:>9}"


def main() -> None:
    """Measure with each planner."""
    parser = argparse.ArgumentParser(prog="gazelle bench planning", description=__doc__)
    parser.add_argument("--queries", type=int, default=100)
    args = parser.parse_args()
    print(f"{args.queries} queries; ms of processor time to plan, shorten and time")
    print(f"{'planner':22}{'in 1 s':>9}{'median':>11}{'90 %':>9}{'most':>9}{'unsound':>9}")
    print(f"{'RRT-Connect, own':22}{measure(args.queries, use_ompl=False)}")
    if ompl_planners.is_installed():
        print(f"{'RRTConnect of OMPL':22}{measure(args.queries, use_ompl=True)}")


if __name__ == "__main__":
    main()
