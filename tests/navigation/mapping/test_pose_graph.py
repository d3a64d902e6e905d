"""Poses fit what is known of them best."""

import math

import numpy as np
import pytest

from gazelle.navigation.mapping.pose_graph import PoseEdge, optimized
from gazelle.navigation.planners.planar import between, composed

SURE = (100.0, 100.0, 400.0)


def ring(count, drift):
    """Return poses around a circle by odometry with drift, with the closing edge."""
    step = (2.0 * math.sin(math.pi / count), 0.0, 2.0 * math.pi / count)
    true, found, edges = [(0.0, 0.0, 0.0)], [(0.0, 0.0, 0.0)], []
    for number in range(count - 1):
        wrong = (step[0] * 1.02, step[1], step[2] + drift)
        true.append(composed(true[-1], step))
        found.append(composed(found[-1], wrong))
        edges.append(PoseEdge(number, number + 1, wrong, SURE))
    closing = PoseEdge(0, count - 1, between(true[0], true[-1]), (1e6, 1e6, 1e6))
    return np.array(true), np.array(found), edges, closing


@pytest.mark.parametrize(("count", "drift"), [(12, 0.02), (60, 0.005), (200, -0.003)])
def test_a_loop_that_is_closed_spreads_its_error(count, drift):
    true, found, edges, closing = ring(count, drift)
    fitted = optimized(found, [*edges, closing])
    before = np.hypot(*(found - true)[:, :2].T)
    after = np.hypot(*(fitted - true)[:, :2].T)
    assert after.max() < 0.3 * before.max()
    assert after[-1] < 1e-3
    assert fitted[0] == pytest.approx(found[0], abs=1e-9)


def test_edges_that_agree_leave_poses_where_they_are():
    true, _, _, _ = ring(10, 0.0)
    edges = [
        PoseEdge(i, j, between(tuple(true[i].tolist()), tuple(true[j].tolist())), SURE)
        for i in range(10)
        for j in range(i + 1, 10, 3)
    ]
    moved = true + np.random.default_rng(1).normal(0.0, 0.02, true.shape)
    moved[0] = true[0]
    fitted = optimized(moved, edges)
    assert fitted[:, :2] == pytest.approx(true[:, :2], abs=1e-6)
    turned = np.cos(fitted[:, 2] - true[:, 2])
    assert turned == pytest.approx(np.ones(10), abs=1e-9)
