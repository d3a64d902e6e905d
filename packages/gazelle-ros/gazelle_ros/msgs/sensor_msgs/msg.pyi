# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from typing import ClassVar as _ClassVar
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Time as _Time
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class BatteryState(_Message):
    POWER_SUPPLY_STATUS_UNKNOWN: _ClassVar[int]
    POWER_SUPPLY_STATUS_CHARGING: _ClassVar[int]
    POWER_SUPPLY_STATUS_DISCHARGING: _ClassVar[int]
    POWER_SUPPLY_STATUS_NOT_CHARGING: _ClassVar[int]
    POWER_SUPPLY_STATUS_FULL: _ClassVar[int]
    POWER_SUPPLY_HEALTH_UNKNOWN: _ClassVar[int]
    POWER_SUPPLY_HEALTH_GOOD: _ClassVar[int]
    POWER_SUPPLY_HEALTH_OVERHEAT: _ClassVar[int]
    POWER_SUPPLY_HEALTH_DEAD: _ClassVar[int]
    POWER_SUPPLY_HEALTH_OVERVOLTAGE: _ClassVar[int]
    POWER_SUPPLY_HEALTH_UNSPEC_FAILURE: _ClassVar[int]
    POWER_SUPPLY_HEALTH_COLD: _ClassVar[int]
    POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE: _ClassVar[int]
    POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE: _ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_UNKNOWN: _ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_NIMH: _ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LION: _ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LIPO: _ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LIFE: _ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_NICD: _ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LIMN: _ClassVar[int]
    header: _std_msgs.Header
    voltage: float
    temperature: float
    current: float
    charge: float
    capacity: float
    design_capacity: float
    percentage: float
    power_supply_status: int
    power_supply_health: int
    power_supply_technology: int
    present: bool
    cell_voltage: _Sequence[float] | _NDArray[_Any]
    cell_temperature: _Sequence[float] | _NDArray[_Any]
    location: str
    serial_number: str
    def __init__(self, header: _std_msgs.Header | None = ..., voltage: float | None = ..., temperature: float | None = ..., current: float | None = ..., charge: float | None = ..., capacity: float | None = ..., design_capacity: float | None = ..., percentage: float | None = ..., power_supply_status: int | None = ..., power_supply_health: int | None = ..., power_supply_technology: int | None = ..., present: bool | None = ..., cell_voltage: _Sequence[float] | _NDArray[_Any] | None = ..., cell_temperature: _Sequence[float] | _NDArray[_Any] | None = ..., location: str | None = ..., serial_number: str | None = ...) -> None: ...
class CameraInfo(_Message):
    header: _std_msgs.Header
    height: int
    width: int
    distortion_model: str
    D: _Sequence[float] | _NDArray[_Any]
    K: _Sequence[float] | _NDArray[_Any]
    R: _Sequence[float] | _NDArray[_Any]
    P: _Sequence[float] | _NDArray[_Any]
    binning_x: int
    binning_y: int
    roi: RegionOfInterest
    def __init__(self, header: _std_msgs.Header | None = ..., height: int | None = ..., width: int | None = ..., distortion_model: str | None = ..., D: _Sequence[float] | _NDArray[_Any] | None = ..., K: _Sequence[float] | _NDArray[_Any] | None = ..., R: _Sequence[float] | _NDArray[_Any] | None = ..., P: _Sequence[float] | _NDArray[_Any] | None = ..., binning_x: int | None = ..., binning_y: int | None = ..., roi: RegionOfInterest | None = ...) -> None: ...
