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
    from gazelle.training import VERIFIED, list_tasks, recipe_for

    rows = [("TASK", "ALGORITHM", "STEPS", "ENGINE", "VERIFIED", "SECONDS", "ID")]
    for task in list_tasks():
        recipe = recipe_for(task.name)
        found = VERIFIED.get(task.name)
        engine = recipe.training_options.get("engine", "-")
        rows.append(
            (
                task.name,
                recipe.algo,
                f"{recipe.steps:,}",
                str(engine),
                "-" if found is None else _reached(found),
                "-" if found is None else f"{found.seconds:.0f}",
                task.id,
            )
        )
    sys.stdout.write(showing.table(rows))
    sys.stdout.write(
        "\nVERIFIED: goals reached, on starts and goals that were not trained on, by 'gazelle train TASK'\n"
        "and 'gazelle eval RUN --engine ENGINE'; SECONDS: processor time of the training.\n"
        "'gazelle bench recipes' measures the TurtleBot3's again.\n"
    )
    return 0


def _reached(found: Verified) -> str:
    """``planar 100.0 %, mujoco 99.9 %``."""
    return ", ".join(
        f"{engine} {100.0 * rate.value:.1f} %" for engine, rate in found.success.items()
    )
