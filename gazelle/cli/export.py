"""Write the policy of a run for use elsewhere, or the whole run as one file.

A JSON file beside a policy describes its observations and actions: layout,
units, rates, limits, frames.

  gazelle export runs/TurtleBot3Stage1-ppo-20261105-140302
  gazelle export RUN --format numpy --out robot/policy.npz
  gazelle export RUN --format run --out run.zip

onnx:  for ONNX Runtime, TensorRT ...; takes 'observation', gives 'action'.
numpy: arrays alone; gazelle.training.load_actor(FILE).act(observations) acts
       without torch.
run:   configuration, curves, policies and the newest checkpoint; elsewhere
       'gazelle runs --import FILE' unpacks it.
"""  # this is the text of --help

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from gazelle.cli import showing
from gazelle.errors import TaskError
from gazelle_ros.cli.parsing import add_import_option


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("run", metavar="RUN", type=Path, help="folder of a run")
    parser.add_argument(
        "--format", metavar="NAME", default="onnx", help="onnx (default), numpy or run"
    )
    parser.set_defaults(parser=parser)
    parser.add_argument(
        "--best", action="store_true", help="the best policy of the run, not the newest"
    )
    parser.add_argument(
        "--out",
        metavar="PATH",
        type=Path,
        help="file or folder (default RUN/export; of a run RUN.zip)",
    )
    add_import_option(parser)


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    if args.format == "run":
        return _pack(args)
    from gazelle.training.policy_files import check_format, export_policy

    try:
        check_format(args.format)
    except TaskError as error:
        args.parser.error(f"{error.message}: {error.hint}")
    files = export_policy(
        args.run, args.format, args.out, best=args.best, imports=args.imports, trust=args.trust
    )
    sys.stdout.write(
        f"policy:   {files.policy}\n"
        f"contract: {files.contract}\n"
        f"next:     {showing.program()} deploy {files.policy}\n"
    )
    return 0


def _pack(args: argparse.Namespace) -> int:
    """Write the run as one file; returns the exit code."""
    from gazelle.training import pack_run

    folder = args.run.resolve()
    file = pack_run(args.run, args.out or folder.with_name(f"{folder.name}.zip"))
    sys.stdout.write(f"run:  {file}\nnext: {showing.program()} runs --import {file}\n")
    return 0
