"""Run benchmarks and put what they print into the docs.

Without arguments all that docs/benchmarks.md has, else the ones named; ``contacts`` is the table of
docs/physics.md, what contacts cost and how far off they are; ``workers`` is in docs/scale.md. All of physics, in two minutes:

    python tools/update_benchmarks.py physics contacts
"""

from __future__ import annotations

import datetime as dt
import platform
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
PAGE = ROOT / "docs" / "benchmarks.md"
BLOCK = r"(?ms)(<!-- {name} -->\n```text\n)(.*?)(^```$)"
SCALE = ROOT / "docs" / "scale.md"
PHYSICS = ROOT / "docs" / "physics.md"
TABLE = r"(<!-- {name} -->\n)((?:\|.*\n)+)()"


def main() -> None:
    """Refresh the pages."""
    for name in sys.argv[1:] or [*re.findall(r"<!-- (\w+) -->", PAGE.read_text()), "workers"]:
        if name == "workers":
            refresh(SCALE, BLOCK, name, measured(name))
        elif name == "contacts":
            refresh(PHYSICS, TABLE, name, printed("tools/contact_errors.py"))
        else:
            refresh(PAGE, BLOCK, name, measured(name))


def refresh(page: Path, block: str, name: str, figures: str) -> None:
    """Put figures in the place of what a page has of that name."""
    text = page.read_text()
    pattern = re.compile(block.format(name=name))
    if not pattern.search(text):
        raise SystemExit(f"{page.name} has no place for '{name}': add <!-- {name} --> and a block")
    page.write_text(pattern.sub(lambda found: found[1] + figures + found[3], text, count=1))


def printed(script: str) -> str:
    """What a script of this checkout prints."""
    done = subprocess.run(
        [sys.executable, script], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return f"{done.stdout.strip()}\n"


def measured(name: str) -> str:
    """What a benchmark prints, with the day and the machine."""
    command = [str(Path(sys.executable).with_name("gazelle")), "bench", name]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    versions = f"Python {platform.python_version()}, {processor()}"
    return f"{dt.datetime.now(dt.UTC).date()}, {versions}\n{done.stdout.strip()}\n"


def processor() -> str:
    """The name of the processor."""
    info = Path("/proc/cpuinfo")
    if info.exists():
        found = re.search(r"model name\s*: (.*)", info.read_text())
        if found:
            return found[1]
    return platform.processor() or platform.machine()


if __name__ == "__main__":
    main()
