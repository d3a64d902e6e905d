"""The deployed policy drives the burger of a `gazelle run --ros` world, in processes of their own."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys

import numpy as np
import pytest
from fake_robot import Deployed, wait_for

from gazelle_ros import Node

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")


@pytest.fixture
def world(master):
    """Yield a starter of ``gazelle run WORLD --ros`` with a burger, once it measures."""
    started = []

    def start(name, place="turtlebot3_burger", *, rate="1.0"):
        started.append(
            subprocess.Popen(
                [sys.executable, "-m", "gazelle", "run", name, "--ros", "--spawn", place,
                 "--rate", rate],
                env=os.environ | {"ROS_MASTER_URI": master.uri},
                stdout=subprocess.DEVNULL,
            )
        )  # fmt: skip
        with Node("watch", master_uri=master.uri) as node:
            wait_for(
                lambda: "/scan" in dict(node.master.published_topics()),
                "the burger's lidar",
            )

    yield start
    for process in started:
        process.send_signal(signal.SIGINT)
        process.wait(60)


def outcomes(out):
    return re.findall(r"^\(.*\)  ([a-z-]+), ", out, re.MULTILINE)


@pytest.mark.long
def test_it_drives_to_two_goals(master, world, tmp_path, homing):
    world("turtlebot3_stage_1")
    deployed = Deployed(
        tmp_path, master.uri, homing, "--arm", "--goal", "0.6,0.1", "--goal", "0.6,0.7"
    )
    code, out, err = deployed.wait()
    assert outcomes(out) == ["reached"] * 2, err
    assert code == 0


@pytest.mark.long
def test_it_does_not_drive_into_a_wall(master, world, tmp_path, straight_on):
    """The policy drives straight on; the wall is at 1.85 m, and the stop distance large."""
    world("turtlebot3_stage_1", "turtlebot3_burger@1.0,0.0", rate="4")
    log = tmp_path / "log.jsonl"
    deployed = Deployed(
        tmp_path, master.uri, straight_on,
        "--arm", "--goal", "5,0", "--stop-distance", "0.4", "--time-limit", "12", "--log", log,
    )  # fmt: skip
    code, out, err = deployed.wait()
    assert (code, outcomes(out)) == (1, ["time-out"]), err
    events = [json.loads(line) for line in log.read_text().splitlines()]
    assert "obstacle" in {event.get("reason") for event in events if event["event"] == "begin"}
    # Odometry is of the world: the lidar stands 0.032 m behind the robot's middle.
    (goal,) = [event for event in events if event["event"] == "goal"]
    assert 5.0 - goal["distance"] < 1.85 - 0.25


@pytest.mark.slow
@pytest.mark.timeout(3600)
@pytest.mark.parametrize(("stage", "least"), [(1, 0.98), (2, 0.97)])
def test_a_recipe_s_policy_reaches_a_hundred_goals(master, world, tmp_path, stage, least):
    from gazelle.training import train

    run = train(f"TurtleBot3Stage{stage}", out=tmp_path).run
    chance = np.random.default_rng(1)
    free = [
        (x, y)
        for x, y in chance.uniform(-1.3, 1.3, (400, 2))
        if stage == 1 or min(abs(abs(x) - 0.6), 9) > 0.5 or abs(abs(y) - 0.6) > 0.5
    ]
    goals = tmp_path / "goals.txt"
    goals.write_text("".join(f"{x:.2f}, {y:.2f}\n" for x, y in free[:100]))
    world(f"turtlebot3_stage_{stage}", rate="4")
    deployed = Deployed(tmp_path, master.uri, run.folder, "--arm", "--goals", goals)
    out, err = deployed.process.communicate(timeout=3600)
    assert outcomes(out).count("reached") >= 100 * least, out + err
