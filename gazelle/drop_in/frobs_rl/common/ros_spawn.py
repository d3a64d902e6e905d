"""Put a robot into the simulator with what usually goes with it."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.drop_in.frobs_rl.common import ros_controllers, ros_gazebo, ros_params, ros_urdf
from gazelle.drop_in.frobs_rl.common.connection import node, parameter, reporting
from gazelle.drop_in.shared import background

_DESCRIPTION = "robot_description"


@reporting
def init_robot_state_pub(
    namespace: str = "/",
    max_pub_freq: float | None = None,
    launch_new_term: bool = False,  # noqa: FBT001, FBT002  # frobs_rl's interface
) -> None:
    """Start a ``robot_state_publisher``, called ``rob_st_pub``, in a namespace.

    Args:
        namespace: Of the robot.
        max_pub_freq: Publishing rate [Hz].
        launch_new_term: Taken; nothing here needs a terminal.
    """
    del launch_new_term
    if max_pub_freq is not None:
        # frobs_rl sets it beside the node, where publishers of all versions find it.
        node().set_param(parameter(namespace, "rob_st_pub/publish_frequency"), float(max_pub_freq))
    background.processes().start_node(
        "robot_state_publisher", "robot_state_publisher", name="rob_st_pub", namespace=namespace
    )


def spawn_model_in_gazebo(
    pkg_name: str,
    model_urdf_file: str,
    controllers_file: str | None,
    controllers_list: Sequence[str] | None = None,
    model_urdf_folder: str = "/urdf",
    ns: str = "/",
    args_xacro: Sequence[str] | None = None,
    max_pub_freq: float | None = None,
    rob_st_term: bool = False,  # noqa: FBT001, FBT002
    gazebo_name: str = "robot1",
    gaz_ref_frame: str = "world",
    pos_x: float = 0.0,
    pos_y: float = 0.0,
    pos_z: float = 0.0,
    ori_w: float = 0.0,
    ori_x: float = 0.0,
    ori_y: float = 0.0,
    ori_z: float = 0.0,
) -> bool:
    """Spawn a robot of a package, start its state publisher, its parameters and its controllers.

    Args:
        pkg_name: The package.
        model_urdf_file: Its description, URDF or xacro.
        controllers_file: YAML with the controllers' parameters, in the folder ``config``; None for none.
        controllers_list: Controllers to load and start.
        model_urdf_folder: Folder of the description.
        ns: Namespace of the robot.
        args_xacro: Such as ``["camera:=true"]``.
        max_pub_freq: Publishing rate of its state [Hz].
        rob_st_term: Taken; nothing here needs a terminal.
        gazebo_name: Of the model.
        gaz_ref_frame: Reference frame of the pose.
        pos_x: Place [m], with ``pos_y`` and ``pos_z``.
        pos_y: See ``pos_x``.
        pos_z: See ``pos_x``.
        ori_w: Quaternion, with ``ori_x``, ``ori_y`` and ``ori_z``; all zeros turn nothing.
        ori_x: See ``ori_w``.
        ori_y: See ``ori_w``.
        ori_z: See ``ori_w``.

    Returns:
        Whether all of it succeeded; after a failure the rest is not done.
    """
    names = list(controllers_list or ())
    return (
        ros_urdf.urdf_load_from_pkg(
            pkg_name, model_urdf_file, _DESCRIPTION, model_urdf_folder, ns, args_xacro
        )
        and init_robot_state_pub(ns, max_pub_freq, rob_st_term)
        and bool(
            ros_gazebo.gazebo_spawn_urdf_param(
                parameter(ns, _DESCRIPTION),
                model_name=gazebo_name,
                robot_namespace=ns,
                reference_frame=gaz_ref_frame,
                pos_x=pos_x,
                pos_y=pos_y,
                pos_z=pos_z,
                ori_x=ori_x,
                ori_y=ori_y,
                ori_z=ori_z,
                ori_w=ori_w,
            )
        )
        and (
            controllers_file is None
            or ros_params.ros_load_yaml_from_pkg(pkg_name, controllers_file, ns)
        )
        and (not names or ros_controllers.spawn_controllers_srv(names, ns))
    )
