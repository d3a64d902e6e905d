"""The ROS master: registrations of topics and services, and the parameter server."""
