"""Memory of a policy: layers of long short-term memory in numpy, and their state.

S. Hochreiter and J. Schmidhuber, "Long short-term memory", Neural Computation 9 (1997) 1735-1780,
with the forget gate of F. A. Gers et al. (2000), as `torch.nn.LSTM` has it: its gates are input,
forget, cell and output, in this order.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats32

_GATES = 4


@dataclass(slots=True)
class PolicyMemory:
    """Memory of a policy in N copies of a task; empty when an episode begins.

    Attributes:
        hidden: Last outputs of the layers, shape (layers, N, units), float32.
        cell: Cell states, shape (layers, N, units), float32.
    """

    hidden: Floats32
    cell: Floats32

    def forget(self, where: Bools) -> None:
        """Clear the memory in some copies, shape (N,), at episode starts."""
        self.hidden[:, where] = 0.0
        self.cell[:, where] = 0.0


@dataclass(frozen=True, slots=True)
class MemoryLayers:
    """Layers with a memory, one after the other.

    Attributes:
        inputs: Weights of what a layer is given, one matrix a layer, shape (inputs, 4 units), float32.
        hidden: Weights of what it gave last, shape (units, 4 units), float32.
        biases: One vector a layer, shape (4 units,), float32.
    """

    inputs: tuple[Floats32, ...]
    hidden: tuple[Floats32, ...]
    biases: tuple[Floats32, ...]

    @property
    def units(self) -> int:
        """Outputs of a layer."""
        return len(self.hidden[0])

    def empty(self, copies: int) -> PolicyMemory:
        """Return the memory at the beginning of episodes in a given number of copies."""
        shape = (len(self.biases), copies, self.units)
        return PolicyMemory(np.zeros(shape, np.float32), np.zeros(shape, np.float32))

    def outputs(self, x: Floats32, memory: PolicyMemory) -> Floats32:
        """Return the output of the last layer, shape (N, units), and update the memory.

        Args:
            x: Input of the first layer, shape (N, inputs), float32.
            memory: Of as many copies.
        """
        for layer, bias in enumerate(self.biases):
            gates = x @ self.inputs[layer] + memory.hidden[layer] @ self.hidden[layer] + bias
            let_in, keep, new, give = np.split(gates, _GATES, axis=1)
            cell = _sigmoid(keep) * memory.cell[layer] + _sigmoid(let_in) * np.tanh(new)
            memory.cell[layer] = cell
            x = memory.hidden[layer] = _sigmoid(give) * np.tanh(cell)
        return x.copy()


def _sigmoid(x: Floats32) -> Floats32:
    half = np.float32(0.5)
    share: Floats32 = half * (np.tanh(half * x) + np.float32(1))
    return share
