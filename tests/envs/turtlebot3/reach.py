"""Goals that a robot can reach in time among walls and moving obstacles: a search by layers.

The robot is the published one: every two control steps it chooses one of five arcs at 0.15 m/s,
so it waits by going in circles. A layer holds one robot for each cell of place and heading that
some sequence of actions leads to without a scan below the collision range.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle import Simulation, formats
from gazelle.description import Box, Cylinder

PERIOD = 0.2
SPEED = 0.15
HOLD = 2  # control steps with the same action
TURNS = (1.5, 0.75, 0.0, -0.75, -1.5)
CLEAR = 0.13 + 0.005  # of the lidar, whichever way its rays point [m]
LIDAR = -0.032  # where it is ahead of the robot's middle [m]
ARRIVED = 0.19  # rounds to less than 0.2 [m]
CELL = 0.1
HEADINGS = 16
FINE = 0.01  # of the map of what stands still [m]


def obstacle_paths(world, steps):
    """Return middles and radii [m] of moving cylinders at control steps: (steps, n, 2), (n,)."""
    with Simulation(world, engine="planar", time_step=0.02) as simulation:
        discs = [
            (robot, collision.pose.position[:2], collision.geometry.radius)
            for robot in simulation.robots.values()
            if not robot.description.static
            for link in robot.description.links
            for collision in link.collisions
        ]
        track = np.zeros((steps, len(discs), 2))
        for row in track:
            for place, (robot, middle, _) in zip(row, discs, strict=True):
                yaw = float(robot.yaw[0])
                turn = np.array([[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]])
                place[:] = robot.position[0, :2] + turn @ middle
            simulation.run(PERIOD)
    return track, np.array([radius for _, _, radius in discs])


def clear_of_statics(world, half):
    """Return whether a lidar is clear of all that is static, on a map of cells of `FINE`."""
    ticks = np.arange(-half, half, FINE) + FINE / 2.0
    points = np.stack(np.meshgrid(ticks, ticks, indexing="ij"), axis=-1)
    free = np.ones(points.shape[:2], bool)
    for model in world.models:
        if not model.static:
            continue
        for link in model.links:
            for collision in link.collisions:
                place = model.pose * link.pose * collision.pose
                if isinstance(collision.geometry, Box | Cylinder):
                    free &= away(collision.geometry, place, points) > CLEAR + FINE
    return free


def away(shape, place, points):
    """Return distance [m] of points in the plane from a box or an upright cylinder."""
    offset = points - np.array(place.position[:2])
    if isinstance(shape, Cylinder):
        return np.hypot(offset[..., 0], offset[..., 1]) - shape.radius
    cos, sin = math.cos(place.yaw), math.sin(place.yaw)
    own = np.stack(
        (cos * offset[..., 0] + sin * offset[..., 1], cos * offset[..., 1] - sin * offset[..., 0]),
        axis=-1,
    )
    return np.linalg.norm(np.maximum(np.abs(own) - np.array(shape.size[:2]) / 2.0, 0.0), axis=-1)


def driven(robots, rate):
    """Return robots of (x, y, yaw) a control step later, at these yaw rates."""
    half = 0.5 * rate * PERIOD
    chord = SPEED * PERIOD * np.sinc(half / np.pi)
    middle = robots[:, 2] + half
    step = np.stack((chord * np.cos(middle), chord * np.sin(middle), 2.0 * half), axis=1)
    return robots + step


def thinned(robots, half):
    """Return one robot for each cell of place and heading."""
    across = int(2 * half / CELL)
    cell = ((robots[:, :2] + half) / CELL).astype(int)
    heading = (robots[:, 2] * (HEADINGS / (2.0 * np.pi))).astype(int) % HEADINGS
    key = (cell[:, 0] * across + cell[:, 1]) * HEADINGS + heading
    kept = np.full(across * across * HEADINGS, -1)
    kept[key] = np.arange(len(robots))
    return robots[kept[kept >= 0]]


def reached(world, start, goals, *, limit=300, begin=0, spin=None, half=2.4):
    """Return the goals that can be reached within `limit` control steps.

    Args:
        world: Bundled name.
        start: x and y [m]; the robot looks along x.
        goals: Places [m], shape (m, 2).
        limit: Control steps.
        begin: Control step of the obstacles' motion at which the robot starts.
        spin: Lets the obstacles turn about the origin at this rate [rad/s] instead.
        half: Side of the square that is searched, halved [m].

    Returns:
        Booleans, shape (m,).
    """
    description = formats.load(world)
    if spin is None:
        track, radii = obstacle_paths(description, begin + limit + 1)
        track = track[begin:]
    else:
        track, radii = turned(*obstacle_paths(description, 1), spin, limit + 1)
    free = clear_of_statics(description, half)
    found = np.zeros(len(goals), bool)
    robots = np.array([[*start, 0.0]])
    for step in range(0, limit, HOLD):
        rate = np.tile(TURNS, len(robots))
        robots = np.repeat(robots, len(TURNS), axis=0)
        for now in range(step + 1, step + HOLD + 1):
            robots = driven(robots, rate)
            safe = unharmed(robots, free, half, track[now], radii)
            robots, rate = robots[safe], rate[safe]
        robots = thinned(robots, half)
        for index in np.flatnonzero(~found):
            left = np.linalg.norm(robots[:, :2] - goals[index], axis=1)
            found[index] = left.min(initial=np.inf) < ARRIVED
        if found.all():
            break
    return found


def unharmed(robots, free, half, middles, radii):
    """Return whether the lidars are clear of everything."""
    lidar = robots[:, :2] + LIDAR * np.stack((np.cos(robots[:, 2]), np.sin(robots[:, 2])), 1)
    cell = ((lidar + half) / FINE).astype(int)
    safe = free[cell[:, 0], cell[:, 1]]
    for middle, radius in zip(middles, radii, strict=True):
        safe &= np.linalg.norm(lidar - middle, axis=1) - radius > CLEAR
    return safe


def turned(track, radii, spin, steps):
    """Return the first places of a track, turning about the origin."""
    angle = spin * PERIOD * np.arange(steps)[:, None]
    x, y = track[0, :, 0], track[0, :, 1]
    cos, sin = np.cos(angle), np.sin(angle)
    return np.stack((cos * x - sin * y, sin * x + cos * y), axis=-1), radii
