"""A policy as an ONNX graph of plain operators, which any runtime knows.

The graph takes ``observation``, float32 of shape (N, entries) as the task gives it, and gives

- ``action``: int64 of shape (N,), the number of the action, or float32 of shape (N, actions), within
  the task's bounds;
- ``outputs``: the network's last layer, float32: logits, values of actions, or means.

Scaling, features and bounds are inside. Operators are those of set 13, of the year 2020.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from gazelle.errors import MissingExtraError, TaskError
from gazelle.training.actor import Actor
from gazelle.training.bearing import CENTRE, HALF, NEAR, SHORTEST, Bearing
from gazelle.training.features import LEAST, MIDDLE, Features
from gazelle.training.picture_layers import STRIDE, PictureLayers

try:
    import onnx
    from onnx import TensorProto, helper, numpy_helper
except ModuleNotFoundError as error:
    raise MissingExtraError("onnx", "export") from error

OPERATORS = 13
"""The version of the set of operators."""
FILE_VERSION = 8
"""The version of the file format."""


def onnx_model(actor: Actor, *, metadata: dict[str, str] | None = None) -> onnx.ModelProto:
    """Return the ONNX model of a policy, checked.

    Args:
        actor: The policy.
        metadata: Text that is kept in the model.

    Raises:
        MissingExtraError: The package ``onnx`` is not installed.
        TaskError: The policy has a memory, which no graph of one step keeps.
    """
    if actor.memory is not None:
        hint = "--format numpy writes one that load_actor reads: give Actor.act its memory"
        raise TaskError("a recurrent policy cannot be exported as ONNX yet", hint=hint)
    graph = _Graph()
    name = "observation"
    if actor.limits is not None:
        least, most = (graph.constant(each) for each in actor.limits)
        name = graph.add("Min", graph.add("Max", name, least), most)
    if actor.pictures is not None:
        name = _add_pictures(graph, actor.pictures, name)
    elif actor.features is not None:
        name = _add_features(graph, actor.features, name)
    outputs = _add_layers(graph, actor, name)
    action = _add_head(graph, actor, outputs)
    graph.add("Identity", outputs, out="outputs")
    graph.add("Identity", action, out="action")
    size = len(actor.biases[-1])
    kind = TensorProto.INT64 if actor.discrete else TensorProto.FLOAT
    shape = ["N"] if actor.discrete else ["N", size]
    model = helper.make_model(
        helper.make_graph(
            graph.nodes,
            "policy",
            [helper.make_tensor_value_info("observation", TensorProto.FLOAT, ["N", actor.inputs])],
            [
                helper.make_tensor_value_info("action", kind, shape),
                helper.make_tensor_value_info("outputs", TensorProto.FLOAT, ["N", size]),
            ],
            graph.constants,
        ),
        producer_name="gazelle",
        ir_version=FILE_VERSION,
        opset_imports=[helper.make_opsetid("", OPERATORS)],
    )
    helper.set_model_props(model, metadata or {})
    onnx.checker.check_model(model, full_check=True)
    return model


class _Graph:
    """Nodes and constants in the making; results are named by number."""

    def __init__(self) -> None:
        self.nodes: list[Any] = []
        self.constants: list[Any] = []

    def constant(self, values: npt.ArrayLike, dtype: type[np.generic] = np.float32) -> str:
        """Add an array; returns its name."""
        name = f"constant{len(self.constants)}"
        array = np.asarray(values, dtype)
        self.constants.append(numpy_helper.from_array(np.ascontiguousarray(array), name))
        return name

    def add(self, operator: str, *inputs: str, out: str | None = None, **attributes: Any) -> str:
        """Add a node with one result; returns that one's name."""
        name = out or f"{operator.lower()}{len(self.nodes)}"
        self.nodes.append(helper.make_node(operator, list(inputs), [name], **attributes))
        return name


