"""`gazelle launch --test`: what rostest does."""

from __future__ import annotations

import os
import subprocess
import sys
from xml.etree import ElementTree as ET

import pytest

COMMAND = [
    sys.executable,
    "-c",
    "import sys; from gazelle_ros.cli.main import main; sys.exit(main())",
]
CASES = """#!/usr/bin/env python3
import sys, unittest, rospy, rostest, time
from std_msgs.msg import String
class Cases(unittest.TestCase):
    def test_good(self):
        rospy.init_node("cases")
        self.assertEqual(rospy.wait_for_message("/words", String, 60).data, "hello")
        self.assertEqual(rospy.get_param("~mine"), 3)
        self.assertFalse(rospy.has_param("/left"))
        rospy.set_param("/left", 1)
    def test_other(self):
        self.assertTrue({other})
rostest.rosrun("robot", "cases", Cases)
"""
TALKER = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import String
rospy.init_node("talker")
pub = rospy.Publisher("words", String, queue_size=1)
rate = rospy.Rate(20)
while not rospy.is_shutdown():
    pub.publish("hello")
    rate.sleep()
"""
NODE = '<node pkg="robot" type="talker.py" name="talker"/>'


@pytest.fixture
def run(workspace, script, tmp_path):
    script("talker.py", TALKER)

    def start(body, *options):
        folder = workspace / "robot" / "test"
        folder.mkdir(exist_ok=True)
        (folder / "some.test").write_text(f"<launch>\n{NODE}\n{body}\n</launch>")
        done = subprocess.run(
            [*COMMAND, "launch", "--test", *options, "robot", "some.test"],
            env={
                **os.environ,
                "ROS_HOME": str(tmp_path / "home"),
                "ROS_MASTER_URI": "http://127.0.0.1:1",
            },
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )
        file = tmp_path / "home" / "test_results" / "robot" / "rostest-test_some.xml"
        done.results = ET.parse(file).getroot() if file.is_file() else None
        return done

    return start


@pytest.mark.long
def test_all_tests_pass_each_with_a_master_of_its_own(run, script):
    script("cases.py", CASES.format(other=True))
    one = '<test pkg="robot" type="cases.py" test-name="{}"><param name="mine" value="3"/></test>'
    done = run(one.format("first") + one.format("second"))
    assert done.returncode == 0, done.stdout + done.stderr
    assert " * RESULT: SUCCESS\n * TESTS: 4\n * ERRORS: 0\n * FAILURES: 0" in done.stdout
    names = [(e.get("classname"), e.get("name")) for e in done.results.iter("testcase")]
    assert ("robot.rosunit-second", "test_good") in names
    assert done.results.get("name") == "robot.rostest-test_some"


@pytest.mark.long
def test_a_failure_is_told_with_its_text(run, script):
    script("cases.py", CASES.format(other=False))
    done = run(
        '<test pkg="robot" type="cases.py" test-name="t"><param name="mine" value="3"/></test>'
    )
    assert done.returncode == 1
    assert "[robot.rosunit-t/test_other][FAILURE!]" in done.stdout
    (failure,) = done.results.iter("failure")
    assert "AssertionError" in failure.text


def test_a_test_that_takes_too_long_or_says_nothing_is_an_error(run, script):
    script("slow.sh", "#!/bin/sh\nexec sleep 100\n")
    script("mute.sh", "#!/bin/sh\nexit 0\n")
    done = run(
        '<test pkg="robot" type="slow.sh" test-name="slow" time-limit="0.5"/>'
        '<test pkg="robot" type="mute.sh" test-name="mute"/>'
        '<test pkg="robot" type="none.sh" test-name="none"/>'
    )
    assert done.returncode == 1
    assert "max time [0.5s] allotted for test [slow] of type [robot/slow.sh]" in done.stdout
    assert "test [mute] did not generate test results" in done.stdout
    assert "has no program 'none.sh'" in done.stdout
    assert done.results.get("errors") == "3"


def test_a_test_may_be_tried_again(run, script, tmp_path):
    script(
        "flaky.sh",
        f"#!/bin/sh\nfile=${{1#--gtest_output=xml:}}\n"
        f"if [ -e {tmp_path}/tried ]; then bad=; else bad='<failure>no</failure>'; fi\n"
        f"touch {tmp_path}/tried\n"
        "echo \"<testsuites><testsuite><testcase name='x'>$bad</testcase></testsuite></testsuites>\""
        " > $file\n",
    )
    done = run('<test pkg="robot" type="flaky.sh" test-name="t" retry="1"/>')
    assert done.returncode == 0, done.stdout
    assert "it is tried again" in done.stdout


def test_no_test_is_no_success(run):
    done = run("")
    assert done.returncode == 1
    assert " * TESTS: 0" in done.stdout


@pytest.mark.long
def test_the_test_nodes_of_rostest_are_there(run):
    done = run("""
      <param name="/given" value="7"/>
      <test pkg="rostest" type="hztest" test-name="hz" retry="20">
        <param name="topic" value="/words"/><param name="hz" value="20"/>
        <param name="hzerror" value="8"/><param name="test_duration" value="1.0"/></test>
      <test pkg="rostest" type="hztest" test-name="fast">
        <param name="topic" value="/words"/><param name="hz" value="200"/>
        <param name="hzerror" value="1"/><param name="test_duration" value="0.5"/></test>
      <test pkg="rostest" type="paramtest" test-name="param">
        <param name="param_name_target" value="/given"/>
        <param name="param_value_expected" value="7"/></test>
      <test pkg="rostest" type="publishtest" test-name="publish"><rosparam>
        topics: [{name: /words, timeout: 60}, {name: /none, timeout: 0.5, negative: true}]
      </rosparam></test>
      <test pkg="rostest" type="advertisetest" test-name="advertise"><rosparam>
        topics: [{name: /words, type: std_msgs/String}, {name: /none, timeout: 0.5}]
        services: [{name: /talker/get_loggers, type: roscpp/GetLoggers}]
      </rosparam></test>""")
    failed = {e.get("name") for e in done.results.iter("testcase") if len(e)}
    assert failed == {"test_hz", "test_advertise_topics"}, done.stdout
    assert done.results.get("failures") == "2"
    assert "too low" in done.stdout
    assert "Topic [/none] is not advertised" in done.stdout


def test_child_launchers_are_refused():
    done = subprocess.run(
        [*COMMAND, "launch", "-c", "other", "x.launch"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert "this machine only" in done.stderr
