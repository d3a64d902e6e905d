"""The few internals of rospy that scripts and tests reach for."""
