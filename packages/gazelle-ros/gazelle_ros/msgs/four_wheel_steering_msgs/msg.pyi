# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class FourWheelSteering(_Message):
    front_steering_angle: float
    rear_steering_angle: float
    front_steering_angle_velocity: float
    rear_steering_angle_velocity: float
    speed: float
    acceleration: float
    jerk: float
    def __init__(self, front_steering_angle: float | None = ..., rear_steering_angle: float | None = ..., front_steering_angle_velocity: float | None = ..., rear_steering_angle_velocity: float | None = ..., speed: float | None = ..., acceleration: float | None = ..., jerk: float | None = ...) -> None: ...
class FourWheelSteeringStamped(_Message):
    header: _std_msgs.Header
    data: FourWheelSteering
    def __init__(self, header: _std_msgs.Header | None = ..., data: FourWheelSteering | None = ...) -> None: ...
