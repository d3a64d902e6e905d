# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from typing import ClassVar as _ClassVar
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.actionlib_msgs import msg as _actionlib_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class AutoDockingAction(_Message):
    action_goal: AutoDockingActionGoal
    action_result: AutoDockingActionResult
    action_feedback: AutoDockingActionFeedback
    def __init__(self, action_goal: AutoDockingActionGoal | None = ..., action_result: AutoDockingActionResult | None = ..., action_feedback: AutoDockingActionFeedback | None = ...) -> None: ...
class AutoDockingActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: AutoDockingFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: AutoDockingFeedback | None = ...) -> None: ...
class AutoDockingActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: AutoDockingGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: AutoDockingGoal | None = ...) -> None: ...
class AutoDockingActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: AutoDockingResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: AutoDockingResult | None = ...) -> None: ...
class AutoDockingFeedback(_Message):
    state: str
    text: str
    def __init__(self, state: str | None = ..., text: str | None = ...) -> None: ...
class AutoDockingGoal(_Message):
    def __init__(self) -> None: ...
class AutoDockingResult(_Message):
    text: str
    def __init__(self, text: str | None = ...) -> None: ...
class BumperEvent(_Message):
    LEFT: _ClassVar[int]
    CENTER: _ClassVar[int]
    RIGHT: _ClassVar[int]
    RELEASED: _ClassVar[int]
    PRESSED: _ClassVar[int]
    bumper: int
    state: int
    def __init__(self, bumper: int | None = ..., state: int | None = ...) -> None: ...
class ButtonEvent(_Message):
    Button0: _ClassVar[int]
    Button1: _ClassVar[int]
    Button2: _ClassVar[int]
    RELEASED: _ClassVar[int]
    PRESSED: _ClassVar[int]
    button: int
    state: int
    def __init__(self, button: int | None = ..., state: int | None = ...) -> None: ...
class CliffEvent(_Message):
    LEFT: _ClassVar[int]
    CENTER: _ClassVar[int]
    RIGHT: _ClassVar[int]
    FLOOR: _ClassVar[int]
    CLIFF: _ClassVar[int]
    sensor: int
    state: int
    bottom: int
    def __init__(self, sensor: int | None = ..., state: int | None = ..., bottom: int | None = ...) -> None: ...
class ControllerInfo(_Message):
    DEFAULT: _ClassVar[int]
    USER_CONFIGURED: _ClassVar[int]
    type: int
    p_gain: float
    i_gain: float
    d_gain: float
    def __init__(self, type: int | None = ..., p_gain: float | None = ..., i_gain: float | None = ..., d_gain: float | None = ...) -> None: ...
class DigitalInputEvent(_Message):
    values: list[bool]
    def __init__(self, values: list[bool] | None = ...) -> None: ...
class DigitalOutput(_Message):
    values: list[bool]
    mask: list[bool]
    def __init__(self, values: list[bool] | None = ..., mask: list[bool] | None = ...) -> None: ...
class DockInfraRed(_Message):
    NEAR_LEFT: _ClassVar[int]
    NEAR_CENTER: _ClassVar[int]
    NEAR_RIGHT: _ClassVar[int]
    FAR_LEFT: _ClassVar[int]
    FAR_CENTER: _ClassVar[int]
    FAR_RIGHT: _ClassVar[int]
    header: _std_msgs.Header
    data: bytes
    def __init__(self, header: _std_msgs.Header | None = ..., data: bytes | None = ...) -> None: ...
class ExternalPower(_Message):
    PWR_3_3V1A: _ClassVar[int]
    PWR_5V1A: _ClassVar[int]
    PWR_12V5A: _ClassVar[int]
    PWR_12V1_5A: _ClassVar[int]
    OFF: _ClassVar[int]
    ON: _ClassVar[int]
    source: int
    state: int
    def __init__(self, source: int | None = ..., state: int | None = ...) -> None: ...
class KeyboardInput(_Message):
    KeyCode_Right: _ClassVar[int]
    KeyCode_Left: _ClassVar[int]
    KeyCode_Up: _ClassVar[int]
    KeyCode_Down: _ClassVar[int]
    KeyCode_Space: _ClassVar[int]
    KeyCode_Enable: _ClassVar[int]
    KeyCode_Disable: _ClassVar[int]
    pressedKey: int
    def __init__(self, pressedKey: int | None = ...) -> None: ...
class Led(_Message):
    BLACK: _ClassVar[int]
    GREEN: _ClassVar[int]
    ORANGE: _ClassVar[int]
    RED: _ClassVar[int]
    value: int
    def __init__(self, value: int | None = ...) -> None: ...
