#!/usr/bin/env python3
"""An environment in the way of gym, with a random agent."""

import random

import rospy
from gazebo_msgs.msg import ModelState
from gazebo_msgs.srv import SetModelState
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Empty


class Env:
    def __init__(self):
        self.vel_pub = rospy.Publisher("/cmd_vel", Twist, queue_size=5)
        self.unpause = rospy.ServiceProxy("/gazebo/unpause_physics", Empty)
        self.pause = rospy.ServiceProxy("/gazebo/pause_physics", Empty)
        self.reset_proxy = rospy.ServiceProxy("/gazebo/reset_simulation", Empty)
        self.set_state = rospy.ServiceProxy("/gazebo/set_model_state", SetModelState)

    def observe(self):
        data = None
        while data is None:
            try:
                data = rospy.wait_for_message("/scan", LaserScan, timeout=5)
            except rospy.ROSException:
                print("no scan")
        return data

    def discretize(self, data, bins=5):
        step = len(data.ranges) // bins
        ranges = [min(r, data.range_max) for r in data.ranges]
        return [int(min(ranges[i * step : (i + 1) * step]) * 2) for i in range(bins)]

    def reset(self):
        rospy.wait_for_service("/gazebo/reset_simulation")
        try:
            self.reset_proxy()
        except rospy.ServiceException:
            print("/gazebo/reset_simulation service call failed")
        start = ModelState(model_name="r1")
        start.pose.position.x = -0.5
        start.pose.orientation.w = 1.0
        self.set_state(start)
        rospy.wait_for_service("/gazebo/unpause_physics")
        self.unpause()
        data = self.observe()
        rospy.wait_for_service("/gazebo/pause_physics")
        self.pause()
        return self.discretize(data)

    def step(self, action):
        self.unpause()
        vel_cmd = Twist()
        vel_cmd.linear.x = 0.15
        vel_cmd.angular.z = 0.6 * (action - 1)
        self.vel_pub.publish(vel_cmd)
        data = self.observe()
        self.pause()
        return self.discretize(data), 1.0, min(data.ranges) < 0.13, {}


if __name__ == "__main__":
    rospy.init_node("train", anonymous=True, log_level=rospy.INFO)
    random.seed(1)
    env = Env()
    first = env.reset()
    for episode in range(3):
        state = env.reset()
        print("episode", episode, len(state), "as the first", state == first)
        total, done = 0.0, False
        for _ in range(3):
            state, reward, done, _ = env.step(random.randrange(3))
            total += reward
        rospy.rostime.wallsleep(0.1)  # ticks that are on their way
        before = rospy.get_time()
        rospy.rostime.wallsleep(0.2)
        print("reward", total, "done", done, "paused", rospy.get_time() == before)
    env.unpause()
