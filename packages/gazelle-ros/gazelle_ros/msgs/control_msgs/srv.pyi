# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from typing import ClassVar as _ClassVar
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.time import Time as _Time

class QueryCalibrationStateRequest(_Message):
    def __init__(self) -> None: ...
class QueryCalibrationStateResponse(_Message):
    is_calibrated: bool
    def __init__(self, is_calibrated: bool | None = ...) -> None: ...
class QueryCalibrationState(_ServiceDefinition):
    _request_class: _ClassVar[type[QueryCalibrationStateRequest]]
    _response_class: _ClassVar[type[QueryCalibrationStateResponse]]
class QueryTrajectoryStateRequest(_Message):
    time: _Time
    def __init__(self, time: _Time | None = ...) -> None: ...
class QueryTrajectoryStateResponse(_Message):
    name: list[str]
    position: _Sequence[float] | _NDArray[_Any]
    velocity: _Sequence[float] | _NDArray[_Any]
    acceleration: _Sequence[float] | _NDArray[_Any]
    def __init__(self, name: list[str] | None = ..., position: _Sequence[float] | _NDArray[_Any] | None = ..., velocity: _Sequence[float] | _NDArray[_Any] | None = ..., acceleration: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class QueryTrajectoryState(_ServiceDefinition):
    _request_class: _ClassVar[type[QueryTrajectoryStateRequest]]
    _response_class: _ClassVar[type[QueryTrajectoryStateResponse]]
