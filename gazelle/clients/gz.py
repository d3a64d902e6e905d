"""The program ``gz`` for scripts that call it: ``gz world``, ``gz physics`` and ``gz model -d``.

It speaks to the simulator on the ROS graph; Gazebo's own speaks to Gazebo's transport.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence

from gazelle.argument_types import NumberParser
from gazelle.clients.gazebo import Gazebo
from gazelle.description.pose import rpy_from_quaternion

_TIMEOUT_S = 10.0


def main(arguments: Sequence[str]) -> int:
    """Do it; returns the exit code.

    Raises:
        ClientError: The simulator refuses.
        MasterUnreachableError: There is no master.
    """
    parser = _parser()
    options = parser.parse_args(arguments)
    with Gazebo(timeout=_TIMEOUT_S) as gazebo:
        return _TASKS[options.command](gazebo, options)


def _parser() -> argparse.ArgumentParser:
    parser = NumberParser(
        prog="gz", description="Steer a simulator from the shell, as Gazebo's gz does."
    )
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
    for each in (world, physics, model):
        each.add_argument("-w", "--world-name", help=argparse.SUPPRESS)
    return parser


def _world(gazebo: Gazebo, options: argparse.Namespace) -> int:
    if options.reset_all:
        gazebo.reset_simulation()
    if options.reset_models:
        gazebo.reset_world()
    if options.pause is not None:
        (gazebo.pause if options.pause else gazebo.unpause)()
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
    if options.pose:
        state = gazebo.model_state(options.model_name)
        angles = rpy_from_quaternion(state.quaternion)
        numbers = " ".join(f"{value:g}" for value in (*state.position, *angles))
        sys.stdout.write(f"{numbers}\n")
    if options.delete:
        gazebo.delete(options.model_name)
    return 0


def _vector(text: str) -> tuple[float, float, float]:
    x, y, z = (float(word) for word in text.replace(",", " ").split())
    return x, y, z


_TASKS: Mapping[str, Callable[[Gazebo, argparse.Namespace], int]] = {
    "model": _model,
    "physics": _physics,
    "world": _world,
}
