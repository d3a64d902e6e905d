"""``tf_echo``, ``tf_monitor`` and ``view_frames`` write what those of ROS write."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from ros.real import environment

from gazelle_ros import Time, load_message
from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.registry import main_of
from gazelle_ros.builtin.static_transform import from_angles

REAL = Path("/usr/lib/tf/tf_echo")
ECHOED = """\
- Translation: [1.181, 1.873, 3.975]
- Rotation: in Quaternion [0.084, 0.073, 0.241, 0.964]
            in RPY (radian) [0.200, 0.100, 0.500]
            in RPY (degree) [11.459, 5.730, 28.648]"""


@pytest.fixture
def tree(make_node):
    """Return ``odom`` to ``base`` to ``laser``, once anybody has received it."""
    kind = load_message("tf2_msgs/TFMessage")
    node = make_node("tree")
    publisher = node.advertise("/tf_static", kind, latch=True)
    publisher.publish(
        kind(
            transforms=[
                link("odom", "base", (1.0, 2.0, 3.0), from_angles(0.5, 0.1, 0.2)),
                link("base", "laser", (0.0, 0.0, 1.0), (0.0, 0.0, 0.0, 1.0)),
            ]
        )
    )
    return publisher


def link(parent, child, place, turn):
    made = load_message("geometry_msgs/TransformStamped")()
    made.header.frame_id, made.child_frame_id, made.header.stamp = parent, child, Time(5)
    where, way = made.transform.translation, made.transform.rotation
    where.x, where.y, where.z = place
    way.x, way.y, way.z, way.w = turn
    return made


def first_lines(command, env, folder, enough):
    """Return the output of a command once it is long enough."""
    with subprocess.Popen(
        command, env=env, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as process:
        said = ""
        try:
            while enough not in said:
                line = process.stdout.readline()
                assert line, said
                said += line
        finally:
            process.terminate()
        return said


def ours(uri, folder, *words, enough):
    command = [sys.executable, "-m", "gazelle_ros.builtin.start", "tf", *words]
    return first_lines(command, os.environ | {"ROS_MASTER_URI": uri}, folder, enough)


def test_tf_echo_prints_a_transform(master, tree, tmp_path):
    said = ours(master.uri, tmp_path, "tf_echo", "odom", "laser", enough="(degree)")
    assert re.match(r"At time 0\.000\n", said), said
    assert said.partition("\n")[2].rstrip() == ECHOED


@pytest.mark.ros
def test_the_real_tf_echo_prints_the_same(master, tree, tmp_path):
    if not REAL.exists():
        pytest.skip("the real tf_echo is not installed (Debian: tf-tools)")
    command = [str(REAL), "odom", "laser"]
    said = first_lines(command, environment(master.uri), tmp_path, "(degree)")
    assert said.partition("\n")[2].rstrip() == ECHOED


def test_tf_echo_names_the_frames_where_one_is_not_there(master, tree, tmp_path):
    said = ours(master.uri, tmp_path, "tf_echo", "odom", "lasre", enough="parent base")
    assert '"lasre" passed to lookupTransform argument source_frame does not exist' in said
    assert "Frame laser exists with parent base." in said


def test_tf_monitor_knows_chain_and_senders(master, tree, tmp_path):
    said = ours(master.uri, tmp_path, "tf_monitor", "odom", "laser", enough="Node:")
    assert "Chain is: odom -> base -> laser" in said
    assert re.search(r"Frame: laser published by /tree\(static\) Average Delay: 0 Max", said)


@pytest.mark.long
def test_view_frames_draws_the_tree(master, tree, tmp_path):
    said = ours(master.uri, tmp_path, "view_frames", enough="written")
    drawn = (tmp_path / "frames.gv").read_text(encoding="utf-8")
    assert '"odom" -> "base"[label="Broadcaster: /tree' in drawn
    assert '"base" -> "laser"' in drawn
    assert (tmp_path / "frames.pdf").exists() == (shutil.which("dot") is not None)
    assert "frames.gv" in said


@pytest.mark.parametrize(
    "words",
    [
        ["tf_echo", "one"],
        ["tf_echo", "a", "b", "0"],
        ["tf_echo", "a", "b", "fast"],
        ["tf_monitor", "one"],
        ["view_frames", "x"],
    ],
)
def test_a_wrong_command_line_is_one_error(words):
    with pytest.raises(RosError, match=r"takes|rate must be above 0"):
        main_of("tf", words[0])(words[1:])
