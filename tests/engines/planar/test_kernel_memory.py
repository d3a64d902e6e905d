"""Caches of kernels save time and change no bit."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.engines.planar import Body, Drive, Fleet, PlanarPart

STEPS = 40
SHAPES = {
    "disc": PlanarPart.circle(0.02, 0.0, 0.15),
    "bar": PlanarPart(((-0.3, -0.05), (0.3, -0.05), (0.3, 0.05), (-0.3, 0.05))),
}
BOUNDS = {
    "free": {},
    "bounded": {"slowest": (-0.5,) * 3, "fastest": (0.9,) * 3},
    "slow": {"brake": (-2.0,) * 3, "push": (1.5,) * 3},
}


def clutter(rng, count):
    """Return walls and pillars in a square of 4 m."""
    ends = rng.uniform(-2.0, 2.0, (count, 4))
    walls = [PlanarPart(((a, b), (c, d)), closed=False) for a, b, c, d in ends]
    return [
        *walls,
        *(PlanarPart.circle(*rng.uniform(-2.0, 2.0, 2), 0.2) for _ in range(count // 3)),
    ]


def run(seed, *, shape, kind, bounds, walls, nworld, forget, euler=False, threads=1):
    rng = np.random.default_rng(seed)
    body = Body((SHAPES[shape],), drive=Drive(kind, **BOUNDS[bounds]))
    fleet = Fleet(
        [body] * 3, clutter(rng, walls), nworld=nworld, euler=euler, threads=threads, time_step=0.05
    )
    for each in range(3):
        fleet.place(each, rng.uniform((-2, -2, -3), (2, 2, 3), (nworld, 3)))
    seen = []
    for step in range(STEPS):
        if step % 5 == 0:  # slow and fast, straight on and in circles
            fleet.command[:] = rng.normal(0.0, rng.choice([0.02, 0.3, 3.0]), fleet.command.shape)
        if step % 11 == 7:
            fleet.place(1, rng.uniform((-2, -2, -3), (2, 2, 3)))
        if step % 13 == 12:
            fleet.reset(np.arange(0, nworld, 2))
        if forget:
            fleet.memory[:] = math.inf
        fleet.step()
        seen.append((fleet.rows.copy(), fleet.velocity.copy(), fleet.stalled.copy()))
    fleet.close()
    return seen


@pytest.mark.long
@given(
    seed=st.integers(0, 10**6),
    shape=st.sampled_from(sorted(SHAPES)),
    kind=st.sampled_from(["diff", "omni", "car"]),
    bounds=st.sampled_from(sorted(BOUNDS)),
    walls=st.sampled_from([0, 6, 30, 150]),
    nworld=st.integers(1, 3),
    euler=st.booleans(),
)
def test_remembered_is_worked_out(seed, shape, kind, bounds, walls, nworld, euler):
    case = {"shape": shape, "kind": kind, "bounds": bounds, "walls": walls, "nworld": nworld}
    kept = run(seed, **case, euler=euler, forget=False)
    anew = run(seed, **case, euler=euler, forget=True)
    for step, (first, second) in enumerate(zip(kept, anew, strict=True)):
        for one, other in zip(first, second, strict=True):
            assert np.array_equal(one, other), f"step {step}"


@pytest.mark.parametrize("walls", [4, 40, 150])
def test_threads_share_what_is_remembered(walls):
    case = {"shape": "bar", "kind": "diff", "bounds": "free", "walls": walls, "nworld": 64}
    one = run(1, **case, forget=False)
    three = run(1, **case, forget=False, threads=3)
    assert all(np.array_equal(a[0], b[0]) for a, b in zip(one, three, strict=True))


def test_a_command_that_is_no_number_leads_nowhere_in_free_and_bounded_drives():
    for bounds in BOUNDS:
        fleet = Fleet([Body((SHAPES["disc"],), drive=Drive("omni", **BOUNDS[bounds]))])
        for wrong in (math.nan, math.inf, -math.inf):
            fleet.command[:] = wrong
            fleet.step()
        if bounds == "free":
            assert fleet.stalled.all()
            assert not fleet.velocity.any()
        assert np.isfinite(fleet.pose).all()
        fleet.close()
