"""Finding a post by sight as Gymnasium environments."""

from __future__ import annotations

from gazelle.envs.camera_world.task import CameraWorldTask
from gazelle.envs.settings_env import SettingsEnv, many_worlds


class TurtleBot3CameraWorldEnv(SettingsEnv):
    """A TurtleBot3 Waffle Pi drives to the red post in a room, by nothing but its camera.

    The room is that of stage 1, 3.7 m square. A red, a green and a blue post stand in it, each
    0.5 m high and 0.24 m thick. Id: ``gazelle/TurtleBot3CameraWorld-v0``.

    ## Observation

    ``Box``, uint8, shape (84, 84, 3): red, green and blue, from 0 to 255, top row first. The camera is
    that of the robot's file, 0.1 m above the floor, looking ahead, with a field of view of 1.0856 rad
    (62 degrees) both ways; only the number of pixels differs.

    ## Action

    ``Discrete(3)``, for 0.25 s:

    =====  ================  ===============
    Value  Speed [m/s]       Yaw rate [rad/s]
    =====  ================  ===============
    0      0.26              0
    1      0                 1.2 (left)
    2      0                 -1.2 (right)
    =====  ================  ===============

    ## Reward

    In each step 2 for a metre nearer to the red post, 0.3 for a radian nearer to facing it, and -0.02;
    5 at the red post, -3 for a collision.

    ## Start

    Robot and posts stand anywhere up to 1.4 m from the middle along x and y, the robot facing anywhere,
    the red post 1.2 m from the robot or more, the others 0.8 m from all.

    ## End

    Terminated when the red post is less than 0.5 m from the robot's middle (``info["is_success"]``), or
    when the robot is at a wall or another post: less than 0.24 m from the wall or 0.36 m from the
    post's middle (``info["is_collision"]``). Truncated after 120 steps (30 s).

    ## Options

    Those that every task takes; see docs/reference/gymnasium.md. The physics step is 10 ms in the plane, and in
    MuJoCo that of the world's file, 1 ms.

    ## Versions

    - v0: the first.
    """

    task: CameraWorldTask
    task_class = CameraWorldTask


TurtleBot3CameraWorldVectorEnv = many_worlds(TurtleBot3CameraWorldEnv)
