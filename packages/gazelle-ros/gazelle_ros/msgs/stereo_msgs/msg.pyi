# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.sensor_msgs import msg as _sensor_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class DisparityImage(_Message):
    header: _std_msgs.Header
    image: _sensor_msgs.Image
    f: float
    T: float
    valid_window: _sensor_msgs.RegionOfInterest
    min_disparity: float
    max_disparity: float
    delta_d: float
    def __init__(self, header: _std_msgs.Header | None = ..., image: _sensor_msgs.Image | None = ..., f: float | None = ..., T: float | None = ..., valid_window: _sensor_msgs.RegionOfInterest | None = ..., min_disparity: float | None = ..., max_disparity: float | None = ..., delta_d: float | None = ...) -> None: ...
