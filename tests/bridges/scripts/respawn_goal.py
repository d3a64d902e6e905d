#!/usr/bin/env python
# ruff: noqa: RUF005, SIM105  it is written as people write such scripts
"""A goal that is deleted and spawned elsewhere, as DQN examples do between episodes."""

import math
import time

import rospy
from gazebo_msgs.msg import ModelStates
from gazebo_msgs.srv import DeleteModel, SpawnModel
from geometry_msgs.msg import Pose, Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Empty
from tf.transformations import euler_from_quaternion

GOAL = """<?xml version='1.0'?><sdf version='1.6'><model name='goal'><link name='link'>
<pose frame=''>0 0 0 0 -0 0</pose><visual name='visual'><geometry><box><size>0.5 0.5 0.01</size>
</box></geometry><material><ambient>1 0 0 1</ambient></material></visual></link>
<static>1</static></model></sdf>"""


class Respawn:
    def __init__(self):
        self.pose = Pose()
        self.there = False
        rospy.Subscriber("gazebo/model_states", ModelStates, self.check)

    def check(self, model):
        self.there = False
        for i in range(len(model.name)):
            if model.name[i] == "goal":
                self.there = True

    def move(self, x, y, delete=False):
        while delete:
            if self.there:
                rospy.wait_for_service("gazebo/delete_model")
                rospy.ServiceProxy("gazebo/delete_model", DeleteModel)("goal")
                break
        self.pose.position.x, self.pose.position.y = x, y
        time.sleep(0.2)
        while self.there:
            pass
        rospy.wait_for_service("gazebo/spawn_sdf_model")
        spawn = rospy.ServiceProxy("gazebo/spawn_sdf_model", SpawnModel)
        print(spawn("goal", GOAL, "robotos_name_space", self.pose, "world").success)


class Env:
    def __init__(self):
        self.yaw = 0.0
        self.pub = rospy.Publisher("cmd_vel", Twist, queue_size=5)
        rospy.Subscriber("odom", Odometry, self.odometry)
        self.reset_proxy = rospy.ServiceProxy("gazebo/reset_simulation", Empty)
        self.goal = Respawn()

    def odometry(self, odom):
        q = odom.pose.pose.orientation
        self.yaw = euler_from_quaternion([q.x, q.y, q.z, q.w])[2]

    def scan(self):
        data = None
        while data is None:
            try:
                data = rospy.wait_for_message("scan", LaserScan, timeout=5)
            except rospy.ROSException:
                pass
        return [3.5 if r == float("Inf") else 0 if math.isnan(r) else r for r in data.ranges]

    def step(self, action):
        cmd = Twist()
        cmd.linear.x = 0.15
        cmd.angular.z = (2 - action) * 0.75
        self.pub.publish(cmd)
        scan = self.scan()
        return len(scan + [self.yaw]), 0.13 > min(scan) > 0


rospy.init_node("turtlebot3_dqn_stage_1")
env = Env()
for episode, (x, y) in enumerate([(0.6, 0.0), (1.0, -1.0), (-0.9, 1.1)]):
    rospy.wait_for_service("gazebo/reset_simulation")
    env.reset_proxy()
    env.scan()
    env.goal.move(x, y, delete=episode > 0)
    print(episode, [env.step(2) for _ in range(2)])
rospy.ServiceProxy("gazebo/delete_model", DeleteModel)("goal")
env.pub.publish(Twist())
