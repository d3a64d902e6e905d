"""Small clients for any ROS 1 graph with Gazebo's interfaces: Gazelle's or a real Gazebo's."""
