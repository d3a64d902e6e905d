# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Duration as _Duration
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class ImageMarker(_Message):
    CIRCLE: _ClassVar[int]
    LINE_STRIP: _ClassVar[int]
    LINE_LIST: _ClassVar[int]
    POLYGON: _ClassVar[int]
    POINTS: _ClassVar[int]
    ADD: _ClassVar[int]
    REMOVE: _ClassVar[int]
    header: _std_msgs.Header
    ns: str
    id: int
    type: int
    action: int
    position: _geometry_msgs.Point
    scale: float
    outline_color: _std_msgs.ColorRGBA
    filled: int
    fill_color: _std_msgs.ColorRGBA
    lifetime: _Duration
    points: list[_geometry_msgs.Point]
    outline_colors: list[_std_msgs.ColorRGBA]
    def __init__(self, header: _std_msgs.Header | None = ..., ns: str | None = ..., id: int | None = ..., type: int | None = ..., action: int | None = ..., position: _geometry_msgs.Point | None = ..., scale: float | None = ..., outline_color: _std_msgs.ColorRGBA | None = ..., filled: int | None = ..., fill_color: _std_msgs.ColorRGBA | None = ..., lifetime: _Duration | None = ..., points: list[_geometry_msgs.Point] | None = ..., outline_colors: list[_std_msgs.ColorRGBA] | None = ...) -> None: ...
class InteractiveMarker(_Message):
    header: _std_msgs.Header
    pose: _geometry_msgs.Pose
    name: str
    description: str
    scale: float
    menu_entries: list[MenuEntry]
    controls: list[InteractiveMarkerControl]
    def __init__(self, header: _std_msgs.Header | None = ..., pose: _geometry_msgs.Pose | None = ..., name: str | None = ..., description: str | None = ..., scale: float | None = ..., menu_entries: list[MenuEntry] | None = ..., controls: list[InteractiveMarkerControl] | None = ...) -> None: ...
class InteractiveMarkerControl(_Message):
    INHERIT: _ClassVar[int]
    FIXED: _ClassVar[int]
    VIEW_FACING: _ClassVar[int]
    NONE: _ClassVar[int]
    MENU: _ClassVar[int]
    BUTTON: _ClassVar[int]
    MOVE_AXIS: _ClassVar[int]
    MOVE_PLANE: _ClassVar[int]
    ROTATE_AXIS: _ClassVar[int]
    MOVE_ROTATE: _ClassVar[int]
    MOVE_3D: _ClassVar[int]
    ROTATE_3D: _ClassVar[int]
    MOVE_ROTATE_3D: _ClassVar[int]
    name: str
    orientation: _geometry_msgs.Quaternion
    orientation_mode: int
    interaction_mode: int
    always_visible: bool
    markers: list[Marker]
    independent_marker_orientation: bool
    description: str
    def __init__(self, name: str | None = ..., orientation: _geometry_msgs.Quaternion | None = ..., orientation_mode: int | None = ..., interaction_mode: int | None = ..., always_visible: bool | None = ..., markers: list[Marker] | None = ..., independent_marker_orientation: bool | None = ..., description: str | None = ...) -> None: ...
class InteractiveMarkerFeedback(_Message):
    KEEP_ALIVE: _ClassVar[int]
    POSE_UPDATE: _ClassVar[int]
    MENU_SELECT: _ClassVar[int]
    BUTTON_CLICK: _ClassVar[int]
    MOUSE_DOWN: _ClassVar[int]
    MOUSE_UP: _ClassVar[int]
    header: _std_msgs.Header
    client_id: str
    marker_name: str
    control_name: str
    event_type: int
    pose: _geometry_msgs.Pose
    menu_entry_id: int
    mouse_point: _geometry_msgs.Point
    mouse_point_valid: bool
    def __init__(self, header: _std_msgs.Header | None = ..., client_id: str | None = ..., marker_name: str | None = ..., control_name: str | None = ..., event_type: int | None = ..., pose: _geometry_msgs.Pose | None = ..., menu_entry_id: int | None = ..., mouse_point: _geometry_msgs.Point | None = ..., mouse_point_valid: bool | None = ...) -> None: ...
class InteractiveMarkerInit(_Message):
    server_id: str
    seq_num: int
    markers: list[InteractiveMarker]
    def __init__(self, server_id: str | None = ..., seq_num: int | None = ..., markers: list[InteractiveMarker] | None = ...) -> None: ...
class InteractiveMarkerPose(_Message):
    header: _std_msgs.Header
    pose: _geometry_msgs.Pose
    name: str
    def __init__(self, header: _std_msgs.Header | None = ..., pose: _geometry_msgs.Pose | None = ..., name: str | None = ...) -> None: ...
class InteractiveMarkerUpdate(_Message):
    KEEP_ALIVE: _ClassVar[int]
    UPDATE: _ClassVar[int]
    server_id: str
    seq_num: int
    type: int
    markers: list[InteractiveMarker]
    poses: list[InteractiveMarkerPose]
    erases: list[str]
    def __init__(self, server_id: str | None = ..., seq_num: int | None = ..., type: int | None = ..., markers: list[InteractiveMarker] | None = ..., poses: list[InteractiveMarkerPose] | None = ..., erases: list[str] | None = ...) -> None: ...
class Marker(_Message):
    ARROW: _ClassVar[int]
    CUBE: _ClassVar[int]
    SPHERE: _ClassVar[int]
    CYLINDER: _ClassVar[int]
    LINE_STRIP: _ClassVar[int]
    LINE_LIST: _ClassVar[int]
    CUBE_LIST: _ClassVar[int]
    SPHERE_LIST: _ClassVar[int]
    POINTS: _ClassVar[int]
    TEXT_VIEW_FACING: _ClassVar[int]
    MESH_RESOURCE: _ClassVar[int]
    TRIANGLE_LIST: _ClassVar[int]
    ADD: _ClassVar[int]
    MODIFY: _ClassVar[int]
    DELETE: _ClassVar[int]
    DELETEALL: _ClassVar[int]
    header: _std_msgs.Header
    ns: str
    id: int
    type: int
    action: int
    pose: _geometry_msgs.Pose
    scale: _geometry_msgs.Vector3
    color: _std_msgs.ColorRGBA
    lifetime: _Duration
    frame_locked: bool
    points: list[_geometry_msgs.Point]
    colors: list[_std_msgs.ColorRGBA]
    text: str
    mesh_resource: str
    mesh_use_embedded_materials: bool
    def __init__(self, header: _std_msgs.Header | None = ..., ns: str | None = ..., id: int | None = ..., type: int | None = ..., action: int | None = ..., pose: _geometry_msgs.Pose | None = ..., scale: _geometry_msgs.Vector3 | None = ..., color: _std_msgs.ColorRGBA | None = ..., lifetime: _Duration | None = ..., frame_locked: bool | None = ..., points: list[_geometry_msgs.Point] | None = ..., colors: list[_std_msgs.ColorRGBA] | None = ..., text: str | None = ..., mesh_resource: str | None = ..., mesh_use_embedded_materials: bool | None = ...) -> None: ...
class MarkerArray(_Message):
    markers: list[Marker]
    def __init__(self, markers: list[Marker] | None = ...) -> None: ...
class MenuEntry(_Message):
    FEEDBACK: _ClassVar[int]
    ROSRUN: _ClassVar[int]
    ROSLAUNCH: _ClassVar[int]
    id: int
    parent_id: int
    title: str
    command: str
    command_type: int
    def __init__(self, id: int | None = ..., parent_id: int | None = ..., title: str | None = ..., command: str | None = ..., command_type: int | None = ...) -> None: ...
