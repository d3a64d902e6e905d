"""Plans and what the real roslaunch makes of the same files are the same."""

from __future__ import annotations

import json
import os
import re
import subprocess
from pathlib import Path

import pytest
from ros.real import PYTHON, needs_ros

from gazelle_ros.launch import LaunchError, Packages, ParameterCommand, TestPlan, load_launch

pytestmark = [pytest.mark.ros, needs_ros]

ORACLE = Path(__file__).parent / "roslaunch_oracle.py"
ANONYMOUS = re.compile(r"\b(\w+?)(_[A-Za-z]\w*?)?_\d+_\d{10,}")
SETTINGS = {
    "TURTLEBOT3_MODEL": "burger",
    "TURTLEBOT_BASE": "kobuki",
    "TURTLEBOT_STACKS": "hexagons",
    "TURTLEBOT_3D_SENSOR": "kinect",
    "TURTLEBOT_SIMULATION": "false",
    "TURTLEBOT_SERIAL_PORT": "/dev/kobuki",
    "TURTLEBOT_BATTERY": "/sys/battery",
    "TURTLEBOT_GAZEBO_WORLD_FILE": "/x.world",
    "TURTLEBOT_MAP_FILE": "/m.yaml",
}


class Roslaunch:
    """The real one, asked file by file."""

    def __init__(self, environment):
        self.process = subprocess.Popen(
            [PYTHON, str(ORACLE)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=environment | {"PATH": "/usr/bin:/bin", "HOME": os.environ["ROS_HOME"]},
        )

    def load(self, path, args=None):
        request = {"path": str(path), "args": args or {}}
        self.process.stdin.write(json.dumps(request) + "\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())

    def close(self):
        self.process.stdin.close()
        self.process.wait(60)
        self.process.stdout.close()


def plain_value(value):
    if isinstance(value, ParameterCommand):
        return {"command": value.text, "kind": value.kind}
    return {"binary": value.hex()} if isinstance(value, bytes) else value


def plain_node(node):
    keys = (
        "package", "type", "name", "namespace", "arguments", "output", "respawn", "respawn_delay",
        "required", "cwd", "launch_prefix", "environment", "remappings",
    )  # fmt: skip
    keys += ("test_name", "time_limit", "retry") if isinstance(node, TestPlan) else ()
    return {key: getattr(node, key) for key in keys}


def ours(path, environment, args=None):
    packages = Packages(environment)
    try:
        plan = load_launch(path, args, packages=packages, environment=environment)
    except LaunchError as error:
        return {"error": str(error)}
    return {
        "files": plan.files,
        "parameters": {name: plain_value(each.value) for name, each in plan.parameters.items()},
        "clear": plan.clear,
        "actions": [
            [each.command, *([each.file] if each.file else []), each.name] for each in plan.actions
        ],
        "nodes": [plain_node(each) for each in plan.nodes],
        "tests": [plain_node(each) for each in plan.tests],
    }


def comparable(answer):
    """Return the answer without what differs from run to run, or in form only."""
    answer = json.loads(ANONYMOUS.sub(r"\1_ANON", json.dumps(answer, default=str)))
    answer.pop("problems", None)
    answer["actions"] = [
        [part.rstrip("/") for part in action if part != "rosparam"]
        for action in answer.get("actions", [])
    ]
    return answer


@pytest.mark.long
def test_every_launch_file_of_the_corpus(corpus):
    environment = SETTINGS | {"ROS_PACKAGE_PATH": str(corpus)}
    real = Roslaunch(environment)
    files = sorted(
        {*corpus.rglob("*.launch"), *corpus.rglob("*.launch.xml"), *corpus.rglob("*.test")}
    )
    different, same = [], 0
    try:
        for file in files:
            theirs, mine = real.load(file), ours(file, environment)
            if "error" in theirs or "error" in mine:
                if ("error" in theirs) != ("error" in mine):
                    different.append((str(file), theirs.get("error"), mine.get("error")))
            elif comparable(theirs) == comparable(mine):
                same += 1
            else:
                different.append(str(file))
    finally:
        real.close()
    assert different == []
    assert same > 150


TORTURE = """
<launch>
  <arg name="a" default="1"/> <arg name="b" default="$(arg a)2" doc="d"/>
  <param name="~early" value="x"/>
  <group ns="g1">
    <param name="~p" value="$(eval a + 1)"/> <param name="rel" value=" 3 "/>
    <param name="/abs" value="1_0"/> <param name="s" value="true" type="str"/>
    <remap from="x" to="y"/> <env name="E" value="$(arg b)"/>
    <node pkg="p" type="t" name="n1" args="$(arg a)  'q r'" ns="deep/er">
      <remap from="x" to="z"/> <remap from="in" to="~out"/> <param name="own" value="5.0"/>
      <rosparam>{k: {l: [1, 2, {m: 3}]}, deg: deg(180), t: !degrees 90}</rosparam>
      <rosparam param="list">[a, b]</rosparam> <env name="F" value="f"/>
    </node>
    <group ns="/top" clear_params="true"><node pkg="p" type="t" name="n2" clear_params="true"/></group>
    <param name="~late" value="y"/>
    <node pkg="p" type="t" name="n3" respawn="true" respawn_delay="1.5" output="screen"/>
  </group>
  <include file="$(dirname)/inner.launch" ns="inc" pass_all_args="true">
    <arg name="c" value="7"/> <env name="G" value="g"/>
  </include>
  <include file="$(dirname)/inner.launch" ns="inc2"><arg name="c" default="8"/></include>
  <node pkg="p" type="t" name="n4" required="true" launch-prefix="nice"/>
  <rosparam command="delete" param="gone"/> <rosparam ns="a/b" param="c">5</rosparam>
  <test test-name="tt" pkg="p" type="t" retry="1" args="-x"><param name="q" value="1"/></test>
  <unknown/> <node pkg="p" type="t" name="n5" cwd="node"/>
</launch>
"""
INNER = """
<launch>
  <arg name="a" default="inner"/> <arg name="c"/> <param name="a" value="$(arg a)"/>
  <param name="~leaks" value="$(arg c)"/> <remap from="local" to="only"/>
  <node pkg="p" type="t" name="i1" if="$(eval arg('c') == 7)"/>
  <node pkg="p" type="t" name="i2" unless="$(eval c == 7)"/>
</launch>
"""


@pytest.mark.long
@pytest.mark.parametrize("args", [{}, {"a": "5"}, {"b": "x y"}, {"nope": "1"}])
def test_a_file_with_everything(tmp_path, args):
    path = tmp_path / "all.launch"
    path.write_text(TORTURE)
    (tmp_path / "inner.launch").write_text(INNER)
    environment = {"ROS_PACKAGE_PATH": str(tmp_path)}
    real = Roslaunch(environment)
    try:
        theirs = real.load(path, args)
    finally:
        real.close()
    assert "error" not in theirs, theirs
    assert comparable(ours(path, environment, args)) == comparable(theirs)
