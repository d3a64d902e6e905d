"""Policies from files, without torch: numpy arrays, or ONNX Runtime."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from gazelle.array_types import Floats32
from gazelle.envs.contract import ActionRule, PolicyContract
from gazelle.errors import FormatError, TaskError
from gazelle.training.actor import Actor, load_actor
from gazelle.training.deploy.safety import VelocityCommand
from gazelle.training.policy_files import load_policy


class PolicyNetwork(Protocol):
    """Protocol of a policy network: observations (N, entries) to its outputs and actions."""

    def decide(self, obs: Floats32) -> tuple[Floats32, npt.NDArray[Any]]:
        """Return outputs of shape (N, outputs), and actions of shape (N,) or (N, actions)."""


@dataclass(frozen=True, slots=True)
class Decision:
    """Decision of a policy."""

    action: tuple[float, ...]
    """The number of a discrete action, or the numbers of a continuous one."""
    command: VelocityCommand
    """Velocity command that it stands for."""
    best_output: float
    """The greatest output of the last layer: of DQN, the value of the action."""


class Policy:
    """A policy and its contract.

    Args:
        network: Acts.
        contract: Observations and actions.

    Raises:
        TaskError: Its actions are not velocities.
    """

    def __init__(self, network: PolicyNetwork, contract: PolicyContract) -> None:
        if contract.action.kind != "velocity":
            raise TaskError(
                "the policy's actions are not velocities, so there is nothing to send",
                hint="give the task a contract; docs/how-to/deploy.md says how",
            )
        self.network = network
        self.contract = contract

    def decide(self, obs: Floats32) -> Decision:
        """Return the decision for one observation, shape (1, entries)."""
        outputs, actions = self.network.decide(obs)
        action = tuple(float(value) for value in np.asarray(actions[0]).reshape(-1))
        return Decision(action, command_of(action, self.contract.action), float(outputs.max()))


def command_of(action: tuple[float, ...], rule: ActionRule) -> VelocityCommand:
    """Return the velocity command that an action stands for.

    Raises:
        TaskError: The rule is undecided, or the action is none of its own.
    """
    if rule.type == "discrete":
        number = int(action[0]) - rule.first
        if not 0 <= number < len(rule.choices):
            raise TaskError(f"the contract does not define action {int(action[0])}")
        return VelocityCommand(*rule.choices[number])
    if rule.at_low is None or rule.at_high is None or len(action) != 2:
        raise TaskError("the contract does not define the two actions")
    low, high = np.array(rule.low), np.array(rule.high)
    share = (np.clip(np.array(action), low, high) - low) / (high - low)
    least, greatest = np.array(rule.at_low), np.array(rule.at_high)
    linear, angular = least + share * (greatest - least)
    return VelocityCommand(float(linear), float(angular))


def open_policy(source: str | Path, *, imports: Sequence[str] = (), trust: bool = False) -> Policy:
    """Return a policy from the folder of a run, or from a file that `export_policy` wrote.

    Args:
        source: The folder or file.
        imports: Modules or files that register the task, instead of those that the run names.
        trust: Whether to import those.

    Raises:
        FormatError: There is none, or it or its contract is damaged.
        TaskError: It has a memory, its actions are not velocities, it is an ONNX file, and ONNX
            Runtime is not installed, or the run names code that is not trusted.
    """
    file, contract = load_policy(source, imports=imports, trust=trust)
    network: PolicyNetwork = (
        _OnnxNetwork(file) if file.suffix == ".onnx" else _ArrayNetwork(load_actor(file))
    )
    outputs, _ = network.decide(np.zeros((1, contract.size), np.float32))
    if contract.action.choices and outputs.shape[1] != len(contract.action.choices):
        raise FormatError(
            f"the policy has {outputs.shape[1]} actions, its contract defines "
            f"{len(contract.action.choices)}",
            file=str(file),
        )
    return Policy(network, contract)


class _ArrayNetwork:
    def __init__(self, actor: Actor) -> None:
        if actor.memory is not None:
            hint = "deploy one without, such as of --algo ppo; 'gazelle eval' runs this one"
            raise TaskError("recurrent policies cannot be deployed yet", hint=hint)
        self._actor = actor

    def decide(self, obs: Floats32) -> tuple[Floats32, npt.NDArray[Any]]:
        if obs.shape[1] != self._actor.inputs:
            raise FormatError(
                f"the policy takes {self._actor.inputs} numbers, its contract defines {obs.shape[1]}"
            )
        outputs = self._actor.outputs(obs)
        return outputs, self._actor.to_env(self._actor.mode(outputs))


class _OnnxNetwork:
    def __init__(self, file: Path) -> None:
        # Else it reports each use to its makers, and keeps an identity and a queue in the home folder.
        os.environ.setdefault("ORT_DISABLE_TELEMETRY", "1")
        try:
            import onnxruntime  # type: ignore[import-untyped]
        except ModuleNotFoundError as error:
            raise TaskError(
                "ONNX policies need ONNX Runtime",
                hint="pip install onnxruntime, or export with --format numpy",
            ) from error
        try:
            self._session = onnxruntime.InferenceSession(
                str(file), providers=["CPUExecutionProvider"]
            )
        except Exception as error:  # the library has no common class of its errors
            reason = str(error).splitlines()[0]
            raise FormatError(f"not a policy: {reason}", file=str(file)) from error

    def decide(self, obs: Floats32) -> tuple[Floats32, npt.NDArray[Any]]:
        outputs, action = self._session.run(["outputs", "action"], {"observation": obs})
        return outputs, action
