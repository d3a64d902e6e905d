# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class ContactState(_Message):
    info: str
    collision1_name: str
    collision2_name: str
    wrenches: list[_geometry_msgs.Wrench]
    total_wrench: _geometry_msgs.Wrench
    contact_positions: list[_geometry_msgs.Vector3]
    contact_normals: list[_geometry_msgs.Vector3]
    depths: _Sequence[float] | _NDArray[_Any]
    def __init__(self, info: str | None = ..., collision1_name: str | None = ..., collision2_name: str | None = ..., wrenches: list[_geometry_msgs.Wrench] | None = ..., total_wrench: _geometry_msgs.Wrench | None = ..., contact_positions: list[_geometry_msgs.Vector3] | None = ..., contact_normals: list[_geometry_msgs.Vector3] | None = ..., depths: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class ContactsState(_Message):
    header: _std_msgs.Header
    states: list[ContactState]
    def __init__(self, header: _std_msgs.Header | None = ..., states: list[ContactState] | None = ...) -> None: ...
class LinkState(_Message):
    link_name: str
    pose: _geometry_msgs.Pose
    twist: _geometry_msgs.Twist
    reference_frame: str
    def __init__(self, link_name: str | None = ..., pose: _geometry_msgs.Pose | None = ..., twist: _geometry_msgs.Twist | None = ..., reference_frame: str | None = ...) -> None: ...
class LinkStates(_Message):
    name: list[str]
    pose: list[_geometry_msgs.Pose]
    twist: list[_geometry_msgs.Twist]
    def __init__(self, name: list[str] | None = ..., pose: list[_geometry_msgs.Pose] | None = ..., twist: list[_geometry_msgs.Twist] | None = ...) -> None: ...
class ModelState(_Message):
    model_name: str
    pose: _geometry_msgs.Pose
    twist: _geometry_msgs.Twist
    reference_frame: str
    def __init__(self, model_name: str | None = ..., pose: _geometry_msgs.Pose | None = ..., twist: _geometry_msgs.Twist | None = ..., reference_frame: str | None = ...) -> None: ...
class ModelStates(_Message):
    name: list[str]
    pose: list[_geometry_msgs.Pose]
    twist: list[_geometry_msgs.Twist]
    def __init__(self, name: list[str] | None = ..., pose: list[_geometry_msgs.Pose] | None = ..., twist: list[_geometry_msgs.Twist] | None = ...) -> None: ...
class ODEJointProperties(_Message):
    damping: _Sequence[float] | _NDArray[_Any]
    hiStop: _Sequence[float] | _NDArray[_Any]
    loStop: _Sequence[float] | _NDArray[_Any]
    erp: _Sequence[float] | _NDArray[_Any]
    cfm: _Sequence[float] | _NDArray[_Any]
    stop_erp: _Sequence[float] | _NDArray[_Any]
    stop_cfm: _Sequence[float] | _NDArray[_Any]
    fudge_factor: _Sequence[float] | _NDArray[_Any]
    fmax: _Sequence[float] | _NDArray[_Any]
    vel: _Sequence[float] | _NDArray[_Any]
    def __init__(self, damping: _Sequence[float] | _NDArray[_Any] | None = ..., hiStop: _Sequence[float] | _NDArray[_Any] | None = ..., loStop: _Sequence[float] | _NDArray[_Any] | None = ..., erp: _Sequence[float] | _NDArray[_Any] | None = ..., cfm: _Sequence[float] | _NDArray[_Any] | None = ..., stop_erp: _Sequence[float] | _NDArray[_Any] | None = ..., stop_cfm: _Sequence[float] | _NDArray[_Any] | None = ..., fudge_factor: _Sequence[float] | _NDArray[_Any] | None = ..., fmax: _Sequence[float] | _NDArray[_Any] | None = ..., vel: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class ODEPhysics(_Message):
    auto_disable_bodies: bool
    sor_pgs_precon_iters: int
    sor_pgs_iters: int
    sor_pgs_w: float
    sor_pgs_rms_error_tol: float
    contact_surface_layer: float
    contact_max_correcting_vel: float
    cfm: float
    erp: float
    max_contacts: int
    def __init__(self, auto_disable_bodies: bool | None = ..., sor_pgs_precon_iters: int | None = ..., sor_pgs_iters: int | None = ..., sor_pgs_w: float | None = ..., sor_pgs_rms_error_tol: float | None = ..., contact_surface_layer: float | None = ..., contact_max_correcting_vel: float | None = ..., cfm: float | None = ..., erp: float | None = ..., max_contacts: int | None = ...) -> None: ...
class PerformanceMetrics(_Message):
    header: _std_msgs.Header
    real_time_factor: float
    sensors: list[SensorPerformanceMetric]
    def __init__(self, header: _std_msgs.Header | None = ..., real_time_factor: float | None = ..., sensors: list[SensorPerformanceMetric] | None = ...) -> None: ...
class SensorPerformanceMetric(_Message):
    name: str
    sim_update_rate: float
    real_update_rate: float
    fps: float
    def __init__(self, name: str | None = ..., sim_update_rate: float | None = ..., real_update_rate: float | None = ..., fps: float | None = ...) -> None: ...
class WorldState(_Message):
    header: _std_msgs.Header
    name: list[str]
    pose: list[_geometry_msgs.Pose]
    twist: list[_geometry_msgs.Twist]
    wrench: list[_geometry_msgs.Wrench]
    def __init__(self, header: _std_msgs.Header | None = ..., name: list[str] | None = ..., pose: list[_geometry_msgs.Pose] | None = ..., twist: list[_geometry_msgs.Twist] | None = ..., wrench: list[_geometry_msgs.Wrench] | None = ...) -> None: ...
