# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.controller_manager_msgs import msg as _controller_manager_msgs

class ListControllerTypesRequest(_Message):
    def __init__(self) -> None: ...
class ListControllerTypesResponse(_Message):
    types: list[str]
    base_classes: list[str]
    def __init__(self, types: list[str] | None = ..., base_classes: list[str] | None = ...) -> None: ...
class ListControllerTypes(_ServiceDefinition):
    _request_class: _ClassVar[type[ListControllerTypesRequest]]
    _response_class: _ClassVar[type[ListControllerTypesResponse]]
class ListControllersRequest(_Message):
    def __init__(self) -> None: ...
class ListControllersResponse(_Message):
    controller: list[_controller_manager_msgs.ControllerState]
    def __init__(self, controller: list[_controller_manager_msgs.ControllerState] | None = ...) -> None: ...
class ListControllers(_ServiceDefinition):
    _request_class: _ClassVar[type[ListControllersRequest]]
    _response_class: _ClassVar[type[ListControllersResponse]]
class LoadControllerRequest(_Message):
    name: str
    def __init__(self, name: str | None = ...) -> None: ...
class LoadControllerResponse(_Message):
    ok: bool
    def __init__(self, ok: bool | None = ...) -> None: ...
class LoadController(_ServiceDefinition):
    _request_class: _ClassVar[type[LoadControllerRequest]]
    _response_class: _ClassVar[type[LoadControllerResponse]]
class ReloadControllerLibrariesRequest(_Message):
    force_kill: bool
    def __init__(self, force_kill: bool | None = ...) -> None: ...
class ReloadControllerLibrariesResponse(_Message):
    ok: bool
    def __init__(self, ok: bool | None = ...) -> None: ...
class ReloadControllerLibraries(_ServiceDefinition):
    _request_class: _ClassVar[type[ReloadControllerLibrariesRequest]]
    _response_class: _ClassVar[type[ReloadControllerLibrariesResponse]]
class SwitchControllerRequest(_Message):
    BEST_EFFORT: _ClassVar[int]
    STRICT: _ClassVar[int]
    start_controllers: list[str]
    stop_controllers: list[str]
    strictness: int
    start_asap: bool
    timeout: float
    def __init__(self, start_controllers: list[str] | None = ..., stop_controllers: list[str] | None = ..., strictness: int | None = ..., start_asap: bool | None = ..., timeout: float | None = ...) -> None: ...
class SwitchControllerResponse(_Message):
    ok: bool
    def __init__(self, ok: bool | None = ...) -> None: ...
class SwitchController(_ServiceDefinition):
    _request_class: _ClassVar[type[SwitchControllerRequest]]
    _response_class: _ClassVar[type[SwitchControllerResponse]]
class UnloadControllerRequest(_Message):
    name: str
    def __init__(self, name: str | None = ...) -> None: ...
class UnloadControllerResponse(_Message):
    ok: bool
    def __init__(self, ok: bool | None = ...) -> None: ...
class UnloadController(_ServiceDefinition):
    _request_class: _ClassVar[type[UnloadControllerRequest]]
    _response_class: _ClassVar[type[UnloadControllerResponse]]
