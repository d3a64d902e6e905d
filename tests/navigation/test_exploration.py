"""Robots explore worlds that they do not know, by frontiers, and their maps are those of the world."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mapping_drives import SETTINGS
from touch_counter import Touches
from wall_errors import distances, drawn_walls, seen_walls

import gazelle
from gazelle.description import Pose
from gazelle.errors import Error, SimulationError
from gazelle.navigation.exploration import Explorer, ExploreSettings
from gazelle.navigation.frontiers import Frontier, find_frontiers
from gazelle.navigation.mapping import GmappingSettings, GridSlam
from gazelle.navigation.planners.planar import composed
from gazelle.navigation.true_map import true_map

FREE, WALL, UNKNOWN = 0, 254, 255
SIGNS = {".": FREE, "#": WALL, "?": UNKNOWN, "~": 40}


def grid(*rows):
    """Return costs of rows of signs, the highest one first."""
    return np.array([[SIGNS[sign] for sign in row] for row in rows[::-1]], np.uint8)


def cells(frontier):
    """Return columns and rows of a frontier on a grid of cells of 1 m at the origin."""
    return {tuple(each) for each in np.floor(frontier.points).astype(int).tolist()}


def test_a_frontier_is_what_is_unknown_beside_free_ground():
    costs = grid("????????", "?#....#?", "?#....??", "?######?", "????????")
    found = find_frontiers(costs, (0.0, 0.0), 1.0, (2.5, 2.5))
    assert sorted(map(len, map(cells, found))) == [1, 4]
    top = max(found, key=lambda each: each.size)
    assert cells(top) == {(2, 4), (3, 4), (4, 4), (5, 4)}
    assert top.centroid == (4.0, 4.5)
    assert top.distance == pytest.approx(2.0)
    assert [each.size for each in find_frontiers(costs, (0.0, 0.0), 1.0, (2.5, 2.5), 2.0)] == [4]


def test_what_cannot_be_reached_over_free_cells_is_no_frontier():
    costs = grid("..#..?", "..#..?", "..~..?")
    assert find_frontiers(costs, (0.0, 0.0), 1.0, (0.5, 0.5)) == []
    assert len(find_frontiers(costs, (0.0, 0.0), 1.0, (4.5, 0.5))) == 1


def test_a_robot_on_a_cell_that_is_not_free_begins_at_the_nearest_that_is():
    costs = grid("?....#", "?.~~.#")
    assert len(find_frontiers(costs, (0.0, 0.0), 1.0, (2.5, 0.5))) == 1
    assert find_frontiers(np.full((3, 3), UNKNOWN, np.uint8), (0.0, 0.0), 1.0, (1.0, 1.0)) == []
    assert find_frontiers(np.zeros((3, 3), np.uint8), (0.0, 0.0), 1.0, (1.0, 1.0)) == []


def flood(start, allowed, steps):
    """Return the cells that can be reached from one by steps over allowed ones."""
    found, waiting = {start}, [start]
    while waiting:
        row, column = waiting.pop()
        for down, right in steps:
            other = row + down, column + right
            if other in allowed and other not in found:
                found.add(other)
                waiting.append(other)
    return found


SIDES = [(0, 1), (0, -1), (1, 0), (-1, 0)]
AROUND = [(a, b) for a in (-1, 0, 1) for b in (-1, 0, 1) if (a, b) != (0, 0)]


@pytest.mark.long
@given(st.integers(0, 2**32 - 1), st.integers(3, 14), st.integers(3, 14))
def test_frontiers_are_those_of_a_plain_search(seed, rows, columns):
    random = np.random.default_rng(seed)
    costs = random.choice([FREE, FREE, UNKNOWN, WALL], (rows, columns)).astype(np.uint8)
    start = int(random.integers(rows)), int(random.integers(columns))
    costs[start] = FREE
    free = {tuple(each) for each in np.argwhere(costs == FREE).tolist()}
    unknown = {tuple(each) for each in np.argwhere(costs == UNKNOWN).tolist()}
    edge = {(r, c) for r, c in unknown if any((r + a, c + b) in free for a, b in SIDES)}
    reached = flood(start, free, SIDES)
    wanted = {
        frozenset((c, r) for r, c in flood((r, c), edge, AROUND))
        for r, c in edge
        if any((r + a, c + b) in reached for a, b in SIDES)
    }
    found = find_frontiers(costs, (0.0, 0.0), 1.0, (start[1] + 0.5, start[0] + 0.5))
    assert {frozenset(cells(each)) for each in found} == wanted
    assert len(found) == len(wanted)


# Decisions --------------------------------------------------------------------------------


def frontier(x, y, size=10, distance=1.0):
    return Frontier(np.zeros((size, 2)), (x, y), distance)


def test_the_frontier_that_is_worth_most_is_next():
    explorer = Explorer(ExploreSettings(potential_scale=1.0, gain_scale=0.1), 0.05)
    near, far, long = frontier(1, 0), frontier(9, 0, distance=9.0), frontier(5, 0, 80, 5.0)
    assert explorer.decide(0.0, [far, long, near]).place == long.centroid
    greedy = Explorer(ExploreSettings(potential_scale=1.0, gain_scale=0.0), 0.05)
    assert greedy.decide(0.0, [far, long, near]).place == near.centroid
    assert greedy.decide(0.0, []).place is None


def test_a_goal_is_new_once():
    explorer = Explorer(ExploreSettings(), 0.05)
    assert explorer.decide(0.0, [frontier(1, 0)]).fresh
    assert not explorer.decide(1.0, [frontier(1, 0)]).fresh
    assert explorer.decide(2.0, [frontier(2, 0)]).fresh


def test_one_that_comes_no_nearer_is_given_up():
    explorer = Explorer(ExploreSettings(progress_timeout=5.0), 0.05)
    both = [frontier(1, 0, 50, 3.0), frontier(2, 0, 10)]
    assert explorer.decide(0.0, both).place == (1, 0)
    nearer = [frontier(1, 0, 50, 2.0), both[1]]
    assert explorer.decide(4.0, nearer).place == (1, 0)
    assert explorer.decide(8.0, nearer).place == (1, 0)
    assert explorer.decide(9.5, nearer).place == (2, 0)
    assert explorer.given_up == [(1, 0)]
    assert explorer.decide(9.6, [frontier(1.2, 0.2), frontier(1.3, 0.0)]).place == (1.3, 0.0)
    explorer.give_up((1.3, 0.0))
    assert explorer.decide(9.7, [frontier(1.2, 0.2)]).place is None


@pytest.mark.parametrize("wrong", [{"planner_frequency": 0.0}, {"gain_scale": "much"}])
def test_wrong_settings_are_refused(wrong):
    with pytest.raises(Error):
        ExploreSettings.read(wrong)


# Worlds -----------------------------------------------------------------------------------


def explored(world, model, start, *, engine="planar", seconds=600.0, settings=None):
    """Explore a world until nothing is left.

    Returns the true map, what a map of the same scans from true poses has, the map, how often the robot
    ran into something, and the time.
    """
    ideal = GridSlam(GmappingSettings.read({**SETTINGS, "particles": 1}))
    with gazelle.Simulation(world, engine=engine, seed=0) as sim:
        robot = sim.spawn(f"turtlebot3_{model}", pose=Pose(*start))
        touches = Touches(sim, robot.name)
        robot.navigation.configure(localization="slam")
        task, stamp = robot.navigation.explore(settings), -1
        while not task.done and sim.time < seconds:
            sim.run(seconds=0.1)
            if engine == "mujoco":
                touches.look()
            scan = robot.sensors["lds_lfcd_sensor"].read()
            if scan.stamp == stamp:
                continue
            stamp = scan.stamp
            ranges = np.array(scan.ranges, np.float64).reshape(-1)
            angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
            seen = np.isfinite(ranges) & (ranges < scan.range_max)
            beams = np.stack((np.cos(angles), np.sin(angles)), 1)[seen] * ranges[seen, None]
            laser = (-0.032 if model == "burger" else -0.064, 0.0, 0.0)
            eye = composed((robot.pose.x, robot.pose.y, robot.pose.yaw), laser)
            ideal._maps.register(0, np.array(eye), beams, SETTINGS["maxUrange"])
        assert (task.done, task.succeeded, task.text) == (True, True, "Exploration stopped.")
        return (
            true_map(sim.world, 0.18, margin=2.0), ideal.map(), robot.navigation.map(), touches.count,
            sim.time,
        )  # fmt: skip


def check(true, ideal, found, least):
    """Check for at most one cell of error on 95 % of wall cells, both ways."""
    walls = seen_walls(true, ideal)
    assert len(walls) > least
    assert np.mean(distances(walls, found) <= 1.0) >= 0.95
    assert np.mean(distances(drawn_walls(found), true) <= 1.0) >= 0.95


@pytest.mark.long
def test_turtlebot3_world_is_explored():
    true, ideal, found, _, seconds = explored("turtlebot3_world", "burger", (-2.0, -0.5))
    check(true, ideal, found, 400)
    # All that is free within its walls, and nothing else.
    assert (found.data == 0).sum() == pytest.approx(7938, rel=0.02)
    assert seconds < 120.0


def test_a_map_that_is_made_is_not_given():
    with gazelle.Simulation("turtlebot3_world", engine="planar") as sim:
        robot = sim.spawn("turtlebot3_burger", pose=Pose(-2.0, -0.5))
        plan = true_map(sim.world, 0.18)
        with pytest.raises(SimulationError, match="takes no map"):
            robot.navigation.configure(grid=plan, localization="slam")
        robot.navigation.configure(localization="slam")
        assert robot.navigation.map() is None
        task = robot.navigation.explore()
        sim.run(seconds=2.0)
        assert not task.done
        assert (robot.navigation.map().data == 0).sum() > 500
        robot.navigation.cancel()
        sim.run(seconds=0.5)
        assert task.done
        assert not task.succeeded


@pytest.mark.slow
@pytest.mark.parametrize(
    ("world", "model", "start", "engine", "least"),
    [
        ("turtlebot3_world", "waffle", (-2.0, -0.5), "mujoco", 400),
        ("turtlebot3_world", "burger", (0.5, 1.75, 0.0, 0.0, 0.0, 2.0), "mujoco", 400),
        ("furnished_room", "burger", (-0.5, 0.0), "mujoco", 500),
    ],
)
def test_worlds_are_explored_without_touching_anything(world, model, start, engine, least):
    true, ideal, found, touches, seconds = explored(world, model, start, engine=engine)
    check(true, ideal, found, least)
    assert touches == 0
    assert math.isfinite(seconds)
