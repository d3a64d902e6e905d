"""The benchmark runs, with and without the real ROS."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from ros import real

BENCHMARK = Path(__file__).parents[2] / "benchmarks" / "ros.py"


def bench(*arguments):
    words = [sys.executable, str(BENCHMARK), "--rounds", "1", "--seconds", "0.3", *arguments]
    done = subprocess.run(words, capture_output=True, text=True, timeout=120, check=True)
    return done.stdout


@pytest.mark.long
def test_without_the_real_one_ours_is_measured_alone():
    out = bench("--python", sys.executable, "string", "within-calls")
    if "ratio" in out:
        pytest.skip("this interpreter finds the real rospy")
    assert "the real rospy is not installed" in out
    assert re.search(r"String, flat out +/s +[\d,.]+$", out, re.MULTILINE)
    assert re.search(r"service calls +/s +[\d,.]+$", out, re.MULTILINE)


@pytest.mark.long
@pytest.mark.ros
@real.needs_ros
def test_both_are_measured_side_by_side():
    out = bench("persistent")
    assert re.search(r"service, persistent +/s +[\d,.]+ +[\d,.]+ +\d+\.\d\d$", out, re.MULTILINE)
