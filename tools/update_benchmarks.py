"""Run benchmarks and put what they print into the docs, with the day and the commit.

Without arguments all tables, else the ones named. A table of docs/explanation/benchmarks.md
stands behind its benchmark and the arguments (``<!-- learner --all-in -->``); ``contacts`` is the
table of docs/explanation/accuracy.md, errors and costs of contacts. All of physics, in two minutes:

    python tools/update_benchmarks.py physics contacts
"""

from __future__ import annotations

import datetime as dt
import platform
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "benchmarks"))

from _checkout import commit  # noqa: E402  # lies beside the benchmarks

PAGES = ("explanation/benchmarks.md", "explanation/accuracy.md")
BLOCK = re.compile(
    r"(?ms)^<!-- (?P<name>[a-z]+)(?P<arguments> [^>]*?)? -->\n"
    r"(?P<text>```text\n.*?^```\n|(?:\|[^\n]*\n)+\n[^\n]*\n)"
)


@dataclass(frozen=True, slots=True)
class Table:
    """One table of a page."""

    page: Path
    """File that it stands in."""
    name: str
    """Benchmark that prints it."""
    arguments: str
    """Arguments of the benchmark."""

    def refresh(self) -> None:
        """Measure it and put it into the page."""
        if self.name == "contacts":
            new = f"{printed('tools/contact_errors.py')}\n\nMeasured {source()}.\n"
        else:
            # Under ROOT's own gazelle, as the commit is of that.
            figures = printed(
                "-m", "gazelle.cli.main", "bench", self.name, *shlex.split(self.arguments)
            )
            new = f"```text\n{source()}\n{figures}\n```\n"

        def block(found: re.Match[str]) -> str:
            here = (found["name"], (found["arguments"] or "").strip())
            head = found[0][: found.start("text") - found.start()]
            return head + new if here == (self.name, self.arguments) else found[0]

        self.page.write_text(BLOCK.sub(block, self.page.read_text(encoding="utf-8")))


def tables() -> Iterator[Table]:
    """Yield all tables of the docs."""
    for name in PAGES:
        page = ROOT / "docs" / name
        for found in BLOCK.finditer(page.read_text(encoding="utf-8")):
            yield Table(page, found["name"], (found["arguments"] or "").strip())


def printed(*arguments: str) -> str:
    """Run Python in this checkout and return what it prints."""
    done = subprocess.run(
        [sys.executable, *arguments], cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True
    )
    return done.stdout.strip()


def source() -> str:
    """Return what figures are of: day, commit, Python and processor."""
    day = dt.datetime.now(dt.UTC).date()
    return f"{day}, commit {commit()}, {machine()}"


def machine() -> str:
    """Return what measures: Python and the processor."""
    return f"Python {platform.python_version()}, {processor()}"


def processor() -> str:
    """Return the name of the processor."""
    info = Path("/proc/cpuinfo")
    if info.exists():
        found = re.search(r"model name\s*: (.*)", info.read_text())
        if found:
            return found[1]
    return platform.processor() or platform.machine()


def main() -> None:
    """Refresh the pages."""
    known = list(tables())
    unknown = set(sys.argv[1:]) - {table.name for table in known}
    if unknown:
        raise SystemExit(f"no page has a table of {', '.join(sorted(unknown))}")
    for table in known:
        if not sys.argv[1:] or table.name in sys.argv[1:]:
            table.refresh()
            print(f"{table.page.relative_to(ROOT)} has the new figures of {table.name}")


if __name__ == "__main__":
    main()
