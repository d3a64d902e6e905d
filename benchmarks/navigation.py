"""Navigation: time of its laws, pace of the whole stack, and goals it reaches on TurtleBot3's stages.

Every time is processor time of the fastest of some calls. Beside each stands its goal. The last part is the
baseline that learned policies are compared with: the share of goals that DWA reaches in stages 1 to
4, with a planner that knows the walls, within the time that the task gives a policy.

    gazelle bench navigation [--stages] [--goals 20] [--robots 20]
"""

from __future__ import annotations

import argparse
import math
import time

import numpy as np
import yaml

import gazelle
from gazelle import assets
from gazelle.description import Pose
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import SimulationError
from gazelle.navigation.costmap import Costmap, InflationLayer, ObstacleLayer, footprint_of
from gazelle.navigation.costmap.obstacle_layer import ObservationSource
from gazelle.navigation.localization import AmclSettings, Localizer, PlanarScan
from gazelle.navigation.localization.scan_likelihood import BeamModel
from gazelle.navigation.planners import NavfnPlanner
from gazelle.navigation.planners.rollout import TrajectoryRollout, steps_of
from gazelle.navigation.planners.wavefront import grid_distances
from gazelle.navigation.true_map import true_map
from gazelle.simulation.navigation import NavigationTask

ANGLES = np.radians(np.arange(0.0, 360.0, 2.0))
BURGER = footprint_of([[-0.105, -0.105], [-0.105, 0.105], [0.041, 0.105], [0.041, -0.105]])


def best(work, seconds: float = 1.0) -> float:
    """Return processor time of the fastest of some calls [s]."""
    times, end = [], time.thread_time() + seconds
    while not times or time.thread_time() < end:
        begin = time.thread_time()
        work()
        times.append(time.thread_time() - begin)
    return min(times)


def house(side: int = 384) -> OccupancyMap:
    """Return rooms with doors, the same every time."""
    random = np.random.default_rng(0)
    grid = np.zeros((side, side), np.int8)
    grid[[0, -1]] = grid[:, [0, -1]] = 100
    for at in range(96, side - 1, 96):
        for first in range(0, side, 96):
            door = first + int(random.integers(15, 65))
            grid[at : at + 3, first : first + 96] = grid[first : first + 96, at : at + 3] = 100
            grid[at : at + 3, door : door + 24] = grid[door : door + 24, at : at + 3] = 0
    return OccupancyMap(grid, 0.05, Pose())


def show(what: str, value: float, goal: float) -> None:
    """Print a line of the table."""
    print(f"{what:<62}{value:>10.2f} ms   goal {goal:g} ms")


def scan(grid: OccupancyMap, x: float, y: float) -> PlanarScan:
    """Return the scan of a laser of 180 beams at a place."""
    model = BeamModel((grid.data != 0).view(np.uint8), (0.0, 0.0), 0.05, np.ones(4), 0.2, 0.1)
    ranges = np.array([model.range_at(x, y, angle, 3.5) for angle in ANGLES])
    return PlanarScan(np.where(ranges >= 3.5, np.inf, ranges), ANGLES, 3.5, 0.12, (0.0, 0.0, 0.0))


def measure_amcl(grid: OccupancyMap) -> None:
    """Measure 3,000 particles by 180 beams: motion, weighing, resampling, clusters."""
    settings = AmclSettings(
        min_particles=3000, max_particles=3000, resample_interval=1, laser_max_beams=180
    )
    localizer, seen = Localizer(settings, grid), scan(grid, 2.0, 2.0)
    localizer.begin((2.0, 2.0, 0.0), np.diag([0.05, 0.05, 0.02]))
    odom = [0.0]

    def update() -> None:
        odom[0] += 0.01
        localizer.force_update()
        localizer.update((odom[0], 0.0, 0.0), seen)

    show("amcl, 3,000 particles x 180 beams, one update", 1e3 * best(update), 1.0)


def measure_dwa() -> None:
    """Measure 800 commands for 1.5 s with a footprint of four corners."""
    costs = np.zeros((60, 60), np.uint8)
    costs[40:45, 30:40] = 254
    path = grid_distances(costs, np.array([[59, 30], [50, 30]]))
    forward, turn = np.meshgrid(np.linspace(0, 0.22, 20), np.linspace(-2.75, 2.75, 40))
    commands = np.stack((forward.ravel(), 0.0 * forward.ravel(), turn.ravel()), axis=1)
    steps = steps_of(commands, 1.5, 0.025, 0.1)
    weights = np.array([1.6, 1.0, 1.0, 1.6, 0.02, 0.0])

    def judge() -> None:
        rollout = TrajectoryRollout(
            costs, (0.0, 0.0), 0.05, BURGER, np.stack([path] * 4), weights, 0.325
        )
        rollout.judge(np.array([1.5, 1.5, 0.3]), np.zeros(3), commands, steps, 1.5)

    show("DWA, 800 trajectories", 1e3 * best(judge), 1.0)


def measure_plans(grid: OccupancyMap) -> None:
    """Measure plans from corner to corner, and across one room."""
    from gazelle.navigation.costmap import StaticLayer

    static = StaticLayer()
    costmap = Costmap([static, InflationLayer(radius=1.0, scaling=3.0)], BURGER)
    static.set_map(grid, costmap)
    costmap.update((2.0, 2.0, 0.0))
    planner = NavfnPlanner("navfn", costmap, {})
    for what, goal in (
        ("corner to corner", (17.0, 17.0, 0.0)),
        ("to the next room", (7.0, 2.0, 0.0)),
    ):
        plan = planner.make_plan((2.0, 2.0, 0.0), goal)
        work = lambda goal=goal: planner.make_plan((2.0, 2.0, 0.0), goal)  # noqa: E731
        show(f"navfn, 384 x 384 cells, {what} ({len(plan)} poses)", 1e3 * best(work), 3.0)


