"""Let every world and robot of the corpus stand for ten minutes, and see what becomes of it.

Nothing drives: no plugins, no controllers. Robots are put on a ground plane. What has come to
rest after ``SETTLING`` must not sink, and nothing may gain energy or lose its numbers.

    python tests/standing.py CORPUS [--budget SECONDS] [--part K/N] [--only TEXT]
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import mujoco
import numpy as np

import gazelle
from gazelle import formats
from gazelle.description import Collision, Link, Model, Plane, Pose, World
from gazelle.engines import DivergenceError, make_engine
from gazelle.engines.mujoco.compiler.spec import COLLISION_GROUP

LONG = 600.0
SETTLING = 20.0
RESTS = 1e-3
"""Speed of what rests [m/s]."""
LOOKS = (0.11, 0.27, 0.62)
"""What rests does so each time that it is looked at, so long apart, and does not swing [s]."""
SINKS = 0.01
"""What rests may sink by so much [m]."""

# Stage's worlds are another language; sdformat's own are parser tests, most without ground.
_LEFT_OUT = ("stage", "gazebosim__sdformat", "rl-collision-avoidance", "ros__xacro")


@dataclass(frozen=True)
class Outcome:
    """What became of one scene.

    Attributes:
        name: Path below the corpus.
        moving: How many links can move.
        seconds: Simulated time reached [s].
        fault: ``nan``, ``sinks``, ``gains`` (energy), ``refused`` (by the engine),
            ``unreadable`` or empty.
        where: The link, or the message.
        sunk: How far the worst link sank after it had come to rest [m].
        fastest: Highest speed of a link that is not falling freely, after settling [m/s].
        thrown: The same in the time of settling [m/s].
        cpu: Seconds of processor time.
    """

    name: str
    moving: int = 0
    seconds: float = 0.0
    fault: str = ""
    where: str = ""
    sunk: float = 0.0
    fastest: float = 0.0
    thrown: float = 0.0
    cpu: float = 0.0


def scenes(corpus: Path) -> Iterator[Path]:
    """Yield files of worlds and of robots, sorted."""
    for path in sorted(corpus.rglob("*")):
        name = str(path.relative_to(corpus))
        wanted = path.suffix in (".world", ".sdf", ".urdf") or name.endswith(".urdf.xacro")
        if wanted and not any(word in name for word in _LEFT_OUT):
            yield path


def load(path: Path) -> World:
    """Load a world; a robot stands on a plane."""
    world = formats.load(path)
    if path.suffix == ".world" or any(model.static for model in world.models):
        return world
    plane = Collision("c", Plane())
    ground = Model("the_ground", static=True, links=(Link("l", collisions=(plane,)),))
    models = tuple(replace(m, plugins=()) for m in world.models)
    try:
        lift = -_lowest(replace(world, models=models))
    except gazelle.EngineError:
        return world  # what cannot be simulated need not be placed
    placed = tuple(replace(m, pose=Pose(z=lift) * m.pose) for m in models)
    return replace(world, models=(ground, *placed), gravity=(0.0, 0.0, -9.8))


def stand(path: Path, corpus: Path, *, long: float = LONG, budget: float = 1e9) -> Outcome:
    """Run one scene at rest.

    Args:
        path: The file.
        corpus: The folder that names are relative to.
        long: Simulated time [s].
        budget: Processor time after which to stop [s].
    """
    name = str(path.relative_to(corpus))
    start = time.process_time()
    try:
        world = load(path)
    except gazelle.Error as error:
        return Outcome(name, fault="unreadable", where=str(error).splitlines()[0])
    try:
        engine = make_engine("mujoco", world, threads=1)
    except gazelle.Error as error:
        return Outcome(name, fault="refused", where=str(error).splitlines()[0])
    watch = _Watch(engine)
    if not watch.moving.size:
        return Outcome(name)
    pauses = [max(1, round(seconds / engine.time_step)) for seconds in LOOKS]
    fault = ""
    while watch.time < long and time.process_time() - start < budget and not fault:
        steps = pauses[watch.looks % len(pauses)]
        try:
            engine.step(steps)
        except DivergenceError:
            fault = "nan"
            break
        watch.look(steps * engine.time_step)
        fault = watch.fault
    spent = time.process_time() - start
    return Outcome(
        name,
        int(watch.moving.size),
        watch.time,
        fault,
        watch.where if fault else "",
        watch.sunk,
        watch.fastest,
        watch.thrown,
        spent,
    )


class _Watch:
    """Heights, speeds and energy of one world, from sample to sample."""

    def __init__(self, engine) -> None:
        self._engine = engine
        self._batch = engine.running.batch
        model = self._model = self._batch.model
        self._data = mujoco.MjData(model)
        mobile = [b for b in range(1, model.nbody) if model.body_weldid[b] != 0]
        self.moving = np.array([b for b in mobile if model.body_mocapid[b] < 0], dtype=int)
        self.time, self.sunk, self.fastest, self.thrown = 0.0, 0.0, 0.0, 0.0
        self.fault, self.where = "", ""
        self.looks, self._slow = 0, np.zeros(self.moving.size, dtype=int)
        self._rested = np.full(self.moving.size, np.nan)
        self._energy = self._look_closer()[2]
        self._scale = max(1.0, float(model.body_mass[self.moving].sum()) * 9.8 * 0.01)

    def _look_closer(self):
        model, data = self._model, self._data
        mujoco.mj_setState(
            model, data, self._batch.state[0], mujoco.mjtState.mjSTATE_INTEGRATION.value
        )
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        mujoco.mj_energyPos(model, data)
        mujoco.mj_energyVel(model, data)
        speed = np.linalg.norm(data.cvel[self.moving, 3:], axis=1)
        spin = np.linalg.norm(data.cvel[self.moving, :3], axis=1)
        # What has no gravity has no energy by its height either.
        held = model.body_gravcomp * model.body_mass * (data.xipos @ model.opt.gravity)
        energy = float(data.energy.sum() + held.sum())
        return data.xipos[self.moving, 2].copy(), speed + 0.1 * spin, energy

    def look(self, seconds: float) -> None:
        """Take a sample."""
        self.time += seconds
        self.looks += 1
        height, speed, energy = self._look_closer()
        in_world = height > -20.0
        if self.time < SETTLING or self._engine.running.overlaps.any:
            if in_world.any() and speed[in_world].max() > self.thrown:
                self.thrown = float(speed[in_world].max())
            # What overlaps in a file is pushed apart: it may gain energy at first.
            self._energy = max(self._energy, energy)
            return
        if energy > self._energy + self._scale + 0.01 * abs(self._energy):
            self.fault = "gains"
            self.where = f"{self._model.body(self.moving[speed.argmax()]).name} at {self.time:g} s"
        if in_world.any():
            self.fastest = max(self.fastest, float(speed[in_world].max()))
        self._slow = np.where(speed < RESTS, self._slow + 1, 0)
        fresh = np.isnan(self._rested) & (self._slow >= len(LOOKS))
        self._rested[fresh] = height[fresh]
        drop = np.nan_to_num(self._rested - height)
        if drop.max() > self.sunk:
            self.sunk = float(drop.max())
            if self.sunk > SINKS:
                self.fault = "sinks"
                self.where = (
                    f"{self._model.body(self.moving[drop.argmax()]).name} at {self.time:g} s"
                )


def _lowest(world: World) -> float:
    """Return the height of the lowest point of all collision shapes [m]."""
    engine = make_engine("mujoco", world, threads=1)
    model = engine.running.batch.model
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    lows = [_low(model, data, g) for g in range(model.ngeom) if _is_solid(model, g)]
    return min(lows, default=0.0)


def _is_solid(model, geom: int) -> bool:
    kind = model.geom_type[geom]
    return model.geom_group[geom] == COLLISION_GROUP and kind != mujoco.mjtGeom.mjGEOM_PLANE


def _low(model, data, geom: int) -> float:
    place, turn = data.geom_xpos[geom], data.geom_xmat[geom].reshape(3, 3)
    kind, size = mujoco.mjtGeom(int(model.geom_type[geom])), model.geom_size[geom]
    if kind == mujoco.mjtGeom.mjGEOM_SPHERE:
        return float(place[2] - size[0])
    if kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
        along = abs(turn[2, 2])
        return float(place[2] - along * size[1] - np.sqrt(max(0.0, 1.0 - along**2)) * size[0])
    if kind == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = int(model.geom_dataid[geom])
        first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
        return float(place[2] + (model.mesh_vert[first : first + count] @ turn[2]).min())
    centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
    return float(place[2] + turn[2] @ centre - np.abs(turn[2]) @ half)


def main() -> None:
    """Print a line for every scene."""
    parser = argparse.ArgumentParser()
    parser.add_argument("corpus", type=Path)
    parser.add_argument("--budget", type=float, default=1e9)
    parser.add_argument("--long", type=float, default=LONG)
    parser.add_argument("--part", default="1/1")
    parser.add_argument("--only", default="")
    parser.add_argument("--after", type=int, default=0, help="leave out so many of the first")
    args = parser.parse_args()
    warnings.simplefilter("ignore")
    part, parts = (int(word) for word in args.part.split("/"))
    chosen = [p for p in scenes(args.corpus) if args.only in str(p)][args.after :][
        part - 1 :: parts
    ]
    for path in chosen:
        try:
            o = stand(path, args.corpus, long=args.long, budget=args.budget)
        except Exception as error:  # noqa: BLE001  the sweep goes on, and the line says so
            o = Outcome(str(path.relative_to(args.corpus)), fault="crash", where=repr(error))
        figures = f"{o.moving}\t{o.seconds:.0f}\t{o.sunk * 1e3:.2f}\t{o.fastest:.3g}"
        figures += f"\t{o.thrown:.3g}\t{o.cpu:.1f}"
        print(f"{o.fault or '-'}\t{o.name}\t{figures}\t{o.where}", flush=True)


if __name__ == "__main__":
    main()
