# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.sensor_msgs import msg as _sensor_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class PanoramaImg(_Message):
    header: _std_msgs.Header
    pano_id: str
    latitude: float
    longitude: float
    heading: float
    geo_tag: str
    image: _sensor_msgs.Image
    def __init__(self, header: _std_msgs.Header | None = ..., pano_id: str | None = ..., latitude: float | None = ..., longitude: float | None = ..., heading: float | None = ..., geo_tag: str | None = ..., image: _sensor_msgs.Image | None = ...) -> None: ...
