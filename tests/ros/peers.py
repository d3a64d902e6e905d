"""The real ROS 1 of Debian, run beside ours; without it these tests skip."""

from __future__ import annotations

import json
import os
import subprocess
from functools import cache
from typing import Any

import pytest

PYTHON = "/usr/bin/python3"


def environment(master_uri: str | None = None, **more: str) -> dict[str, str]:
    """Return the environment in which Debian's nodes and tools run."""
    env = {
        "PATH": "/usr/bin:/bin:/usr/sbin:/sbin",
        "HOME": os.environ.get("HOME", "/tmp"),
        "ROS_IP": "127.0.0.1",
        "ROS_HOME": os.environ.get("ROS_HOME", "/tmp/gazelle-test-ros-home"),
        "ROS_PYTHON_VERSION": "3",
    }
    if master_uri is not None:
        env["ROS_MASTER_URI"] = master_uri
    return env | more


@cache
def has(*modules: str) -> bool:
    """Return whether Debian's Python has these modules."""
    line = "import " + ", ".join(modules)
    try:
        run = subprocess.run(
            [PYTHON, "-c", line], env=environment(), capture_output=True, check=False, timeout=60
        )
    except OSError:
        return False
    return run.returncode == 0


def need(*modules: str) -> None:
    """Skip the test if the real ROS has not these modules."""
    if not has(*modules):
        pytest.skip(f"the real ROS 1 is not installed (no {', '.join(modules)})")


def ask(script: str, question: Any, **env: str) -> Any:
    """Run a script in Debian's Python: it reads JSON from stdin and prints JSON."""
    run = subprocess.run(
        [PYTHON, "-c", script],
        input=json.dumps(question),
        env=environment(**env),
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)
