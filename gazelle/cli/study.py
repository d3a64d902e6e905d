"""Run a function for all combinations of parameters and seeds, on all processors
or on a cluster, and write its results into a table. The same command continues
a stopped study.

  gazelle study my_study.py:run --vary speed=0.2,0.5 --seeds 20
  gazelle study my_study.py:run --seeds 1000 --ray auto --out stalls.csv
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

from gazelle_ros.base.argument_types import positive_int


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "function",
        metavar="FILE:FUNCTION",
        help="function to run, called as FUNCTION(seed=..., NAME=...)",
    )
    parser.add_argument(
        "--vary",
        metavar="NAME=V1,V2",
        action="append",
        type=_values,
        default=[],
        help="values of a parameter (repeatable)",
    )
    parser.add_argument(
        "--seeds", metavar="N", type=positive_int, default=1, help="number of seeds (default 1)"
    )
    parser.add_argument(
        "--workers",
        metavar="N",
        type=positive_int,
        help="number of processes (default: one per processor)",
    )
    parser.add_argument(
        "--ray",
        metavar="ADDRESS",
        nargs="?",
        const="local",
        help="run the workers on a Ray cluster (default: one on this machine)",
    )
    parser.add_argument(
        "--out",
        metavar="FILE",
        type=Path,
        default=Path("study.csv"),
        help="output table (default study.csv)",
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle.training.study import Study, conduct

    study = Study(function=args.function, vary=dict(args.vary), seeds=args.seeds)
    try:
        result = conduct(study, args.out, workers=args.workers, ray=args.ray, on_row=_show)
    except KeyboardInterrupt:
        sys.stderr.write(f"\nstopped; the same command goes on with {args.out}\n")
        raise
    if sys.stderr.isatty() and result.new:
        sys.stderr.write("\n")
    sys.stdout.write(f"{args.out}: {len(result.rows)} rows, {result.new} of them new\n")
    if result.failed:
        sys.stderr.write(f"{result.failed} calls failed: see the column 'error'\n")
    return 1 if result.failed else 0


def _values(text: str) -> tuple[str, list[Any]]:
    name, equals, values = text.partition("=")
    if not equals or not name.isidentifier() or not values:
        raise argparse.ArgumentTypeError(f"expected NAME=VALUE,VALUE..., not '{text}'")
    return name, [_value(each) for each in values.split(",")]


def _value(text: str) -> Any:
    try:
        return json.loads(text)
    except ValueError:
        return text


def _show(done: int, total: int) -> None:
    if sys.stderr.isatty():
        sys.stderr.write(f"\r{done:,} of {total:,}")
        sys.stderr.flush()
