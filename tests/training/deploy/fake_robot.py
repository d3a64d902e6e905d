"""A robot that a test drives through time: it publishes clock, scan and odometry, and hears twists."""

from __future__ import annotations

import math
import os
import signal
import subprocess
import sys
import threading
import time

from gazelle_ros import Node, load_message, load_service

PATIENCE = 60.0


def wait_for(condition, what):
    """Wait until it holds; the deadline is for a machine that is very busy."""
    deadline = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError(f"waited in vain for {what() if callable(what) else what}")
        time.sleep(0.005)


class FakeRobot:
    """Simulated time stands unless it is moved on; what is published is heard by whoever listens."""

    def __init__(self, master_uri, name="robot", ranges=(3.0,) * 24):
        self.node = Node(name, master_uri=master_uri)
        self.node.set_param("/use_sim_time", True)
        self.ranges = list(ranges)
        self.x = self.y = self.yaw = 0.0
        self.time = 10.0
        self.delay = 0.0
        """Age of the readings of its sensors [s]."""
        self.twists = []
        self.results, self.actions, self.status = [], [], []
        self._lock = threading.Lock()
        self._clock = self.advertise("/clock", "rosgraph_msgs/Clock")
        self._scan = self.advertise("/scan", "sensor_msgs/LaserScan")
        self._odom = self.advertise("/odom", "nav_msgs/Odometry")
        self.goals = self.advertise("/move_base_simple/goal", "geometry_msgs/PoseStamped")
        self.listen("/cmd_vel", "geometry_msgs/Twist", self._hear)
        floats = "std_msgs/Float32MultiArray"
        self.listen("/result", floats, lambda m: self.results.append(list(m.data)))
        self.listen("/get_action", floats, lambda m: self.actions.append(list(m.data)))
        self.listen(
            "/gazelle_policy/status", "std_msgs/String", lambda m: self.status.append(m.data)
        )

    def advertise(self, topic, kind):
        return self.node.advertise(topic, load_message(kind), None, latch=topic == "/clock")

    def listen(self, topic, kind, callback):
        self.node.subscribe(topic, load_message(kind), callback)

    def _hear(self, message):
        with self._lock:
            self.twists.append((message.linear.x, message.angular.z))

    @property
    def last(self):
        """The newest twist."""
        with self._lock:
            return self.twists[-1] if self.twists else None

    def tell(self, *, scan=True, odom=True):
        """Publish the time and what the sensors measure."""
        clock = load_message("rosgraph_msgs/Clock")()
        self._set(clock.clock)
        self._clock.publish(clock)
        if odom:
            self._odom.publish(self._odom_message())
        if scan:
            self._scan.publish(self._scan_message())

    def _set(self, stamp, delay=0.0):
        """Write the time into a message."""
        stamp.secs, stamp.nsecs = divmod(round((self.time - delay) * 1e9), 10**9)

    def go(self, seconds, **what):
        """Move on in time, and tell."""
        self.time += seconds
        self.tell(**what)

    def alive(self, until, what):
        """Advance in time, and measure, until something holds."""
        deadline = time.monotonic() + PATIENCE
        while not until():
            if time.monotonic() > deadline:
                raise AssertionError(f"waited in vain for {what}")
            self.go(0.01)
            time.sleep(0.01)

    def send_goal(self, x, y, frame="odom"):
        message = load_message("geometry_msgs/PoseStamped")()
        message.header.frame_id = frame
        message.pose.position.x, message.pose.position.y = x, y
        self.goals.publish(message)

    def arm(self, on=True, node="gazelle_policy"):
        kind = load_service("std_srvs/SetBool")
        client = self.node.client(f"/{node}/arm", kind)
        try:
            return client.call(kind._request_class(data=on), PATIENCE)
        finally:
            client.close()

    def close(self):
        self.node.close()

    def _scan_message(self):
        scan = load_message("sensor_msgs/LaserScan")()
        scan.header.frame_id = "base_scan"
        self._set(scan.header.stamp, self.delay)
        scan.angle_max = 2.0 * math.pi
        scan.angle_increment = 2.0 * math.pi / (len(self.ranges) - 1)
        scan.range_min, scan.range_max = 0.12, 3.5
        scan.ranges = self.ranges
        return scan

    def _odom_message(self):
        odom = load_message("nav_msgs/Odometry")()
        odom.header.frame_id = "odom"
        self._set(odom.header.stamp, self.delay)
        odom.pose.pose.position.x, odom.pose.pose.position.y = self.x, self.y
        odom.pose.pose.orientation.z = math.sin(self.yaw / 2.0)
        odom.pose.pose.orientation.w = math.cos(self.yaw / 2.0)
        return odom


def _as_in_a_terminal():
    """Reset hangups, which the parent may ignore as nohup does, and children would, too."""
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


class Deployed:
    """`gazelle deploy` in a process of its own, in which torch cannot be imported."""

    def __init__(self, folder, master_uri, *arguments):
        blocked = folder / "blocked"
        for name in ("torch", "stable_baselines3", "tensorboard"):
            (blocked / name).mkdir(parents=True, exist_ok=True)
            (blocked / name / "__init__.py").write_text("raise ImportError('no such thing here')\n")
        self.process = subprocess.Popen(
            [sys.executable, "-m", "gazelle", "deploy", *map(str, arguments)],
            env=os.environ | {"PYTHONPATH": str(blocked), "ROS_MASTER_URI": master_uri},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            preexec_fn=_as_in_a_terminal,  # noqa: PLW1509  # it only sets a handler
        )

    @property
    def pid(self):
        return self.process.pid

    def end(self, number):
        """Send a signal and wait for the node and its guard: both hold the pipes."""
        if self.process.poll() is None:
            os.kill(self.pid, number)
        return self.wait()

    def wait(self):
        out, err = self.process.communicate(timeout=PATIENCE)
        return self.process.returncode, out, err

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate(timeout=PATIENCE)
