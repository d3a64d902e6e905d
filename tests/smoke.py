"""Checks of a plain installation: no extra, an empty folder. Run it with that Python.

It is no test of pytest's, for pytest is not installed there: `.ci/plain_wheel` runs it.
"""

from __future__ import annotations

import importlib
import os
import pkgutil
import re
import signal
import subprocess
import sys
import tempfile
import time
from importlib.metadata import requires
from pathlib import Path

BIN = Path(sys.executable).parent
OTHER_NAMES = {"google": "protobuf", "warp": "warp_lang"}
"""Distributions whose module is called otherwise."""
ROBOT = """<robot name="arm"><link name="base"/><link name="hand"/>
<joint name="elbow" type="revolute"><parent link="base"/><child link="hand"/>
<origin xyz="0 0 1"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>"""
LAUNCH = """<launch><param name="robot_description" textfile="$(dirname)/arm.urdf"/>
<node pkg="joint_state_publisher" type="joint_state_publisher" name="jsp"/>
<node pkg="robot_state_publisher" type="robot_state_publisher" name="rsp"/></launch>"""


def main() -> None:
    """Run every check."""
    for check in (every_module_imports, a_simulation_runs, commands_run, a_launch_file_runs):
        started = time.perf_counter()
        check()
        print(f"{check.__name__.replace('_', ' ')}: {time.perf_counter() - started:.1f} s")
    print("1 passed, 0 failed")


def every_module_imports() -> None:
    """Import every module: only packages of extras may be missing."""
    import gazelle

    names = [each.name for each in pkgutil.walk_packages(gazelle.__path__, "gazelle.", _missed)]
    for name in names:
        if not name.endswith("__main__"):
            try:
                importlib.import_module(name)
            except (ImportError, gazelle.Error) as error:
                _excuse(name, error)
    if len(names) < 500:
        raise SystemExit(f"only {len(names)} modules were found")


def _missed(name: str) -> None:
    """Check a package whose modules cannot be listed; its error is judged above."""


def _excuse(module: str, error: Exception) -> None:
    """Raise what is not a missing package of an extra."""
    optional = {
        re.split(r"[^A-Za-z0-9_-]", line)[0].replace("-", "_").lower(): line
        for line in requires("gazelle") or ()
        if "extra ==" in line and not re.search(r"""["'](test|lint|oracle|bench)["']""", line)
    }
    missing = getattr(error, "name", None) or getattr(error.__cause__, "name", None) or ""
    top = missing.split(".")[0].lower()
    if OTHER_NAMES.get(top, top) not in optional:
        raise SystemExit(f"{module} cannot be imported after a plain installation: {error}")


def a_simulation_runs() -> None:
    """Run a simulation: a robot drives, and its lidar sees."""
    import gazelle

    with gazelle.Simulation("turtlebot3_stage_4", seed=0) as sim:
        robot = sim.spawn("turtlebot3_burger", name="r1", pose=gazelle.Pose(x=-0.7))
        robot.inputs["cmd_vel"].send(linear=0.15)
        sim.run(seconds=1.0)
        if not 0.1 < robot.pose.x + 0.7 < 0.2:
            raise SystemExit(f"the burger is at {robot.pose}")
        if robot.sensors["lds_lfcd_sensor"].read().ranges.shape != (360,):
            raise SystemExit("the lidar has not 360 beams")


def commands_run() -> None:
    """Run commands: they do their work, or name the extra that they need."""
    for line in ("run turtlebot3_world --for 1", "check turtlebot3_burger", "tasks", "--version"):
        done = subprocess.run(
            [BIN / "gazelle", *line.split()], check=False, capture_output=True, text=True
        )
        if done.returncode:
            raise SystemExit(f"gazelle {line}: {done.stderr}")
    done = subprocess.run([BIN / "gazelle", "demo"], check=False, capture_output=True, text=True)
    if done.returncode != 1 or 'pip install "gazelle[train]"' not in done.stderr:
        raise SystemExit(f"gazelle demo without its extra: {done.returncode} {done.stderr}")


def a_launch_file_runs() -> None:
    """Run a launch file: the robot's publishers place the hand of an arm."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "arm.urdf").write_text(ROBOT)
        Path(folder, "arm.launch").write_text(LAUNCH)
        port = 11300 + os.getpid() % 1000
        environment = os.environ | {"ROS_MASTER_URI": f"http://127.0.0.1:{port}"}
        launch = [BIN / "gazelle", "launch", "--port", str(port), f"{folder}/arm.launch"]
        process = subprocess.Popen(launch, env=environment, cwd=folder)
        try:
            echo = [BIN / "gazelle", "topic", "echo", "-n", "1", "/tf"]
            heard = _until(echo, environment, "hand")
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(60)
        if "hand" not in heard:
            raise SystemExit(f"no transform of the hand: {heard}")


def _until(command: list[object], environment: dict[str, str], word: str) -> str:
    """Return the output of a command, repeated until a word is in it, for 30 s."""
    heard, end = "", time.monotonic() + 30.0
    while word not in heard and time.monotonic() < end:
        done = subprocess.run(
            [str(each) for each in command],
            check=False,
            env=environment,
            capture_output=True,
            text=True,
            timeout=30,
        )
        heard = done.stdout + done.stderr
        time.sleep(0.2)
    return heard


if __name__ == "__main__":
    main()
