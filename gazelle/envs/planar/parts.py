"""What a simulation holds that native kernels can step, read from its parts as tables."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.engines.planar import Fleet, PlanarEngine
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.clearing import listed
from gazelle.engines.planar.rays import Caster
from gazelle.envs.planar.kernels_drive import measure_room
from gazelle.envs.planar.tables import (
    LAW,
    LAW_BODY,
    LAW_HALF,
    LAW_RADIUS,
    LAW_RAMP,
    LAW_REACH,
    PATH,
    PATH_BODY,
    PATH_DRIFT,
    PATH_FIRST,
    PATH_LAST,
    PATH_LOOP,
    PATH_SPIN,
    PATH_START,
    Floats,
)
from gazelle.plugins.diff_drive import DiffDrive
from gazelle.plugins.imu import ImuPlugin
from gazelle.plugins.laser import Laser
from gazelle.plugins.scripted_motion import ScriptedMotion
from gazelle.rotations import yaw_of
from gazelle.sensors import LidarModel
from gazelle.simulation import Robot, Simulation
from gazelle.simulation.stepping import ScheduledPlugin

_CELL = 0.3  # side of the cells that statics are listed in [m]
_MOST_CELLS = 500  # along a side
_MAP = 480  # cells along the longer side of the map of distances
_SAME = 1e-12
_MARGIN = 1e-9  # by which cells are larger than they are [m]


@dataclass(frozen=True, slots=True)
class Drive:
    """The two-wheel drive of the one robot.

    Attributes:
        entry: The plugin and its schedule.
        plugin: The same plugin.
        law: See ``tables``.
        matrix: From wheel speeds to the twist, shape (3, 2).
    """

    entry: ScheduledPlugin
    plugin: DiffDrive
    law: Floats
    matrix: Floats


@dataclass(frozen=True, slots=True)
class Paths:
    """Bodies that follow scripts.

    Attributes:
        entries: Their plugins and schedules, all of one rate.
        plugins: The same plugins.
        table: See ``tables``, shape (paths, PATH).
        points: Way-points, shape (n, 7).
        drift: How far a point of each body may go in a control step [m], shape (nbody,).
    """

    entries: tuple[ScheduledPlugin, ...]
    plugins: tuple[ScriptedMotion, ...]
    table: Floats
    points: Floats
    drift: Floats


@dataclass(frozen=True, slots=True)
class Statics:
    """What stands still, for the lidar and for the base.

    Attributes:
        faces: Sides that the lidar sees: both ends, whether from both sides, and their lowest
            and highest height [m], shape (7, n).
        discs: Discs it sees: middle and radius, shape (m, 3).
        room: Map of lower bounds of the distance to anything static [m].
        corner: Of the map: x, y [m], cells a metre.
        cells: A fine grid over them, as ``kernels_grid`` has it.
        start: First item of each of its cells.
        items: Indices of statics, cell by cell.
    """

    faces: Floats
    discs: Floats
    room: Floats
    corner: Floats
    cells: Floats
    start: NDArray[np.int32]
    items: NDArray[np.int32]


@dataclass(frozen=True, slots=True)
class Looks:
    """What can be seen of bodies, in their own frames.

    Attributes:
        sides: As ``Statics.faces``, shape (7, n).
        rounds: Discs: middle, radius, lowest and highest height [m], shape (m, 5).
        spans: Of each body the first side and the one after the last, and so for discs, and
            how much farther its sides come in a list of all bodies' sides, shape (nbody, 5).
    """

    sides: Floats
    rounds: Floats
    spans: NDArray[np.int64]


def drive_of(simulation: Simulation, robot: Robot) -> Drive | None:
    """The robot's drive; None if more than it moves the robot, or something else does."""
    engine = simulation.engine
    if not isinstance(engine, PlanarEngine):
        return None
    own = [entry for entry in simulation.plugins if entry.owner == robot.name]
    drives = [entry for entry in own if type(entry.plugin) is DiffDrive]
    others = [entry for entry in own if type(entry.plugin) not in (DiffDrive, ImuPlugin, Laser)]
    body = engine.bodies.get(robot.name)
    rolls = [each for each in engine.layout.rollings if each.body == body]
    if len(drives) != 1 or others or len(rolls) != 1 or len(engine.layout.rollings) != 1:
        return None
    plugin = drives[0].plugin
    wheels = [f"{robot.name}::{name}" for name in getattr(plugin, "wheel_joints", ())]
    columns = [engine.layout.joints[name][0] for name in wheels if name in engine.layout.joints]
    if not isinstance(plugin, DiffDrive) or list(rolls[0].columns) != columns or body is None:
        return None
    row = np.zeros(LAW)
    row[LAW_BODY], row[LAW_HALF], row[LAW_RADIUS] = body, plugin.separation / 2.0, plugin.radius
    row[LAW_RAMP], row[LAW_REACH] = plugin.acceleration, engine.fleet.kinds[body, c.RADIUS]
    return Drive(drives[0], plugin, row, np.ascontiguousarray(rolls[0].matrix))


