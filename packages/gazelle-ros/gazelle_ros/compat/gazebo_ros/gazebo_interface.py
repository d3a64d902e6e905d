"""Functions that call the services of a Gazebo, for scripts that import them from gazebo_ros."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle_ros.compat import rospy
from gazelle_ros.messages import load_service


def spawn_sdf_model_client(
    model_name: str,
    model_xml: str,
    robot_namespace: str,
    initial_pose: Any,
    reference_frame: str,
    gazebo_namespace: str,
) -> bool | None:
    """Spawn a model of SDF; waits for the service, for ever if need be.

    Args:
        model_name: Its name.
        model_xml: SDF.
        robot_namespace: Of its topics.
        initial_pose: A ``geometry_msgs/Pose``, in ``reference_frame``.
        reference_frame: A model or link; the world if empty.
        gazebo_namespace: Of the services, such as ``/gazebo``.

    Returns:
        Whether it is there; None if the call failed.
    """
    fields = (model_name, model_xml, robot_namespace, initial_pose, reference_frame)
    return _call(gazebo_namespace, "spawn_sdf_model", "SpawnModel", fields)


def spawn_urdf_model_client(
    model_name: str,
    model_xml: str,
    robot_namespace: str,
    initial_pose: Any,
    reference_frame: str,
    gazebo_namespace: str,
) -> bool | None:
    """Spawn a model of URDF; see `spawn_sdf_model_client`."""
    fields = (model_name, model_xml, robot_namespace, initial_pose, reference_frame)
    return _call(gazebo_namespace, "spawn_urdf_model", "SpawnModel", fields)


def set_model_configuration_client(
    model_name: str,
    model_param_name: str,
    joint_names: Sequence[str],
    joint_positions: Sequence[float],
    gazebo_namespace: str,
) -> bool | None:
    """Set joint positions of a model; waits for the service, for ever if need be.

    Args:
        model_name: Model of the joints.
        model_param_name: Gazebo takes it, and ignores it.
        joint_names: Names of the joints.
        joint_positions: Joint positions [rad or m].
        gazebo_namespace: Of the service, such as ``/gazebo``.

    Returns:
        Whether it was done; None if the call failed.
    """
    fields = (model_name, model_param_name, list(joint_names), list(joint_positions))
    return _call(gazebo_namespace, "set_model_configuration", "SetModelConfiguration", fields)


def _call(namespace: str, name: str, kind: str, fields: Sequence[Any]) -> bool | None:
    full = f"{namespace}/{name}"
    rospy.loginfo(f"Waiting for service {full}")
    rospy.wait_for_service(full)
    rospy.loginfo(f"Calling service {full}")
    try:
        answer = rospy.ServiceProxy(full, load_service(f"gazebo_msgs/{kind}"))(*fields)
    except rospy.ServiceException as error:
        rospy.logerr(f"Service call failed: {error}")
        return None
    what = "Spawn" if kind == "SpawnModel" else "Set model configuration"
    rospy.loginfo(f"{what} status: {answer.status_message}")
    return bool(answer.success)