class MotorPower(_Message):
    OFF: _ClassVar[int]
    ON: _ClassVar[int]
    state: int
    def __init__(self, state: int | None = ...) -> None: ...
class PowerSystemEvent(_Message):
    UNPLUGGED: _ClassVar[int]
    PLUGGED_TO_ADAPTER: _ClassVar[int]
    PLUGGED_TO_DOCKBASE: _ClassVar[int]
    CHARGE_COMPLETED: _ClassVar[int]
    BATTERY_LOW: _ClassVar[int]
    BATTERY_CRITICAL: _ClassVar[int]
    event: int
    def __init__(self, event: int | None = ...) -> None: ...
class RobotStateEvent(_Message):
    ONLINE: _ClassVar[int]
    OFFLINE: _ClassVar[int]
    state: int
    def __init__(self, state: int | None = ...) -> None: ...
class ScanAngle(_Message):
    header: _std_msgs.Header
    scan_angle: float
    def __init__(self, header: _std_msgs.Header | None = ..., scan_angle: float | None = ...) -> None: ...
class SensorState(_Message):
    BUMPER_RIGHT: _ClassVar[int]
    BUMPER_CENTRE: _ClassVar[int]
    BUMPER_LEFT: _ClassVar[int]
    WHEEL_DROP_RIGHT: _ClassVar[int]
    WHEEL_DROP_LEFT: _ClassVar[int]
    CLIFF_RIGHT: _ClassVar[int]
    CLIFF_CENTRE: _ClassVar[int]
    CLIFF_LEFT: _ClassVar[int]
    BUTTON0: _ClassVar[int]
    BUTTON1: _ClassVar[int]
    BUTTON2: _ClassVar[int]
    DISCHARGING: _ClassVar[int]
    DOCKING_CHARGED: _ClassVar[int]
    DOCKING_CHARGING: _ClassVar[int]
    ADAPTER_CHARGED: _ClassVar[int]
    ADAPTER_CHARGING: _ClassVar[int]
    OVER_CURRENT_LEFT_WHEEL: _ClassVar[int]
    OVER_CURRENT_RIGHT_WHEEL: _ClassVar[int]
    OVER_CURRENT_BOTH_WHEELS: _ClassVar[int]
    DIGITAL_INPUT0: _ClassVar[int]
    DIGITAL_INPUT1: _ClassVar[int]
    DIGITAL_INPUT2: _ClassVar[int]
    DIGITAL_INPUT3: _ClassVar[int]
    DB25_TEST_BOARD_CONNECTED: _ClassVar[int]
    header: _std_msgs.Header
    time_stamp: int
    bumper: int
    wheel_drop: int
    cliff: int
    left_encoder: int
    right_encoder: int
    left_pwm: int
    right_pwm: int
    buttons: int
    charger: int
    battery: int
    bottom: _Sequence[int] | _NDArray[_Any]
    current: bytes
    over_current: int
    digital_input: int
    analog_input: _Sequence[int] | _NDArray[_Any]
    def __init__(self, header: _std_msgs.Header | None = ..., time_stamp: int | None = ..., bumper: int | None = ..., wheel_drop: int | None = ..., cliff: int | None = ..., left_encoder: int | None = ..., right_encoder: int | None = ..., left_pwm: int | None = ..., right_pwm: int | None = ..., buttons: int | None = ..., charger: int | None = ..., battery: int | None = ..., bottom: _Sequence[int] | _NDArray[_Any] | None = ..., current: bytes | None = ..., over_current: int | None = ..., digital_input: int | None = ..., analog_input: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class Sound(_Message):
    ON: _ClassVar[int]
    OFF: _ClassVar[int]
    RECHARGE: _ClassVar[int]
    BUTTON: _ClassVar[int]
    ERROR: _ClassVar[int]
    CLEANINGSTART: _ClassVar[int]
    CLEANINGEND: _ClassVar[int]
    value: int
    def __init__(self, value: int | None = ...) -> None: ...
class VersionInfo(_Message):
    SMOOTH_MOVE_START: _ClassVar[int]
    GYROSCOPE_3D_DATA: _ClassVar[int]
    hardware: str
    firmware: str
    software: str
    udid: _Sequence[int] | _NDArray[_Any]
    features: int
    def __init__(self, hardware: str | None = ..., firmware: str | None = ..., software: str | None = ..., udid: _Sequence[int] | _NDArray[_Any] | None = ..., features: int | None = ...) -> None: ...
class WheelDropEvent(_Message):
    LEFT: _ClassVar[int]
    RIGHT: _ClassVar[int]
    RAISED: _ClassVar[int]
    DROPPED: _ClassVar[int]
    wheel: int
    state: int
    def __init__(self, wheel: int | None = ..., state: int | None = ...) -> None: ...
