"""openai_ros: learning tasks on a ROS 1 graph, in three layers, by the names that it has there.

`robot_gazebo_env.RobotGazeboEnv` talks to the simulator, the classes of `robot_envs` know a robot's
topics, those of `task_envs` what is seen, done and rewarded. They run on Gazelle and on Gazebo.
"""
