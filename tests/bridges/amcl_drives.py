"""Drives along the paths of amcl's own tests, in a hall of ours, written down as bags."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image

import gazelle
from gazelle.stage import stage_of
from gazelle_ros import Time, load_message
from gazelle_ros.bags import Bag

SIDE, CELL = 60.0, 0.1
"""Of the hall and of its map's cells [m]; as in those tests the map begins at the origin."""
SPEED = 0.8

WORLD = """
interval_sim 100
resolution 0.02
define scanner ranger ( sensor ( range [0.05 30.0] fov 270.0 samples 541 ) )
define agv position
(
  size [0.6 0.5 0.4]
  drive "diff"
  localization "odom"
  odom_error [0.02 0.02 0.0 1.0]
  scanner ( pose [0.25 0 -0.1 0] )
)
define floorplan model ( boundary 0 ranger_return 1.0 )
floorplan ( bitmap "hall.png" size [60 60 2] pose [30 30 0 0] )
agv ( name "r0" pose [ %g %g 0 %g ] )
"""


@dataclass(frozen=True)
class RecordedDrive:
    """A drive, and what a test asks of it.

    Attributes:
        start: Pose on the map [m, m, rad].
        via: Places on the way [m].
        end: Pose at the end.
        seconds: When the test looks, after it began.
        tolerances: [m], [rad].
        guess: What amcl is told of the start; None to be found anywhere.
        odom: Frame of the odometry.
        waits: How long the robot stands first, while nodes come up [s].
        skips: How much of its beginning is not played [s].
        begins: Stamp of its first message [s].
    """

    start: tuple[float, float, float]
    via: tuple[tuple[float, float], ...]
    end: tuple[float, float, float]
    seconds: float
    tolerances: tuple[float, float]
    guess: tuple[float, float, float] | None
    odom: str = "odom"
    waits: float = 15.0
    skips: float = 0.0
    begins: float = 1000.0


DRIVES = {
    "basic_localization_stage": RecordedDrive(
        (47.943, 21.421, -0.503), ((52.0, 14.0), (40.0, 12.0), (36.0, 24.0), (40.0, 34.644)),
        (30.329, 34.644, 3.142), 90.0, (0.75, 0.75), (47.443, 21.421, -1.003),
    ),
    "global_localization_stage": RecordedDrive(
        (16.0, 21.0, -1.6), ((16.0, 19.0), (12.0, 19.0), (12.0, 12.0)), (10.0, 9.67, 6.21), 28.0,
        (0.25, 0.25), None, waits=0.0,
    ),
    "small_loop_prf": RecordedDrive(
        (14.099, 21.063, -0.006), ((22.0, 21.0), (22.0, 28.0), (13.94, 28.0)), (13.94, 23.02, 4.72),
        66.0, (0.75, 0.75), (14.099, 21.063, -0.006), odom="odom_combined",
    ),
    "rosie_multilaser": RecordedDrive(
        (42.378, 17.730, 1.583), ((42.0, 26.0), (48.0, 34.0), (44.0, 44.0), (33.0, 44.0)),
        (33.12, 34.53, -0.52), 103.5, (0.75, 0.4), (42.378, 17.730, 1.583),
    ),
    "small_loop_crazy_driving_prg": RecordedDrive(
        (14.016, 25.75, -3.0),
        ((10.0, 25.5), (9.0, 30.0), (14.0, 33.0), (18.0, 30.0), (15.5, 26.0), (20.0, 26.0), (18.0, 32.0)),
        (14.05, 28.91, 4.28), 90.0, (0.75, 0.75), None, odom="odom_combined",
    ),
    "texas_greenroom_loop": RecordedDrive(
        (14.049, 24.234, -1.517), ((14.0, 18.0), (20.0, 16.0), (23.0, 22.0), (20.0, 28.0), (14.5, 28.5)),
        (13.87, 24.07, 4.65), 89.0, (0.75, 0.75), None, odom="odom_combined", waits=30.0, skips=15.0,
    ),
    "texas_willow_hallway_loop": RecordedDrive(
        (31.872, 31.557, 0.0),
        ((44.0, 31.0), (52.0, 32.0), (52.0, 43.0), (40.0, 50.0), (24.0, 50.0), (10.0, 46.0), (8.0, 36.0),
         (14.0, 32.0), (20.0, 31.0)),
        (32.36, 31.44, 6.18), 250.0, (0.75, 0.75), None, odom="odom_combined", waits=30.0, skips=15.0,
    ),
}  # fmt: skip
# The drive that a pose belongs to which is sent late, with an earlier stamp: the robot moves in between.
DRIVES["set_initial_pose_delayed"] = replace(
    DRIVES["basic_localization_stage"], waits=0.5, begins=34.6
)


