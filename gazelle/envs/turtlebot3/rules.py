"""The numbers of the TurtleBot3 DQN tasks.

Source: ROBOTIS, package ``turtlebot3_machine_learning`` for ROS 1 (Noetic) and the chapter
"Machine Learning" of the TurtleBot3 e-Manual.
"""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.envs.goals import GoalTable
from gazelle.envs.turtlebot3.places import grid_goals, plaza_goals

SHORTEST = 0.01  # a shorter distance to a new goal counts as this in the reward [m]
NO_GOAL = -1  # index of the goal of a world that had none yet


@dataclass(frozen=True, slots=True)
class Rules:
    """Parameters of one stage.

    Attributes:
        world: Name of the bundled world.
        start: Start of the robot, x and y in the world frame [m]; yaw is 0.
        control_period: Simulated time of one step [s]: the lidar's period.
        time_step: Physics step [s].
        range_max: Ranges are capped here [m].
        collision_range: A shorter range is a collision [m].
        goal_distance: A shorter rounded distance is a reached goal [m].
        sees_obstacle: Whether the state ends with the nearest range and its ray.
        arena_diagonal: Longest distance in the arena [m].
        goal_reward: Replaces the reward when the goal is reached.
        collision_reward: Replaces the reward at a collision.
        obstacle_range: Below this nearest range [m] ``obstacle_reward`` is added.
        obstacle_reward: Added near an obstacle.
    """

    world: str
    start: tuple[float, float] = (0.0, 0.0)
    control_period: float = 0.2
    time_step: float = 0.02
    range_max: float = 3.5
    collision_range: float = 0.13
    goal_distance: float = 0.2
    sees_obstacle: bool = True
    arena_diagonal: float = 5.24
    goal_reward: float = 200.0
    collision_reward: float = -150.0
    obstacle_range: float = 0.5
    obstacle_reward: float = 0.0


STAGES = {
    1: Rules("turtlebot3_stage_1", sees_obstacle=False, collision_reward=-200.0),
    2: Rules("turtlebot3_stage_2"),
    3: Rules("turtlebot3_stage_3"),
    4: Rules(
        "turtlebot3_stage_4",
        start=(-0.7, 0.0),
        arena_diagonal=6.65,
        goal_reward=1000.0,
        collision_reward=-500.0,
        obstacle_reward=-5.0,
    ),
}


def stage_goals(stage: int) -> GoalTable:
    """Return the goals of a stage: a grid in stages 1 to 3, thirteen places in stage 4."""
    return plaza_goals() if stage == 4 else grid_goals()
