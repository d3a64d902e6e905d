"""Modules under foreign names, used where they are not installed: smach, six and others.

Entry points of ``gazelle_ros.modules`` name them. Modules that are ROS's own stand in ``compat``.
"""
