"""The programs that ``gazelle bench ros`` times: written for rospy, run with Gazelle's or the real one.

Usage: ``_ros_roles.py gazelle|rospy ROLE [ARGUMENT ...]``; each prints one line of JSON, except the
roles that serve until they are terminated.
"""

from __future__ import annotations

import json
import os
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

if sys.argv[1] == "gazelle":
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "packages" / "gazelle-ros"))
    import gazelle_ros

    gazelle_ros.install()

_BEGIN = time.perf_counter()
import rospy  # noqa: E402  # which one is decided above
from sensor_msgs.msg import Image, LaserScan  # noqa: E402
from std_msgs.msg import String  # noqa: E402
from std_srvs.srv import SetBool, SetBoolResponse  # noqa: E402

_IMPORTED = time.perf_counter()
_SILENCE_S = 0.7
_PATIENCE_S = 20.0
_WARM = 200

KINDS: dict[str, Callable[[], Any]] = {
    "string": lambda: String("x" * 20),
    "image": lambda: Image(
        height=480, width=640, encoding="rgb8", step=1920, data=bytes(480 * 1920)
    ),
    "scan": lambda: LaserScan(ranges=[1.5] * 720),
}


def tell(**figures: float) -> None:
    """Print what was measured."""
    print(json.dumps(figures), flush=True)


