"""The Python code of the package sensor_msgs: point clouds as points."""
