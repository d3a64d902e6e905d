"""A Gymnasium environment with a robot on a ROS 1 graph."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import gymnasium

from gazelle.drop_in.frobs_rl.common import ros_controllers, ros_gazebo, ros_node, ros_spawn
from gazelle.errors import TaskError
from gazelle_ros.compat import rospy

Result = tuple[Any, float, bool, bool, dict[str, Any]]

_RESET_WORLD, _RESET_SIMULATION = 1, 2
_BY_TIME, _BY_STEPS = 1, 2


class RobotBasicEnv(gymnasium.Env[Any, Any]):
    """Starts the simulator and the robot on request; defines step and reset.

    Subclasses override the methods that raise `NotImplementedError` here.

    Args:
        launch_gazebo: Start the simulator.
        gazebo_init_paused: Whether time stands still at its beginning.
        gazebo_use_gui: Whether it has a window.
        gazebo_recording: Whether it writes a log.
        gazebo_freq: Messages of ``/clock`` a second [Hz].
        world_path: A file with a world.
        world_pkg: A package that has one, in its folder ``worlds``.
        world_filename: World file.
        gazebo_max_freq: The pace as a multiple of real time; 0 for as fast as possible, None to leave it.
        gazebo_timestep: Between two steps of the physics [s]; None to leave it.
        spawn_robot: Spawn the robot.
        model_name_in_gazebo: Its name.
        namespace: Of its topics and controllers.
        pkg_name: With its description.
        urdf_file: The description, URDF or xacro.
        urdf_folder: Its folder in the package.
        controller_file: YAML with the controllers' parameters, in the package's ``config``.
        controller_list: Controllers to load and start.
        urdf_xacro_args: Such as ``["camera:=true"]``.
        rob_state_publisher_max_freq: Publishing rate of its state [Hz].
        rob_st_term: Taken; nothing here needs a terminal.
        model_pos_x: Place [m], with ``model_pos_y`` and ``model_pos_z``.
        model_pos_y: See ``model_pos_x``.
        model_pos_z: See ``model_pos_x``.
        model_ori_x: Quaternion, with ``model_ori_y``, ``model_ori_z`` and ``model_ori_w``; zeros turn nothing.
        model_ori_y: See ``model_ori_x``.
        model_ori_z: See ``model_ori_x``.
        model_ori_w: See ``model_ori_x``.
        reset_controllers: Whether an episode begins with controllers that were started again.
        reset_mode: 1 puts back the models, 2 the time too.
        step_mode: 1 lets time advance while the action is sent, 2 makes ``num_gazebo_steps`` steps then.
        num_gazebo_steps: Of the physics.

    Raises:
        TaskError: A mode is neither 1 nor 2, or the simulator or the robot did not start.
    """

    def __init__(
        self,
        launch_gazebo: bool = False,  # noqa: FBT001, FBT002  # frobs_rl's interface
        gazebo_init_paused: bool = True,  # noqa: FBT001, FBT002
        gazebo_use_gui: bool = True,  # noqa: FBT001, FBT002
        gazebo_recording: bool = False,  # noqa: FBT001, FBT002
        gazebo_freq: float = 100,
        world_path: str | None = None,
        world_pkg: str | None = None,
        world_filename: str | None = None,
        gazebo_max_freq: float | None = None,
        gazebo_timestep: float | None = None,
        spawn_robot: bool = False,  # noqa: FBT001, FBT002
        model_name_in_gazebo: str = "robot",
        namespace: str = "/robot",
        pkg_name: str | None = None,
        urdf_file: str | None = None,
        urdf_folder: str = "/urdf",
        controller_file: str | None = None,
        controller_list: Sequence[str] | None = None,
        urdf_xacro_args: Sequence[str] | None = None,
        rob_state_publisher_max_freq: float | None = None,
        rob_st_term: bool = False,  # noqa: FBT001, FBT002
        model_pos_x: float = 0.0,
        model_pos_y: float = 0.0,
        model_pos_z: float = 0.0,
        model_ori_x: float = 0.0,
        model_ori_y: float = 0.0,
        model_ori_z: float = 0.0,
        model_ori_w: float = 0.0,
        reset_controllers: bool = False,  # noqa: FBT001, FBT002
        reset_mode: int = _RESET_WORLD,
        step_mode: int = _BY_TIME,
        num_gazebo_steps: int = 1,
    ) -> None:
        super().__init__()
        for name, mode in (("reset_mode", reset_mode), ("step_mode", step_mode)):
            if mode not in {1, 2}:
                raise TaskError(f"{name} is 1 or 2, not {mode!r}")
        self.namespace = namespace
        self.reset_controllers, self.controllers_list = reset_controllers, controller_list
        self.reset_mode, self.step_mode = reset_mode, step_mode
        self.num_gazebo_steps = num_gazebo_steps
        self.info: dict[str, Any] = {}
        if launch_gazebo:
            _insist(
                "the simulator did not start",
                done=ros_gazebo.launch_Gazebo(
                    paused=gazebo_init_paused,
                    gui=gazebo_use_gui,
                    recording=gazebo_recording,
                    pub_clock_frequency=gazebo_freq,
                    custom_world_path=world_path,
                    custom_world_pkg=world_pkg,
                    custom_world_name=world_filename,
                ),
            )
        if gazebo_max_freq is not None:
            ros_gazebo.gazebo_set_max_update_rate(gazebo_max_freq)
        if gazebo_timestep is not None:
            ros_gazebo.gazebo_set_time_step(gazebo_timestep)
        if spawn_robot:
            _insist(
                f"the robot '{model_name_in_gazebo}' is not spawned",
                done=ros_spawn.spawn_model_in_gazebo(
                    str(pkg_name),
                    str(urdf_file),
                    controller_file,
                    controller_list,
                    model_urdf_folder=urdf_folder,
                    ns=namespace,
                    args_xacro=urdf_xacro_args,
                    max_pub_freq=rob_state_publisher_max_freq,
                    rob_st_term=rob_st_term,
                    gazebo_name=model_name_in_gazebo,
                    pos_x=model_pos_x,
                    pos_y=model_pos_y,
                    pos_z=model_pos_z,
                    ori_x=model_ori_x,
                    ori_y=model_ori_y,
                    ori_z=model_ori_z,
                    ori_w=model_ori_w,
                ),
            )
        if reset_controllers:
            self._restart_controllers()

    # -- Gymnasium's interface -----------------------------------------------------------------

    def step(self, action: Any) -> Result:
        """Send an action, let it act, and observe."""
        self.info = {}
        if self.step_mode == _BY_TIME:
            ros_gazebo.gazebo_unpause_physics()
            self._send_action(action)
            ros_gazebo.gazebo_pause_physics()
        else:
            self._send_action(action)
            ros_gazebo.gazebo_step_physics(steps=self.num_gazebo_steps)
        self.observation = self._get_observation()
        self.reward = self._get_reward()
        self.terminated = bool(self._check_if_done())
        self.truncated = False
        return self.observation, self.reward, self.terminated, self.truncated, self.info

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None, **kwargs: Any
    ) -> tuple[Any, dict[str, Any]]:
        """Start an episode; returns the first observation and an empty dictionary."""
        del kwargs
        super().reset(seed=seed, options=options)
        ros_gazebo.gazebo_pause_physics()
        self._reset_gazebo()
        self.observation = self._get_observation()
        return self.observation, {}

    def close(self) -> None:
        """Stop the simulator, all nodes and the master."""
        ros_gazebo.close_Gazebo()
        ros_node.ros_kill_all_processes()
        rospy.signal_shutdown("the environment is closed")

    # -- around an episode ---------------------------------------------------------------------

    def _reset_gazebo(self) -> None:
        """Reset the world, and start the episode while time advances."""
        if self.reset_mode == _RESET_WORLD:
            ros_gazebo.gazebo_reset_world()
        else:
            ros_gazebo.gazebo_reset_sim()
        if self.reset_controllers:
            self._restart_controllers()
        ros_gazebo.gazebo_unpause_physics()
        self._check_subs_and_pubs_connection()
        self._set_episode_init_params()
        ros_gazebo.gazebo_pause_physics()

    def _restart_controllers(self) -> None:
        ros_gazebo.gazebo_unpause_physics()
        ros_controllers.reset_controllers_srv(list(self.controllers_list or ()), ns=self.namespace)
        ros_gazebo.gazebo_pause_physics()

    # -- overridden by subclasses -------------------------------------------------------------------

    def _send_action(self, action: Any) -> Any:
        """Send an action."""
        raise NotImplementedError

    def _get_observation(self) -> Any:
        """Return the present observation."""
        raise NotImplementedError

    def _get_reward(self) -> float:
        """Return the reward of the last action."""
        raise NotImplementedError

    def _check_if_done(self) -> bool:
        """Return whether the episode is over; a success also sets ``info["is_success"] = 1.0``."""
        raise NotImplementedError

    def _check_subs_and_pubs_connection(self) -> Any:
        """Wait until sensors and controllers answer."""
        raise NotImplementedError

    def _set_episode_init_params(self) -> Any:
        """Initialise the variables of an episode."""
        raise NotImplementedError


def _insist(otherwise: str, *, done: bool) -> None:
    """Raise an error unless something was done.

    Raises:
        TaskError: It was not; why not is in the log.
    """
    if not done:
        raise TaskError(otherwise, hint="the log says why")
