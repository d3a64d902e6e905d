"""The real ROS 1 of the system, if it is installed: its master and its Python nodes."""

from __future__ import annotations

import contextlib
import os
import subprocess
import time
from pathlib import Path

import pytest
from ports import free_port

from gazelle_ros.errors import RosError
from gazelle_ros.master.proxy import MasterProxy

PYTHON = "/usr/bin/python3"
INSTALLED = (
    Path("/usr/bin/roscore").exists() and Path("/usr/lib/python3/dist-packages/rospy").exists()
)

needs_ros = pytest.mark.skipif(
    not INSTALLED, reason="the real ROS 1 is not installed (Debian: ros-core python3-rospy)"
)

HELPERS = """
import sys, time, rospy
from std_msgs.msg import String
from std_srvs.srv import SetBool, SetBoolResponse
def say(*words): print(*words, flush=True)
"""


def environment(master_uri):
    """Return the environment for real programs to find each other on this machine only."""
    home = Path(os.environ["ROS_HOME"])  # of these tests (tests/conftest.py)
    (home / "log").mkdir(parents=True, exist_ok=True)
    kept = {key: os.environ[key] for key in ("HOME", "LANG", "TMPDIR") if key in os.environ}
    return kept | {
        "PATH": "/usr/bin:/bin:/usr/sbin:/sbin",
        "ROS_MASTER_URI": master_uri,
        "ROS_IP": "127.0.0.1",
        "ROS_HOME": str(home),
        "ROS_LOG_DIR": str(home / "log"),
        "ROS_ROOT": "/usr/share/ros",
        "ROS_DISTRO": "debian",
        "PYTHONWARNINGS": "ignore",
        "PYTHONUNBUFFERED": "1",
    }


def stop(process):
    """End a program the polite way, then the other."""
    if process.poll() is None:
        process.terminate()
        try:
            process.wait(20)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
    for stream in (process.stdin, process.stdout):
        if stream is not None:
            stream.close()


@contextlib.contextmanager
def master(*, core=True, port=None):
    """Run a real roscore (or a bare rosmaster); yields its URI."""
    port = port or free_port()
    uri = f"http://127.0.0.1:{port}/"
    program = ["roscore", "-p", str(port)] if core else ["rosmaster", "--core", "-p", str(port)]
    process = subprocess.Popen(
        program,
        env=environment(uri),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        wait_for_master(uri, core=core)
        yield uri
    finally:
        stop(process)


def wait_for_master(uri, *, core):
    deadline = time.monotonic() + 60
    proxy = MasterProxy(uri, "/test")
    while True:
        with contextlib.suppress(RosError):
            if core:
                proxy.lookup_node("/rosout")
            else:
                proxy.get_pid()
            break
        assert time.monotonic() < deadline, "the real master does not come up"
        time.sleep(0.05)
    proxy.close()


class RealNode:
    """A real rospy program; what it prints is read line by line."""

    def __init__(self, uri, script, *arguments):
        self.process = subprocess.Popen(
            [PYTHON, "-c", HELPERS + script, *arguments],
            env=environment(uri),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    def line(self):
        return self.process.stdout.readline().rstrip("\n")

    def expect(self, *lines):
        for wanted in lines:
            got = self.line()
            assert got == wanted, got + "\n" + (self.rest() if not got else "")

    def rest(self):
        self.process.terminate()
        return self.process.stdout.read()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        stop(self.process)


def tool(uri, *command, timeout=120):
    """Return the output of a real command-line tool."""
    done = subprocess.run(
        command,
        env=environment(uri),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=timeout,
        check=False,
        stdin=subprocess.DEVNULL,
    )
    return done.stdout
