# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Duration as _Duration
from gazelle_ros.time import Time as _Time
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class ControllerState(_Message):
    name: str
    state: str
    type: str
    claimed_resources: list[HardwareInterfaceResources]
    def __init__(self, name: str | None = ..., state: str | None = ..., type: str | None = ..., claimed_resources: list[HardwareInterfaceResources] | None = ...) -> None: ...
class ControllerStatistics(_Message):
    name: str
    type: str
    timestamp: _Time
    running: bool
    max_time: _Duration
    mean_time: _Duration
    variance_time: _Duration
    num_control_loop_overruns: int
    time_last_control_loop_overrun: _Time
    def __init__(self, name: str | None = ..., type: str | None = ..., timestamp: _Time | None = ..., running: bool | None = ..., max_time: _Duration | None = ..., mean_time: _Duration | None = ..., variance_time: _Duration | None = ..., num_control_loop_overruns: int | None = ..., time_last_control_loop_overrun: _Time | None = ...) -> None: ...
class ControllersStatistics(_Message):
    header: _std_msgs.Header
    controller: list[ControllerStatistics]
    def __init__(self, header: _std_msgs.Header | None = ..., controller: list[ControllerStatistics] | None = ...) -> None: ...
class HardwareInterfaceResources(_Message):
    hardware_interface: str
    resources: list[str]
    def __init__(self, hardware_interface: str | None = ..., resources: list[str] | None = ...) -> None: ...
