"""Put a whole robot there: description, state publisher, model and controllers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Unpack

from gazelle.argument_checks import checked
from gazelle.clients.controllers import Controllers
from gazelle.clients.descriptions import load_parameters, load_urdf
from gazelle.clients.errors import ClientError
from gazelle.clients.gazebo import Gazebo
from gazelle.clients.poses import ModelPlace
from gazelle.clients.processes import Processes


@checked(ClientError, after=True)
def spawn_robot(
    gazebo: Gazebo,
    processes: Processes,
    name: str,
    path: str | Path,
    *,
    package: str | None = None,
    xacro_args: Mapping[str, str] | None = None,
    namespace: str = "/",
    publisher_rate: float | None = 50.0,
    controller_file: str | Path | None = None,
    controllers: Sequence[str] = (),
    **where: Unpack[ModelPlace],
) -> None:
    """Spawn a robot in a running world, with its usual nodes.

    Args:
        gazebo: Simulator.
        processes: Runs its ``robot_state_publisher``.
        name: Of the model.
        path: URDF or xacro; within the package if one is given.
        package: A ROS package.
        xacro_args: Values of xacro's arguments.
        namespace: Of the robot: its ``robot_description``, topics and controllers.
        publisher_rate: Of the state publisher [Hz]; None for none.
        controller_file: YAML with the controllers' parameters.
        controllers: Those to load and start.
        where: As for ``Gazebo.spawn_sdf``.

    Raises:
        ClientError: A file is missing, or the robot cannot be spawned, or a controller not started.
    """
    space = "/" + namespace.strip("/")
    prefix = space.rstrip("/")
    text = load_urdf(
        gazebo.node,
        path,
        package=package,
        xacro_args=xacro_args,
        parameter=f"{prefix}/robot_description",
    )
    if publisher_rate is not None:
        processes.start_node(
            "robot_state_publisher",
            "robot_state_publisher",
            namespace=space,
            parameters={"publish_frequency": publisher_rate},
        )
    gazebo.spawn_urdf(name, text, namespace=space, **where)
    if controller_file is not None:
        load_parameters(gazebo.node, controller_file, package=package, namespace=prefix)
    if controllers:
        with Controllers(gazebo.node, prefix) as manager:
            manager.spawn(controllers)
