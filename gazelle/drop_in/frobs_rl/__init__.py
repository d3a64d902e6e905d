"""frobs_rl: robot environments of Gymnasium on a ROS 1 graph, by the names that it has there.

`common` has the helpers, `envs.robot_BasicEnv.RobotBasicEnv` the environment that robots and tasks derive
from, `wrappers` and `models` what trains on it. They run on Gazelle and on Gazebo.
"""
