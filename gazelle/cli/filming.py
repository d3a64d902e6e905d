"""Common arguments of ``gazelle picture`` and ``gazelle film``: source and camera."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.cli.grounding import add_ground
from gazelle.cli.spawning import parse_spawn, spawn
from gazelle.errors import Error
from gazelle_ros.cli.parsing import (
    add_environment_options,
    add_file_options,
    add_import_option,
    add_scenario_options,
    environment_options,
)

if TYPE_CHECKING:
    from gazelle.simulation import Simulation

_LEAST, _MOST = 16, 8192
_SIZE = 960, 600

_WORLD, _RECORDING, _BAG, _RUN = "a world or a robot", "a recording", "a bag", "a training run"
_KINDS = {".bag": _BAG, ".jsonl": _RECORDING}
_SCENES = (_WORLD, _RECORDING)
# What takes the options that not every source has.
_TAKERS = {
    "--seed": (_WORLD, _RUN),
    "--eye": _SCENES,
    "--target": _SCENES,
    "--follow": _SCENES,
    "--top": (*_SCENES, _BAG),
    "--size": (*_SCENES, _BAG),
    "--no-ground": (_WORLD,),
    "--spawn": (_WORLD,),
    "--drive": (_WORLD,),
    "--topic": (_BAG,),
    "--engine": (_WORLD, _RUN),
    **dict.fromkeys(("--task", "--import", "--trust", "--world", "--robot"), (_RUN,)),
    **dict.fromkeys(("--goals", "--starts", "--option"), (_RUN,)),
}


def add_source(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "source",
        metavar="SOURCE",
        help="a world or robot file or its bundled name, a recording (.jsonl), a bag, or the "
        "folder of a training run",
    )
    parser.add_argument("out", metavar="OUT", type=Path, help="output file")
    parser.add_argument(
        "--seed", metavar="N", type=int, help="random seed (worlds and training runs)"
    )
    look = parser.add_argument_group("camera and scene (worlds and recordings)")
    look.add_argument("--eye", metavar="X,Y,Z", type=_triple, help="camera position [m]")
    look.add_argument(
        "--target", metavar="X,Y,Z", type=_triple, help="point that the camera looks at [m]"
    )
    look.add_argument("--follow", metavar="MODEL", default="", help="follow this model")
    look.add_argument("--top", action="store_true", help="top view of a planar world or a bag")
    look.add_argument(
        "--size",
        metavar="WxH",
        type=_size,
        help=f"image size in pixels (default {_SIZE[0]}x{_SIZE[1]})",
    )
    add_ground(look)
    look.add_argument(
        "--spawn",
        metavar="ROBOT[@X,Y[,YAW]]",
        type=parse_spawn,
        action="append",
        default=[],
        help="also spawn a robot (repeatable)",
    )
    look.add_argument(
        "--drive",
        metavar="V,W",
        type=_pair,
        help="command every robot's cmd_vel: forward [m/s], turning [rad/s]",
    )
    parser.add_argument("--topic", metavar="NAME", help="of a bag: the images to show")
    policy = parser.add_argument_group("of a training run")
    policy.add_argument("--task", metavar="TASK", help="another task than the run's")
    add_import_option(parser)
    add_file_options(parser)
    add_scenario_options(parser)
    add_environment_options(parser)


def opened(args: argparse.Namespace) -> Any:
    """Open the source that the arguments name: a ``gazelle.viewer.sources.FilmSource``.

    Raises:
        Error: It cannot be read.
    """
    from gazelle.viewer import sources

    path = Path(args.source)
    kind = _RUN if sources.is_run(path) else _KINDS.get(path.suffix, _WORLD)
    _refuse_others(args, kind)
    if kind == _RUN:
        return sources.PolicySource(
            path,
            seed=10_000 if args.seed is None else args.seed,
            task=args.task,
            imports=args.imports,
            trust=args.trust,
            **environment_options(args),
        )
    if kind == _BAG:
        from gazelle.viewer.bag_top_view import bag_source

        return bag_source(path, args.topic, top=args.top, size=args.size or _SIZE)
    if kind == _RECORDING:
        return sources.RecordingSource(path, lambda simulation: _camera(simulation, args))
    return _running(args)


def _refuse_others(args: argparse.Namespace, kind: str) -> None:
    """Check that no option was written that this kind of source has no use for.

    Raises:
        Error: There is one.
    """
    values = {"--import": args.imports, "--no-ground": not args.ground}
    for option, takers in _TAKERS.items():
        value = values.get(option) if option in values else getattr(args, option.strip("-"))
        if kind not in takers and value not in (None, False, "", []):
            raise Error(
                f"{option} does not apply to {kind}, which {args.source} is",
                hint=f"it applies to {' or '.join(takers)}",
            )


def _running(args: argparse.Namespace) -> Any:
    """Return the pictures of a file that runs."""
    from gazelle import formats
    from gazelle.simulation import Simulation
    from gazelle.viewer.sources import SimulationSource

    world = formats.open_world(args.source, ground=args.ground)
    engine = args.engine or ("planar" if world.kind == "stage" or args.top else "mujoco")
    simulation = Simulation(world, engine, seed=args.seed or 0)
    try:
        for robot in args.spawn:
            spawn(simulation, robot)
        _drive(simulation, args)
        return SimulationSource(simulation, _camera(simulation, args))
    except BaseException:
        simulation.close()
        raise


def _drive(simulation: Simulation, args: argparse.Namespace) -> None:
    if args.drive is None:
        return
    for robot in simulation.robots.values():
        if "cmd_vel" in robot.inputs:
            robot.inputs["cmd_vel"].send(*args.drive)


def _camera(simulation: Simulation, args: argparse.Namespace) -> Any:
    from gazelle.viewer.plan import TopView
    from gazelle.viewer.scene_camera import SceneCamera

    if args.top:
        return TopView(simulation, size=args.size or _SIZE)
    return SceneCamera(
        simulation,
        eye=args.eye,
        target=args.target,
        follow=args.follow,
        size=args.size or _SIZE,
    )


def _triple(text: str) -> tuple[float, float, float]:
    x, y, z = _numbers(text, 3)
    return x, y, z


def _pair(text: str) -> tuple[float, float]:
    forward, turn = _numbers(text, 2)
    return forward, turn


def _numbers(text: str, count: int) -> list[float]:
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) != count or not all(map(math.isfinite, values)):
        raise argparse.ArgumentTypeError(f"expected {count} numbers with commas, not '{text}'")
    return values


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.lower().partition("x")
    if not (width.isdigit() and height.isdigit()) or not all(
        _LEAST <= int(side) <= _MOST for side in (width, height)
    ):
        raise argparse.ArgumentTypeError(
            f"expected WIDTHxHEIGHT, {_LEAST} to {_MOST} pixels each, not '{text}'"
        )
    return int(width), int(height)
