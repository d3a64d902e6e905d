"""A multi-layer perceptron with the chain rule written out, whose hidden layers may be short.

Recording what to differentiate, and rounding each factor to bfloat16 as often as it is used, take a
third of the time in which networks of some hundred thousand weights learn from a minibatch. Here
weights are rounded once after each step of the optimiser, and gradients go to where it looks for
them. PyTorch's own gradients are the same; a test compares them.
"""

from __future__ import annotations

import torch
from torch import nn


class LayerStack:
    """Linear layers, each but the last followed by an activation, that learn within `torch.no_grad`.

    Args:
        net: Linear layers and their ReLU or Tanh in order; a Tanh may be the last.
        bfloat16: Whether hidden layers multiply in bfloat16; the last one never does.
    """

    def __init__(self, net: nn.Sequential, *, bfloat16: bool) -> None:
        self._layers = [layer for layer in net if isinstance(layer, nn.Linear)]
        self._relu = any(isinstance(layer, nn.ReLU) for layer in net)
        self._bounded = isinstance(net[-1], nn.Tanh)
        self._dtype = torch.bfloat16 if bfloat16 else torch.float32
        self.refresh()

    def refresh(self) -> None:
        """Round the weights as they are now; call it where they have changed."""
        self._hidden = [
            (layer.weight.detach().to(self._dtype), layer.bias.detach().to(self._dtype))
            for layer in self._layers[:-1]
        ]

    def forward(self, inputs: torch.Tensor) -> torch.Tensor:
        """Outputs for rows of inputs, float32, both of shape (n, entries)."""
        x = inputs.to(self._dtype)
        self._given = [x]
        for weight, bias in self._hidden:
            x = nn.functional.linear(x, weight, bias)
            x = x.relu_() if self._relu else x.tanh_()
            self._given.append(x)
        last = self._layers[-1]
        self._outputs = nn.functional.linear(x.float(), last.weight, last.bias)
        if self._bounded:
            self._outputs.tanh_()
        return self._outputs

    def backward(self, slope: torch.Tensor) -> None:
        """Put gradients of a loss where the optimiser looks for them.

        Args:
            slope: Of the loss by the outputs of the last `forward`, shape (n, outputs).
        """
        for level in reversed(range(len(self._layers))):
            slope = self._before_activation(slope, level)
            layer = self._layers[level]
            layer.weight.grad = (slope.t() @ self._given[level].to(slope.dtype)).float()
            layer.bias.grad = slope.sum(0, dtype=torch.float32)
            if level:
                slope = slope @ self._weight(level)

    def slopes(self, slope: torch.Tensor, entries: slice) -> torch.Tensor:
        """Gradients of a loss by some entries of the inputs of the last `forward`, float32.

        Args:
            slope: By the outputs, shape (n, outputs).
            entries: Which ones.
        """
        for level in reversed(range(len(self._layers))):
            weight = self._weight(level)
            slope = self._before_activation(slope, level) @ (
                weight if level else weight[:, entries]
            )
        return slope.float()

    def _before_activation(self, slope: torch.Tensor, level: int) -> torch.Tensor:
        """From the gradient by what a layer's activation gave to that by what the layer gave."""
        last = level == len(self._hidden)
        if last:
            return slope * (1.0 - self._outputs.square()) if self._bounded else slope
        activated = self._given[level + 1]
        slope = slope.to(self._dtype)
        through = torch.ops.aten
        found: torch.Tensor = (
            through.threshold_backward(slope, activated, 0)
            if self._relu
            else through.tanh_backward(slope, activated)
        )
        return found

    def _weight(self, level: int) -> torch.Tensor:
        return self._layers[-1].weight if level == len(self._hidden) else self._hidden[level][0]