def _add_features(graph: _Graph, features: Features, name: str) -> str:
    """Add the operators of `Features.added_to`; return the output's name."""
    parts = [name]
    if len(features.angles):
        angles = graph.add("Gather", name, graph.constant(features.angles, np.int64), axis=1)
        parts += [graph.add("Sin", angles), graph.add("Cos", angles)]
    if len(features.magnitudes):
        index = graph.constant(features.magnitudes, np.int64)
        part = graph.add("Gather", name, index, axis=1)
        part = graph.add("Relu", graph.add("Div", part, graph.constant(features.spans)))
        part = graph.add("Log", graph.add("Add", part, graph.constant(LEAST)))
        parts.append(graph.add("Add", part, graph.constant(MIDDLE)))
    if features.bearing is not None:
        parts += _add_bearing(graph, features.bearing, name)
    return graph.add("Concat", *parts, axis=1)


def _add_bearing(graph: _Graph, bearing: Bearing, name: str) -> list[str]:
    """Add the operators of `Bearing.of`; return the outputs' names."""
    dx, dy = (
        graph.add("Sub", graph.constant(side), _entry(graph, name, entry))
        for entry, side in zip((bearing.x, bearing.y), bearing.goal, strict=True)
    )
    away = graph.add("Sqrt", graph.add("Add", *(graph.add("Mul", d, d) for d in (dx, dy))))
    part = graph.add("Log", graph.add("Add", away, graph.constant(NEAR)))
    part = graph.add("Sub", part, graph.constant(CENTRE))
    distance = graph.add("Div", part, graph.constant(HALF))
    ahead, left = dx, dy
    if bearing.yaw is not None:
        yaw = _entry(graph, name, bearing.yaw)
        cos, sin = graph.add("Cos", yaw), graph.add("Sin", yaw)
        ahead = graph.add("Add", graph.add("Mul", dx, cos), graph.add("Mul", dy, sin))
        left = graph.add("Sub", graph.add("Mul", dy, cos), graph.add("Mul", dx, sin))
    length = graph.add("Max", away, graph.constant(SHORTEST))
    return [distance, *(graph.add("Div", side, length) for side in (ahead, left))]


def _entry(graph: _Graph, name: str, entry: int) -> str:
    """Add one entry of observations, shape (N, 1); returns its name."""
    return graph.add("Gather", name, graph.constant([entry], np.int64), axis=1)


def _add_pictures(graph: _Graph, pictures: PictureLayers, name: str) -> str:
    """Add the operators of `PictureLayers.features`; return the output's name."""
    shape = graph.constant([-1, *pictures.shape], np.int64)
    name = graph.add("Transpose", graph.add("Reshape", name, shape), perm=[0, 3, 1, 2])
    name = graph.add("Mul", name, graph.constant(1.0 / 255.0))
    name = graph.add("Sub", name, graph.constant(0.5))
    if pictures.pooling > 1:
        side = [pictures.pooling] * 2
        name = graph.add("AveragePool", name, kernel_shape=side, strides=side)
    for weight, bias in zip(pictures.weights, pictures.biases, strict=True):
        kernel = graph.constant(weight.transpose(3, 2, 0, 1))
        name = graph.add("Conv", name, kernel, graph.constant(bias), strides=[STRIDE, STRIDE])
        name = graph.add("Relu", name)
    return graph.add("Flatten", graph.add("Transpose", name, perm=[0, 2, 3, 1]))


def _add_layers(graph: _Graph, actor: Actor, name: str) -> str:
    """Add the operators of `Actor.outputs`; return the output's name."""
    last = len(actor.weights) - 1
    for number, (weight, bias) in enumerate(zip(actor.weights, actor.biases, strict=True)):
        name = graph.add("MatMul", name, graph.constant(weight))
        name = graph.add("Add", name, graph.constant(bias))
        if number < last:
            name = graph.add("Tanh" if actor.activation == "tanh" else "Relu", name)
    return name


def _add_head(graph: _Graph, actor: Actor, name: str) -> str:
    """Add the operators of `Actor.mode` and `Actor.to_env`; return the output's name."""
    if actor.discrete:
        best = graph.add("ArgMax", name, axis=1, keepdims=0)
        return graph.add("Add", best, graph.constant(actor.first_action, np.int64))
    low, high = actor.bounds
    if actor.head == "squashed":
        share = graph.add("Add", graph.add("Tanh", name), graph.constant(1.0))
        share = graph.add("Mul", share, graph.constant(0.5))
        name = graph.add("Mul", share, graph.constant(high - low))
        return graph.add("Add", name, graph.constant(low))
    name = graph.add("Max", name, graph.constant(low))
    return graph.add("Min", name, graph.constant(high))