def measure_costmap(grid: OccupancyMap) -> None:
    """Measure a rolling costmap of 60 x 60 cells with 180 beams."""
    source = ObservationSource(clearing=True, obstacle_range=3.0, raytrace_range=3.5)
    layer = ObstacleLayer("obstacle_layer", {"scan": source})
    costmap = Costmap(
        [layer, InflationLayer(radius=1.0, scaling=3.0)], BURGER, width=3, height=3, rolling=True
    )
    seen = scan(grid, 2.0, 2.0)
    good = np.isfinite(seen.ranges)
    ends = seen.ranges[good]
    points = np.stack(
        (2.0 + ends * np.cos(ANGLES[good]), 2.0 + ends * np.sin(ANGLES[good]), 0 * ends), 1
    )

    def update() -> None:
        layer.observe("scan", 0.0, np.array([2.0, 2.0, 0.0]), points)
        costmap.update((2.0, 2.0, 0.0))

    show("local costmap, 60 x 60 cells, one scan", 1e3 * best(update), 0.3)


def measure_stack(robots: int) -> None:
    """Measure the stack in turtlebot3_world, with amcl; many robots, each with its own."""
    places = [
        (-2.0, -0.5),
        (-2.0, 0.5),
        (-1.6, 0.0),
        (-0.5, -1.75),
        (0.5, -1.75),
        (0.5, 1.75),
        (-0.5, 1.75),
    ]
    for count in (1, robots):
        with gazelle.Simulation("turtlebot3_world", engine="planar", seed=0) as sim:
            tasks = []
            for number in range(count):
                x, y = places[number % len(places)]
                robot = sim.spawn(
                    "turtlebot3_burger",
                    name=f"r{number}",
                    namespace=f"/r{number}",
                    pose=Pose(x + 0.02 * (number // len(places)), y, yaw=0.3 * number),
                )
                robot.navigation.configure(localization="amcl")
                tasks.append(robot.navigation.go_to(0.55, 0.55 if number % 2 else -0.55))
            what = f"whole stack, {count} robot{'s' * (count > 1)}"
            pace(what, sim, tasks, 30.0 if count == 1 else 1.0)


def measure_fleet(robots: int) -> None:
    """Measure the stack in the Stage world ``fleet``, with amcl, for some of its AGVs."""
    config = assets.root() / "fleet_stage" / "config"
    read = {
        name: yaml.safe_load((config / f"{name}.yaml").read_text())
        for name in ("move_base", "amcl", "scanner")
    }
    values = {**read["move_base"], "amcl": read["amcl"]}
    for name in ("global_costmap", "local_costmap"):
        values[name] = {**values[name], "obstacle_layer": read["scanner"]}
    with gazelle.Simulation("fleet", engine="planar", seed=0) as sim:
        tasks = []
        for number in range(robots):
            robot = sim.robots[f"agv_{number}"]
            robot.navigation.configure(values, localization="amcl")
            tasks.append(robot.navigation.go_to(robot.pose.x + 1.5, robot.pose.y + 1.5))
        pace(f"whole stack, {robots} AGVs of a Stage world", sim, tasks, 1.0)


def pace(what: str, sim: gazelle.Simulation, tasks: list[NavigationTask], goal: float) -> None:
    """Run until all are at their goals, 10 s at most, and print how fast that was."""
    wall, begin = time.perf_counter(), time.process_time()
    while sim.time < 10.0 and not all(task.done for task in tasks):
        sim.run(seconds=0.5)
    used, wall = time.process_time() - begin, time.perf_counter() - wall
    print(
        f"{what}: {sim.time / used:.1f} times real time "
        f"of processor, {sim.time / wall:.1f} of the wall; goal {goal:g}"
    )


def measure_stages(goals: int) -> None:
    """Share of goals that the stack reaches in the stages, one after another, with truth for the place."""
    for stage in range(1, 5):
        reached = tried = 0
        random = np.random.default_rng(stage)
        with gazelle.Simulation(f"turtlebot3_stage_{stage}", engine="planar", seed=stage) as sim:
            robot = sim.spawn("turtlebot3_burger")
            try:
                grid = true_map(sim.world, 0.15)
            except SimulationError:
                grid = true_map(sim.world, 0.15, area=(-2.5, -2.5, 2.5, 2.5))
            robot.navigation.configure(grid=grid)
            while tried < goals:
                x, y = random.uniform(-1.7, 1.7, 2).tolist()
                here = robot.pose
                if math.dist((x, y), (here.x, here.y)) < 0.5 or not is_free(grid, x, y):
                    continue
                tried += 1
                reached += robot.navigation.go_to(x, y).wait(100.0)
        print(f"stage {stage}: {reached} of {tried} goals reached")


def is_free(grid: OccupancyMap, x: float, y: float) -> bool:
    """Return whether there is room for a burger."""
    column = int((x - grid.origin.x) / grid.resolution)
    row = int((y - grid.origin.y) / grid.resolution)
    return not grid.data[max(row - 5, 0) : row + 6, max(column - 5, 0) : column + 6].any()


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="gazelle bench navigation", description=__doc__)
    parser.add_argument("--stages", action="store_true", help="the stages, too (minutes)")
    parser.add_argument("--goals", type=int, default=20, help="in each stage")
    parser.add_argument("--robots", type=int, default=20)
    options = parser.parse_args()
    grid = house()
    measure_amcl(grid)
    measure_dwa()
    measure_plans(grid)
    measure_costmap(grid)
    measure_stack(options.robots)
    measure_fleet(min(options.robots, 72))
    if options.stages:
        measure_stages(options.goals)


if __name__ == "__main__":
    main()
