"""A trained policy as a few numpy arrays: acts without torch, many times faster on small batches.

Every algorithm's policy is one multi-layer perceptron with a head, behind convolutions if it looks at
pictures and behind layers with a memory if it remembers (`PolicyMemory`):

- ``categorical``: logits of discrete actions; draws from them, or takes the likeliest (PPO);
- ``greedy``: values of discrete actions; takes the best (DQN);
- ``gaussian``: mean of a normal distribution, cut to the bounds (PPO);
- ``squashed``: mean before a tanh that is stretched to the bounds (SAC, TD3, DDPG).
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np
import numpy.typing as npt

from gazelle.argument_checks import checked
from gazelle.array_types import Floats32
from gazelle.bounded_npz import BROKEN, open_npz
from gazelle.errors import FormatError, TaskError
from gazelle.training.bearing import Bearing
from gazelle.training.features import Features
from gazelle.training.memory_layers import MemoryLayers, PolicyMemory
from gazelle.training.picture_layers import PictureLayers

Head = Literal["categorical", "greedy", "gaussian", "squashed"]

_FORMAT = "gazelle-policy-1"
_FEATURES = ("angles", "magnitudes", "spans")
_BEARING = "bearing"
_PICTURE = "picture"
_MEMORY = ("memory_inputs", "memory_hidden", "memory_bias")
_OPTIONAL = ("log_std", "low", "high", "limits")


@checked(TaskError, after=True)
@dataclass(frozen=True, slots=True)
class Actor:
    """A policy in numpy.

    Attributes:
        weights: One matrix a layer, shape (inputs, outputs), float32.
        biases: One vector a layer, shape (outputs,), float32.
        activation: ``tanh`` or ``relu`` after every layer but the last.
        head: Meaning of the last layer's outputs.
        log_std: Logarithm of the standard deviations (``gaussian``), shape (actions,).
        low: Lower bounds of the actions (continuous heads), shape (actions,).
        high: Upper bounds of the actions (continuous heads), shape (actions,).
        first_action: The number of the first discrete action.
        limits: Limits of observations before that, least and greatest, shape (2, inputs), if any.
        features: Entries added to observations before the first layer, if any.
        pictures: Layers for images, of a policy with images.
        memory: Memory layers before the first layer, if any.
    """

    weights: tuple[Floats32, ...]
    biases: tuple[Floats32, ...]
    activation: str
    head: Head
    log_std: Floats32 | None = None
    low: Floats32 | None = None
    high: Floats32 | None = None
    first_action: int = 0
    limits: Floats32 | None = None
    features: Features | None = None
    pictures: PictureLayers | None = None
    memory: MemoryLayers | None = None

    @property
    def inputs(self) -> int:
        """Entries of an observation."""
        if self.pictures is not None:
            return self.pictures.inputs
        added = 0 if self.features is None else self.features.count
        first = self.weights[0] if self.memory is None else self.memory.inputs[0]
        return len(first) - added

    @property
    def discrete(self) -> bool:
        """True if actions are discrete (indices of choices)."""
        return self.head in {"categorical", "greedy"}

    @property
    def bounds(self) -> tuple[Floats32, Floats32]:
        """Least and greatest actions (continuous heads), each of shape (actions,).

        Raises:
            FormatError: The policy lacks them.
        """
        return _present(self.low), _present(self.high)

    def begin(self, copies: int) -> PolicyMemory | None:
        """Return the empty memory of this many new episodes; None for a policy without a memory."""
        return None if self.memory is None else self.memory.empty(copies)

    def outputs(self, obs: Floats32, memory: PolicyMemory | None = None) -> Floats32:
        """Return the last layer's outputs.

        Args:
            obs: Observations, shape (N, inputs), float32.
            memory: State of a policy with a memory, which changes; see `begin`.

        Returns:
            Shape (N, outputs), float32.

        Raises:
            TaskError: The policy has a memory and is given none.
        """
        if self.limits is not None:
            obs = np.clip(obs, *self.limits)
        if self.pictures is not None:
            x = self.pictures.features(obs)
        else:
            x = obs if self.features is None else self.features.added_to(obs)
        if self.memory is not None:
            if memory is None:
                hint = "give it the memory that Actor.begin(copies) makes"
                raise TaskError("this policy is recurrent", hint=hint)
            x = self.memory.outputs(x, memory)
        for weight, bias in zip(self.weights[:-1], self.biases[:-1], strict=True):
            x = x @ weight
            x += bias
            if self.activation == "tanh":
                np.tanh(x, out=x)
            else:
                np.maximum(x, 0.0, out=x)
        result: Floats32 = x @ self.weights[-1] + self.biases[-1]
        return result

    def act(
        self,
        obs: Floats32,
        rng: np.random.Generator | None = None,
        memory: PolicyMemory | None = None,
    ) -> npt.NDArray[Any]:
        """Return actions for the environment.

        Args:
            obs: Observations, shape (N, ...).
            rng: Draws from the policy's distribution; without it the likeliest action is taken.
            memory: As `outputs` takes it.

        Returns:
            Shape (N,) int64 for discrete actions, else (N, actions) float32 within the bounds.
        """
        rows = np.asarray(obs, dtype=None if self.pictures is not None else np.float32)
        outputs = self.outputs(rows.reshape(len(obs), -1), memory)
        if rng is None or self.head in {"greedy", "squashed"}:
            return self.to_env(self.mode(outputs))
        return self.to_env(self.sample(outputs, rng))

    def mode(self, outputs: Floats32) -> npt.NDArray[Any]:
        """Return the likeliest raw actions for the outputs of the last layer."""
        if not self.discrete:
            return outputs
        best: npt.NDArray[np.int64] = outputs.argmax(axis=-1)
        return best

    def sample(self, outputs: Floats32, rng: np.random.Generator) -> npt.NDArray[Any]:
        """Sample raw actions from the distribution (``categorical`` and ``gaussian`` heads).

        Args:
            outputs: Result of `outputs`, shape (N, outputs).
            rng: Random generator.

        Returns:
            Shape (N,) int64, counted from 0, or (N, actions) float32, not yet cut to the bounds.
        """
        if self.discrete:
            likelihood = np.exp(outputs - outputs.max(axis=-1, keepdims=True))
            threshold = likelihood.cumsum(axis=-1)
            draw = rng.random(len(outputs), dtype=np.float32) * threshold[:, -1]
            # Rounding may put the draw on the last threshold itself, hence the cut.
            chosen = (threshold <= draw[:, None]).sum(axis=-1)
            drawn: npt.NDArray[np.int64] = np.minimum(chosen, outputs.shape[-1] - 1)
            return drawn
        noise = rng.standard_normal(outputs.shape, dtype=np.float32)
        return outputs + np.exp(_present(self.log_std)) * noise

    def log_prob(self, outputs: Floats32, actions: npt.NDArray[Any]) -> Floats32:
        """Return logarithms of the probability (density) of raw actions.

        Args:
            outputs: Result of `outputs`, shape (N, outputs).
            actions: Result of `sample`.

        Returns:
            Shape (N,), float32.
        """
        if self.discrete:
            shifted = outputs - outputs.max(axis=-1, keepdims=True)
            total = np.log(np.exp(shifted).sum(axis=-1))
            chosen: Floats32 = shifted[np.arange(len(shifted)), actions] - total
            return chosen
        log_std = _present(self.log_std)
        scaled = (actions - outputs) / np.exp(log_std)
        density = -0.5 * scaled**2 - log_std - np.float32(0.5 * np.log(2 * np.pi))
        summed: Floats32 = density.sum(axis=-1, dtype=np.float32)
        return summed

    def to_env(self, actions: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Return raw actions in the environment's form: indices, clipped or scaled values."""
        if self.discrete:
            return actions + self.first_action
        low, high = self.bounds
        if self.head == "squashed":
            share: Floats32 = np.float32(0.5) * (np.tanh(actions) + np.float32(1))
            return low + share * (high - low)
        clipped: Floats32 = np.clip(actions, low, high)
        return clipped

    def save(self, path: Path) -> None:
        """Write the policy to a ``.npz`` file without Python objects.

        Raises:
            OSError: It cannot be written.
        """
        arrays = {f"weight{i}": weight for i, weight in enumerate(self.weights)}
        arrays |= {f"bias{i}": bias for i, bias in enumerate(self.biases)}
        for name in _OPTIONAL:
            if getattr(self, name) is not None:
                arrays[name] = getattr(self, name)
        if self.features is not None:
            arrays |= _feature_arrays(self.features)
        if self.pictures is not None:
            arrays |= _picture_arrays(self.pictures)
        if self.memory is not None:
            arrays |= _memory_arrays(self.memory)
        about = {
            "format": _FORMAT,
            "layers": len(self.weights),
            "activation": self.activation,
            "head": self.head,
            "first_action": self.first_action,
        }
        np.savez(path, allow_pickle=False, about=np.array(json.dumps(about)), **arrays)


