"""A car among walls, driven by a local planner in a closed loop; and the rooms it drives in."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass

import numpy as np

from gazelle.description import Pose
from gazelle.description.occupancy import OccupancyMap
from gazelle.navigation.costmap import Costmap, InflationLayer, StaticLayer, footprint_of
from gazelle.navigation.costmap.footprint import placed
from gazelle.navigation.planners import NavfnPlanner
from gazelle.navigation.planners.teb import TebPlanner

OUTLINE = [[-0.1, -0.125], [0.5, -0.125], [0.5, 0.125], [-0.1, 0.125]]
"""Of the car [m]; its rear axle is the origin, its wheelbase 0.4 m, its least radius 0.5 m."""

CAR = {
    "max_global_plan_lookahead_dist": 3.0, "allow_init_with_backwards_motion": True,
    "max_vel_x": 0.4, "max_vel_x_backwards": 0.2, "max_vel_theta": 0.8, "acc_lim_x": 0.5,
    "acc_lim_theta": 0.8, "min_turning_radius": 0.5, "wheelbase": 0.4,
    "footprint_model": {"type": "line", "line_start": [0.0, 0.0], "line_end": [0.4, 0.0]},
    "xy_goal_tolerance": 0.1, "yaw_goal_tolerance": 0.1, "min_obstacle_dist": 0.22,
    "inflation_dist": 0.4, "weight_obstacle": 100.0, "weight_inflation": 0.2,
    "weight_kinematics_turning_radius": 1.0,
}  # fmt: skip

Wall = tuple[float, float, float, float]


@dataclass(frozen=True)
class Room:
    """A room of 6 m by 6 m.

    Attributes:
        name: Of the room.
        walls: Inner walls: two corners each.
        start: Of the car.
        goal: Of the car.
    """

    name: str
    walls: tuple[Wall, ...]
    start: tuple[float, float, float]
    goal: tuple[float, float, float]


ROOMS = (
    Room("open", (), (1.0, 1.0, 0.0), (4.5, 4.0, 1.0)),
    Room("turned around", (), (2.0, 2.0, 0.0), (2.0, 3.5, 3.1)),
    Room("door of 0.6 m", ((2.9, 0.0, 3.1, 2.7), (2.9, 3.3, 3.1, 6.0)), (1.0, 1.5, 0.0), (5.0, 4.5, 0.0)),
    Room("corridor of 0.7 m with a bend", ((1.0, 2.0, 3.3, 6.0), (1.0, 0.0, 6.0, 1.3), (4.0, 1.3, 6.0, 6.0)),
         (0.4, 1.65, 0.0), (3.65, 5.0, 1.57)),
    Room("parallel parking, gap of 1.2 m", ((0.0, 1.0, 2.0, 1.4), (3.2, 1.0, 6.0, 1.4), (0.0, 0.6, 6.0, 1.0)),
         (3.4, 1.8, 0.0), (2.3, 1.25, 0.0)),
    Room("parking backwards, box of 0.5 m", ((0.0, 1.0, 2.6, 2.0), (3.1, 1.0, 6.0, 2.0)),
         (2.0, 2.6, 0.0), (2.85, 1.3, 1.571)),
    Room("parking forwards, box of 0.5 m", ((0.0, 1.0, 2.6, 2.0), (3.1, 1.0, 6.0, 2.0)),
         (1.2, 3.2, 0.0), (2.85, 1.75, -1.571)),
)  # fmt: skip


@dataclass(frozen=True)
class CarDrive:
    """Result of a drive.

    Attributes:
        reached: Whether the car stands at the goal.
        seconds: It took, of simulated time.
        clearance: Least distance of the outline to a wall; 0 if it ran into one [m].
        turns: Changes of direction.
        cycle: Mean time of a control cycle [s].
        failures: Cycles without a command.
    """

    reached: bool
    seconds: float
    clearance: float
    turns: int
    cycle: float
    failures: int


def costmaps(room):
    """Return the map, the global and the local costmap."""
    grid = np.zeros((120, 120), np.int8)
    grid[[0, -1]] = grid[:, [0, -1]] = 100
    for x0, y0, x1, y1 in room.walls:
        grid[round(y0 * 20) : round(y1 * 20), round(x0 * 20) : round(x1 * 20)] = 100
    found = []
    for rolling in (False, True):
        static, inflation = StaticLayer(), InflationLayer(radius=0.5, scaling=10.0)
        layers = [static] if rolling else [static, inflation]
        costmap = Costmap(
            layers, footprint_of(OUTLINE, padding=0.0), width=5, height=5, rolling=rolling
        )
        static.set_map(OccupancyMap(grid, 0.05, Pose()), costmap)
        costmap.update(room.start)
        found.append(costmap)
    return grid, *found


def drive(room, values=None, seconds=90.0, period=0.2):
    """Drive a car that accelerates at 0.5 m/s², and steers at 1 rad/s, to a goal."""
    grid, whole, local = costmaps(room)
    rows, columns = np.nonzero(grid)
    walls = np.stack((columns + 0.5, rows + 0.5), axis=1) * 0.05
    planner = TebPlanner("teb", local, {**CAR, **(values or {})}, period)
    navfn = NavfnPlanner("navfn", whole, {})
    pose, speed, steering = room.start, 0.0, 0.0
    clearance, turns, failures, spent, ahead = math.inf, 0, 0, [], 0.0
    for cycle in range(round(seconds / period)):
        local.update(pose)
        if cycle % 5 == 0:
            plan = navfn.make_plan(pose, room.goal)
            planner.set_plan(plan)
        velocity = (speed, 0.0, speed * math.tan(steering) / 0.4)
        if planner.goal_reached(pose, velocity, (0.0, 0.0, 0.0)):
            return CarDrive(True, cycle * period, clearance, turns, float(np.mean(spent)), failures)
        begun = time.perf_counter()
        command = planner.command(pose, velocity, (0.0, 0.0, 0.0))
        spent.append(time.perf_counter() - begun)
        failures += command is None
        wanted, _, turning = command or (0.0, 0.0, 0.0)
        if abs(wanted) > 1e-3:
            angle = math.atan(0.4 * turning / wanted)
            if ahead * wanted < 0.0:
                turns += 1
            ahead = wanted
        else:
            angle = steering
        for _ in range(round(period / 0.01)):
            speed += max(-0.005, min(wanted - speed, 0.005))
            steering += max(-0.01, min(angle - steering, 0.01))
            x, y, heading = pose
            pose = (
                x + 0.01 * speed * math.cos(heading),
                y + 0.01 * speed * math.sin(heading),
                heading + 0.01 * speed * math.tan(steering) / 0.4,
            )
        clearance = min(clearance, _clearance(pose, walls))
    return CarDrive(False, seconds, clearance, turns, float(np.mean(spent)), failures)


def _clearance(pose, walls):
    """Return the distance of the outline to cells of walls [m]."""
    corners = placed(np.array(OUTLINE), *pose)
    middle, half = corners.mean(axis=0), np.array([0.3, 0.125])
    away = walls - middle
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    beside = np.abs(np.stack((away @ (cos, sin), away @ (-sin, cos)), axis=1)) - half
    apart = np.hypot(*np.maximum(beside, 0.0).T) - 0.025
    return max(0.0, float(apart.min()))
