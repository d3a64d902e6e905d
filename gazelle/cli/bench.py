"""Run a benchmark of a source checkout. It prints its result, and where there is
one the result of a comparable project measured in the same run.

  gazelle bench
  gazelle bench physics
  gazelle bench recipes --verify --cheap
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import ast
import runpy
import sys
from pathlib import Path

import gazelle
from gazelle.cli import showing
from gazelle.errors import Error, ResolveError, did_you_mean


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "name", nargs="?", metavar="NAME", help="benchmark to run (default: list all)"
    )
    parser.add_argument(
        "arguments", nargs=argparse.REMAINDER, metavar="...", help="arguments of the benchmark"
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    known = benchmarks()
    if args.name is None:
        rows = [(name, _purpose(path)) for name, path in known.items()]
        sys.stdout.write(showing.table([("BENCHMARK", "WHAT IT MEASURES"), *rows]))
        return 0
    if args.name not in known:
        hint = did_you_mean(args.name, known)
        raise ResolveError(f"there is no benchmark '{args.name}'", hint=hint)
    path = known[args.name]
    saved = sys.argv, sys.path
    sys.argv = [f"gazelle bench {args.name}", *args.arguments]
    sys.path = [str(path.parent), *sys.path]  # they import what lies beside them
    try:
        runpy.run_path(str(path), run_name="__main__")
    finally:
        sys.argv, sys.path = saved
    return 0


def benchmarks() -> dict[str, Path]:
    """Return the benchmark scripts by name.

    Raises:
        Error: There is no ``benchmarks`` folder beside the package.
    """
    folder = Path(gazelle.__file__).resolve().parent.parent / "benchmarks"
    if not folder.is_dir():
        raise Error(
            "the benchmarks come with the source code only",
            hint="get a checkout of Gazelle and install it with: pip install -e .",
        )
    return {path.stem: path for path in sorted(folder.glob("*.py")) if _is_run(path)}


def _is_run(path: Path) -> bool:
    """Return whether a file is a benchmark, and not a module that benchmarks import."""
    return path.stem[0] != "_" and '__name__ == "__main__"' in path.read_text(encoding="utf-8")


def _purpose(path: Path) -> str:
    """Return the first line of a script's docstring."""
    text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8")))
    return (text or "").partition("\n")[0]
