"""List the tasks that 'gazelle train' knows, and how it trains them."""

from __future__ import annotations

import argparse
import sys

from gazelle.cli import showing


def configure(parser: argparse.ArgumentParser) -> None:
    """There are no arguments."""
    del parser


def run(args: argparse.Namespace) -> int:
    """Do it; returns the exit code."""
    del args
    from gazelle.training import list_tasks, recipe_for

    rows = [("TASK", "ALGORITHM", "STEPS", "ID")]
    for task in list_tasks():
        recipe = recipe_for(task.name)
        rows.append((task.name, recipe.algo, f"{recipe.steps:,}", task.id))
    sys.stdout.write(showing.table(rows))
    return 0
