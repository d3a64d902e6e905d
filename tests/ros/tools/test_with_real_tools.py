"""Our tools write what the real ones write, about the same graph of a real node."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest
from ros.real import RealNode, environment, needs_ros, tool

from gazelle_ros import Master

pytestmark = [pytest.mark.ros, needs_ros]

NODE = """
from sensor_msgs.msg import LaserScan
from geometry_msgs.msg import PoseStamped
from std_msgs.msg import Header
from std_srvs.srv import Empty, EmptyResponse
rospy.init_node('real')
latched = dict(queue_size=1, latch=True)
keep = [rospy.Publisher('/chatter', String, **latched), rospy.Publisher('/scan', LaserScan, **latched),
        rospy.Publisher('/ns/pose', PoseStamped, **latched)]
keep[0].publish('hi: there')
stamp = Header(stamp=rospy.Time(12, 34), frame_id='base')
keep[1].publish(LaserScan(header=stamp, ranges=[1, 2.5, 3], angle_min=-1))
keep[2].publish(PoseStamped())
rospy.Subscriber('/listen', String, lambda m: None)
rospy.Service('/set', SetBool, lambda r: SetBoolResponse(r.data, 'ok %s' % r.data))
rospy.Service('/empty', Empty, lambda r: EmptyResponse())
rospy.set_param('/a', {'b': 1, 'c': [1, 2.5, 'x'], 'd': {'e': 'text\\nmore', 'f': True}})
say('ready')
rospy.spin()
"""

COMMANDS = """
topic list
topic list -v
topic list -p
topic list -s
topic list /ns
topic list --host
topic info /chatter
topic type /scan
topic type /scan/header/stamp
topic find std_msgs/String
topic echo -n1 /chatter
topic echo -n1 /scan
topic echo -n1 -p /scan
topic echo -n1 --noarr /scan
topic echo -n1 --nostr /scan
topic echo -n1 -p --noarr --nostr /scan
topic echo -n1 /scan/ranges
topic echo -n1 /scan/ranges[1]
topic echo -n1 /scan/ranges[0:2]
topic echo -n1 -w5 /scan
topic echo -n1 /scan/header
topic echo -n1 --noarr /scan/ranges
topic echo -n1 /ns/pose/pose/position
topic echo -n1 -p /ns/pose
topic echo -n1 -c /chatter
topic echo -n1 --filter m.data==m.data /chatter
service list
service list -n
service list /real
service info /set
service type /set
service uri /set
service node /set
service args /set
service find std_srvs/SetBool
service call /set true
service call -v /set {data:\u00a0false}
service call /empty
node list
node list -u
node list -a
node list /ns
node info -q /real
node info /real
node info /rosout
node ping -c2 /real
node machine
node machine 127.0.0.1
node cleanup
param list
param list /a
param get /a
param get /a/b
param get /a/c
param get -p /a
param get -p /a/d/e
param get -v /a/b
param set -v /n 4
param set /n -5
param get /n
param set /m {x:\u00a01}
param get /m
param dump
param delete /m
""".strip().splitlines()
VARYING = (
    (re.compile(r"_\d+_\d{13}"), "_ANON"),
    (re.compile(r"time=[\d.]+ms"), "time=T"),
    (re.compile(r"average: [\d.]+ms"), "average: T"),
    (re.compile(r"seq: +\d+"), "seq: N"),
    (re.compile(r"(?m)^(\d+),\d+,"), r"\1,N,"),
    (re.compile(r"direction: inbound.*"), "direction: inbound"),
    (re.compile(r"/real \(http.*"), "/real"),
)
"""What is another each time: names, times, sequence numbers; and ports that only we tell."""


def same_form(text):
    for pattern, replacement in VARYING:
        text = pattern.sub(replacement, text)
    return text


@pytest.fixture(scope="module")
def uri():
    with Master(port=0) as master, RealNode(master.uri, NODE) as node:
        node.expect("ready")
        yield master.uri


def ours(uri, *arguments):
    done = subprocess.run(
        [sys.executable, "-m", "gazelle_ros.cli.main", *arguments],
        env=environment(uri),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.mark.long
@pytest.mark.parametrize("line", COMMANDS)
def test_a_command_writes_the_same(uri, line):
    kind, *rest = [word.replace("\u00a0", " ") for word in line.split(" ")]
    if "delete" in rest:
        ours(uri, "param", "set", "/m", "1")
        mine = ours(uri, kind, *rest)
        tool(uri, "rosparam", "set", "/m", "1")
    else:
        mine = ours(uri, kind, *rest)
    theirs = tool(uri, f"ros{kind}", *rest)
    assert same_form(mine) == same_form(theirs)


def test_loading_and_dumping_are_told_the_same(uri, tmp_path):
    file = str(tmp_path / "x.yaml")
    for words in (["dump", "-v", file, "/a"], ["load", "-v", file, "/copy"]):
        assert ours(uri, "param", *words) == tool(uri, "rosparam", *words)


@pytest.mark.long
def test_what_we_publish_the_real_one_echoes(uri):
    command = ["topic", "pub", "-r", "20", "/out", "geometry_msgs/Point", "{x: 1, z: -2.5}"]
    process = subprocess.Popen(
        [sys.executable, "-m", "gazelle_ros.cli.main", *command],
        env=environment(uri),
        stdout=subprocess.DEVNULL,
    )
    try:
        theirs = tool(uri, "rostopic", "echo", "-n1", "/out")
    finally:
        process.terminate()
        assert process.wait(60) == 0
    assert theirs.endswith("x: 1.0\ny: 0.0\nz: -2.5\n---\n")


@pytest.mark.long
def test_the_real_one_measures_our_rate_as_we_do(uri):
    command = [sys.executable, "-m", "gazelle_ros.cli.main", "topic"]
    talker = subprocess.Popen(
        [*command, "pub", "-r", "50", "/beat", "std_msgs/Int32", "1"],
        env=environment(uri),
        stdout=subprocess.DEVNULL,
    )
    measuring = [
        subprocess.Popen(
            program,
            env=environment(uri),
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        for program in ([*command, "hz", "/beat"], ["rostopic", "hz", "/beat"])
    ]
    rates = []
    for process in measuring:
        # It is the average of all; a pause of either program is in it for a while.
        lines = (text.split()[-1] for text in process.stdout if text.startswith("average rate"))
        for _, text in zip(range(60), lines, strict=False):
            rates.append(float(text))
            if abs(rates[-1] - 50.0) < 7.5:
                break
    for process in [*measuring, talker]:
        process.terminate()
        process.wait(60)
    for process in measuring:
        process.stdout.close()
    good = [rate for rate in rates if abs(rate - 50.0) < 7.5]
    assert len(good) == 2, rates
