# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class AckermannDrive(_Message):
    steering_angle: float
    steering_angle_velocity: float
    speed: float
    acceleration: float
    jerk: float
    def __init__(self, steering_angle: float | None = ..., steering_angle_velocity: float | None = ..., speed: float | None = ..., acceleration: float | None = ..., jerk: float | None = ...) -> None: ...
class AckermannDriveStamped(_Message):
    header: _std_msgs.Header
    drive: AckermannDrive
    def __init__(self, header: _std_msgs.Header | None = ..., drive: AckermannDrive | None = ...) -> None: ...
