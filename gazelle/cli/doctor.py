"""Examine this machine: what works, what is missing, and what to type.

The exit code is 1 if there is a problem.
"""

from __future__ import annotations

import argparse
import sys

from gazelle.cli import showing
from gazelle.cli.machine_checks import Finding, Grade, examine
from gazelle_ros.base.output import say


def configure(parser: argparse.ArgumentParser) -> None:
    """Add no arguments."""
    del parser


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    del args
    problems = 0
    for finding in examine():
        say(_lines(finding))
        problems += finding.grade is Grade.PROBLEM
    sys.stdout.write(f"{problems or 'no'} problem{'' if problems == 1 else 's'}\n")
    return 1 if problems else 0


def _lines(finding: Finding) -> str:
    """Return a finding in lines of a terminal; the command of a hint is not broken."""
    text = showing.table([(f"{finding.grade.value:<7}", f"{finding.name:<11}", finding.text)])
    return text + (f"{'':<22}> {finding.hint}\n" if finding.hint else "")
