"""The commit that a measurement is of."""

from __future__ import annotations

import subprocess
from functools import cache
from pathlib import Path

from gazelle.errors import Error

ROOT = Path(__file__).parent.parent
_MEASURED = (
    "gazelle",
    "packages",
    "benchmarks",
    "examples",
    "setup.py",
    "constraints.txt",
    ":!gazelle/training/claims.yaml",
)
_DIGITS = 12


def commit() -> str:
    """Return the commit that is checked out, with ``+changes`` where files differ from it."""
    return f"{_git('rev-parse', 'HEAD')[:_DIGITS]}{'+changes' if _changes() else ''}"


def commits() -> int:
    """Return how many commits there are up to the one that is checked out."""
    return int(_git("rev-list", "--count", "HEAD"))


def clean_commit() -> str:
    """Return the commit that is checked out.

    Raises:
        Error: What is measured differs from it.
    """
    changes = _changes()
    if changes:
        raise Error(
            f"these files differ from the commit: {' '.join(changes[:5])}",
            hint="commit them first: a published figure names the commit that it is of",
        )
    return commit()


@cache
def is_since(commit: str, oldest: str) -> bool:
    """Return whether a commit is another one or a descendant of it."""
    known = subprocess.run(
        ["git", "merge-base", "--is-ancestor", oldest, commit],
        cwd=ROOT,
        check=False,
        capture_output=True,
    )
    return known.returncode == 0


def _changes() -> list[str]:
    """Return files that differ from the commit, or that it does not have."""
    lines = _git("status", "--porcelain", "--", *_MEASURED).splitlines()
    return [line[3:] for line in lines]


def _git(*arguments: str) -> str:
    done = subprocess.run(
        ["git", *arguments], cwd=ROOT, check=False, capture_output=True, text=True
    )
    if done.returncode:
        raise Error(
            f"git {arguments[0]} fails: {done.stderr.strip()}",
            hint="figures are measured in a git checkout of Gazelle",
        )
    return done.stdout.rstrip()
