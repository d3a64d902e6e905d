"""Measure everything that Gazelle publishes, before a release, and write down what came of it.

Steps are: each training of gazelle/training/claims.yaml with three seeds, each table of the docs,
the slow tests by folder, and ROS 1's own suites. Figures go to where they are published; the outcome
of each step goes to docs/explanation/release-check.md, with the commit. It takes hours. A step that has passed
at a commit is not repeated, so a run that was broken off goes on.

    python tools/release_check.py
    python tools/release_check.py --only 'recipe Kobuki*' 'table physics'
"""

from __future__ import annotations

import argparse
import fnmatch
import os
import shlex
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "benchmarks")]

from _checkout import clean_commit, is_since  # noqa: E402  # lies beside the benchmarks
from _claim_table import expected, percent  # noqa: E402
from update_benchmarks import machine, tables  # noqa: E402

from gazelle.training.claims import (  # noqa: E402
    CLAIMS_FILE,
    HELD_OUT,
    Claim,
    Claims,
    read_claims,
)

REPORT = ROOT / "docs" / "explanation" / "release-check.md"
_TWO_PROCESSES = ("-n", "2", "--dist", "loadfile")
GAZELLE = (sys.executable, "-m", "gazelle.cli.main")


@dataclass(frozen=True, slots=True)
class Step:
    """One thing to measure or to test."""

    name: str
    """Name of the part."""
    command: Sequence[str]
    """Command of the part."""
    judge: Callable[[str], tuple[bool, str]] = lambda output: (True, last_line(output))
    """Returns of its output whether it is good, and a summary of one line."""
    environment: dict[str, str] = field(default_factory=dict)
    """Environment variables that are added."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """Result of a step."""

    good: bool
    seconds: float
    summary: str
    commit: str


def steps(since: str | None = None) -> list[Step]:
    """Return all steps in their order.

    Args:
        since: Trainings of this commit or later are not repeated; by default only today's.
    """
    python = (sys.executable,)
    return [
        *(
            recipe_step(train, since)
            for train in dict.fromkeys(claim.train for claim in read_claims().claims)
        ),
        *(
            Step(f"table {table.name}", (*python, "tools/update_benchmarks.py", table.name))
            for table in tables()
        ),
        *(
            Step(
                f"slow tests of {folder}",
                (*python, "tools/run_tests.py", "-q", *_TWO_PROCESSES, "-m", "slow", *files),
                lambda output: (True, last_line(output, "passed")),
                {"GAZELLE_EXAMPLES": "fresh"},
            )
            for folder, files in slow_tests().items()
        ),
        Step("ROS suites", (*python, "tools/ros_suites.py", "--fetch", "--strict", "--tries", "2")),
    ]


def slow_tests() -> dict[str, list[str]]:
    """Return the files with slow tests, by the folder of tests that they are in."""
    found: dict[str, list[str]] = {}
    for path in sorted((ROOT / "tests").rglob("test_*.py")):
        if "mark.slow" in path.read_text(encoding="utf-8"):
            _, folder, *within = path.relative_to(ROOT).parts
            found.setdefault(folder if within else "the whole", []).append(
                str(path.relative_to(ROOT))
            )
    return found


def recipe_step(train: str, since: str | None = None) -> Step:
    """Return the step that trains with three seeds and writes the success rates."""

    def judge(_: str) -> tuple[bool, str]:
        before = {claim.key: claim for claim in committed().claims if claim.train == train}
        after = [claim for claim in read_claims().claims if claim.train == train]
        pairs = [(before.get(claim.key, claim), claim) for claim in after]
        return (
            not any(falls_short(old, new) for old, new in pairs),
            "; ".join(compared(old, new) for old, new in pairs if new.goals == HELD_OUT),
        )

    name = train.removeprefix("gazelle train ")
    command = (*GAZELLE, "bench", "recipes", "--tasks", name, "--seeds", "0", "1", "2", "--write")
    command = (*command, "--since", since) if since else command
    return Step(f"recipe {name}", command, judge)


@cache
def committed() -> Claims:
    """Return the success rates of the commit, whatever was measured since."""
    name = CLAIMS_FILE.relative_to(ROOT)
    text = subprocess.run(
        ["git", "show", f"HEAD:{name}"], cwd=ROOT, stdout=subprocess.PIPE, check=True
    ).stdout
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / name.name
        file.write_bytes(text)
        return read_claims(file)


def falls_short(old: Claim, new: Claim) -> bool:
    """Return whether most seeds are below the interval that was published before."""
    if old.predicted is None:
        return False
    low = [trial.rate.value < old.predicted[0] for trial in new.trials]
    return 2 * sum(low) > len(low)


def compared(old: Claim, new: Claim) -> str:
    """Return a success rate beside the interval that was published before."""
    rate = "-" if new.success is None else f"{percent(new.success.value)} %"
    before = expected(old) if old.trials else "nothing"
    short = ", BELOW" if falls_short(old, new) else ""
    return f"{new.engine} {rate} (before: {before}{short})"


def last_line(output: str, word: str = "") -> str:
    """Return the last line that is not empty and has a word."""
    lines = [line.strip() for line in output.splitlines() if line.strip() and word in line]
    return lines[-1] if lines else ""


def run(step: Step, commit: str) -> Outcome:
    """Run a step of a commit; its output is shown, and its last line kept."""
    print(f"--- {step.name}: {shlex.join(step.command)}", flush=True)
    start = time.monotonic()
    output = ""
    with subprocess.Popen(
        step.command, cwd=ROOT, env=os.environ | step.environment, stdout=subprocess.PIPE, text=True
    ) as process:
        for line in process.stdout or ():
            print(line, end="", flush=True)
            output += line
    good, summary = step.judge(output) if process.returncode == 0 else (False, last_line(output))
    if process.returncode:
        summary = f"exit code {process.returncode}; {summary}"
    return Outcome(good, round(time.monotonic() - start, 1), summary, commit)


def check(
    chosen: Iterable[Step],
    everything: Sequence[Step],
    report: Path,
    *,
    since: str | None = None,
) -> bool:
    """Run the steps that have not passed yet and write the report after each.

    Args:
        chosen: Steps to run.
        everything: Steps that the report lists.
        report: File with the outcomes so far, to write again.
        since: What passed at this commit or later is not repeated; by default only at today's.

    Returns:
        Whether all of them are good.
    """
    commit = clean_commit()
    oldest = since or commit
    found = {name: each for name, each in outcomes(report).items() if is_since(each.commit, oldest)}
    for step in chosen:
        known = found.get(step.name)
        if known is None or not known.good:
            found[step.name] = run(step, commit)
        report.write_text(written(everything, found), encoding="utf-8")
    return all(found[step.name].good for step in chosen)


def outcomes(report: Path) -> dict[str, Outcome]:
    """Return the outcomes that a report lists, by the steps' names."""
    if not report.exists():
        return {}
    rows = [line[2:-2].split(" | ") for line in report.read_text("utf-8").splitlines()]
    return {
        name: Outcome(good == "good", float(seconds.replace(",", "")), summary, commit)
        for name, good, commit, seconds, summary in (row for row in rows if len(row) == 5)
        if good in ("good", "FAILED")
    }


