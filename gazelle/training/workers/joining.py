"""From a run's configuration to the workers that play its rollouts."""

from __future__ import annotations

from collections.abc import Callable

from gazelle.training.copies import TaskCopies
from gazelle.training.episodes import Episodes
from gazelle.training.runs import RunConfig
from gazelle.training.tasks import fitting_copies, make_task
from gazelle.training.workers.clusters import connect, start_actors
from gazelle.training.workers.processes import start_processes
from gazelle.training.workers.shards import ShardSpec, divided
from gazelle.training.workers.team import WorkerGroup
from gazelle.training.workers.vecenv import WorkerVecEnv


def join_workers(
    config: RunConfig,
    workers: int | None,
    ray: str | None,
    on_episodes: Callable[[Episodes], None],
) -> WorkerVecEnv:
    """Start workers for a run.

    Args:
        config: Configuration of the run.
        workers: Number of workers; by default one, or one for each processor of a cluster.
        ray: The address of a Ray cluster; None for processes on this machine.
        on_episodes: Called with the episodes that ended.

    Raises:
        TaskError: There are more workers than parts, or the task cannot be divided so.
        MissingExtraError: Ray is requested and not installed.
    """
    recipe = config.recipe
    fewest = fitting_copies(config.task, 1, config.options)
    sizes = divided(recipe.num_envs, fewest)
    blueprint = ShardSpec(
        task=config.task,
        sizes=sizes,
        options=config.options,
        imports=config.imports,
        reward_scale=recipe.reward_scale,
        goal_reward=recipe.goal_reward,
    )
    if ray is None:
        count = workers or 1
        start = start_processes(blueprint, count)
    else:
        there = connect(ray)
        count = workers or min(there, len(sizes))
        start = start_actors(blueprint)
    team = WorkerGroup(start, len(sizes), count)
    try:
        return WorkerVecEnv(
            team,
            sizes,
            on_episodes=on_episodes,
            copy=lambda: TaskCopies(make_task(config.task, fewest, **config.options)),
        )
    except BaseException:
        team.close()
        raise
