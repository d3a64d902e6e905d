"""The end of the program for state machines."""

from __future__ import annotations

import threading
from typing import Any

from gazelle_ros.compat import rospy

_LOOK_S = 0.1
_LOOKS = 15


def set_preempt_handler(sc: Any) -> None:
    """Request a container to end early when the node shuts down, and wait for it briefly."""

    def end(_reason: str = "") -> None:
        sc.request_preempt()
        for _ in range(_LOOKS):
            if not sc.is_running():
                return
            threading.Event().wait(_LOOK_S)

    rospy.core.add_preshutdown_hook(end)
