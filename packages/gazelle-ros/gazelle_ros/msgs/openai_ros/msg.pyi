# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message

class RLExperimentInfo(_Message):
    episode_number: int
    episode_reward: float
    def __init__(self, episode_number: int | None = ..., episode_reward: float | None = ...) -> None: ...