def hall():
    """Return the map, True in walls, shape (600, 600), the first row lowest.

    Blocks of all sizes stand where no drive comes near.
    """
    random = np.random.default_rng(5)
    cells = round(SIDE / CELL)
    walls = np.zeros((cells, cells), np.bool_)
    walls[[0, 1, -2, -1]] = walls[:, [0, 1, -2, -1]] = True
    ways = np.concatenate([_points(drive) for drive in DRIVES.values()])
    for _ in range(140):
        low, size = random.uniform(0.0, SIDE, 2), random.uniform(0.3, 5.0, 2)
        off = np.maximum(np.maximum(low - ways, ways - low - size), 0.0)
        if np.hypot(*off.T).min() > 1.2:
            first, last = (low / CELL).astype(int), ((low + size) / CELL).astype(int)
            walls[first[1] : last[1], first[0] : last[0]] = True
    return walls


def _points(drive):
    """Return places along a drive, a tenth of a metre apart, shape (n, 2)."""
    stops = [drive.start[:2], *drive.via, drive.end[:2]]
    pieces = [
        np.linspace(a, b, max(int(math.dist(a, b) / 0.1), 1)) for a, b in itertools.pairwise(stops)
    ]
    return np.concatenate(pieces)


def seen_hall():
    """Return a laser's map: surfaces of walls are 100, inside is -1, shape (600, 600)."""
    walls = hall()
    ring = np.pad(walls, 1, constant_values=True)
    inside = walls & ring[:-2, 1:-1] & ring[2:, 1:-1] & ring[1:-1, :-2] & ring[1:-1, 2:]
    return np.where(inside, -1, np.where(walls, 100, 0)).astype(np.int8)


def save_hall(folder, *names):
    """Write the hall as the picture of a Stage world, and what a laser sees of it as maps of these names."""
    picture = Image.fromarray(np.where(hall()[::-1], 0, 255).astype(np.uint8))
    picture.save(folder / "hall.png")
    seen = seen_hall()[::-1]
    seen = Image.fromarray(np.select([seen < 0, seen > 0], [205, 0], 254).astype(np.uint8))
    for name in names:
        seen.save(folder / name)


def command(pose, target, yaw):
    """Forward [m/s] and turn [rad/s] on the way to a place, or at the end of it to a heading."""
    ahead = math.atan2(target[1] - pose[1], target[0] - pose[0])
    if yaw is not None:
        return 0.0, max(-1.0, min(1.0, 2.0 * math.remainder(yaw - pose[2], 2 * math.pi)))
    error = math.remainder(ahead - pose[2], 2 * math.pi)
    return SPEED * max(math.cos(error), 0.0) ** 3, max(-1.0, min(1.0, 2.0 * error))


def record(drive, folder, bag_path):
    """Drive, stand at the end, and write scans and transforms down; returns the true last pose."""
    world = folder / "drive.world"
    world.write_text(WORLD % (*drive.start[:2], math.degrees(drive.start[2])))
    left = [*drive.via, drive.end[:2]]
    with gazelle.Simulation(world, engine="planar", seed=3) as sim, Bag(bag_path, "w") as bag:
        for _ in range(round((drive.skips + drive.seconds + 30.0) / 0.1)):
            pose = stage_of(sim).poses[0, 0]
            while left and math.dist(pose[:2], left[0]) < 0.1:
                left.pop(0)
            moved = sim.time > drive.waits
            forward, turn = command(pose, left[0] if left else pose, None if left else drive.end[2])
            stage_of(sim).commands[0, 0] = (forward * moved, 0.0, turn * moved)
            sim.step()
            stamp = Time(nsecs=round(1e9 * (drive.begins + sim.time)))
            bag.write("/tf", _transforms(sim, drive, stamp), stamp)
            bag.write("/base_scan", _scan(sim, stamp), stamp)
        assert not left
        return stage_of(sim).poses[0, 0].copy()


def _transforms(sim, drive, stamp):
    links = [
        (drive.odom, "base_link", stage_of(sim).odometry[0, 0]),
        ("base_link", "base_laser_link", (0.25, 0.0, 0.0)),
    ]
    made = load_message("tf2_msgs/TFMessage")()
    for parent, child, (x, y, yaw) in links:
        link = load_message("geometry_msgs/TransformStamped")()
        link.header.stamp, link.header.frame_id, link.child_frame_id = stamp, parent, child
        link.transform.translation.x, link.transform.translation.y = float(x), float(y)
        link.transform.rotation.z, link.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        made.transforms.append(link)
    return made


def _scan(sim, stamp):
    made = load_message("sensor_msgs/LaserScan")()
    made.header.stamp, made.header.frame_id = stamp, "base_laser_link"
    ranges = np.asarray(stage_of(sim).scan_of("r0")).ravel()
    made.angle_min, made.angle_max = -math.radians(135.0), math.radians(135.0)
    made.angle_increment = math.radians(270.0) / (len(ranges) - 1)
    made.range_min, made.range_max = 0.05, 30.0
    made.ranges = ranges.tolist()
    return made
