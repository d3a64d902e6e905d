"""Run benchmarks and put what they print into docs/benchmarks.md.

Without arguments all that the page has, else the ones named.
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
BLOCK = r"(<!-- {name} -->\n```text\n)(.*?)(^```$)"


def main() -> None:
    """Refresh the page."""
    text = PAGE.read_text()
    names = sys.argv[1:] or re.findall(r"<!-- (\w+) -->", text)
    for name in names:
        pattern = re.compile(BLOCK.format(name=name), re.DOTALL | re.MULTILINE)
        if not pattern.search(text):
            raise SystemExit(
                f"{PAGE.name} has no place for '{name}': add <!-- {name} --> and a block"
            )
        figures = measured(name).replace("\\", r"\\")
        text = pattern.sub(rf"\g<1>{figures}\g<3>", text, count=1)
        PAGE.write_text(text)


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
