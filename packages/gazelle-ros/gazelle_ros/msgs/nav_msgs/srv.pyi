# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.nav_msgs import msg as _nav_msgs

class GetMapRequest(_Message):
    def __init__(self) -> None: ...
class GetMapResponse(_Message):
    map: _nav_msgs.OccupancyGrid
    def __init__(self, map: _nav_msgs.OccupancyGrid | None = ...) -> None: ...
class GetMap(_ServiceDefinition):
    _request_class: _ClassVar[type[GetMapRequest]]
    _response_class: _ClassVar[type[GetMapResponse]]
class GetPlanRequest(_Message):
    start: _geometry_msgs.PoseStamped
    goal: _geometry_msgs.PoseStamped
    tolerance: float
    def __init__(self, start: _geometry_msgs.PoseStamped | None = ..., goal: _geometry_msgs.PoseStamped | None = ..., tolerance: float | None = ...) -> None: ...
class GetPlanResponse(_Message):
    plan: _nav_msgs.Path
    def __init__(self, plan: _nav_msgs.Path | None = ...) -> None: ...
class GetPlan(_ServiceDefinition):
    _request_class: _ClassVar[type[GetPlanRequest]]
    _response_class: _ClassVar[type[GetPlanResponse]]
class LoadMapRequest(_Message):
    map_url: str
    def __init__(self, map_url: str | None = ...) -> None: ...
class LoadMapResponse(_Message):
    RESULT_SUCCESS: _ClassVar[int]
    RESULT_MAP_DOES_NOT_EXIST: _ClassVar[int]
    RESULT_INVALID_MAP_DATA: _ClassVar[int]
    RESULT_INVALID_MAP_METADATA: _ClassVar[int]
    RESULT_UNDEFINED_FAILURE: _ClassVar[int]
    map: _nav_msgs.OccupancyGrid
    result: int
    def __init__(self, map: _nav_msgs.OccupancyGrid | None = ..., result: int | None = ...) -> None: ...
class LoadMap(_ServiceDefinition):
    _request_class: _ClassVar[type[LoadMapRequest]]
    _response_class: _ClassVar[type[LoadMapResponse]]
class SetMapRequest(_Message):
    map: _nav_msgs.OccupancyGrid
    initial_pose: _geometry_msgs.PoseWithCovarianceStamped
    def __init__(self, map: _nav_msgs.OccupancyGrid | None = ..., initial_pose: _geometry_msgs.PoseWithCovarianceStamped | None = ...) -> None: ...
class SetMapResponse(_Message):
    success: bool
    def __init__(self, success: bool | None = ...) -> None: ...
class SetMap(_ServiceDefinition):
    _request_class: _ClassVar[type[SetMapRequest]]
    _response_class: _ClassVar[type[SetMapResponse]]
