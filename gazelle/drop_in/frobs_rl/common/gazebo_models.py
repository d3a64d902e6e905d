"""Models of the simulator: spawn, delete, query and place them."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, TypedDict, Unpack

from gazelle.clients.descriptions import find_file, read_urdf
from gazelle.clients.errors import ClientError
from gazelle.description.pose import rpy_from_quaternion
from gazelle.drop_in.frobs_rl.common.connection import gazebo, in_folder, log_error, node, reporting
from gazelle.errors import Error
from gazelle_ros import load_message
from gazelle_ros.base.text_files import read_text
from gazelle_ros.messages import Message


class SpawnReport(NamedTuple):
    """Result of spawning a robot, with the simulator's message; true if it succeeded."""

    success: bool
    status_message: str

    def __bool__(self) -> bool:
        return self.success


class SpawnPlace(TypedDict, total=False):
    """Pose for placing a model: ``pos_x`` ... [m] and the quaternion ``ori_x`` ..., in a frame.

    The same may be given without names, in this order, after what describes the model.
    """

    model_name: str
    robot_namespace: str
    reference_frame: str
    pos_x: float
    pos_y: float
    pos_z: float
    ori_x: float
    ori_y: float
    ori_z: float
    ori_w: float


_ORDER = tuple(SpawnPlace.__annotations__)
_FRAME = "world"
_NAME = "robot1"


def gazebo_spawn_urdf_path(
    model_path: str, *where: str | float, **place: Unpack[SpawnPlace]
) -> SpawnReport:
    """Spawn a robot of a URDF or xacro file; see `SpawnPlace`."""
    return _reported("spawn_urdf", lambda: read_urdf(model_path), where, place)


def gazebo_spawn_urdf_pkg(
    pkg_name: str,
    file_name: str,
    file_folder: str = "/urdf",
    *where: str | float,
    **place: Unpack[SpawnPlace],
) -> SpawnReport:
    """Spawn a robot of a URDF or xacro file of a package; see `SpawnPlace`."""
    file = in_folder(file_folder, file_name)
    return _reported("spawn_urdf", lambda: read_urdf(file, package=pkg_name), where, place)


def gazebo_spawn_urdf_string(
    model_string: str, *where: str | float, **place: Unpack[SpawnPlace]
) -> SpawnReport:
    """Spawn a robot of a URDF text; see `SpawnPlace`."""
    return _reported("spawn_urdf", lambda: model_string, where, place)


def gazebo_spawn_urdf_param(
    param_name: str, *where: str | float, **place: Unpack[SpawnPlace]
) -> SpawnReport:
    """Spawn a robot from the URDF in a parameter; see `SpawnPlace`."""
    return _reported("spawn_urdf", lambda: _held(param_name), where, place)


def gazebo_spawn_sdf_path(
    model_path: str, *where: str | float, **place: Unpack[SpawnPlace]
) -> bool:
    """Spawn a model of an SDF file; see `SpawnPlace`."""
    return bool(_reported("spawn_sdf", lambda: _text(model_path), where, place))


def gazebo_spawn_sdf_pkg(
    pkg_name: str,
    file_name: str,
    file_folder: str = "/sdf",
    *where: str | float,
    **place: Unpack[SpawnPlace],
) -> bool:
    """Spawn a model of an SDF file of a package; see `SpawnPlace`."""
    file = in_folder(file_folder, file_name)
    return bool(_reported("spawn_sdf", lambda: _text(file, pkg_name), where, place))


def gazebo_spawn_sdf_string(
    model_string: str, *where: str | float, **place: Unpack[SpawnPlace]
) -> bool:
    """Spawn a model of an SDF text; see `SpawnPlace`."""
    return bool(_reported("spawn_sdf", lambda: model_string, where, place))


def gazebo_spawn_sdf_param(
    param_name: str, *where: str | float, **place: Unpack[SpawnPlace]
) -> bool:
    """Spawn a model from the SDF in a parameter; see `SpawnPlace`."""
    return bool(_reported("spawn_sdf", lambda: _held(param_name), where, place))


