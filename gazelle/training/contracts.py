"""The contract of a run's policy: made from its environment, kept in its folder."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gymnasium.vector import VectorEnv

from gazelle.envs.contract import PolicyContract, generic_contract
from gazelle.errors import FormatError, TaskError
from gazelle.training.importing import TaskModule, load_all
from gazelle.training.runs import Run, RunConfig, versions
from gazelle.training.tasks import control_period, env_attribute, make_task
from gazelle.training.trust import require_trust
from gazelle_ros.base.writing import write_text

CONTRACT = "contract.json"


def task_contract(env: VectorEnv[Any, Any, Any]) -> PolicyContract:
    """Return the contract of a task: its policies' observations and actions.

    A task declares it in an attribute ``contract`` of its environment, a `PolicyContract`; without
    one, the contract is derived from the spaces.
    """
    contract = env_attribute(env, "contract")
    if not isinstance(contract, PolicyContract):
        spaces = env.single_observation_space, env.single_action_space
        contract = generic_contract(*spaces, control_period(env))
    limit = contract.time_limit
    if limit is None and contract.control_period and env.spec and env.spec.max_episode_steps:
        limit = env.spec.max_episode_steps * contract.control_period
    return dataclasses.replace(contract, time_limit=limit)


def contract_of(contract: PolicyContract, config: RunConfig) -> PolicyContract:
    """Return the contract of a policy trained with this configuration.

    Args:
        contract: Of its task, see `task_contract`.
        config: Of the run.
    """
    # Trainings may have shorter or longer episodes, and steps.
    evaluated = config.recipe.evaluation_options
    period = evaluated.get("control_period", contract.control_period)
    limit, steps = contract.time_limit, evaluated.get("max_episode_steps")
    if steps is not None and period:
        limit = steps * period
    return dataclasses.replace(
        contract,
        task=config.task,
        control_period=period,
        time_limit=limit,
        versions=versions(),
        training={
            "algorithm": config.recipe.algo,
            "steps": config.recipe.steps,
            "seed": config.seed,
            "options": config.options,
        },
    )


def save_contract(contract: PolicyContract, folder: Path) -> Path:
    """Write a contract into a folder; returns its file."""
    file = folder / CONTRACT
    write_text(file, json.dumps(contract.to_dict(), indent=2) + "\n")
    return file


def load_contract(file: Path) -> PolicyContract:
    """Read a contract.

    Raises:
        FormatError: There is none, or it is damaged.
    """
    try:
        return PolicyContract.from_dict(json.loads(file.read_text(encoding="utf-8")))
    except FileNotFoundError as error:
        hint = "'gazelle export RUN' writes it beside the policy"
        raise FormatError("the policy has no contract", file=str(file), hint=hint) from error
    except (ValueError, TypeError, AttributeError, TaskError) as error:
        raise FormatError(f"not a policy's contract: {error}", file=str(file)) from error


def run_contract(
    run: Run, modules: Sequence[TaskModule] = (), *, trust: bool = False
) -> PolicyContract:
    """Return the contract of a run; without a saved one, from its environment, made for that.

    Args:
        run: The run.
        modules: Imported ones that register its task, instead of those that it names.
        trust: Whether to import those.

    Raises:
        FormatError: It is damaged.
        TaskError: The task of the run is not there, or it names code that is not trusted.
    """
    file = run.folder / CONTRACT
    if file.is_file():
        return load_contract(file)
    require_trust(run, modules, trust=trust)
    load_all(() if modules else run.config.imports)
    env = make_task(run.config.task, 1, **run.config.options)
    try:
        return contract_of(task_contract(env), run.config)
    finally:
        env.close()
