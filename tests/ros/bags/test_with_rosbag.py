"""Bags of the real rosbag and ours: each reads what the other wrote."""

from __future__ import annotations

import json
import signal
import subprocess
import sys

import pytest
from ros.real import PYTHON, environment, needs_ros, tool

from gazelle_ros import Master, Time, load_message
from gazelle_ros.bags import Bag
from gazelle_ros.bags.info import as_dict, as_yaml, describe
from gazelle_ros.bags.operations import reindex

pytestmark = [pytest.mark.ros, needs_ros]
KINDS = ["none", "bz2", "lz4"]

READ = """
import json, sys, rosbag
bag = rosbag.Bag(sys.argv[1])
print(json.dumps([[t, str(m), s.to_nsec()] for t, m, s in bag.read_messages()]))
"""
WRITE = """
import sys, rosbag, rospy
from std_msgs.msg import String
from sensor_msgs.msg import LaserScan
bag = rosbag.Bag(sys.argv[1], 'w', compression=sys.argv[2], chunk_threshold=2000)
for n in range(50):
    bag.write('/s', String('hello %d' % n), rospy.Time(100 + n, n))
    bag.write('/l', LaserScan(ranges=[n] * 50), rospy.Time(100 + n, 5))
bag.close()
"""


def real_python(script, *arguments):
    done = subprocess.run(
        [PYTHON, "-c", script, *map(str, arguments)],
        env=environment("http://127.0.0.1:1"),
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def ours(path):
    with Bag(path) as bag:
        return [[t, str(m), s.to_nsec()] for t, m, s in bag]


def write(path, kind):
    string, scan = load_message("std_msgs/String"), load_message("sensor_msgs/LaserScan")
    with Bag(path, "w", compression=kind, chunk_threshold=2000) as bag:
        for n in range(50):
            bag.write("/s", string(data=f"hello {n}"), Time(100 + n, n))
            bag.write("/l", scan(ranges=[float(n)] * 50), Time(100 + n, 5))


@pytest.mark.parametrize("kind", KINDS)
def test_the_real_one_reads_ours(tmp_path, kind):
    path = tmp_path / "ours.bag"
    write(path, kind)
    theirs = json.loads(real_python(READ, path))
    assert theirs == ours(path)
    assert len(theirs) == 100


@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
def test_we_read_the_real_one(tmp_path, kind):
    path = tmp_path / "real.bag"
    real_python(WRITE, path, kind)
    assert ours(path) == json.loads(real_python(READ, path))
    assert len(ours(path)) == 100


@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("rates", [False, True])
def test_information_is_the_same(tmp_path, kind, rates):
    path = tmp_path / "ours.bag"
    write(path, kind)
    option = ["--freq"] if rates else []
    with Bag(path) as bag:
        assert tool("", "rosbag", "info", *option, str(path)).strip() == describe(bag, rates=rates)
        yaml = as_yaml(as_dict(bag, rates=rates))
    assert tool("", "rosbag", "info", "-y", *option, str(path)).strip() == yaml.strip()


@pytest.mark.long
def test_the_real_one_appends_to_ours_and_we_to_its(tmp_path):
    path = tmp_path / "both.bag"
    write(path, "none")
    real_python(
        "import sys, rosbag, rospy\nfrom std_msgs.msg import String\n"
        "bag = rosbag.Bag(sys.argv[1], 'a')\n"
        "bag.write('/s', String('theirs'), rospy.Time(500))\nbag.close()",
        path,
    )
    with Bag(path, "a") as bag:
        bag.write("/s", load_message("std_msgs/String")(data="ours"), Time(501))
    theirs = json.loads(real_python(READ, path))
    assert theirs == ours(path)
    assert [row[1] for row in theirs[-2:]] == ['data: "theirs"', 'data: "ours"']


@pytest.mark.long
def test_a_cut_recording_of_the_real_one_is_reindexed(tmp_path):
    path = tmp_path / "cut.bag"
    real_python(WRITE, path, "none")
    before = ours(path)
    data = bytearray(path.read_bytes())
    place = data.index(b"index_pos=") + 10
    data[place : place + 8] = bytes(8)
    path.write_bytes(bytes(data[: len(data) * 2 // 3]))
    reindex(str(path))
    # The file is cut in its own order, which is not that of time.
    assert [row for row in before if row in ours(path)] == ours(path)
    assert len(ours(path)) > 40
    assert json.loads(real_python(READ, path)) == ours(path)


TALK = """
import rospy
from std_msgs.msg import String
rospy.init_node('talker')
pub = rospy.Publisher('/chatter', String, queue_size=10)
rate, n = rospy.Rate(50), 0
while not rospy.is_shutdown():
    pub.publish(str(n)); n += 1; rate.sleep()
"""
LISTEN = """
import rospy, sys
from std_msgs.msg import String
rospy.init_node('listener')
rospy.Subscriber('/chatter', String, lambda m: (sys.stdout.write(m.data + '\\n'), sys.stdout.flush()))
print('ready', flush=True)
rospy.spin()
"""


def start(command, uri, cwd):
    env = environment(uri)
    if command[0] == sys.executable:
        env |= {"PATH": "/usr/bin:/bin"}
    return subprocess.Popen(command, env=env, cwd=cwd, stdout=subprocess.PIPE, text=True)


def finish(process):
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=120)
    return out


def command(kind, *arguments):
    tools = {"ours": [sys.executable, "-m", "gazelle_ros.cli.main", "bag"], "real": ["rosbag"]}
    return [*tools[kind], *arguments]


@pytest.mark.long
@pytest.mark.parametrize(("recorder", "player"), [("ours", "real"), ("real", "ours")])
def test_what_one_records_the_other_plays(tmp_path, recorder, player):
    with Master(port=0) as master:
        talker = start([PYTHON, "-c", TALK], master.uri, tmp_path)
        words = command(recorder, "record", "-O", "r", "-l", "50", "/chatter")
        start(words, master.uri, tmp_path).communicate(timeout=120)
        finish(talker)
        with Bag(tmp_path / "r.bag") as bag:
            recorded = [m.data for _, m, _ in bag]
        assert len(recorded) == 50
        listener = start([PYTHON, "-c", LISTEN], master.uri, tmp_path)
        assert listener.stdout.readline() == "ready\n"
        playing = start(
            command(player, "play", "-q", "--wait-for-subscribers", "-d", "1", "r.bag"),
            master.uri,
            tmp_path,
        )
        playing.communicate(timeout=120)
        heard = [listener.stdout.readline().strip() for _ in recorded]
        assert finish(listener) == ""
    assert heard == recorded
