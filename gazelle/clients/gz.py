"""The program ``gz`` for scripts that call it: ``gz world``, ``physics``, ``model``, ``joint``, ``stats``.

It speaks to the simulator on the ROS graph; Gazebo's own speaks to Gazebo's transport.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Mapping, Sequence

import gazelle
from gazelle.clients.gazebo import Gazebo
from gazelle.clients.gz_elsewhere import add_elsewhere, elsewhere
from gazelle.description.pose import rpy_from_quaternion
from gazelle.errors import RosError
from gazelle_ros.base.argument_types import NumberParser
from gazelle_ros.base.bundled_packages import published, published_hint
from gazelle_ros.base.output import say
from gazelle_ros.base.text_files import read_text

_TIMEOUT_S = 10.0
_STATS_S = 0.2
_STATS = "Factor[{:.2f}] SimTime[{:.2f}] RealTime[{:.2f}] Paused[{}]"
_PLACES = ("x", "y", "z", "roll", "pitch", "yaw")


def main(arguments: Sequence[str]) -> int:
    """Run the command; returns the exit code.

    Raises:
        ClientError: The simulator refuses.
        MasterUnreachableError: There is no master.
    """
    parser = _parser()
    words = list(arguments)
    if words[:1] == ["help"]:
        words = [*words[1:2], "--help"]
    options, rest = parser.parse_known_args(words)
    code = elsewhere(options, rest)
    if code is not None:
        return code
    with Gazebo(timeout=_TIMEOUT_S) as gazebo:
        return _TASKS[options.command](gazebo, options)


def _parser() -> argparse.ArgumentParser:
    parser = NumberParser(
        prog="gz", description="Steer a simulator from the shell, as Gazebo's gz does."
    )
    version = f"Gazelle {gazelle.__version__}, in place of Gazebo's gz"
    parser.add_argument("-v", "--version", "--versions", action="version", version=version)
    commands = parser.add_subparsers(dest="command", required=True)
    world = commands.add_parser("world", help="time of the world")
    world.add_argument("-p", "--pause", type=int, choices=(0, 1), help="1 pauses, 0 goes on")
    world.add_argument("-s", "--step", action="store_true", help="make one step")
    world.add_argument("-m", "--multi-step", type=int, metavar="N", help="make N steps")
    world.add_argument("-r", "--reset-all", action="store_true", help="put back all, time too")
    world.add_argument("-o", "--reset-models", action="store_true", help="put back the models")
    physics = commands.add_parser("physics", help="settings of the physics")
    physics.add_argument("-g", "--gravity", type=_vector, metavar="X,Y,Z", help="[m/s^2]")
    physics.add_argument("-s", "--step-size", type=float, metavar="S", help="[s]")
    physics.add_argument("-i", "--iters", type=int, metavar="N", help="of the solver")
    physics.add_argument("-u", "--update-rate", type=float, metavar="HZ", help="steps a second")
    model = commands.add_parser("model", help="models of the world")
    model.add_argument("-m", "--model-name", required=True, metavar="NAME")
    model.add_argument("-d", "--delete", action="store_true", help="take it away")
    model.add_argument("-p", "--pose", action="store_true", help="print x y z roll pitch yaw")
    model.add_argument("-i", "--info", action="store_true", help="print where it is and moves to")
    model.add_argument(
        "-f", "--spawn-file", metavar="FILE", help="put a model of SDF or URDF there"
    )
    for letter, name in zip("xyzRPY", _PLACES, strict=True):
        model.add_argument(f"-{letter}", f"--pose-{letter}", dest=name, type=float)
    joint = commands.add_parser("joint", help="effort of a joint")
    joint.add_argument("-m", "--model-name", required=True, metavar="NAME")
    joint.add_argument("-j", "--joint-name", required=True, metavar="NAME")
    joint.add_argument("-f", "--force", type=float, metavar="F", help="[N or N m]")
    stats = commands.add_parser("stats", help="simulated and real time")
    stats.add_argument("-d", "--duration", type=float, metavar="S", help="end after so long [s]")
    stats.add_argument("-p", "--plot", action="store_true", help="columns for a plot")
    add_elsewhere(commands)
    for each in (world, physics, model, joint, stats):
        each.add_argument("-w", "--world-name", help=argparse.SUPPRESS)
    return parser


def _world(gazebo: Gazebo, options: argparse.Namespace) -> int:
    if options.pause is not None:  # before all else, as Gazebo does
        (gazebo.pause if options.pause else gazebo.unpause)()
    if options.reset_all:
        gazebo.reset_simulation()
    if options.reset_models:
        gazebo.reset_world()
    steps = options.multi_step or int(options.step)
    if steps:
        if not gazebo.physics.paused:
            gazebo.pause()  # as Gazebo's steps do
        gazebo.step(steps)
    return 0


def _physics(gazebo: Gazebo, options: argparse.Namespace) -> int:
    solver = {} if options.iters is None else {"sor_pgs_iters": options.iters}
    gazebo.set_physics(
        time_step=options.step_size,
        max_update_rate=options.update_rate,
        gravity=options.gravity,
        **solver,
    )
    return 0


def _model(gazebo: Gazebo, options: argparse.Namespace) -> int:
    place = [getattr(options, name) for name in _PLACES]
    if options.spawn_file:
        values = [value or 0.0 for value in place]
        _spawn(gazebo, options.model_name, options.spawn_file, values)
    elif any(value is not None for value in place):
        _move(gazebo, options.model_name, place)
    if options.info:
        state = gazebo.model_state(options.model_name)
        rows: tuple[tuple[str, Sequence[float]], ...] = (
            ("position", state.position),
            ("orientation", state.quaternion),
            ("linear", state.linear),
            ("angular", state.angular),
        )
        for name, row in rows:
            sys.stdout.write(f"{name}: {' '.join(f'{value:g}' for value in row)}\n")
    if options.pose:
        state = gazebo.model_state(options.model_name)
        angles = rpy_from_quaternion(state.quaternion)
        numbers = " ".join(f"{value:g}" for value in (*state.position, *angles))
        sys.stdout.write(f"{numbers}\n")
    if options.delete:
        gazebo.delete(options.model_name)
    return 0


def _spawn(gazebo: Gazebo, name: str, file: str, place: Sequence[float]) -> None:
    """Spawn a model from a file as Gazebo does.

    Raises:
        RosError: The file cannot be read.
    """
    try:
        text = read_text(published(file))
    except OSError as error:
        hint = published_hint(file)
        raise RosError(f"the file cannot be read: {error.strerror}", file=file, hint=hint) from None
    x, y, z, roll, pitch, yaw = place
    put = gazebo.spawn_urdf if "<robot" in text else gazebo.spawn_sdf
    put(name, text, position=(x, y, z), rpy=(roll, pitch, yaw))


def _move(gazebo: Gazebo, name: str, place: Sequence[float | None]) -> None:
    """Set the pose of a model; missing values stay."""
    state = gazebo.model_state(name)
    now = (*state.position, *rpy_from_quaternion(state.quaternion))
    x, y, z, roll, pitch, yaw = (
        float(old) if new is None else new for old, new in zip(now, place, strict=True)
    )
    gazebo.set_model_state(name, position=(x, y, z), rpy=(roll, pitch, yaw))


def _joint(gazebo: Gazebo, options: argparse.Namespace) -> int:
    gazebo.clear_efforts(options.joint_name)  # as in Gazebo, it lasts until there is another
    if options.force:
        gazebo.apply_effort(options.joint_name, options.force)
    return 0


def _stats(gazebo: Gazebo, options: argparse.Namespace) -> int:
    begun = before = time.monotonic()
    simulated = gazebo.time
    if options.plot:
        sys.stdout.write("# real-time factor (percent), simtime (sec), realtime (sec), paused\n")
    while options.duration is None or before - begun < options.duration:
        time.sleep(_STATS_S)
        now, there, paused = time.monotonic(), gazebo.time, gazebo.physics.paused
        factor = max(0.0, there - simulated) / (now - before)
        form = "{:.4f}, {:.4f}, {:.4f}, {}" if options.plot else _STATS
        shown = form.format(factor, there, now - begun, "T" if paused else "F")
        say(f"{shown}\n")
        before, simulated = now, there
    return 0


def _vector(text: str) -> tuple[float, float, float]:
    x, y, z = (float(word) for word in text.replace(",", " ").split())
    return x, y, z


_TASKS: Mapping[str, Callable[[Gazebo, argparse.Namespace], int]] = {
    "joint": _joint,
    "model": _model,
    "physics": _physics,
    "stats": _stats,
    "world": _world,
}
