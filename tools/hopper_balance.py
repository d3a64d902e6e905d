"""Longest time that HopperStayUp's leg can stay up: a search over its actions, from one lean.

The cross-entropy method (R. Y. Rubinstein, 1999): sequences of actions are drawn, those that last longest
say how the next are drawn. It sees nothing and need not: it may try the same start as often as it likes.

    .venv/bin/python tools/hopper_balance.py --roll 0.03 --pitch 0
"""

from __future__ import annotations

import argparse
import sys

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.envs.hopper.task import CONTROL_PERIOD, HopperTask
from gazelle.envs.options import TaskSettings

_ACTIONS = 6
_BEST = 16  # one of so many sequences says how the next are drawn
_KEPT = 0.3  # of how they were drawn before
_ANY = 0.02  # of them are drawn evenly


def main() -> int:
    """Search, and tell of each round."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--roll", type=float, default=0.03, help="at the start [rad]")
    parser.add_argument("--pitch", type=float, default=0.0, help="at the start [rad]")
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--sequences", type=int, default=384, help="in each round")
    parser.add_argument("--seconds", type=float, default=4.0, help="that a sequence is long")
    args = parser.parse_args()
    task = HopperTask(args.sequences, TaskSettings(seed=0))
    steps = round(args.seconds / CONTROL_PERIOD)
    rng = np.random.default_rng(0)
    share = np.full((steps, _ACTIONS), 1.0 / _ACTIONS)
    for number in range(args.rounds):
        draw = rng.random((args.sequences, steps, 1))
        actions = (draw > share.cumsum(axis=1)).sum(axis=2).clip(0, _ACTIONS - 1)
        lasted, height = played(task, (args.roll, args.pitch), actions)
        best = np.argsort(-(lasted + 0.1 * height))[: args.sequences // _BEST]
        found = np.stack([(actions[best] == each).mean(axis=0) for each in range(_ACTIONS)], axis=1)
        share = (1.0 - _ANY) * ((1.0 - _KEPT) * found + _KEPT * share) + _ANY / _ACTIONS
        least, mean, most = (
            CONTROL_PERIOD * value for value in (lasted.min(), lasted.mean(), lasted.max())
        )
        text = f"round {number + 1}: up for {least:.2f} s at least, {mean:.2f} on average, {most:.2f} at most\n"
        sys.stdout.write(text)
    task.close()
    return 0


def played(
    task: HopperTask, lean: tuple[float, float], actions: NDArray[np.int64]
) -> tuple[Floats, Floats]:
    """Control steps that each sequence stays up for, and the sum of its heights meanwhile [m]."""
    task.begin(np.arange(task.nworld))
    task.set_lean(np.tile(lean, (task.nworld, 1)), np.arange(task.nworld))
    up = np.ones(task.nworld, np.bool_)
    lasted, height = np.zeros(task.nworld), np.zeros(task.nworld)
    for row in actions.T:
        up &= ~task.advance(row).terminated
        lasted += up
        height += up * task.robot.placement().position[:, 2]
        if not up.any():
            break
    return lasted, height


if __name__ == "__main__":
    sys.exit(main())
