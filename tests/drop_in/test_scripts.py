"""Training scripts, as they are written for openai_ros, run to the end of an episode by `gazelle launch`."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import pytest
from graph import until

import gazelle_ros as ros

LEARN = """#!/usr/bin/env python
import gym
import rospkg
import rospy
from gym import wrappers
{imports}

rospy.init_node('learner', anonymous=True, log_level=rospy.WARN)
env = {make}
env = wrappers.Monitor(env, rospkg.RosPack().get_path('my_training') + '/results', force=True)
table = {{}}
for episode in range(rospy.get_param('/cartpole_v0/nepisodes')):
    state = ''.join(map(str, env.reset()))
    for step in range(rospy.get_param('/cartpole_v0/nsteps')):
        action = step % env.action_space.n
        observation, reward, done, info = env.step(1)
        table[state, action] = reward
        state = ''.join(map(str, observation))
        if done:
            break
env.close()
"""
ONE = {
    "imports": "from openai_ros.task_envs.cartpole_stay_up import stay_up",
    "make": "gym.make('CartPoleStayUp-v0')",
}
TWO = {
    "imports": "from openai_ros.openai_ros_common import StartOpenAI_ROS_Environment",
    "make": "StartOpenAI_ROS_Environment(rospy.get_param('/cartpole_v0/task'))",
}
PARAMETERS = """cartpole_v0:
  task: CartPoleStayUp-v0
  ros_ws_abspath: /home/user/simulation_ws
  nepisodes: 2
  nsteps: 100
"""
LAUNCH = """<launch>
  <rosparam command="load" file="$(find my_training)/config/a.yaml"/>
  <node pkg="my_training" type="learn.py" name="learner" output="screen"/>
</launch>
"""


@pytest.mark.slow
@pytest.mark.parametrize("version", [ONE, TWO], ids=["version 1", "version 2"])
def test_a_training_script_ends_its_episodes(version, tmp_path):
    package = tmp_path / "my_training"
    for name, text in {
        "package.xml": "<package><name>my_training</name></package>",
        "scripts/learn.py": LEARN.format(**version),
        "config/a.yaml": PARAMETERS,
        "launch/train.launch": LAUNCH,
    }.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)
    (package / "scripts" / "learn.py").chmod(0o755)
    info = ros.load_message("openai_ros/RLExperimentInfo")
    with ros.Master(port=0) as master, ros.Node("counter", master_uri=master.uri) as node:
        heard = []
        node.subscribe("/openai/reward", info, heard.append)
        environment = {"ROS_MASTER_URI": master.uri, "ROS_PACKAGE_PATH": str(tmp_path)}
        command = [sys.executable, "-m", "gazelle", "launch", "my_training", "train.launch"]
        with (tmp_path / "said").open("w") as said:
            process = subprocess.Popen(
                command, env={**os.environ, **environment}, stdout=said, stderr=said
            )
            try:
                until(lambda: len(heard) == 2 or process.poll() is not None, timeout=240.0)
                until(lambda: list(package.glob("results/*.stats.json")), timeout=60.0)
            finally:
                process.send_signal(signal.SIGINT)
                process.wait(60.0)
    assert [each.episode_number for each in heard] == [0, 1], (tmp_path / "said").read_text()
    assert heard[1].episode_reward > 0.0
