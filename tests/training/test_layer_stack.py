"""Networks whose chain rule is written out, against PyTorch's own gradients."""

from __future__ import annotations

import itertools

import pytest
import torch
from torch import nn

from gazelle.training.layer_stack import LayerStack


def network(activation, sizes, bounded):
    layers = []
    for given, gives in itertools.pairwise(sizes):
        layers += [nn.Linear(given, gives), activation()]
    return nn.Sequential(*layers[:-1], *([nn.Tanh()] if bounded else []))


def gradients(net):
    return [parameter.grad.clone() for parameter in net.parameters()]


@pytest.mark.parametrize("activation", [nn.ReLU, nn.Tanh])
@pytest.mark.parametrize("bounded", [False, True])
@pytest.mark.parametrize("sizes", [(5, 2), (7, 16, 3), (4, 12, 8, 1)])
@pytest.mark.parametrize(("bfloat16", "near"), [(False, 1e-5), (True, 0.05)])
def test_outputs_and_gradients_are_those_of_the_network(activation, bounded, sizes, bfloat16, near):
    torch.manual_seed(2)
    net = network(activation, sizes, bounded)
    inputs = torch.randn(20, sizes[0], requires_grad=True)
    slope = torch.randn(20, sizes[-1])
    wanted = net(inputs)
    wanted.backward(slope)
    own = gradients(net)
    for parameter in net.parameters():
        parameter.grad = None
    with torch.no_grad():
        stack = LayerStack(net, bfloat16=bfloat16)
        torch.testing.assert_close(stack.forward(inputs), wanted.detach(), atol=near, rtol=near)
        some = slice(-2, None)
        found = stack.slopes(slope, some)
        stack.backward(slope)
    scale = inputs.grad.abs().max()
    torch.testing.assert_close(found / scale, inputs.grad[:, some] / scale, atol=near, rtol=near)
    for mine, theirs in zip(gradients(net), own, strict=True):
        assert mine.dtype == torch.float32
        size = theirs.abs().max()
        torch.testing.assert_close(mine / size, theirs / size, atol=near, rtol=near)


def test_weights_count_from_when_they_are_refreshed():
    net = network(nn.ReLU, (3, 8, 1), bounded=False)
    inputs = torch.randn(4, 3)
    with torch.no_grad():
        stack = LayerStack(net, bfloat16=True)
        before = stack.forward(inputs)
        for parameter in net.parameters():
            parameter.mul_(2.0)
        stack.refresh()
        torch.testing.assert_close(stack.forward(inputs), net(inputs), atol=0.1, rtol=0.1)
        assert not torch.allclose(before, net(inputs), atol=0.1)