def load_actor(path: Path) -> Actor:
    """Read a policy that `Actor.save` wrote.

    Raises:
        FormatError: The file cannot be read, is damaged, or is something else.
    """
    try:
        with open_npz(Path(path)) as file:
            about = _read_about(str(file["about"]))
            layers = range(about["layers"])
            extra: dict[str, Any] = {name: file[name] for name in _OPTIONAL if name in file}
            if _FEATURES[0] in file:
                extra["features"] = _features(file)
            if _PICTURE in file:
                extra["pictures"] = _picture_layers(file)
            if f"{_MEMORY[0]}0" in file:
                extra["memory"] = _memory_layers(file)
            actor = Actor(
                weights=tuple(file[f"weight{i}"] for i in layers),
                biases=tuple(file[f"bias{i}"] for i in layers),
                activation=about["activation"],
                head=about["head"],
                first_action=about["first_action"],
                **extra,
            )
            _refuse_unfit(actor)
            return actor
    except (*BROKEN, TaskError) as error:
        text = " ".join(str(error).split()) or type(error).__name__
        raise FormatError(
            f"not a policy: {text}", file=str(path), hint="expected a policy.npz of a Gazelle run"
        ) from error


def _refuse_unfit(actor: Actor) -> None:
    """Run a policy once, to find arrays of mismatched shapes.

    Raises:
        ValueError: They do not; any of ``BROKEN`` likewise.
    """
    with np.errstate(all="ignore"):
        outputs = actor.outputs(np.zeros((1, actor.inputs), np.float32), actor.begin(1))
        actions = actor.to_env(actor.mode(outputs))
    if outputs.ndim != 2 or len(actions) != 1:
        raise ValueError(f"its layers have outputs of shape {outputs.shape}")


