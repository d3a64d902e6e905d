"""The other side of ``move_group``: what MoveIt's Python clients stand on, which there is C++.

The classes have the names, arguments and values of ``moveit_ros_planning_interface``; messages cross
as bytes, as there, so that programs written for those modules run unchanged. They plan nothing
themselves: whatever ``move_group`` is on the graph, Gazelle's or MoveIt's, does the work.
"""
