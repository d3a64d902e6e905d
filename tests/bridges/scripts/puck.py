#!/usr/bin/env python
# ruff: noqa: F401, I001  it is written as people write such scripts
import rospy
from gazebo_msgs.msg import ContactsState
from gazebo_msgs.srv import SpawnModel, DeleteModel
from geometry_msgs.msg import Pose, Twist, WrenchStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState, Range, Imu
from std_srvs.srv import Empty

URDF = """<?xml version="1.0"?>
<robot name="puck">
 <link name="base_link"><inertial><mass value="5"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
 <visual><geometry><cylinder radius="0.2" length="0.1"/></geometry></visual>
 <collision name="base_collision"><geometry><cylinder radius="0.2" length="0.1"/></geometry></collision></link>
 <link name="sonar_link"><inertial><mass value="0.01"/><inertia ixx="1e-5" ixy="0" ixz="0" iyy="1e-5" iyz="0" izz="1e-5"/></inertial></link>
 <joint name="sonar_joint" type="fixed"><parent link="base_link"/><child link="sonar_link"/><origin xyz="0.2 0 0.1"/></joint>
 <gazebo reference="base_link"><mu1>0.2</mu1><mu2>0.2</mu2><material>Gazebo/Orange</material>
  <sensor name="bump" type="contact"><always_on>true</always_on><update_rate>50</update_rate>
   <contact><collision>base_link_fixed_joint_lump__base_collision_collision</collision></contact>
   <plugin name="bumper_plugin" filename="libgazebo_ros_bumper.so"><bumperTopicName>bumper</bumperTopicName><frameName>world</frameName></plugin></sensor>
 </gazebo>
 <gazebo reference="sonar_link">
  <sensor type="ray" name="sonar"><update_rate>10</update_rate><ray><scan><horizontal><samples>5</samples><resolution>1</resolution><min_angle>-0.1</min_angle><max_angle>0.1</max_angle></horizontal></scan><range><min>0.02</min><max>4</max><resolution>0.01</resolution></range></ray>
   <plugin filename="libgazebo_ros_range.so" name="rng"><gaussianNoise>0.005</gaussianNoise><alwaysOn>true</alwaysOn><updateRate>10</updateRate><topicName>sonar</topicName><frameName>sonar_link</frameName><fov>0.2</fov><radiation>ultrasound</radiation></plugin></sensor>
 </gazebo>
 <gazebo><plugin name="object_controller" filename="libgazebo_ros_planar_move.so"><commandTopic>cmd_vel</commandTopic><odometryTopic>odom</odometryTopic><odometryFrame>odom</odometryFrame><odometryRate>20.0</odometryRate><robotBaseFrame>base_link</robotBaseFrame></plugin>
 <plugin name="p3d" filename="libgazebo_ros_p3d.so"><alwaysOn>true</alwaysOn><updateRate>50.0</updateRate><bodyName>base_link</bodyName><topicName>ground_truth/state</topicName><gaussianNoise>0.01</gaussianNoise><frameName>world</frameName></plugin>
</gazebo>
</robot>"""
rospy.init_node("spawn_puck")
rospy.set_param("puck_description", URDF)
rospy.wait_for_service("/gazebo/spawn_urdf_model")
p = Pose()
p.position.x = -1.0
p.position.y = 1.0
p.position.z = 0.05
r = rospy.ServiceProxy("/gazebo/spawn_urdf_model", SpawnModel)(
    "puck", rospy.get_param("puck_description"), "/puck", p, "world"
)
print(r.success, r.status_message)
b = rospy.wait_for_message("/puck/bumper", ContactsState, 60)
b = rospy.wait_for_message("/puck/bumper", ContactsState, 60)
b = rospy.wait_for_message("/puck/bumper", ContactsState, 60)
print(
    b.header.frame_id,
    len(b.states) > 0,
    b.states[0].collision1_name if b.states else None,
    b.states[0].collision2_name if b.states else None,
    b.states[0].total_wrench.force.z != 0 if b.states else None,
)
o = rospy.wait_for_message("/puck/odom", Odometry, 60)
print(o.header.frame_id, o.child_frame_id)
g = rospy.wait_for_message("/puck/ground_truth/state", Odometry, 60)
print(g.header.frame_id, g.child_frame_id)
s = rospy.wait_for_message("/puck/sonar", Range, 60)
print(s.header.frame_id, s.radiation_type, round(s.field_of_view, 2), s.min_range != s.max_range)
pub = rospy.Publisher("/puck/cmd_vel", Twist, queue_size=1)
while pub.get_num_connections() < 1:
    rospy.sleep(0.05)
t = Twist()
t.linear.y = -0.5
pub.publish(t)
while True:
    rospy.sleep(0.5)
    o2 = rospy.wait_for_message("/puck/odom", Odometry, 60)
    if o.pose.pose.position.y - o2.pose.pose.position.y > 0.3:
        break
print("moved", abs(o.pose.pose.position.x - o2.pose.pose.position.x) < 0.2)
print(rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)("puck").status_message)
rospy.sleep(0.3)
pub.unregister()
rospy.sleep(0.3)
print([t for t, _ in rospy.get_published_topics() if t.startswith("/puck")])
