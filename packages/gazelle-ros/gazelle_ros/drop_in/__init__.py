"""Modules under foreign names, for those who have none of their own: smach, six and others.

Entry points of ``gazelle_ros.modules`` name them. Modules that are ROS's own stand in ``compat``.
"""