def paths_of(simulation: Simulation, robot: Robot, period: float) -> Paths | None:
    """Scripted bodies; None if anything else happens in the world."""
    engine = simulation.engine
    others = [entry for entry in simulation.plugins if entry.owner != robot.name]
    if not isinstance(engine, PlanarEngine) or any(
        type(entry.plugin) is not ScriptedMotion for entry in others
    ):
        return None
    rates = {entry.plugin.update_rate for entry in others}
    scripts = tuple(entry.plugin for entry in others if isinstance(entry.plugin, ScriptedMotion))
    if len(rates) > 1 or not all(_is_plain(script) for script in scripts):
        return None
    table, points = np.zeros((len(scripts), PATH)), [np.zeros((0, 7))]
    drift = np.zeros(engine.fleet.nbody)
    first = 0
    for row, script in zip(table, scripts, strict=True):
        legs = _legs_of(script)
        points.append(legs)
        body = engine.bodies[script.robot.name]
        row[PATH_BODY], row[PATH_FIRST], row[PATH_LAST] = body, first, first + len(legs)
        row[PATH_LOOP], row[PATH_SPIN] = script.loop, script.spin[2]
        row[PATH_START : PATH_START + 3] = script.start[0]
        row[PATH_START + 3] = yaw_of(script.start[1][None])[0]
        first += len(legs)
        speed = np.hypot(legs[:, 4], legs[:, 5]).max(initial=0.0)
        # One period more: what is due now may have been due for that long.
        far = (speed + abs(row[PATH_SPIN]) * engine.fleet.kinds[body, c.RADIUS]) * 2.0 * period
        row[PATH_DRIFT] = drift[body] = far
    return Paths(tuple(others), scripts, table, np.vstack(points), drift)


def _is_plain(script: ScriptedMotion) -> bool:
    """Whether a body keeps its height and turns about z alone, and follows no spline."""
    if script.splines:
        return False
    if script.times.size:
        return bool(np.ptp(script.quaternions, axis=0).max() < _SAME) and not script.spin.any()
    return not script.spin[:2].any()


def caster_of(robot: Robot, sensor: str) -> Caster | None:
    """What casts the lidar's rays; None unless they are one fan with plain noise."""
    model = robot.sensors[sensor].model
    engine = robot.simulation.engine
    if not isinstance(model, LidarModel) or not isinstance(engine, PlanarEngine):
        return None
    noise = model.lidar.noise
    plain = noise.type in ("none", "gaussian") and noise.dynamic_bias_stddev == 0.0
    if not plain or noise.bias_mean != 0.0 or noise.bias_stddev != 0.0:
        return None
    caster = engine.caster(model.link, model.origins, model.directions)
    single = caster.scanner.ranges.shape[1] == 1 and caster.begin == caster.scanner.fan.begin
    return caster if single and (caster.scanner.names >= 0.0).all() else None


