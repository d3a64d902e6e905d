# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message

class BoolParameter(_Message):
    name: str
    value: bool
    def __init__(self, name: str | None = ..., value: bool | None = ...) -> None: ...
class Config(_Message):
    bools: list[BoolParameter]
    ints: list[IntParameter]
    strs: list[StrParameter]
    doubles: list[DoubleParameter]
    groups: list[GroupState]
    def __init__(self, bools: list[BoolParameter] | None = ..., ints: list[IntParameter] | None = ..., strs: list[StrParameter] | None = ..., doubles: list[DoubleParameter] | None = ..., groups: list[GroupState] | None = ...) -> None: ...
class ConfigDescription(_Message):
    groups: list[Group]
    max: Config
    min: Config
    dflt: Config
    def __init__(self, groups: list[Group] | None = ..., max: Config | None = ..., min: Config | None = ..., dflt: Config | None = ...) -> None: ...
class DoubleParameter(_Message):
    name: str
    value: float
    def __init__(self, name: str | None = ..., value: float | None = ...) -> None: ...
class Group(_Message):
    name: str
    type: str
    parameters: list[ParamDescription]
    parent: int
    id: int
    def __init__(self, name: str | None = ..., type: str | None = ..., parameters: list[ParamDescription] | None = ..., parent: int | None = ..., id: int | None = ...) -> None: ...
class GroupState(_Message):
    name: str
    state: bool
    id: int
    parent: int
    def __init__(self, name: str | None = ..., state: bool | None = ..., id: int | None = ..., parent: int | None = ...) -> None: ...
class IntParameter(_Message):
    name: str
    value: int
    def __init__(self, name: str | None = ..., value: int | None = ...) -> None: ...
class ParamDescription(_Message):
    name: str
    type: str
    level: int
    description: str
    edit_method: str
    def __init__(self, name: str | None = ..., type: str | None = ..., level: int | None = ..., description: str | None = ..., edit_method: str | None = ...) -> None: ...
class SensorLevels(_Message):
    RECONFIGURE_CLOSE: _ClassVar[int]
    RECONFIGURE_STOP: _ClassVar[int]
    RECONFIGURE_RUNNING: _ClassVar[int]
    def __init__(self) -> None: ...
class StrParameter(_Message):
    name: str
    value: str
    def __init__(self, name: str | None = ..., value: str | None = ...) -> None: ...