@reporting
def gazebo_delete_model(model_name: str) -> None:
    """Delete a model."""
    gazebo().delete(model_name)


def gazebo_get_model_state(
    model_name: str, relative_entity_name: str = _FRAME
) -> tuple[Any, Any, Any, bool]:
    """Return pose and velocity of a model, relative to another or the world.

    Returns:
        A ``std_msgs/Header``, a ``geometry_msgs/Pose``, a ``geometry_msgs/Twist``, and whether there is
        such a model.
    """
    header, pose, twist = (
        load_message(kind)()
        for kind in ("std_msgs/Header", "geometry_msgs/Pose", "geometry_msgs/Twist")
    )
    result: tuple[Any, Any, Any] = (header, pose, twist)
    try:
        state = gazebo().model_state(model_name, relative_entity_name)
    except ClientError as error:
        log_error(f"gazebo_get_model_state: {error}")
        return (*result, False)
    _fill(result[1].position, state.position)
    _fill(result[1].orientation, state.quaternion)
    _fill(result[2].linear, state.linear)
    _fill(result[2].angular, state.angular)
    result[0].frame_id = relative_entity_name
    return (*result, True)


@reporting
def gazebo_set_model_state(
    model_name: str,
    ref_frame: str = _FRAME,
    pos_x: float = 0.0,
    pos_y: float = 0.0,
    pos_z: float = 0.0,
    ori_x: float = 0.0,
    ori_y: float = 0.0,
    ori_z: float = 0.0,
    ori_w: float = 0.0,
    lin_vel_x: float = 0.0,
    lin_vel_y: float = 0.0,
    lin_vel_z: float = 0.0,
    ang_vel_x: float = 0.0,
    ang_vel_y: float = 0.0,
    ang_vel_z: float = 0.0,
    sleep_time: float = 0.05,
) -> None:
    """Set pose and velocity of a model [m, m/s, rad/s], and wait a little [s of wall time]."""
    gazebo().set_model_state(
        model_name,
        (pos_x, pos_y, pos_z),
        _angles(ori_x, ori_y, ori_z, ori_w),
        (lin_vel_x, lin_vel_y, lin_vel_z),
        (ang_vel_x, ang_vel_y, ang_vel_z),
        ref_frame,
    )
    time.sleep(sleep_time)


def _reported(
    method: str, describe: Callable[[], str], where: Sequence[str | float], place: SpawnPlace
) -> SpawnReport:
    """Spawn, and report; the text is made here so that what is wrong with it is reported too."""
    given: dict[str, Any] = {**dict(zip(_ORDER, where, strict=False)), **place}
    try:
        getattr(gazebo(), method)(
            given.get("model_name", _NAME),
            describe(),
            position=tuple(given.get(f"pos_{axis}", 0.0) for axis in "xyz"),
            rpy=_angles(*(given.get(f"ori_{axis}", 0.0) for axis in "xyzw")),
            frame=given.get("reference_frame", _FRAME),
            namespace=given.get("robot_namespace", "/"),
        )
    except Error as error:
        log_error(f"gazebo_{method}: {error}")
        return SpawnReport(success=False, status_message=str(error))
    return SpawnReport(success=True, status_message="SpawnModel: Successfully spawned entity")


def _angles(x: float, y: float, z: float, w: float) -> tuple[float, float, float]:
    """Return roll, pitch and yaw of a quaternion of any length [rad].

    All zeros is the identity.
    """
    length = math.hypot(x, y, z, w)
    if length == 0.0:
        return (0.0, 0.0, 0.0)
    return rpy_from_quaternion((x / length, y / length, z / length, w / length))


def _fill(message: Message, values: tuple[float, ...]) -> None:
    for axis, value in zip("xyzw", values, strict=False):
        setattr(message, axis, value)


def _held(name: str) -> str:
    text = node().get_param(name, None)
    if not isinstance(text, str):
        raise ClientError(f"the parameter '{name}' holds no description")
    return text


def _text(path: str, package: str | None = None) -> str:
    return read_text(find_file(path, package))
