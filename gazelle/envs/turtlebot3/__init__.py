"""The TurtleBot3 DQN tasks of ROBOTIS: drive to goals in four arenas with a lidar."""
