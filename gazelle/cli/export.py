"""Export the policy of a run, or the whole run as one file.

A JSON file next to the policy describes its observations and actions: layout,
units, rates, limits and frames.

  gazelle export runs/TurtleBot3Stage1-ppo-20261105-140302
  gazelle export RUN --format numpy --out robot/policy.npz
  gazelle export RUN --format run --out run.zip

onnx:  for ONNX Runtime or TensorRT; input 'observation', output 'action'.
numpy: arrays only; gazelle.training.load_actor(FILE).act(observations) needs
       no torch.
run:   configuration, curves, policies and the latest checkpoint;
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
    parser.add_argument("run", metavar="RUN", type=Path, help="run folder")
    parser.add_argument(
        "--format", metavar="NAME", default="onnx", help="format: onnx (default), numpy or run"
    )
    parser.set_defaults(parser=parser)
    parser.add_argument(
        "--best", action="store_true", help="use the best policy of the run instead of the latest"
    )
    parser.add_argument(
        "--out",
        metavar="PATH",
        type=Path,
        help="output file or folder (default RUN/export; RUN.zip for run)",
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