class ChannelFloat32(_Message):
    name: str
    values: _Sequence[float] | _NDArray[_Any]
    def __init__(self, name: str | None = ..., values: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class CompressedImage(_Message):
    header: _std_msgs.Header
    format: str
    data: bytes
    def __init__(self, header: _std_msgs.Header | None = ..., format: str | None = ..., data: bytes | None = ...) -> None: ...
class FluidPressure(_Message):
    header: _std_msgs.Header
    fluid_pressure: float
    variance: float
    def __init__(self, header: _std_msgs.Header | None = ..., fluid_pressure: float | None = ..., variance: float | None = ...) -> None: ...
class Illuminance(_Message):
    header: _std_msgs.Header
    illuminance: float
    variance: float
    def __init__(self, header: _std_msgs.Header | None = ..., illuminance: float | None = ..., variance: float | None = ...) -> None: ...
class Image(_Message):
    header: _std_msgs.Header
    height: int
    width: int
    encoding: str
    is_bigendian: int
    step: int
    data: bytes
    def __init__(self, header: _std_msgs.Header | None = ..., height: int | None = ..., width: int | None = ..., encoding: str | None = ..., is_bigendian: int | None = ..., step: int | None = ..., data: bytes | None = ...) -> None: ...
class Imu(_Message):
    header: _std_msgs.Header
    orientation: _geometry_msgs.Quaternion
    orientation_covariance: _Sequence[float] | _NDArray[_Any]
    angular_velocity: _geometry_msgs.Vector3
    angular_velocity_covariance: _Sequence[float] | _NDArray[_Any]
    linear_acceleration: _geometry_msgs.Vector3
    linear_acceleration_covariance: _Sequence[float] | _NDArray[_Any]
    def __init__(self, header: _std_msgs.Header | None = ..., orientation: _geometry_msgs.Quaternion | None = ..., orientation_covariance: _Sequence[float] | _NDArray[_Any] | None = ..., angular_velocity: _geometry_msgs.Vector3 | None = ..., angular_velocity_covariance: _Sequence[float] | _NDArray[_Any] | None = ..., linear_acceleration: _geometry_msgs.Vector3 | None = ..., linear_acceleration_covariance: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class JointState(_Message):
    header: _std_msgs.Header
    name: list[str]
    position: _Sequence[float] | _NDArray[_Any]
    velocity: _Sequence[float] | _NDArray[_Any]
    effort: _Sequence[float] | _NDArray[_Any]
    def __init__(self, header: _std_msgs.Header | None = ..., name: list[str] | None = ..., position: _Sequence[float] | _NDArray[_Any] | None = ..., velocity: _Sequence[float] | _NDArray[_Any] | None = ..., effort: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class Joy(_Message):
    header: _std_msgs.Header
    axes: _Sequence[float] | _NDArray[_Any]
    buttons: _Sequence[int] | _NDArray[_Any]
    def __init__(self, header: _std_msgs.Header | None = ..., axes: _Sequence[float] | _NDArray[_Any] | None = ..., buttons: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class JoyFeedback(_Message):
    TYPE_LED: _ClassVar[int]
    TYPE_RUMBLE: _ClassVar[int]
    TYPE_BUZZER: _ClassVar[int]
    type: int
    id: int
    intensity: float
    def __init__(self, type: int | None = ..., id: int | None = ..., intensity: float | None = ...) -> None: ...
class JoyFeedbackArray(_Message):
    array: list[JoyFeedback]
    def __init__(self, array: list[JoyFeedback] | None = ...) -> None: ...
class LaserEcho(_Message):
    echoes: _Sequence[float] | _NDArray[_Any]
    def __init__(self, echoes: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class LaserScan(_Message):
    header: _std_msgs.Header
    angle_min: float
    angle_max: float
    angle_increment: float
    time_increment: float
    scan_time: float
    range_min: float
    range_max: float
    ranges: _Sequence[float] | _NDArray[_Any]
    intensities: _Sequence[float] | _NDArray[_Any]
    def __init__(self, header: _std_msgs.Header | None = ..., angle_min: float | None = ..., angle_max: float | None = ..., angle_increment: float | None = ..., time_increment: float | None = ..., scan_time: float | None = ..., range_min: float | None = ..., range_max: float | None = ..., ranges: _Sequence[float] | _NDArray[_Any] | None = ..., intensities: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class MagneticField(_Message):
    header: _std_msgs.Header
    magnetic_field: _geometry_msgs.Vector3
    magnetic_field_covariance: _Sequence[float] | _NDArray[_Any]
    def __init__(self, header: _std_msgs.Header | None = ..., magnetic_field: _geometry_msgs.Vector3 | None = ..., magnetic_field_covariance: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class MultiDOFJointState(_Message):
    header: _std_msgs.Header
    joint_names: list[str]
    transforms: list[_geometry_msgs.Transform]
    twist: list[_geometry_msgs.Twist]
    wrench: list[_geometry_msgs.Wrench]
    def __init__(self, header: _std_msgs.Header | None = ..., joint_names: list[str] | None = ..., transforms: list[_geometry_msgs.Transform] | None = ..., twist: list[_geometry_msgs.Twist] | None = ..., wrench: list[_geometry_msgs.Wrench] | None = ...) -> None: ...
class MultiEchoLaserScan(_Message):
    header: _std_msgs.Header
    angle_min: float
    angle_max: float
    angle_increment: float
    time_increment: float
    scan_time: float
    range_min: float
    range_max: float
    ranges: list[LaserEcho]
    intensities: list[LaserEcho]
    def __init__(self, header: _std_msgs.Header | None = ..., angle_min: float | None = ..., angle_max: float | None = ..., angle_increment: float | None = ..., time_increment: float | None = ..., scan_time: float | None = ..., range_min: float | None = ..., range_max: float | None = ..., ranges: list[LaserEcho] | None = ..., intensities: list[LaserEcho] | None = ...) -> None: ...
class NavSatFix(_Message):
    COVARIANCE_TYPE_UNKNOWN: _ClassVar[int]
    COVARIANCE_TYPE_APPROXIMATED: _ClassVar[int]
    COVARIANCE_TYPE_DIAGONAL_KNOWN: _ClassVar[int]
    COVARIANCE_TYPE_KNOWN: _ClassVar[int]
    header: _std_msgs.Header
    status: NavSatStatus
    latitude: float
    longitude: float
    altitude: float
    position_covariance: _Sequence[float] | _NDArray[_Any]
    position_covariance_type: int
    def __init__(self, header: _std_msgs.Header | None = ..., status: NavSatStatus | None = ..., latitude: float | None = ..., longitude: float | None = ..., altitude: float | None = ..., position_covariance: _Sequence[float] | _NDArray[_Any] | None = ..., position_covariance_type: int | None = ...) -> None: ...
class NavSatStatus(_Message):
    STATUS_NO_FIX: _ClassVar[int]
    STATUS_FIX: _ClassVar[int]
    STATUS_SBAS_FIX: _ClassVar[int]
    STATUS_GBAS_FIX: _ClassVar[int]
    SERVICE_GPS: _ClassVar[int]
    SERVICE_GLONASS: _ClassVar[int]
    SERVICE_COMPASS: _ClassVar[int]
    SERVICE_GALILEO: _ClassVar[int]
    status: int
    service: int
    def __init__(self, status: int | None = ..., service: int | None = ...) -> None: ...
class PointCloud(_Message):
    header: _std_msgs.Header
    points: list[_geometry_msgs.Point32]
    channels: list[ChannelFloat32]
    def __init__(self, header: _std_msgs.Header | None = ..., points: list[_geometry_msgs.Point32] | None = ..., channels: list[ChannelFloat32] | None = ...) -> None: ...
class PointCloud2(_Message):
    header: _std_msgs.Header
    height: int
    width: int
    fields: list[PointField]
    is_bigendian: bool
    point_step: int
    row_step: int
    data: bytes
    is_dense: bool
    def __init__(self, header: _std_msgs.Header | None = ..., height: int | None = ..., width: int | None = ..., fields: list[PointField] | None = ..., is_bigendian: bool | None = ..., point_step: int | None = ..., row_step: int | None = ..., data: bytes | None = ..., is_dense: bool | None = ...) -> None: ...
class PointField(_Message):
    INT8: _ClassVar[int]
    UINT8: _ClassVar[int]
    INT16: _ClassVar[int]
    UINT16: _ClassVar[int]
    INT32: _ClassVar[int]
    UINT32: _ClassVar[int]
    FLOAT32: _ClassVar[int]
    FLOAT64: _ClassVar[int]
    name: str
    offset: int
    datatype: int
    count: int
    def __init__(self, name: str | None = ..., offset: int | None = ..., datatype: int | None = ..., count: int | None = ...) -> None: ...
class Range(_Message):
    ULTRASOUND: _ClassVar[int]
    INFRARED: _ClassVar[int]
    header: _std_msgs.Header
    radiation_type: int
    field_of_view: float
    min_range: float
    max_range: float
    range: float
    def __init__(self, header: _std_msgs.Header | None = ..., radiation_type: int | None = ..., field_of_view: float | None = ..., min_range: float | None = ..., max_range: float | None = ..., range: float | None = ...) -> None: ...
class RegionOfInterest(_Message):
    x_offset: int
    y_offset: int
    height: int
    width: int
    do_rectify: bool
    def __init__(self, x_offset: int | None = ..., y_offset: int | None = ..., height: int | None = ..., width: int | None = ..., do_rectify: bool | None = ...) -> None: ...
class RelativeHumidity(_Message):
    header: _std_msgs.Header
    relative_humidity: float
    variance: float
    def __init__(self, header: _std_msgs.Header | None = ..., relative_humidity: float | None = ..., variance: float | None = ...) -> None: ...
class Temperature(_Message):
    header: _std_msgs.Header
    temperature: float
    variance: float
    def __init__(self, header: _std_msgs.Header | None = ..., temperature: float | None = ..., variance: float | None = ...) -> None: ...
class TimeReference(_Message):
    header: _std_msgs.Header
    time_ref: _Time
    source: str
    def __init__(self, header: _std_msgs.Header | None = ..., time_ref: _Time | None = ..., source: str | None = ...) -> None: ...
