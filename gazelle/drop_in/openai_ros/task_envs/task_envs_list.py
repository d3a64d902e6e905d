"""The environments of openai_ros by name."""

from __future__ import annotations

import importlib

from gazelle.drop_in.gym.envs.registration import register
from gazelle.errors import did_you_mean
from gazelle_ros.compat import rospy

MODULES = {
    "MovingCubeOneDiskWalk-v0": ("moving_cube.one_disk_walk", "MovingCubeOneDiskWalkEnv"),
    "HusarionGetToPosTurtleBotPlayGround-v0": (
        "husarion.husarion_get_to_position_turtlebot_playground",
        "HusarionGetToPosTurtleBotPlayGroundEnv",
    ),
    "CartPoleStayUp-v0": ("cartpole_stay_up.stay_up", "CartPoleStayUpEnv"),
    "HopperStayUp-v0": ("hopper.hopper_stay_up", "HopperStayUpEnv"),
    "ParrotDroneGoto-v0": ("parrotdrone.parrotdrone_goto", "ParrotDroneGotoEnv"),
    "SumitXlRoom-v0": ("sumit_xl.sumit_xl_room", "SumitXlRoom"),
    "MyTurtleBot2Maze-v0": ("turtlebot2.turtlebot2_maze", "TurtleBot2MazeEnv"),
    "TurtleBot2Maze-v0": ("turtlebot2.turtlebot2_maze", "TurtleBot2MazeEnv"),
    "MyTurtleBot2Wall-v0": ("turtlebot2.turtlebot2_wall", "TurtleBot2WallEnv"),
    "TurtleBot2Wall-v0": ("turtlebot2.turtlebot2_wall", "TurtleBot2WallEnv"),
    "WamvNavTwoSetsBuoys-v0": ("wamv.wamv_nav_twosets_buoys", "WamvNavTwoSetsBuoysEnv"),
    "TurtleBot3World-v0": ("turtlebot3.turtlebot3_world", "TurtleBot3WorldEnv"),
}
"""From the name to the module below ``task_envs``, and the class in it."""

WITHOUT_ROBOT = (
    "FetchPickAndPlace-v0",
    "FetchPush-v0",
    "FetchReach-v0",
    "FetchSimpleTest-v0",
    "FetchTest-v0",
    "IriWamTcpToBowl-v0",
    "SawyerTouchCube-v0",
    "ShadowTcGetBall-v0",
)
"""Names that openai_ros has besides, and Gazelle not."""

_HOME = "gazelle.drop_in.openai_ros.task_envs"


def RegisterOpenAI_Ros_Env(  # noqa: N802  # openai_ros' name
    task_env: str, max_episode_steps: int = 10000, timestep_limit_per_episode: int | None = None
) -> bool:
    """Register an environment for ``gym.make``; returns whether there is one of that name.

    Args:
        task_env: Its name.
        max_episode_steps: After which an episode is cut.
        timestep_limit_per_episode: Earlier name of that parameter.
    """
    found = MODULES.get(task_env)
    if found is None and task_env in WITHOUT_ROBOT:
        rospy.logerr(f"'{task_env}' is a task of openai_ros that Gazelle has not")
    elif found is None:
        hint = did_you_mean(task_env, [*MODULES, *WITHOUT_ROBOT])
        rospy.logerr(f"openai_ros has no task '{task_env}'; {hint}")
    if found is None:
        return False
    _register(task_env, timestep_limit_per_episode or max_episode_steps)
    importlib.import_module(f"{_HOME}.{found[0]}")
    return True


def register_task(*names: str) -> None:
    """Register environments as the modules of openai_ros 1 do when they are imported."""
    for name in names:
        _register(name, 10000)


def _register(name: str, max_episode_steps: int) -> None:
    module, kind = MODULES[name]
    register(id=name, entry_point=f"{_HOME}.{module}:{kind}", max_episode_steps=max_episode_steps)
