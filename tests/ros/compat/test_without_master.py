"""Exceptions without a master are those that programs for ROS catch: the real ones' classes."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest
from ports import free_port
from ros import real

REFUSED = "ConnectionRefusedError"
CALLS = {
    "rospy.get_master().getPid()": REFUSED,
    "rospy.get_master().getSystemState()": REFUSED,
    "rospy.get_master().lookupNode('/a')": REFUSED,
    "rospy.get_master()['/a']": REFUSED,
    "rospy.get_master().__setitem__('/a', 1)": REFUSED,
    "rospy.get_master().__delitem__('/a')": REFUSED,
    "rospy.get_published_topics()": REFUSED,
    "rospy.get_param('/a')": REFUSED,
    "rospy.get_param('/a', 3)": REFUSED,
    "rospy.get_param_cached('/a', 3)": REFUSED,
    "rospy.set_param('/a', 1)": REFUSED,
    "rospy.has_param('/a')": REFUSED,
    "rospy.delete_param('/a')": REFUSED,
    "rospy.search_param('a')": REFUSED,
    "rospy.get_param_names()": REFUSED,
    "rosgraph.Master('/x').getPid()": REFUSED,
    "rosgraph.Master('/x').getParam('/a')": REFUSED,
    "rosgraph.Master('/x').is_online()": None,
    "rosgraph.is_master_online()": None,
    "rosnode.get_node_names()": "ROSNodeIOException",
    "rosnode.rosnode_ping('/a', max_count=1)": "ROSNodeIOException",
    "rosnode.get_api_uri(rosgraph.Master('/x'), '/a')": "ROSNodeIOException",
    "rosnode.get_machines_by_nodes()": "ROSNodeIOException",
    "rosnode.rosnode_info('/a')": "ROSNodeIOException",
    "rosnode.kill_nodes(['/a'])": None,
    "rostopic.get_topic_type('/a')": "ROSTopicIOException",
    "rostopic.get_topic_class('/a')": "ROSTopicIOException",
    "rostopic.find_by_type('std_msgs/String')": "ROSTopicIOException",
    "rostopic.get_info_text('/a')": "ROSTopicIOException",
    "rostopic.get_topic_list()": REFUSED,
    "rosparam.get_param('/a')": "RosParamIOException",
    "rosparam.set_param('/a', '1')": "RosParamIOException",
    "rosparam.delete_param('/a')": "RosParamIOException",
    "rosparam.upload_params('/', {'a': 1})": "RosParamIOException",
    "rosparam.list_params('/')": "RosParamIOException",
    "rosservice.get_service_list()": "ROSServiceIOException",
    "rosservice.get_service_node('/a')": "ROSServiceIOException",
    "rosservice.get_service_type('/a')": "ROSServiceIOException",
    "rosservice.get_service_uri('/a')": "ROSServiceIOException",
    "rosservice.get_service_class_by_name('/a')": "ROSServiceIOException",
    "rosservice.rosservice_find('std_srvs/Empty')": "ROSServiceIOException",
    "rosservice.get_service_args('/a')": "ROSServiceIOException",
}
SCRIPT = f"""
import json, sys
import rosgraph, rosnode, rosparam, rosservice, rospy, rostopic
found = {{}}
for call in {list(CALLS)!r}:
    try:
        eval(call)
    except Exception as error:
        refused = isinstance(error, OSError) and error.errno
        found[call] = [each.__name__ for each in type(error).__mro__], refused
    else:
        found[call] = None, None
print("FOUND", json.dumps(found))
"""


def found(command, env):
    done = subprocess.run(command, env=env, capture_output=True, text=True, check=False)
    lines = [line for line in done.stdout.splitlines() if line.startswith("FOUND ")]
    assert lines, done.stderr
    return json.loads(lines[0].removeprefix("FOUND "))


@pytest.fixture(scope="module")
def script(tmp_path_factory):
    path = tmp_path_factory.mktemp("script") / "ask.py"
    path.write_text(SCRIPT)
    return path


@pytest.fixture(scope="module")
def nowhere():
    return f"http://127.0.0.1:{free_port()}"


@pytest.fixture(scope="module")
def ours(script, nowhere):
    command = [sys.executable, "-m", "gazelle_ros.cli.main", "exec", str(script)]
    return found(command, os.environ | {"ROS_MASTER_URI": nowhere})


@pytest.mark.parametrize("call", CALLS)
def test_errors_have_the_class_that_programs_catch(ours, call):
    classes, number = ours[call]
    if CALLS[call] is None:
        assert classes is None
        return
    assert CALLS[call] in classes
    if CALLS[call] == REFUSED:
        assert number == 111


@pytest.mark.ros
@real.needs_ros
def test_the_real_ones_raise_no_others(ours, script, nowhere):
    theirs = found([real.PYTHON, str(script)], real.environment(nowhere))
    # After another question failed, rospy's cache raises a TypeError of its insides.
    del theirs["rospy.get_param_cached('/a', 3)"]
    for call, (classes, _) in theirs.items():
        mine = ours[call][0]
        assert (mine is None) == (classes is None), call
        assert set(classes or ()) <= set(mine or ()), call
