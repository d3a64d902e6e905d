"""Start a launch file of the corpus, and look at what comes up on its graph."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field

from gazelle_ros import Node, WallClock, load_message

# What is there without any robot, and what every node has.
_ALWAYS = {
    "/clock",
    "/gazebo/link_states",
    "/gazebo/model_states",
    "/gazebo/parameter_descriptions",
    "/gazebo/parameter_updates",
    "/gazebo/performance_metrics",
    "/gazebo/set_link_state",
    "/gazebo/set_model_state",
    "/rosout",
    "/rosout_agg",
}
_PATIENCE_S = 150.0


@dataclass(frozen=True)
class Expected:
    """What a launch file brings up.

    Attributes:
        file: ``package file.launch``, and its arguments.
        models: In the world, at least these.
        topics: All there are, without those that Gazebo itself has.
        frames: ``parent>child`` of every transform.
        missing: What the lines say that name what is not there.
        left_out: How many nodes have no program here.
    """

    file: str
    models: str
    topics: str
    frames: str = ""
    missing: tuple[str, ...] = ()
    left_out: int = 0


@dataclass
class Found:
    """What came up."""

    models: list[str] = field(default_factory=list)
    topics: set[str] = field(default_factory=set)
    frames: set[str] = field(default_factory=set)


class Launched:
    """A launch file that runs in a process of its own, and a node that watches the graph."""

    def __init__(self, uri, corpus, folder, file, name="/watcher", more=None):
        self._log = folder / "launch.log"
        with self._log.open("w", encoding="utf-8") as log:
            self._process = subprocess.Popen(
                [sys.executable, "-m", "gazelle", "launch", *file.split()],
                env=environment(uri, corpus, folder) | (more or {}),
                stdout=log,
                stderr=subprocess.STDOUT,
                stdin=subprocess.DEVNULL,
            )
        self.node = Node(name, master_uri=uri, clock=WallClock())
        self.found = Found()
        kind = load_message("tf2_msgs/TFMessage")
        for topic in ("/tf", "/tf_static"):
            self.node.subscribe(topic, kind, self._learn)
        self.node.subscribe(
            "/gazebo/model_states", load_message("gazebo_msgs/ModelStates"), self._count
        )

    @property
    def said(self):
        """What the launch and its nodes have written so far."""
        return self._log.read_text(encoding="utf-8")

    @property
    def ended(self):
        """True once the launch is over."""
        return self._process.poll() is not None

    def look(self):
        """Return the present models, topics and frames."""
        published, subscribed, _ = self.node.master.system_state()
        own = {self.node.name}
        graph = {**published, **subscribed}
        users = {
            topic: {*published.get(topic, ()), *subscribed.get(topic, ())} - own for topic in graph
        }
        self.found.topics = {topic for topic, nodes in users.items() if nodes} - _ALWAYS
        return self.found

    def wait_for(self, models, topics, frames):
        """Wait until at least these are present; a launch that ends before is a failure."""
        deadline = time.monotonic() + _PATIENCE_S
        while True:
            found = self.look()
            if (
                set(models) <= set(found.models)
                and topics <= found.topics
                and frames <= found.frames
            ):
                return found
            assert self._process.poll() is None, self.said
            assert time.monotonic() < deadline, f"{self.said}\n{found}"
            time.sleep(0.1)

    def close(self):
        """Send Ctrl-C, and wait for the end of everything that was started."""
        self.node.close()
        self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(60)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
            raise
        return self._process.returncode

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _learn(self, message):
        for each in message.transforms:
            self.found.frames.add(f"{each.header.frame_id}>{each.child_frame_id}")

    def _count(self, message):
        self.found.models = list(message.name)


def environment(uri, corpus, folder):
    """Return the environment with the search path, and the model of TurtleBot3."""
    kept = {
        key: value
        for key, value in os.environ.items()
        if not key.startswith(("ROS_", "GAZEBO_", "TURTLEBOT"))
    }
    return kept | {
        "ROS_MASTER_URI": uri,
        "ROS_PACKAGE_PATH": str(corpus),
        "ROS_HOME": str(folder),
        "TURTLEBOT3_MODEL": "burger",
        "PYTHONUNBUFFERED": "1",
    }


def stub_packages(folder, files):
    """Return a folder with packages of empty xacro files, by name.

    Args:
        folder: A new folder is made in it.
        files: Names of files without ``.urdf.xacro``, by package.
    """
    packages = folder / "packages"
    packages.mkdir()
    for name, stems in files.items():
        urdf = packages / name / "urdf"
        urdf.mkdir(parents=True)
        manifest = f"<package format='2'><name>{name}</name><version>0.0.0</version></package>"
        urdf.with_name("package.xml").write_text(manifest, encoding="utf-8")
        for stem in stems:
            empty = "<robot xmlns:xacro='http://ros.org/wiki/xacro'/>"
            (urdf / f"{stem}.urdf.xacro").write_text(empty, encoding="utf-8")
    return packages
