"""Runs the suites of ROS 1's own repositories with parts of Gazelle in the real ones' place."""
