"""A script that starts roscore, roslaunch and the rest by name, and ends them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from ports import free_port

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="it asks pgrep")
SCRIPT = Path(__file__).parents[1] / "scripts" / "session.py"
PRINTED = """
master False
gazebo_ros
physics engine updated
SpawnModel: Successfully spawned entity
time 0.020
publisher 0
gzserver True
launch 0
again True
core 0
"""


@pytest.mark.slow
def test_a_script_that_starts_all_it_needs_itself_runs_unchanged(tmp_path):
    surroundings = {
        "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}",
        "ROS_HOME": str(tmp_path),
        "ROS_PACKAGE_PATH": "",
    }
    done = subprocess.run(
        [sys.executable, "-m", "gazelle", "exec", str(SCRIPT)],
        env=os.environ | surroundings,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        stdin=subprocess.DEVNULL,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    said = [line for line in done.stdout.splitlines() if not line.startswith("Unable to register")]
    assert said == PRINTED.strip().splitlines(), done.stderr
