"""The nodes ``turtlebot3_dqn_stage_N``: learn a stage of TurtleBot3's, then drive the graph's robot."""

from __future__ import annotations

import functools
import sys
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.clients import Gazebo
from gazelle.clients.errors import ClientError
from gazelle.envs.goals import GoalTable
from gazelle.envs.turtlebot3.places import grid_goals, plaza_goals
from gazelle.training.deploy.goals import GoalPlace, GoalResult
from gazelle.training.deploy.node import DeployNode
from gazelle.training.deploy.policies import Policy, open_policy
from gazelle.training.deploy.safety import SafetyLimits
from gazelle_ros import Node
from gazelle_ros.base.interrupts import stopping
from gazelle_ros.base.path_texts import expanded
from gazelle_ros.builtin.arguments import parse_arguments

_CALLBACK = "gazelle.training.graph_results:GraphResults"
_SERVICE_S = 2.0


def run_stage(stage: int, arguments: Sequence[str]) -> int:
    """Train a stage in the simulator, then drive to its goals on the graph until shutdown.

    Private parameters: ``~run``, the folder of a run, takes the place of the training; ``~algo``
    (``dqn``), ``~steps`` (the recipe's), ``~seed`` (0), ``~out`` (``runs``) are those of ``gazelle train``.
    ``~goals``: how many goals to go to; 0, the default, for no end.

    Args:
        stage: 1 to 4.
        arguments: The command line of the node.

    Returns:
        The exit code.

    Raises:
        Error: A parameter is wrong, or the policy cannot drive.
    """
    found = parse_arguments(arguments, f"turtlebot3_dqn_stage_{stage}")
    with found.start() as node, stopping() as stop:
        folder = _learned(node, stage)
        if folder is not None:
            _Tour(node, open_policy(folder), stage, stop).drive()
    return 0


def _learned(node: Node, stage: int) -> Path | None:
    """Return the folder of a run; None if its training was stopped."""
    folder = str(node.get_param("~run", ""))
    if folder:
        return expanded(folder)
    from gazelle.training.progress import choose_progress
    from gazelle.training.session import train

    steps: Any = node.get_param("~steps", None)
    result = train(
        f"TurtleBot3Stage{stage}",
        algo=str(node.get_param("~algo", "dqn")),
        steps=None if steps is None else int(steps),
        seed=int(node.get_param("~seed", 0)),
        out=expanded(str(node.get_param("~out", "runs"))),
        callbacks=[_CALLBACK],
        progress=choose_progress(),
    )
    where = result.run.folder.resolve()
    if result.interrupted:
        sys.stderr.write(f"stopped; go on with: gazelle train --resume {where}\n")
        return None
    sys.stderr.write(f"learned, in {where}: now it drives; next time, _run:={where}\n")
    return where


class _Tour:
    """Goes to the published goals, one after another; a world in which it fails starts again."""

    def __init__(self, node: Node, policy: Policy, stage: int, stop: threading.Event) -> None:
        distance = SafetyLimits.default_stop_distance(policy.contract)
        table = plaza_goals() if stage == 4 else grid_goals()
        self._goals = _goals(table, int(node.get_param("~seed", 0)))
        self._left = int(node.get_param("~goals", 0))
        self._stop = stop
        self._deployed = DeployNode(
            node, policy, SafetyLimits(stop_distance=distance), on_end=self._ended
        )

    def drive(self) -> None:
        """Drive until shutdown, or until a given number of goals are done."""
        with self._deployed as deployed:
            deployed.go_to([next(self._goals)])
            deployed.run(self._stop, arm=True)

    def _ended(self, ended: GoalResult) -> None:
        if ended.outcome == "replaced":  # another client's goal took its place
            return
        goal = ended.goal
        sys.stderr.write(f"({goal.x:g}, {goal.y:g})  {ended.outcome}, {ended.seconds:.1f} s\n")
        if ended.outcome != "reached":
            _restart(self._deployed.node)
        self._left -= 1
        if self._left == 0:
            self._stop.set()
        else:
            self._deployed.go_to([next(self._goals)])


def _goals(table: GoalTable, seed: int) -> Iterator[GoalPlace]:
    """Yield places of a table at random, without end."""
    chance = np.random.default_rng(seed)
    at = np.array([table.start])
    while True:
        x, y = table.places(at)[0].tolist()
        yield GoalPlace(x, y)
        at = table.after(at, chance.random(1))


def _restart(node: Node) -> None:
    """Reset a Gazebo's models; a real robot is put back by hand.

    A real robot is put back by hand.
    """
    try:
        Gazebo(node, timeout=_SERVICE_S).reset_world()
    except ClientError as error:
        sys.stderr.write(f"the world was not reset: {error.message}\n")


stage_1 = functools.partial(run_stage, 1)
stage_2 = functools.partial(run_stage, 2)
stage_3 = functools.partial(run_stage, 3)
stage_4 = functools.partial(run_stage, 4)
