# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Duration as _Duration
from gazelle_ros.time import Time as _Time

class Bool(_Message):
    data: bool
    def __init__(self, data: bool | None = ...) -> None: ...
class Byte(_Message):
    data: int
    def __init__(self, data: int | None = ...) -> None: ...
class ByteMultiArray(_Message):
    layout: MultiArrayLayout
    data: _Sequence[int] | _NDArray[_Any]
    def __init__(self, layout: MultiArrayLayout | None = ..., data: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class Char(_Message):
    data: int
    def __init__(self, data: int | None = ...) -> None: ...
class ColorRGBA(_Message):
    r: float
    g: float
    b: float
    a: float
    def __init__(self, r: float | None = ..., g: float | None = ..., b: float | None = ..., a: float | None = ...) -> None: ...
class Duration(_Message):
    data: _Duration
    def __init__(self, data: _Duration | None = ...) -> None: ...
class Empty(_Message):
    def __init__(self) -> None: ...
class Float32(_Message):
    data: float
    def __init__(self, data: float | None = ...) -> None: ...
class Float32MultiArray(_Message):
    layout: MultiArrayLayout
    data: _Sequence[float] | _NDArray[_Any]
    def __init__(self, layout: MultiArrayLayout | None = ..., data: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class Float64(_Message):
    data: float
    def __init__(self, data: float | None = ...) -> None: ...
class Float64MultiArray(_Message):
    layout: MultiArrayLayout
    data: _Sequence[float] | _NDArray[_Any]
    def __init__(self, layout: MultiArrayLayout | None = ..., data: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class Header(_Message):
    seq: int
    stamp: _Time
    frame_id: str
    def __init__(self, seq: int | None = ..., stamp: _Time | None = ..., frame_id: str | None = ...) -> None: ...
class Int16(_Message):
    data: int
    def __init__(self, data: int | None = ...) -> None: ...
class Int16MultiArray(_Message):
    layout: MultiArrayLayout
    data: _Sequence[int] | _NDArray[_Any]
    def __init__(self, layout: MultiArrayLayout | None = ..., data: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class Int32(_Message):
    data: int
    def __init__(self, data: int | None = ...) -> None: ...
class Int32MultiArray(_Message):
    layout: MultiArrayLayout
    data: _Sequence[int] | _NDArray[_Any]
    def __init__(self, layout: MultiArrayLayout | None = ..., data: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class Int64(_Message):
    data: int
    def __init__(self, data: int | None = ...) -> None: ...
class Int64MultiArray(_Message):
    layout: MultiArrayLayout
    data: _Sequence[int] | _NDArray[_Any]
    def __init__(self, layout: MultiArrayLayout | None = ..., data: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class Int8(_Message):
    data: int
    def __init__(self, data: int | None = ...) -> None: ...
class Int8MultiArray(_Message):
    layout: MultiArrayLayout
    data: _Sequence[int] | _NDArray[_Any]
    def __init__(self, layout: MultiArrayLayout | None = ..., data: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class MultiArrayDimension(_Message):
    label: str
    size: int
    stride: int
    def __init__(self, label: str | None = ..., size: int | None = ..., stride: int | None = ...) -> None: ...
class MultiArrayLayout(_Message):
    dim: list[MultiArrayDimension]
    data_offset: int
    def __init__(self, dim: list[MultiArrayDimension] | None = ..., data_offset: int | None = ...) -> None: ...
class String(_Message):
    data: str
    def __init__(self, data: str | None = ...) -> None: ...
class Time(_Message):
    data: _Time
    def __init__(self, data: _Time | None = ...) -> None: ...
class UInt16(_Message):
    data: int
    def __init__(self, data: int | None = ...) -> None: ...
class UInt16MultiArray(_Message):
    layout: MultiArrayLayout
    data: _Sequence[int] | _NDArray[_Any]
    def __init__(self, layout: MultiArrayLayout | None = ..., data: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class UInt32(_Message):
    data: int
    def __init__(self, data: int | None = ...) -> None: ...
class UInt32MultiArray(_Message):
    layout: MultiArrayLayout
    data: _Sequence[int] | _NDArray[_Any]
    def __init__(self, layout: MultiArrayLayout | None = ..., data: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class UInt64(_Message):
    data: int
    def __init__(self, data: int | None = ...) -> None: ...
class UInt64MultiArray(_Message):
    layout: MultiArrayLayout
    data: _Sequence[int] | _NDArray[_Any]
    def __init__(self, layout: MultiArrayLayout | None = ..., data: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class UInt8(_Message):
    data: int
    def __init__(self, data: int | None = ...) -> None: ...
class UInt8MultiArray(_Message):
    layout: MultiArrayLayout
    data: bytes
    def __init__(self, layout: MultiArrayLayout | None = ..., data: bytes | None = ...) -> None: ...
