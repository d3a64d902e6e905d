# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class Floats(_Message):
    data: _Sequence[float] | _NDArray[_Any]
    def __init__(self, data: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class HeaderString(_Message):
    header: _std_msgs.Header
    data: str
    def __init__(self, header: _std_msgs.Header | None = ..., data: str | None = ...) -> None: ...
