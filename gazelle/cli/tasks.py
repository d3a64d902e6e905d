"""List the tasks that 'gazelle train' knows, and how it trains them."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from gazelle.cli import showing

if TYPE_CHECKING:
    from gazelle.training import Verified


def configure(parser: argparse.ArgumentParser) -> None:
    """There are no arguments."""
    del parser


def run(args: argparse.Namespace) -> int:
    """Do it; returns the exit code."""
    del args
    from gazelle.training import VERIFIED, list_tasks, listed_recipe

    rows = [("TASK", "ALGO", "STEPS", "ENGINE", "PLANAR", "MUJOCO", "SECONDS")]
    for task in list_tasks():
        recipe = listed_recipe(task.id)
        found = VERIFIED.get(task.name)
        rows.append(
            (
                task.name if task.id == f"gazelle/{task.name}-v0" else task.id,
                recipe.algo,
                f"{recipe.steps:,}",
                str(recipe.training_options.get("engine", "-")),
                _reached(found, "planar"),
                _reached(found, "mujoco"),
                "-" if found is None else f"{found.seconds:.0f}",
            )
        )
    sys.stdout.write(showing.table(rows))
    sys.stdout.write(
        "\nFor gym.make a TASK of Gazelle's own is gazelle/TASK-v0.\n"
        "PLANAR, MUJOCO: goals reached after 'gazelle train TASK', on starts and goals\n"
        "that were not trained on, by 'gazelle eval RUN --engine ENGINE'; SECONDS:\n"
        "processor time of the training. 'gazelle bench recipes' measures the\n"
        "TurtleBot3's again.\n"
    )
    return 0


def _reached(found: Verified | None, engine: str) -> str:
    """``99.9 %``; ``-`` where nothing was verified."""
    rate = None if found is None else found.success.get(engine)
    return "-" if rate is None else f"{100.0 * rate.value:.1f} %"
