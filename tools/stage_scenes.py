"""Worlds that run in Stage and in Gazelle, and how far apart the two are."""

from __future__ import annotations

import warnings
from collections import defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from _stage_itself import Stage
from numpy.typing import NDArray
from PIL import Image

from gazelle.stage import Blob, StageSimulation

Floats = NDArray[np.float64]
STEPS = 60
HEAD = "interval_sim 100\nresolution 0.02\nquit_time 6\n"


class Row(NamedTuple):
    """A line of the table."""

    scene: str
    compared: str
    count: str
    apart: str
    most: str
    why: str = ""


class Robot(NamedTuple):
    """What the file says of one, and what it is told [m/s, m/s, rad/s]."""

    text: str
    pose: tuple[float, float, float] = (0.0, 0.0, 0.0)  # m, m, degrees
    command: tuple[float, float, float] = (0.0, 0.0, 0.0)


class Heard(NamedTuple):
    """What both say, by robot: of Stage all steps, x y heading stalled and the odometry."""

    poses: dict[str, Floats]  # (steps, 7)
    senses: dict[tuple[str, str], list[list[str]]]  # kind and robot: the rest of the lines
    ours: Floats  # (steps, robots, 7)
    sim: StageSimulation


def both(stage: Stage, folder: Path, robots: list[Robot], more: str = "") -> Heard:
    """Run a world in Stage and in Gazelle."""
    lines = [HEAD, more]
    for i, (text, (x, y, yaw), command) in enumerate(robots):
        words = " ".join(f"{value:.6f}" for value in command)
        lines.append(
            f'position ( name "r{i}" pose [{x:.6f} {y:.6f} 0 {yaw:.6f}] {text}'
            f' ctrl "stage_probe drive {words}" )'
        )
    file, log = folder / "scene.world", folder / "log"
    file.write_text("\n".join(lines), encoding="utf-8")
    stage.run(file, log)
    poses: dict[str, list[list[float]]] = defaultdict(list)
    senses: dict[tuple[str, str], list[list[str]]] = defaultdict(list)
    for line in log.read_text(encoding="utf-8").splitlines():
        kind, name, _, *rest = line.split()
        if kind == "pose":
            poses[name].append([float(value) for value in rest])
        else:
            senses[kind, name].append(rest)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that stage_probe is unknown
        sim = StageSimulation(file, euler=True, threads=1)
    sim.commands[0] = [robot.command for robot in robots]
    ours = []
    for _ in range(STEPS):
        sim.step()
        stalled = sim.stalled[0][:, None]
        ours.append(np.hstack((sim.poses[0], stalled, sim.odometry[0])))
    arrays = {name: np.array(rows) for name, rows in poses.items()}
    return Heard(arrays, dict(senses), np.array(ours), sim)


def apart(theirs: Floats, ours: Floats) -> Floats:
    """Return differences of steps of both, shape (steps, 7)."""
    count = min(len(theirs), len(ours))
    difference: Floats = theirs[:count] - ours[:count]
    turns = difference[:, (2, 6)]
    difference[:, (2, 6)] = np.arctan2(np.sin(turns), np.cos(turns))
    return np.abs(difference)


def row(
    scene: str, compared: str, values: list[float] | Floats, unit: str = "m", why: str = ""
) -> Row:
    """Return a line about lengths or angles."""
    all_values = np.asarray(values)
    mean, most = (f"{rounded(v)} {unit}" for v in (all_values.mean(), all_values.max()))
    return Row(scene, compared, f"{all_values.size:,}", mean, most, why)


def rounded(value: float) -> str:
    """Return a figure with two digits; nothing below what is written to nine places."""
    return "< 1e-9" if value < 1e-9 else f"{value:.2g}"


def share(scene: str, compared: str, differ: int, total: int, why: str = "") -> Row:
    """Return a line about the share of things that differ."""
    return Row(scene, compared, f"{total:,}", f"{differ} ({100 * differ / total:.1f} %)", "", why)


BASE = "size [.4 .4 .3]"
BASES = {
    "differential bases": (
        (BASE, (0.5, 0.0, 0.4)),
        (BASE, (-0.3, 0.4, -0.7)),
        (BASE, (3.0, 0.0, 3.0)),
        (f"{BASE} velocity_bounds [-.1 .2 0 0 0 0 -20 30]", (0.5, 0.0, 1.0)),
        (f"{BASE} origin [.1 .05 0 20]", (0.5, 0.0, 0.4)),
    ),
    "omnidirectional bases": (
        (f'{BASE} drive "omni"', (0.3, 0.2, -0.5)),
        (f'{BASE} drive "omni"', (-2.0, 3.0, 0.1)),
    ),
    "cars": (
        (f'{BASE} drive "car" wheelbase .8', (0.5, 0.0, 0.3)),
        (f'{BASE} drive "car"', (-0.5, 0.3, -0.5)),
        (f'{BASE} drive "car" wheelbase .3', (0.9, 0.0, 1.2)),
        (f'{BASE} drive "car" wheelbase .3', (4.0, 0.0, 1.2)),
        (f'{BASE} drive "car" wheelbase .3', (-4.0, 0.0, 2.5)),
    ),
}


