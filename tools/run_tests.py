"""Run pytest with the given arguments; a few tests that fail beside others run once more, alone.

Many tests speak over sockets, start processes and wait for real clocks, and a machine that is busy
with something else can make one of seven thousand late. What fails again alone is broken, and so is
everything where more than a few fail. Both runs are printed, and the last line says which tests
passed only alone: they want mending too.

The first run shows an assertion's line, the second its values too: to rewrite the assertions of all
files costs 13 s of processor time in each process, where no earlier run has left them.

The temporary folder of the tests is one of their own, and goes with them. What lies in it then,
beside pytest's, would stay behind wherever else the same is done: it fails the run.

    python tools/run_tests.py -q -n 2 --dist loadfile -m "not slow"
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TESTS_FAILED = 1  # pytest's exit status
FEW = 3
CACHE = Path(".pytest_cache/v/cache/lastfailed")


def failed() -> list[str]:
    """Return the failed tests of the last run, by their names."""
    return sorted(json.loads(CACHE.read_text())) if CACHE.exists() else []


def run(arguments: list[str], folder: str) -> int:
    """Run the tests with their temporary files in a folder, and those few that failed once more."""
    pytest = [sys.executable, "-m", "pytest"]
    environment = os.environ | {"TMPDIR": folder}
    CACHE.unlink(missing_ok=True)
    first = [*pytest, "--assert=plain", *arguments]
    status = subprocess.run(first, env=environment, check=False).returncode
    again = failed()
    if status != TESTS_FAILED or not 0 < len(again) <= FEW:
        return status
    print(f"\n{len(again)} failed beside others; once more, alone:", flush=True)
    alone = [*pytest, "-q", "--last-failed", *again]
    status = subprocess.run(alone, env=environment, check=False).returncode
    if status == 0:
        print("PASSED ONLY ALONE (mend them):", *again, sep="\n  ", flush=True)
    return status


def main(arguments: list[str]) -> int:
    """Run the tests; exit as pytest does."""
    folder = tempfile.mkdtemp(prefix="tests-")
    status = run(arguments, folder)
    names = [each.name for each in Path(folder).iterdir()]
    left = sorted(name for name in names if not name.startswith("pytest-of-"))
    if left:
        print("LEFT IN THE TEMPORARY FOLDER (mend it):", *left, sep="\n  ", flush=True)
        status = status or TESTS_FAILED
    if status:
        print(f"the files of the tests are in {folder}", flush=True)
    else:
        shutil.rmtree(folder)
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