def written(everything: Sequence[Step], found: dict[str, Outcome]) -> str:
    """Return the report."""
    rows = []
    for step in everything:
        outcome = found.get(step.name)
        if outcome is None:
            rows.append(f"| {step.name} | not run | | | |")
        else:
            good = "good" if outcome.good else "FAILED"
            summary = outcome.summary.replace("|", "/")
            seconds = f"{outcome.seconds:,.0f}"
            rows.append(f"| {step.name} | {good} | {outcome.commit} | {seconds} | {summary} |")
    count = sum(found[step.name].good for step in everything if step.name in found)
    return "\n".join(
        [
            "# Release check",
            "",
            "Written by `make release-check` (`tools/release_check.py`), and not to be edited: everything that is published, measured again.",
            "",
            f"{count} of {len(everything)} steps are good. Each names the commit that it was run at. {machine()}.",
            "",
            "| step | outcome | commit | seconds | result |",
            "|---|---|---|---|---|",
            *rows,
            "",
        ]
    )


def main() -> int:
    """Run the steps that are asked for."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--only", nargs="+", default=["*"], metavar="PATTERN", help="of the steps")
    parser.add_argument(
        "--since", metavar="COMMIT", help="do not repeat what passed at this commit or later"
    )
    args = parser.parse_args()
    everything = steps(args.since)
    chosen = [
        step
        for step in everything
        if any(fnmatch.fnmatch(step.name, pattern) for pattern in args.only)
    ]
    if not chosen:
        parser.error(f"no step is called like {' or '.join(args.only)}")
    good = check(chosen, everything, REPORT, since=args.since)
    subprocess.run([sys.executable, "tools/render_claims.py"], cwd=ROOT, check=True)
    print(f"the report is in {REPORT.relative_to(ROOT)}; commit it with the figures")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
