"""Print what a run of the tests skipped, a line each, for ``pytest @FILE``.

    python .ci/skipped.py FILE                   what FILE, of pytest's cache, says of a run before
    python .ci/skipped.py --but-for REASONS ...  what the last run skipped for other reasons, and fail

REASONS holds reasons for which a test may be skipped on a machine that has everything, a line each.
"""

import json
import sys
from pathlib import Path

LAST = Path(".pytest_cache/v/gazelle/skipped")


def main(words: list[str]) -> int:
    """Print what was skipped; 1 where it should not have been."""
    if words[0] != "--but-for":
        print(*json.loads(Path(words[0]).read_text()), sep="\n")  # noqa: T201
        return 0
    lines = [line for name in words[1:] for line in Path(name).read_text().splitlines()]
    allowed = tuple(line for line in lines if line and not line.startswith("#"))
    again = {
        name: reason
        for name, reason in json.loads(LAST.read_text()).items()
        if not reason.startswith(allowed)
    }
    for name, reason in again.items():
        print(f"STILL SKIPPED: {name}: {reason}")  # noqa: T201
    return 1 if again else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
