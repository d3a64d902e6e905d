"""Start, steer and fill the simulator.

What changes something returns whether that succeeded; why not is in the log.
"""

from __future__ import annotations

import time
from typing import Any

from gazelle.clients.errors import ClientError
from gazelle.drop_in.frobs_rl.common.connection import node, reporting
from gazelle.drop_in.frobs_rl.common.gazebo_models import (
    SpawnReport,
    gazebo_delete_model,
    gazebo_get_model_state,
    gazebo_set_model_state,
    gazebo_spawn_sdf_param,
    gazebo_spawn_sdf_path,
    gazebo_spawn_sdf_pkg,
    gazebo_spawn_sdf_string,
    gazebo_spawn_urdf_param,
    gazebo_spawn_urdf_path,
    gazebo_spawn_urdf_pkg,
    gazebo_spawn_urdf_string,
)
from gazelle.drop_in.frobs_rl.common.gazebo_physics import (
    gazebo_get_gravity,
    gazebo_get_max_update_rate,
    gazebo_get_ODE_physics,
    gazebo_get_time_step,
    gazebo_set_default_properties,
    gazebo_set_gravity,
    gazebo_set_max_update_rate,
    gazebo_set_ODE_physics,
    gazebo_set_time_step,
)
from gazelle.drop_in.frobs_rl.common.gazebo_time import (
    gazebo_pause_physics,
    gazebo_reset_sim,
    gazebo_reset_world,
    gazebo_step_physics,
    gazebo_unpause_physics,
)
from gazelle.drop_in.shared import background
from gazelle.errors import RosError
from gazelle_ros.launch.packages import Packages

__all__ = [
    "SpawnReport",
    "close_Gazebo",
    "gazebo_delete_model",
    "gazebo_get_ODE_physics",
    "gazebo_get_gravity",
    "gazebo_get_max_update_rate",
    "gazebo_get_model_state",
    "gazebo_get_time_step",
    "gazebo_pause_physics",
    "gazebo_reset_sim",
    "gazebo_reset_world",
    "gazebo_set_ODE_physics",
    "gazebo_set_default_properties",
    "gazebo_set_gravity",
    "gazebo_set_max_update_rate",
    "gazebo_set_model_state",
    "gazebo_set_time_step",
    "gazebo_spawn_sdf_param",
    "gazebo_spawn_sdf_path",
    "gazebo_spawn_sdf_pkg",
    "gazebo_spawn_sdf_string",
    "gazebo_spawn_urdf_param",
    "gazebo_spawn_urdf_path",
    "gazebo_spawn_urdf_pkg",
    "gazebo_spawn_urdf_string",
    "gazebo_step_physics",
    "gazebo_unpause_physics",
    "launch_Gazebo",
]

_PATIENCE_S = 60.0
_LOOK_S = 0.05
_NODES = ("/gazebo", "/gazebo_gui")


@reporting
def launch_Gazebo(  # noqa: N802  # frobs_rl's names, here and below
    paused: bool = False,  # noqa: FBT001, FBT002
    use_sim_time: bool = True,  # noqa: FBT001, FBT002
    gui: bool = True,  # noqa: FBT001, FBT002
    recording: bool = False,  # noqa: FBT001, FBT002
    debug: bool = False,  # noqa: FBT001, FBT002
    verbose: bool = False,  # noqa: FBT001, FBT002
    output: str = "screen",
    custom_world_path: str | None = None,
    custom_world_pkg: str | None = None,
    custom_world_name: str | None = None,
    respawn_gazebo: bool = False,  # noqa: FBT001, FBT002
    pub_clock_frequency: float = 100,
    server_required: bool = False,  # noqa: FBT001, FBT002
    gui_required: bool = False,  # noqa: FBT001, FBT002
    launch_new_term: bool = True,  # noqa: FBT001, FBT002
) -> None:
    """Start the simulator, and a master if there is none; it is there when this returns.

    Args:
        paused: Whether time stands still at the beginning.
        use_sim_time: Whether nodes go by its time.
        gui: Whether it has a window; Gazelle has none.
        recording: Whether it writes a log; Gazelle writes none.
        debug: Whether it runs under a debugger.
        verbose: Whether to log more.
        output: ``screen`` or ``log``.
        custom_world_path: A file with a world.
        custom_world_pkg: A package that has one, in its folder ``worlds``.
        custom_world_name: World file.
        respawn_gazebo: Start it again if it ends.
        pub_clock_frequency: Messages of ``/clock`` a second [Hz].
        server_required: End the launch with it.
        gui_required: End the launch with its window.
        launch_new_term: Taken; nothing here needs a terminal.
    """
    del launch_new_term
    if custom_world_pkg is not None:
        folder = Packages().folder(custom_world_pkg)
        custom_world_path = str(folder / "worlds" / str(custom_world_name))
    arguments: dict[str, Any] = {
        "paused": paused,
        "use_sim_time": use_sim_time,
        "gui": gui,
        "recording": recording,
        "debug": debug,
        "verbose": verbose,
        "output": output,
        "respawn_gazebo": respawn_gazebo,
        "use_clock_frequency": True,
        "pub_clock_frequency": pub_clock_frequency,
        "server_required": server_required,
        "gui_required": gui_required,
    }
    if custom_world_path is not None:
        arguments["world_name"] = custom_world_path
    name = background.processes().start_launch(
        "launch/empty_world.launch", package="gazebo_ros", arguments=arguments
    )
    _await(name)


def _await(name: str) -> None:
    """Wait for a simulator that has been started.

    Raises:
        ClientError: It ends, or does not come.
    """
    deadline = time.monotonic() + _PATIENCE_S
    while time.monotonic() < deadline:
        if name not in background.processes().running:
            raise ClientError("the simulator ended at once; what it said is above")
        try:
            node().wait_for_service("/gazebo/get_world_properties", timeout=1.0)
        except RosError:
            time.sleep(_LOOK_S)
        else:
            return
    raise ClientError(f"the simulator is not there after {_PATIENCE_S:g} s")


def close_Gazebo() -> bool:  # noqa: N802
    """Stop the simulator, of any origin; returns True."""
    from gazelle.drop_in.frobs_rl.common.ros_node import ros_kill_node

    for name in _NODES:
        ros_kill_node(name)
    return True