def _feature_arrays(features: Features) -> dict[str, npt.NDArray[Any]]:
    """Return the parameters of added features as arrays by name."""
    arrays: dict[str, npt.NDArray[Any]] = {name: getattr(features, name) for name in _FEATURES}
    if features.bearing is not None:
        to = features.bearing
        arrays[_BEARING] = np.array([to.x, to.y, -1 if to.yaw is None else to.yaw, *to.goal])
    return arrays


def _features(file: Any) -> Features:
    """Read the features that `_feature_arrays` wrote."""
    bearing = None
    if _BEARING in file:
        x, y, yaw, *goal = file[_BEARING].tolist()
        bearing = Bearing(
            x=int(x), y=int(y), yaw=None if yaw < 0 else int(yaw), goal=(goal[0], goal[1])
        )
    angles, magnitudes, spans = (file[name] for name in _FEATURES)
    return Features(angles, magnitudes, spans, bearing)


def _picture_arrays(pictures: PictureLayers) -> dict[str, npt.NDArray[Any]]:
    """Return layers for pictures as arrays by name."""
    arrays: dict[str, npt.NDArray[Any]] = {_PICTURE: np.array([*pictures.shape, pictures.pooling])}
    for number, (weight, bias) in enumerate(zip(pictures.weights, pictures.biases, strict=True)):
        arrays[f"convolution{number}"], arrays[f"convolution_bias{number}"] = weight, bias
    return arrays


def _picture_layers(file: Any) -> PictureLayers:
    """Read the layers that `_picture_arrays` wrote."""
    height, width, channels, pooling = map(int, file[_PICTURE])
    numbers = range(sum(name.startswith("convolution_bias") for name in file))
    return PictureLayers(
        (height, width, channels),
        pooling,
        tuple(file[f"convolution{number}"] for number in numbers),
        tuple(file[f"convolution_bias{number}"] for number in numbers),
    )


def _memory_arrays(memory: MemoryLayers) -> dict[str, npt.NDArray[Any]]:
    """Return layers with a memory as arrays by name."""
    parts = (memory.inputs, memory.hidden, memory.biases)
    return {
        f"{name}{number}": array
        for name, part in zip(_MEMORY, parts, strict=True)
        for number, array in enumerate(part)
    }


def _memory_layers(file: Any) -> MemoryLayers:
    """Read the layers that `_memory_arrays` wrote."""
    numbers = range(sum(name.startswith(_MEMORY[0]) for name in file))
    return MemoryLayers(*(tuple(file[f"{name}{i}"] for i in numbers) for name in _MEMORY))


def _read_about(text: str) -> dict[str, Any]:
    about: dict[str, Any] = json.loads(text)
    if about["format"] != _FORMAT or about["head"] not in get_args(Head):
        raise ValueError(f"format {about['format']}, head {about['head']}")
    return about


def _present(array: Floats32 | None) -> Floats32:
    if array is None:
        raise FormatError("the policy lacks the bounds or deviations of its actions")
    return array
