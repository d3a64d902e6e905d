# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class SmachContainerInitialStatusCmd(_Message):
    path: str
    initial_states: list[str]
    local_data: str
    def __init__(self, path: str | None = ..., initial_states: list[str] | None = ..., local_data: str | None = ...) -> None: ...
class SmachContainerStatus(_Message):
    header: _std_msgs.Header
    path: str
    initial_states: list[str]
    active_states: list[str]
    local_data: str
    info: str
    def __init__(self, header: _std_msgs.Header | None = ..., path: str | None = ..., initial_states: list[str] | None = ..., active_states: list[str] | None = ..., local_data: str | None = ..., info: str | None = ...) -> None: ...
class SmachContainerStructure(_Message):
    header: _std_msgs.Header
    path: str
    children: list[str]
    internal_outcomes: list[str]
    outcomes_from: list[str]
    outcomes_to: list[str]
    container_outcomes: list[str]
    def __init__(self, header: _std_msgs.Header | None = ..., path: str | None = ..., children: list[str] | None = ..., internal_outcomes: list[str] | None = ..., outcomes_from: list[str] | None = ..., outcomes_to: list[str] | None = ..., container_outcomes: list[str] | None = ...) -> None: ...
