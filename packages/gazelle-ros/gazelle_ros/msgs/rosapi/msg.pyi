# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message

class TypeDef(_Message):
    type: str
    fieldnames: list[str]
    fieldtypes: list[str]
    fieldarraylen: _Sequence[int] | _NDArray[_Any]
    examples: list[str]
    constnames: list[str]
    constvalues: list[str]
    def __init__(self, type: str | None = ..., fieldnames: list[str] | None = ..., fieldtypes: list[str] | None = ..., fieldarraylen: _Sequence[int] | _NDArray[_Any] | None = ..., examples: list[str] | None = ..., constnames: list[str] | None = ..., constvalues: list[str] | None = ...) -> None: ...