def statics_of(fleet: Fleet, height: float) -> Statics:
    """The statics of a fleet, as a lidar at a height [m] and a base meet them."""
    rows = fleet.scene.table.rows
    kind = rows[:, c.KIND].astype(int)
    disc = (kind & int(c.CIRCLE)) != 0
    level = (rows[:, c.LOW] <= height) & (height <= rows[:, c.HIGH]) & (rows[:, c.GLOW] >= 0.0)
    ends = rows[:, [c.X0, c.Y0, c.X1, c.Y1]]
    faces = _sides(rows)[level & ~disc].T.copy()
    low, high = _extent(rows, disc)
    per_metre = _MAP / max(float((high - low).max()), 1e-3)
    corner = np.array([*low, per_metre])
    columns, lines = np.maximum(np.ceil((high - low) * per_metre).astype(int), 1)
    room = np.zeros((lines, columns), np.float32)
    measure_room(room, corner, ends[~disc].copy(), ends[disc][:, :3].copy())
    cells, start, items = _grid_over(rows, low, high)
    return Statics(faces, ends[level & disc][:, :3].copy(), room, corner, cells, start, items)


def looks_of(fleet: Fleet) -> Looks:
    """What a lidar sees of the bodies of a fleet."""
    rows = fleet.looks
    disc = (rows[:, c.KIND].astype(int) & int(c.CIRCLE)) != 0
    seen = rows[:, c.GLOW] >= 0.0
    flat, round_ = seen & ~disc, seen & disc
    ends = fleet.kinds[:, [c.FIRST_LOOK, c.LAST_LOOK]].astype(int)
    spans = [np.concatenate(([0], np.cumsum(which)))[ends] for which in (flat, round_)]
    discs = rows[:, [c.X0, c.Y0, c.X1, c.LOW, c.HIGH]][round_]
    counts = np.diff(spans[0], axis=1)
    spans.append(np.cumsum(counts)[:, None] - counts - spans[0][:, :1])
    table = np.ascontiguousarray(np.hstack(spans), np.int64)
    return Looks(_sides(rows)[flat].T.copy(), discs.copy(), table)


def _sides(rows: Floats) -> Floats:
    """Both ends of segments, whether they are seen from both sides, and their heights."""
    open_ = ((rows[:, c.KIND].astype(int) & int(c.OPEN)) != 0).astype(np.float64)
    ends = rows[:, [c.X0, c.Y0, c.X1, c.Y1]]
    return np.column_stack((ends, open_, rows[:, c.LOW], rows[:, c.HIGH]))


def _grid_over(
    rows: Floats, low: Floats, high: Floats
) -> tuple[Floats, NDArray[np.int32], NDArray[np.int32]]:
    """Which statics are in which cell of a grid that is finer than the engine's."""
    side = max(_CELL, float((high - low).max()) / _MOST_CELLS)
    columns, lines = np.ceil((high - low) / side)
    cells = np.array([*low, side, columns, lines])
    start, items = listed(rows, cells, _MARGIN)
    return cells, start, items


def _extent(
    rows: Floats, disc: np.ndarray[tuple[int], np.dtype[np.bool_]]
) -> tuple[Floats, Floats]:
    """Least and greatest x and y of statics, with some room around."""
    radius = np.where(disc, rows[:, c.X1], 0.0)[:, None]
    start = rows[:, [c.X0, c.Y0]]
    end = np.where(disc[:, None], start, rows[:, [c.X1, c.Y1]])
    corners = np.vstack((start - radius, start + radius, end, np.zeros((1, 2))))
    return corners.min(axis=0) - 1.0, corners.max(axis=0) + 1.0


def _legs_of(script: ScriptedMotion) -> Floats:
    """Time, place and velocity from there on of each way-point, shape (n, 7)."""
    legs = np.zeros((len(script.times), 7))
    legs[:, 0], legs[:, 1:4] = script.times, script.positions
    if len(legs) > 1:
        legs[:-1, 4:] = script.velocities
    return legs
