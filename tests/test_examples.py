"""Quick tests draw the same examples every time, slow ones fresh ones."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
TEST = """
from hypothesis import given, strategies as st

@given(st.lists(st.integers(), min_size=5))
def test_something(numbers):
    print("drawn", numbers)
"""


def drawn(folder, profile):
    (folder / "conftest.py").write_text((HERE / "conftest.py").read_text())
    (folder / "test_it.py").write_text(TEST)
    env = {key: value for key, value in os.environ.items() if key != "GAZELLE_EXAMPLES"}
    env |= {"GAZELLE_EXAMPLES": profile} if profile else {}
    command = [sys.executable, "-m", "pytest", "-q", "-s", "-p", "no:cacheprovider", str(folder)]
    done = subprocess.run(command, env=env, cwd=folder, capture_output=True, text=True, check=True)
    return [line for line in done.stdout.splitlines() if "drawn" in line]


@pytest.mark.long
@pytest.mark.parametrize(("profile", "same"), [("", True), ("fresh", False)])
def test_examples_are_the_same_only_where_they_should(tmp_path, profile, same):
    first, second = drawn(tmp_path, profile), drawn(tmp_path, profile)
    assert len(first) > 20
    assert (first == second) == same
