"""Parts of ``moveit_commander``: the node, the robot's names and states, requests and actions.

They plan nothing themselves: whatever ``move_group`` is on the graph, Gazelle's or MoveIt's, does the
work. ``moveit_ros_planning_interface``, which is C++ in MoveIt and takes messages as bytes, stands on
``moveit_commander`` here, by `byte_interface`; there the roles are reversed.
"""
