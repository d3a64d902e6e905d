"""A simulation on a ROS graph: start to first scan, state calls, real-time factor while all is published.

A burger in turtlebot3_world at physics steps of 1 ms. Clients are Debian's real rospy where it is
installed (python3-rospy and its messages), else Gazelle's. The goals are those of the project;
Gazebo classic is not to be had from a package registry, so no figure of it is shown.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import gazelle
from gazelle.bridges import serve_ros
from gazelle_ros import Master, Node, WallClock, load_message, load_service

DEBIAN = "/usr/bin/python3"
TURNS = 8
TOPICS = {
    "/clock": "rosgraph_msgs/Clock",
    "/odom": "nav_msgs/Odometry",
    "/scan": "sensor_msgs/LaserScan",
    "/joint_states": "sensor_msgs/JointState",
    "/tf": "tf2_msgs/TFMessage",
    "/gazebo/model_states": "*",
}
LISTENER = """
import sys
import rospy
rospy.init_node("listener")
for topic, kind in zip(sys.argv[1::2], sys.argv[2::2]):
    message = rospy.AnyMsg
    if kind != "*":
        package, name = kind.split("/")
        message = getattr(__import__(package + ".msg", fromlist=[name]), name)
    rospy.Subscriber(topic, message, lambda heard: None)
rospy.spin()
"""


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(prog="gazelle bench gazebo", description=__doc__)
    parser.add_argument("--seconds", type=float, default=5.0, help="of each window (default 5)")
    parser.add_argument("--runs", type=int, default=5, help="of the start (default 5)")
    args = parser.parse_args()
    warnings.simplefilter("ignore")
    peer = "rospy" if has_rospy() else "gazelle exec (rospy is not installed)"
    print(f"turtlebot3_world with a burger, 1 ms steps; subscribers: {peer}")
    print(f"from command to first /scan      {first_scan(args.runs):8.2f} s     (goal under 1)")
    with Master(port=0, rosout=False) as master:
        idle, server = costs(master.uri, args.seconds)
        print(f"without a server                 {idle:8.1f} real-time factor")
        print(f"server, no subscribers           {server:8.1f}   cost {100 * (idle / server - 1):.1f}%"
              " (goal under 5%)")  # fmt: skip
        print(f"a subscriber on each of {len(TOPICS)} topics {listened(master.uri, args.seconds):8.1f}"
              " real-time factor (goal over 10)")  # fmt: skip
        for words, paused in (("paused", True), ("in real time", False)):
            rate = state_calls(master.uri, args.seconds, paused=paused)
            print(f"set_model_state, {words:<15} {rate:8.0f} calls/s (goal over 1,000)")


def has_rospy() -> bool:
    """Return whether Debian's rospy is installed."""
    return Path("/usr/lib/python3/dist-packages/rospy").is_dir()


def first_scan(runs: int) -> float:
    """Return the median seconds from the command to a scan at a waiting node."""
    times = []
    command = [sys.executable, "-m", "gazelle", "run", "turtlebot3_world", "--ros"]
    with Master(port=0, rosout=False) as master:
        node = Node("listener", master_uri=master.uri, clock=WallClock())
        arrived = threading.Event()
        node.subscribe("/scan", load_message("sensor_msgs/LaserScan"), lambda _scan: arrived.set())
        for _ in range(runs):
            arrived.clear()
            start = time.perf_counter()
            process = subprocess.Popen(
                [*command, "--spawn", "turtlebot3_burger"],
                env={**os.environ, "ROS_MASTER_URI": master.uri},
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            arrived.wait(60.0)
            times.append(time.perf_counter() - start)
            process.terminate()
            process.wait()
        node.close()
    return statistics.median(times)


@contextmanager
def world() -> Iterator[gazelle.Simulation]:
    """Yield the world with its robot."""
    with gazelle.Simulation("turtlebot3_world") as sim:
        place = gazelle.Pose(x=-2.0, y=-0.5)  # between the pillars, where the launch file puts it
        sim.spawn("turtlebot3_burger", name="burger", pose=place, namespace="/")
        sim.run(seconds=1.0)
        yield sim


def costs(uri: str, seconds: float) -> tuple[float, float]:
    """Return real-time factors of one world without bridge and with one, in turns.

    The best of each.
    """
    bare, served = [], []
    with world() as sim:
        for _ in range(TURNS):
            bare.append(pace(sim, seconds / TURNS))
            with serve_ros(sim, uri):
                served.append(pace(sim, seconds / TURNS))
    return max(bare), max(served)


def pace(sim: gazelle.Simulation, seconds: float) -> float:
    """Return the real-time factor."""
    start, began = time.perf_counter(), sim.time
    while time.perf_counter() - start < seconds:
        sim.run(seconds=0.25)
    return (sim.time - began) / (time.perf_counter() - start)


def listened(uri: str, seconds: float) -> float:
    """Return the real-time factor with a rospy subscriber on each topic."""
    with world() as sim, serve_ros(sim, uri) as server, listeners(uri):
        deadline = time.monotonic() + 60.0
        while not heard_everywhere(server.node) and time.monotonic() < deadline:
            sim.step(10)
            time.sleep(0.02)
        return pace(sim, seconds)


def heard_everywhere(node: Node) -> bool:
    """Return whether each topic has a subscriber."""
    _, subscribers, _ = node.master.system_state()
    return set(TOPICS) <= set(subscribers)


@contextmanager
def listeners(uri: str) -> Iterator[None]:
    """Run a program with a subscriber on each topic."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "listener.py"
        script.write_text(LISTENER, encoding="utf-8")
        python = [DEBIAN] if has_rospy() else [sys.executable, "-m", "gazelle", "exec"]
        pairs = [word for pair in TOPICS.items() for word in pair]
        env = {**os.environ, "ROS_MASTER_URI": uri, "ROS_IP": "127.0.0.1"}
        program = subprocess.Popen(
            [*python, str(script), *pairs],
            env={**env, "PYTHONWARNINGS": "ignore"},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            yield
        finally:
            program.kill()
            program.wait()


def state_calls(uri: str, seconds: float, *, paused: bool) -> float:
    """Return persistent calls of ``set_model_state`` a second, from one client."""
    service = load_service("gazebo_msgs/SetModelState")
    request = service._request_class()
    request.model_state.model_name = "burger"
    place = request.model_state.pose  # between the pillars, not in one
    place.position.x, place.position.y, place.orientation.w = -2.0, -0.5, 1.0
    with world() as sim, serve_ros(sim, uri) as server:
        if paused:
            sim.pause()
        thread = threading.Thread(target=server.run)
        thread.start()
        with Node("caller", master_uri=uri, clock=WallClock()) as node:
            client = node.client("/gazebo/set_model_state", service, persistent=True)
            count, start = 0, time.perf_counter()
            while time.perf_counter() - start < seconds:
                client.call(request)
                count += 1
            taken = time.perf_counter() - start
        server.stop()
        thread.join()
    return count / taken


if __name__ == "__main__":
    main()
