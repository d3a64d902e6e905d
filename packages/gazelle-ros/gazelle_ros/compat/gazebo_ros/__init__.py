"""The Python code of the package gazebo_ros."""
