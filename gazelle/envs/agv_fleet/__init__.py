"""A fleet of AGVs in one hall, each with a goal of its own.

::

    from gazelle.envs.agv_fleet import parallel_env

    env = parallel_env(agents=12)  # PettingZoo's parallel API; needs gazelle[marl]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle.envs.agv_fleet.parallel import AGVFleetParallelEnv

__all__ = ["parallel_env"]


def parallel_env(**options: Any) -> AGVFleetParallelEnv:
    """Return the fleet under PettingZoo's parallel API; see `AGVFleetParallelEnv`.

    Raises:
        MissingExtraError: PettingZoo is not installed.
        TaskError: An option is invalid.
    """
    from gazelle.envs.agv_fleet.parallel import AGVFleetParallelEnv

    return AGVFleetParallelEnv(**options)
