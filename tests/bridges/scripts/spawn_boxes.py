#!/usr/bin/env python3
# ruff: noqa: PLW2901, PTH118, PTH120, PTH123, RUF005, SIM105, UP031  it is written as people write such scripts
"""Spawns the boxes of a file, looks at them and takes them away."""

import os
import sys

import rospy
from gazebo_msgs.srv import DeleteModel, GetWorldProperties, SpawnModel
from geometry_msgs.msg import Point, Pose, Quaternion
from tf.transformations import quaternion_from_euler

BOX = """<?xml version='1.0'?>
<sdf version='1.6'>
  <model name='box'>
    <link name='link'>
      <inertial><mass>1.0</mass></inertial>
      <collision name='collision'><geometry><box><size>{0} {0} {0}</size></box></geometry></collision>
      <visual name='visual'><geometry><box><size>{0} {0} {0}</size></box></geometry></visual>
    </link>
  </model>
</sdf>"""


def read(path):
    with open(path) as handle:
        for line in handle:
            line = line.split("#")[0].strip()
            if line:
                name, x, y, size = line.split()
                yield name, float(x), float(y), float(size)


def main():
    rospy.init_node("spawn_boxes", anonymous=True)
    for service in ("spawn_sdf_model", "delete_model", "get_world_properties"):
        rospy.wait_for_service("/gazebo/" + service)
    spawn = rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)
    delete = rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)
    world = rospy.ServiceProxy("/gazebo/get_world_properties", GetWorldProperties)
    path = (
        sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "boxes.txt")
    )
    boxes = list(read(path))
    for i, (name, x, y, size) in enumerate(boxes):
        turn = Quaternion(*quaternion_from_euler(0, 0, 0.3 * i))
        pose = Pose(position=Point(x=x, y=y, z=size / 2), orientation=turn)
        answer = spawn(name, BOX.format(size), "", pose, "world")
        print("spawn %s: %s %s" % (name, answer.success, answer.status_message))
    again = spawn(boxes[0][0], BOX.format(0.1), "", Pose(), "world")
    print("again: %s %s" % (again.success, again.status_message))
    broken = spawn("broken", "<sdf><model", "", Pose(), "world")
    print("broken: %s" % broken.success)
    urdf = rospy.ServiceProxy("/gazebo/spawn_urdf_model", SpawnModel)
    try:
        urdf("sdf", BOX.format(0.1), "", Pose(), "world")
    except rospy.ServiceException:
        print("no urdf: ServiceException")
    print(sorted(set(world().model_names) & {box[0] for box in boxes}))
    for name, _, _, _ in boxes + [("nobody", 0, 0, 0)]:
        answer = delete(model_name=name)
        print("delete %s: %s %s" % (name, answer.success, answer.status_message))
    print(sorted(set(world().model_names) & {box[0] for box in boxes}))


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
