"""Nodes of ROS's navigation stack: ``amcl``, ``move_base``, ``slam_gmapping`` and its kin."""
