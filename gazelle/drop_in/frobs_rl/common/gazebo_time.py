"""Time of the simulator: pause, step, reset."""

from __future__ import annotations

import functools
import subprocess

from gazelle.clients.errors import ClientError
from gazelle.clients.gazebo import Gazebo
from gazelle.drop_in.frobs_rl.common.connection import gazebo, reporting
from gazelle_ros.tools.graph import GraphInspector

_STEP = "/gazelle/step"


@reporting
def gazebo_reset_sim(retries: int = 5) -> None:
    """Reset the simulation with its time; ``retries`` is accepted without effect."""
    del retries
    gazebo().reset_simulation()


@reporting
def gazebo_reset_world(retries: int = 5) -> None:
    """Reset the models; time continues."""
    del retries
    gazebo().reset_world()


@reporting
def gazebo_pause_physics(retries: int = 5) -> None:
    """Pause the simulation."""
    del retries
    gazebo().pause()


@reporting
def gazebo_unpause_physics(retries: int = 5) -> None:
    """Unpause the simulation."""
    del retries
    gazebo().unpause()


@functools.lru_cache(maxsize=4)
def _is_gazelle(simulator: Gazebo) -> bool:
    """Return whether a simulator offers a service that makes steps."""
    with GraphInspector("frobs_rl", simulator.node.master_uri) as graph:
        return graph.service_uri(_STEP) is not None


@reporting
def gazebo_step_physics(steps: int = 1) -> None:
    """Advance a paused world by steps; with Gazelle they are done when this returns.

    A real Gazebo is set by its command, ``gz world``, which returns at once.
    """
    simulator = gazebo()
    if _is_gazelle(simulator):
        simulator.step(steps)
        return
    command = ["gz", "world", "-m", str(steps)]
    try:
        subprocess.run(command, check=True, capture_output=True)  # noqa: S603  # Gazebo's program
    except (OSError, subprocess.CalledProcessError) as error:
        raise ClientError(f"the simulator takes no steps: {error}") from error
