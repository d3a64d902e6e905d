"""Core processes that roslaunch starts where there is no master: ``rosmaster`` and ``rosout``.

They are called so, too: helper scripts end them by ``killall rosmaster``, and a master survives the
end of the launcher by ``killall -9 roslaunch``, as with ROS.
"""

from __future__ import annotations

import sys
import time

from gazelle_ros.errors import MasterUnreachableError
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.plan import NodePlan, SourceLocation
from gazelle_ros.launch.process import NodeProcess
from gazelle_ros.launch.programs import Program
from gazelle_ros.master.proxy import MasterProxy

_PLACE = SourceLocation("roscore", 0, "node")
_LOOK_S = 0.005
_MASTER_S = 30.0
"""Seconds a master may take to answer, on the slowest of machines."""
_ROSOUT_S = 10.0
"""Seconds to wait for rosout; nodes work without, but what they log early would be lost."""

ROSOUT_PROGRAM = Program((sys.executable, "-m", "gazelle_ros.builtin.rosout"), None)
"""Program that copies all that nodes log to ``/rosout_agg``."""
MASTER = NodePlan(
    package="rosmaster", type="rosmaster", name="master", namespace="/", place=_PLACE, required=True
)
ROSOUT = NodePlan(
    package="rosout",
    type="rosout",
    name="rosout",
    namespace="/",
    place=_PLACE,
    respawn=True,
    respawn_delay=0.5,
)


def master_program(host: str, port: int, run_id: str) -> Program:
    """Return the program of a master.

    Args:
        host: The name nodes reach it by.
        port: Port.
        run_id: Value for ``/run_id``.
    """
    words = ("--core", "-p", str(port), "--host", host, "--run-id", run_id)
    return Program((sys.executable, "-m", "gazelle_ros.master.rosmaster", *words), None)


def await_master(master: MasterProxy, process: NodeProcess) -> None:
    """Wait until a master that was just started answers.

    Raises:
        LaunchError: It ended, or takes too long.
    """
    deadline = time.monotonic() + _MASTER_S
    while True:
        try:
            master.greet()
        except MasterUnreachableError as error:
            if process.poll() is not None:
                raise LaunchError(f"the master ended with code {process.poll()}") from None
            if time.monotonic() > deadline:
                raise LaunchError(f"the new master is silent: {error}") from None
            time.sleep(_LOOK_S)
        else:
            return


def await_rosout(master: MasterProxy) -> bool:
    """Wait for rosout, so that nothing is lost that nodes log at once.

    Returns:
        Whether it has.
    """
    deadline = time.monotonic() + _ROSOUT_S
    while "/rosout" not in master.system_state()[1]:
        if time.monotonic() > deadline:
            return False
        time.sleep(_LOOK_S)
    return True
