"""Nodes of ROS's navigation stack: ``amcl``, ``move_base``, ``slam_gmapping``, ``slam_karto``, ``hector_mapping``."""
