"""Run pytest with the given arguments; a few tests that fail beside others run once more, alone.

Many tests speak over sockets, start processes and wait for real clocks, and a machine that is busy
with something else can make one of seven thousand late. What fails again alone is broken, and so is
everything where more than a few fail. Both runs are printed, and the last line says which tests
passed only alone: they want mending too.

    python tools/run_tests.py -q -n 2 --dist loadfile -m "not slow"
"""

import json
import subprocess
import sys
from pathlib import Path

TESTS_FAILED = 1  # pytest's exit status
FEW = 3
CACHE = Path(".pytest_cache/v/cache/lastfailed")


def failed() -> list[str]:
    """The tests that failed in the last run, by their names."""
    return sorted(json.loads(CACHE.read_text())) if CACHE.exists() else []


def main(arguments: list[str]) -> int:
    """Run the tests; exit as pytest does."""
    pytest = [sys.executable, "-m", "pytest"]
    CACHE.unlink(missing_ok=True)
    status = subprocess.run([*pytest, *arguments], check=False).returncode
    again = failed()
    if status != TESTS_FAILED or not 0 < len(again) <= FEW:
        return status
    print(f"\n{len(again)} failed beside others; once more, alone:", flush=True)
    status = subprocess.run([*pytest, "-q", "--last-failed", *again], check=False).returncode
    if status == 0:
        print("PASSED ONLY ALONE (mend them):", *again, sep="\n  ", flush=True)
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
