#!/usr/bin/env python
# ruff: noqa: SIM105, TRY300, UP004, UP008  it is written as people write such scripts
"""The layers of environments as openai_ros has them: connection, controllers, robot, task."""

import rospy
from controller_manager_msgs.srv import SwitchController
from gazebo_msgs.msg import ODEPhysics
from gazebo_msgs.srv import SetPhysicsProperties, SetPhysicsPropertiesRequest
from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import Float64
from std_srvs.srv import Empty


class Connection:
    def __init__(self, max_retry=20):
        self.max_retry = max_retry
        self.unpause = rospy.ServiceProxy("/gazebo/unpause_physics", Empty)
        self.pause = rospy.ServiceProxy("/gazebo/pause_physics", Empty)
        self.reset = rospy.ServiceProxy("/gazebo/reset_simulation", Empty)
        rospy.wait_for_service("/gazebo/set_physics_properties")
        self.set_physics = rospy.ServiceProxy(
            "/gazebo/set_physics_properties", SetPhysicsProperties
        )
        self.do("pause")
        self.do("reset")
        self.init_physics()

    def do(self, name):
        for _ in range(self.max_retry):
            try:
                getattr(self, name)()
                return
            except rospy.ServiceException as e:
                rospy.logerr("%s failed: %s", name, e)
        raise RuntimeError(name)

    def init_physics(self):
        request = SetPhysicsPropertiesRequest()
        request.time_step = Float64(0.001).data
        request.max_update_rate = Float64(1000.0).data
        request.gravity = Vector3(0.0, 0.0, -9.81)
        request.ode_config = ODEPhysics(
            sor_pgs_iters=50, sor_pgs_w=1.3, contact_surface_layer=0.001, erp=0.2, max_contacts=20
        )
        self.do("pause")
        result = self.set_physics(request)
        print(result.success, result.status_message)
        self.do("unpause")


class RobotEnv(object):
    def __init__(self):
        self.gazebo = Connection()
        self.gazebo.do("unpause")
        self.check_sensors()
        rospy.Subscriber("/odom", Odometry, self.on_odom)
        rospy.Subscriber("/scan", LaserScan, self.on_scan)
        self.cmd = rospy.Publisher("/cmd_vel", Twist, queue_size=1)
        rate = rospy.Rate(10)
        while self.cmd.get_num_connections() == 0 and not rospy.is_shutdown():
            try:
                rate.sleep()
            except rospy.ROSInterruptException:
                pass
        self.gazebo.do("pause")

    def on_odom(self, data):
        self.odom = data

    def on_scan(self, data):
        self.scan = data

    def check_sensors(self):
        self.odom = self.wait("/odom", Odometry)
        self.imu = self.wait("/imu", Imu)
        self.scan = self.wait("/scan", LaserScan)

    def wait(self, topic, kind):
        value = None
        while value is None and not rospy.is_shutdown():
            try:
                value = rospy.wait_for_message(topic, kind, timeout=5.0)
            except rospy.ROSException:
                rospy.logerr("%s is not ready yet", topic)
        return value

    def move_base(self, linear, angular, epsilon=0.05):
        cmd = Twist()
        cmd.linear.x, cmd.angular.z = linear, angular
        self.cmd.publish(cmd)
        rate = rospy.Rate(10)
        while not rospy.is_shutdown():
            now = self.wait("/odom", Odometry).twist.twist
            if abs(now.linear.x - linear) <= epsilon and abs(now.angular.z - angular) <= epsilon:
                break
            rate.sleep()


class TaskEnv(RobotEnv):
    def __init__(self):
        super(TaskEnv, self).__init__()
        self.controllers = "/controller_manager/switch_controller"
        self.switch = rospy.ServiceProxy(self.controllers, SwitchController)

    def reset_controllers(self):
        try:
            rospy.wait_for_service(self.controllers, timeout=0.2)
        except rospy.ROSException:
            print("no controllers")

    def reset(self):
        self.gazebo.do("unpause")
        self.reset_controllers()
        self.check_sensors()
        self.move_base(0.0, 0.0)
        self.gazebo.do("pause")
        self.gazebo.do("reset")
        self.gazebo.do("unpause")
        self.check_sensors()
        self.gazebo.do("pause")
        return self.observe()

    def step(self, action):
        self.gazebo.do("unpause")
        self.move_base(*[(0.15, 0.0), (0.05, 0.3), (0.05, -0.3)][action])
        self.gazebo.do("pause")
        return self.observe(), 5, min(self.scan.ranges) < 0.2, {}

    def observe(self):
        return [int(min(r, 6)) for r in self.scan.ranges[:: len(self.scan.ranges) // 5]]


rospy.init_node("example_turtlebot3_qlearn", anonymous=True, log_level=rospy.WARN)
env = TaskEnv()
for episode in range(2):
    first = env.reset()
    for action in range(3):
        obs, reward, done, info = env.step(action)
        print(episode, action, len(obs), reward, done)
env.gazebo.do("unpause")
