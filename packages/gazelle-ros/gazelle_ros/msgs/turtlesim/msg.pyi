# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message

class Color(_Message):
    r: int
    g: int
    b: int
    def __init__(self, r: int | None = ..., g: int | None = ..., b: int | None = ...) -> None: ...
class Pose(_Message):
    x: float
    y: float
    theta: float
    linear_velocity: float
    angular_velocity: float
    def __init__(self, x: float | None = ..., y: float | None = ..., theta: float | None = ..., linear_velocity: float | None = ..., angular_velocity: float | None = ...) -> None: ...