def spread(seconds: list[float], unit: float) -> dict[str, float]:
    """Return median and 99th percentile in units of a second's fraction."""
    ordered = sorted(seconds)
    count = len(ordered)
    return {"median": unit * ordered[count // 2], "p99": unit * ordered[int(count * 0.99)]}


def connected(topic: Any) -> None:
    """Wait until somebody is at the other end."""
    deadline = time.monotonic() + _PATIENCE_S
    while topic.get_num_connections() < 1:
        if time.monotonic() > deadline:
            raise SystemExit("nobody is at the other end")
        time.sleep(0.01)


def echo(nodelay: str) -> None:
    """Send back what comes."""
    rospy.init_node("echo")
    publisher = rospy.Publisher("/pong", String, queue_size=None, tcp_nodelay=nodelay == "1")
    rospy.Subscriber("/ping", String, publisher.publish, tcp_nodelay=nodelay == "1")
    rospy.spin()


def ping(nodelay: str, count: str) -> None:
    """Send a message, wait for its echo, again and again."""
    rospy.init_node("ping")
    publisher = rospy.Publisher("/ping", String, queue_size=None, tcp_nodelay=nodelay == "1")
    there = threading.Semaphore(0)
    seen: list[str] = []

    def take(message: Any) -> None:
        seen.append(message.data)
        there.release()

    connected(rospy.Subscriber("/pong", String, take, tcp_nodelay=nodelay == "1"))
    connected(publisher)
    time.sleep(0.3)
    tell(**spread(_round_trips(publisher, there, int(count))[_WARM:], 1e6))
    if seen != [str(number) for number in range(int(count))]:
        raise SystemExit("an echo was lost or changed")


def _round_trips(publisher: Any, there: threading.Semaphore, count: int) -> list[float]:
    trips = []
    for number in range(count):
        begin = time.perf_counter()
        publisher.publish(str(number))
        if not there.acquire(timeout=5):
            raise SystemExit("an echo was lost")
        trips.append(time.perf_counter() - begin)
    return trips


def paced(hertz: str, count: str) -> None:
    """Publish at a steady rate, each message with the time at which it left."""
    rospy.init_node("paced")
    publisher = rospy.Publisher("/paced", String, queue_size=10)
    connected(publisher)
    time.sleep(0.5)
    due = time.monotonic()
    for _ in range(int(count)):
        publisher.publish(str(time.monotonic_ns()))
        due += 1 / float(hertz)
        time.sleep(max(0.0, due - time.monotonic()))
    time.sleep(0.2)


def clocked(count: str) -> None:
    """Measure how old the messages of `paced` are when they arrive."""
    rospy.init_node("clocked")
    ages: list[int] = []
    done = threading.Event()

    def take(message: Any) -> None:
        ages.append(time.monotonic_ns() - int(message.data))
        if len(ages) == int(count):
            done.set()

    rospy.Subscriber("/paced", String, take)
    if not done.wait(_PATIENCE_S):
        raise SystemExit("a message was lost")
    tell(**spread([age / 1e9 for age in ages[10:]], 1e6))


def source(kind: str, seconds: str) -> None:
    """Publish as fast as it goes."""
    rospy.init_node("source")
    message = KINDS[kind]()
    publisher = rospy.Publisher("/flood", type(message), queue_size=None)
    connected(publisher)
    time.sleep(0.3)
    end = time.monotonic() + float(seconds)
    while time.monotonic() < end:
        publisher.publish(message)
    time.sleep(0.5)


def sink(kind: str) -> None:
    """Count the messages of `source`."""
    rospy.init_node("sink")
    arrivals = [0, 0.0, 0.0]

    def take(_message: Any) -> None:
        arrivals[2] = time.perf_counter()
        arrivals[0] += 1
        if arrivals[0] == 1:
            arrivals[1] = arrivals[2]

    size = 1 << 22 if kind == "image" else 1 << 16
    connected(rospy.Subscriber("/flood", type(KINDS[kind]()), take, buff_size=size))
    deadline = time.perf_counter() + _PATIENCE_S
    while not arrivals[0] or time.perf_counter() - arrivals[2] < _SILENCE_S:
        if not arrivals[0] and time.perf_counter() > deadline:
            raise SystemExit("no message came")
        time.sleep(0.1)
    tell(rate=(arrivals[0] - 1) / (arrivals[2] - arrivals[1]), count=arrivals[0])


def server() -> None:
    """Serve a service."""
    rospy.init_node("server")
    rospy.Service("/flip", SetBool, lambda _request: SetBoolResponse(True, "ok"))
    rospy.spin()


def caller(persistent: str, seconds: str) -> None:
    """Call it as often as it goes."""
    rospy.init_node("caller")
    tell(**_calls(persistent == "1", float(seconds)))


def _calls(persistent: bool, seconds: float) -> dict[str, float]:  # noqa: FBT001  # an internal
    rospy.wait_for_service("/flip", 15)
    proxy = rospy.ServiceProxy("/flip", SetBool, persistent=persistent)
    for _ in range(20):
        proxy(True)
    times = []
    start = time.perf_counter()
    while time.perf_counter() - start < seconds:
        begin = time.perf_counter()
        proxy(True)
        times.append(time.perf_counter() - begin)
    rate = len(times) / (time.perf_counter() - start)
    proxy.close()
    return {"rate": rate, **spread(times, 1e6)}


def crowd_out(count: str, hertz: str, seconds: str) -> None:
    """Publish with many publishers at a steady rate, and print the processor time."""
    rospy.init_node("crowd_out")
    publishers = [rospy.Publisher(f"/crowd{i}", String, queue_size=2) for i in range(int(count))]
    for publisher in publishers:
        connected(publisher)
    message = KINDS["string"]()
    due = begin = time.monotonic() + 0.5
    time.sleep(0.5)
    cpu = time.process_time()
    while time.monotonic() - begin < float(seconds):
        for publisher in publishers:
            publisher.publish(message)
        due += 1 / float(hertz)
        time.sleep(max(0.0, due - time.monotonic()))
    share = (time.process_time() - cpu) / (time.monotonic() - begin)
    tell(share=100 * share, threads=_threads())


def crowd_in(count: str, seconds: str) -> None:
    """Subscribe to all of them."""
    rospy.init_node("crowd_in")
    got = [0]

    def take(_message: Any) -> None:
        got[0] += 1

    subscribers = [rospy.Subscriber(f"/crowd{i}", String, take) for i in range(int(count))]
    for subscriber in subscribers:
        connected(subscriber)
    while not got[0]:
        time.sleep(0.01)
    cpu, begin = time.process_time(), time.monotonic()
    time.sleep(float(seconds) - 0.5)
    share = (time.process_time() - cpu) / (time.monotonic() - begin)
    tell(share=100 * share, threads=_threads())


def fleet_in(count: str, seconds: str, pid: str) -> None:
    """Subscribe to the scans of each robot of a fleet, which the process ``pid`` runs."""
    rospy.init_node("fleet_in")
    got = [0] * int(count)

    def take(_message: Any, robot: int) -> None:
        got[robot] += 1

    for robot in range(int(count)):
        rospy.Subscriber(f"/robot_{robot}/base_scan", LaserScan, take, robot)
    deadline = time.monotonic() + _PATIENCE_S
    while min(got) == 0:
        if time.monotonic() > deadline:
            raise SystemExit("the fleet is not heard")
        time.sleep(0.05)
    before, cpu, begin = list(got), _processor(pid), time.monotonic()
    time.sleep(float(seconds))
    took = time.monotonic() - begin
    heard = min(now - then for now, then in zip(got, before, strict=True))
    tell(rate=heard / took, share=100 * (_processor(pid) - cpu) / took)


def _processor(pid: str) -> float:
    """Return processor time that a process has taken [s]."""
    fields = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _threads() -> int:
    tasks = Path("/proc/self/task")
    return len(list(tasks.iterdir())) if tasks.is_dir() else threading.active_count()


def start() -> None:
    """Measure the import of a node, its start and its first message."""
    imports = _IMPORTED - _BEGIN
    begin = time.perf_counter()
    rospy.init_node("start", anonymous=True)
    begun = time.perf_counter()
    publisher = rospy.Publisher("/start", LaserScan, queue_size=1, latch=True)
    publisher.publish(LaserScan())
    rospy.wait_for_message("/start", LaserScan, 5)
    first = time.perf_counter()
    tell(imports=1e3 * imports, init=1e3 * (begun - begin), first=1e3 * (first - begun))


def within(kind: str, seconds: str) -> None:
    """Measure publisher and subscriber in one process."""
    rospy.init_node("within")
    there = threading.Semaphore(0)
    message = KINDS[kind]()
    got = [0]

    def count(_message: Any) -> None:
        got[0] += 1

    publisher = rospy.Publisher("/within", type(message), queue_size=None)
    connected(rospy.Subscriber("/within", type(message), count))
    begin = time.perf_counter()
    sent = 0
    while time.perf_counter() - begin < float(seconds):
        publisher.publish(message)
        sent += 1
    patience = time.perf_counter() + _PATIENCE_S
    while got[0] < sent and time.perf_counter() < patience:  # rospy loses some now and then
        time.sleep(0.0005)
    rate = got[0] / (time.perf_counter() - begin)
    hop = rospy.Publisher("/hop", String, queue_size=None, tcp_nodelay=True)
    connected(rospy.Subscriber("/hop", String, lambda _message: there.release(), tcp_nodelay=True))
    time.sleep(0.2)
    tell(rate=rate, **spread(_round_trips(hop, there, 3000)[_WARM:], 1e6))


def within_calls(persistent: str, seconds: str) -> None:
    """Measure service and client in one process."""
    rospy.init_node("within_calls")
    rospy.Service("/flip", SetBool, lambda _request: SetBoolResponse(True, "ok"))
    tell(**_calls(persistent == "1", float(seconds)))


ROLES: tuple[Callable[..., None], ...] = (
    echo,
    ping,
    paced,
    clocked,
    source,
    sink,
    server,
    caller,
    crowd_out,
    crowd_in,
    fleet_in,
    start,
    within,
    within_calls,
)

if __name__ == "__main__":
    {role.__name__: role for role in ROLES}[sys.argv[2]](*sys.argv[3:])