def drives(stage: Stage, folder: Path) -> Iterator[Row]:
    """Yield bases of each kind, also beyond their bounds, and odometry without error."""
    for kind, bases in BASES.items():
        exact = ' localization "odom" odom_error [0 0 0 0]'
        robots = [
            Robot(text + exact, (20.0 * i, 3.0, 35.0 * i), command)
            for i, (text, command) in enumerate(bases)
        ]
        heard = both(stage, folder, robots)
        errors = [apart(heard.poses[f"r{i}"], heard.ours[:, i]) for i in range(len(robots))]
        found = np.array(errors)
        yield row(kind, "place in every step", found[..., :2])
        yield row(kind, "heading", found[..., 2], "rad")
        why = "Stage counts moves to the left as moves to the right" if "omni" in kind else ""
        yield row(kind, "odometry", found[..., 4:6], why=why)


def walls(stage: Stage, folder: Path) -> Iterator[Row]:
    """Yield robots that run into walls at all angles, or turn beside one until they touch it."""
    rng = np.random.default_rng(2)
    robots, more = [], []
    for i in range(24):
        x, y, yaw = 12.0 * (i % 6), 12.0 * (i // 6), float(rng.uniform(-180, 180))
        more.append(f"model ( size [.3 9 1] pose [{x + 1.3} {y} 0 {rng.uniform(-40, 40):.3f}] )")
        command = (0.5, 0.0, 0.0) if i % 3 else (0.0, 0.0, 0.8)
        ahead = 0.0 if i % 3 else -0.2
        robots.append(Robot("size [.8 .3 .3]", (x + ahead, y, yaw / 4), command))
    heard = both(stage, folder, robots, "\n".join(more))
    last, stalls = [], []
    for i in range(len(robots)):
        theirs, ours = heard.poses[f"r{i}"], heard.ours[:, i]
        last.append(float(apart(theirs, ours)[-1, :2].max()))
        first = [
            int(np.argmax(each[:, 3] > 0)) if each[:, 3].any() else -1 for each in (theirs, ours)
        ]
        stalls.append(abs(first[0] - first[1]) if min(first) >= 0 else abs(min(first) - max(first)))
    why = "bodies are cells in Stage, and so up to a cell larger: a step of 0.05 m less"
    yield row("robots that meet walls", "where they end", last, why=why)
    yield row("robots that meet walls", "first step stalled", np.array(stalls, float), "steps")


AWAY = 0.1  # [m]
LASER = "ranger ( pose [.1 0 0 20] sensor ( range [0 8] fov 270 samples 541 ) )"
SOLIDS = """
model ( size [1 2 1] pose [2 1 0 30] )
model ( size [.5 .5 1] pose [-2 -2 0 0] ranger_return .4 )
model ( size [1 1 1] pose [-2 2.5 0 10] ranger_return -1 )
model ( size [3 3 .05] pose [2 -2 0 0] )
model ( size [.6 .6 1] pose [1.5 -2.5 .1 0] obstacle_return 0 )
model ( size [1 1 1] pose [-3 0 0 0] origin [.2 .1 0 45]
  block ( points 3 point[0] [0 0] point[1] [2 0] point[2] [0 3] z [0 1] )
  block ( points 4 point[0] [2 2] point[1] [3 2] point[2] [3 3] point[3] [2 3] z [0 1] ) )
model ( size [10 .1 1] pose [0 5 0 0] )  model ( size [10 .1 1] pose [0 -5 0 0] )
model ( size [.1 10 1] pose [5 0 0 0] )  model ( size [.1 10 1] pose [-5 0 0 0] )
"""


def rangers(stage: Stage, folder: Path) -> Iterator[Row]:
    """Yield beams among boxes, other polygons and what a bitmap draws, from random places."""
    yield from beams(stage, folder, SOLIDS, "among polygons")
    rng = np.random.default_rng(4)
    plan = np.full((220, 260), 255, np.uint8)
    plan[10:210, 10:14] = plan[10:210, 246:250] = plan[10:14, 10:250] = plan[206:210, 10:250] = 0
    for y, x in rng.integers(20, 190, (12, 2)):
        plan[y : y + 12, x : x + rng.integers(4, 40)] = 0
    Image.fromarray(plan).save(folder / "plan.png")
    drawn = 'model ( bitmap "plan.png" size [10 9 1] boundary 1 )'
    yield from beams(stage, folder, drawn, "in a bitmap")


def beams(stage: Stage, folder: Path, world: str, scene: str) -> Iterator[Row]:
    """Compare all beams of robots that nobody sees."""
    rng = np.random.default_rng(3)
    places = rng.uniform((-4.5, -4, -180), (4.5, 4, 180), (30, 3)).tolist()
    robots = [Robot(f"size [.2 .2 .3] ranger_return -1 {LASER}", tuple(p)) for p in places]
    heard = both(stage, folder, robots, world)
    theirs, ours, different = [], [], []
    for i in range(len(robots)):
        name = f"r{i}"
        if heard.sim.scan_of(name).min() < AWAY:
            continue  # what sensors in a wall see is nobody's business
        theirs.append(np.array(heard.senses["ranges", name][0], float))
        ours.append(heard.sim.scan_of(name))
        scanner, place = heard.sim.robots[i].rangers[0].places[0]
        shine = heard.sim.returns(scanner, place)
        different.append(np.array(heard.senses["returns", name][0], float) != shine)
    gaps = np.abs(np.array(theirs) - np.array(ours))
    far = gaps > 0.1
    kind = f"rangers {scene}"
    why = "beams end at cells in Stage; Gazelle's lengths are exact to 1e-9 m"
    yield row(kind, "length, within 0.1 m", gaps[~far], why=why)
    why = "beams that pass an edge in one and not in the other"
    yield share(kind, "length, farther apart", int(far.sum()), gaps.size, why)
    other = int(np.array(different)[~far].sum())
    yield share(kind, "what else they meet", other, int((~far).sum()), "where two bodies are close")


def crowd(seed: int) -> str:
    """Return boxes for fiducial finders and blob finders, each in a square of its own."""
    rng = np.random.default_rng(seed)
    colors = ("red", "green", "blue", "yellow")
    lines = []
    for i, square in enumerate(rng.permutation(100)[:40]):
        x, y = (square % 10) * 1.5 - 6.75, (square // 10) * 1.5 - 6.75
        size, height = rng.uniform(0.2, 0.9, 2), rng.choice([0.2, 1.0])
        lines.append(
            f'model ( name "m{i}" size [{size[0]:.3f} {size[1]:.3f} {height}]'
            f' pose [{x:.3f} {y:.3f} 0 {rng.uniform(-180, 180):.2f}] color "{colors[i % 4]}"'
            f" fiducial_return {i % 5 * (i + 1)} fiducial_key {int(i % 7 == 0)} )"
        )
    return "\n".join(lines)


def anywhere(rng: np.random.Generator, device: str) -> Robot:
    """Return a robot in the crowd, at the corner of four squares."""
    x, y = 1.5 * rng.integers(-4, 5, 2)
    return Robot(f"size [.1 .1 .5] {device}", (float(x), float(y), float(rng.uniform(-180, 180))))


def fiducials(stage: Stage, folder: Path) -> Iterator[Row]:
    """Yield fiducial finders of several kinds in a crowd: their marks and places."""
    kinds = ("", "range_max 4 range_max_id 2", "fov 60", "range_min 3", "ignore_zloc 1")
    rng = np.random.default_rng(5)
    gaps: list[float] = []
    plain, tall = [0, 0], [0, 0]  # seen at all, and by one only
    for i in range(60):
        kind = kinds[i % len(kinds)]
        heard = both(stage, folder, [anywhere(rng, f"fiducial ( {kind} )")], crowd(i))
        lines = heard.senses.get(("fiducial", "r0"), [])
        theirs = {name: [float(v) for v in rest] for name, *rest in lines}
        ours = {s.name: [s.id, s.distance, s.bearing, s.heading] for s in heard.sim.fiducials("r0")}
        for name in theirs.keys() & ours.keys():
            gaps += [abs(p - q) for p, q in zip(theirs[name], ours[name], strict=True)]
        count = tall if "zloc" in kind else plain
        count[0] += len(theirs.keys() | ours.keys())
        count[1] += len(theirs.keys() ^ ours.keys())
    yield row("fiducials", "number, distance, bearing, heading", gaps, "m, rad")
    yield share("fiducials", "seen by one only", plain[1], plain[0], "at edges, as for rangers")
    why = "in Stage also what is behind a mark of another height hides it"
    yield share("fiducials, ignore_zloc", "seen by one only", tall[1], tall[0], why)


def blobs(stage: Stage, folder: Path) -> Iterator[Row]:
    """Yield blob finders in a crowd: the colour in every column, and distances."""
    kinds = ("", 'colors_count 2 colors ["red" "blue"]', "fov 120 image [200 60]", "pan 60 range 4")
    rng = np.random.default_rng(6)
    total, lost, other, gaps = 0, 0, 0, []
    for i in range(32):
        kind = kinds[i % len(kinds)]
        width = 200 if "image" in kind else 80
        heard = both(stage, folder, [anywhere(rng, f"blobfinder ( {kind} )")], crowd(100 + i))
        theirs = [
            Blob((*map(float, line[:3]), 1.0), int(line[3]), int(line[4]), float(line[5]))
            for line in heard.senses.get(("blob", "r0"), [])
        ]
        ours = heard.sim.blobs("r0")
        after = {blob.left - 1 for blob in theirs}  # Stage goes from left to right last
        pairs = list(zip(columns(theirs, width), columns(ours, width), strict=True))
        apart_at = [k for k, (a, b) in enumerate(pairs) if a != b]
        total, skipped = total + width, sum(k in after for k in apart_at)
        lost, other = lost + skipped, other + len(apart_at) - skipped
        gaps += [
            abs(a.distance - b.distance)
            for a in theirs
            for b in ours
            if a.color == b.color and abs(a.left - b.left) + abs(a.right - b.right) <= 1
        ]
    why = "Stage never looks at the column that ends a blob"
    yield share("blobs", "columns beside a blob", lost, total, why)
    yield share("blobs", "other columns", other, total, "at edges, as for rangers")
    why = "one column of a bent blob more or less changes its mean"
    yield row("blobs of the same columns but one", "distance", gaps, why=why)


def columns(seen: list[Blob], width: int) -> list[tuple[float, ...] | None]:
    """Return the colour of each column."""
    found: list[tuple[float, ...] | None] = [None] * width
    for blob in seen:
        found[blob.left : blob.right + 1] = [blob.color] * (blob.right - blob.left + 1)
    return found


def bumpers(stage: Stage, folder: Path) -> Iterator[Row]:
    """Yield strips of bumpers beside walls: those with contacts."""
    rng = np.random.default_rng(7)
    strips = " ".join(f"bpose[{i}] [{x} {y} 0 {90 * i}]" for i, (x, y) in enumerate(SIDES))
    device = f"bumper ( bcount 4 blength .3 {strips} )"
    robots, more = [], []
    for i in range(40):
        x, y = 5.0 * (i % 8), 5.0 * (i // 8)
        gap = float(rng.uniform(0.0, 0.1))
        more.append(f"model ( size [1 1 1] pose [{x + 0.7 + gap:.4f} {y:.4f} 0 0] )")
        robots.append(Robot(f"size [.4 .4 .3] {device}", (x, y, 90.0 * (i % 4))))
    heard = both(stage, folder, robots, "\n".join(more))
    apart_from = 0
    for i in range(len(robots)):
        (theirs,) = heard.senses["bumps", f"r{i}"]
        ours = heard.sim.bumps(f"r{i}")
        apart_from += sum((a == "-") != (b is None) for a, b in zip(theirs, ours, strict=True))
    why = "strips within a body meet no outline in Stage, those beside one only in its cells"
    yield share("bumpers", "strips that touch for one only", apart_from, 4 * len(robots), why)


def noise(stage: Stage, folder: Path) -> Iterator[Row]:
    """Yield deviations of ranges to a wall across the axis, with each kind of noise."""
    wall = "model ( size [1 20 1] pose [4.5 0 0 0] )"
    for words in ("0.01 0", "0 0.1", "0.0004 0.02"):
        sensor = f"sensor ( range [0 8] fov 20 samples 4001 noise [{words} 0] )"
        robot = Robot(f"size [.2 .2 .3] ranger ( {sensor} )")
        heard = both(stage, folder, [robot], wall)
        across = np.cos(np.radians(np.linspace(-10, 10, 4001)))
        ranges = (np.array(heard.senses["ranges", "r0"][0], float), heard.sim.scan_of("r0"))
        theirs, ours = (float((each * across).std()) for each in ranges)
        compared = f"deviation with [{words} 0]: Stage's {theirs:.3f} m"
        yield row("noise of rangers", compared, [abs(theirs - ours)], why="as 4,001 beams tell it")


SIDES = ((0.22, 0.0), (0.0, 0.22), (-0.22, 0.0), (0.0, -0.22))
SCENES: tuple[Callable[[Stage, Path], Iterator[Row]], ...] = (
    drives,
    walls,
    rangers,
    fiducials,
    blobs,
    bumpers,
    noise,
)
