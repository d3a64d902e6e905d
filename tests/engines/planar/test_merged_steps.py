"""Many steps at once have the bits of the same steps one after another."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle import Pose, Simulation
from gazelle.engines.planar import Body, Drive, Fleet, PlanarPart

LIMITED = {"brake": (-0.5, -0.5, -2.0), "push": (0.5, 0.5, 2.0), "fastest": (0.8, 0.8, 1.5)}
DRIVES = [Drive(), Drive("omni"), Drive("car"), Drive("omni", **LIMITED), None]
PARTS = [PlanarPart.box(0.3, 0.2), PlanarPart.circle(0.02, 0.0, 0.1), PlanarPart.box(0.05, 0.6)]
WALLS = [PlanarPart.box(0.1, 0.4, x=1.0), PlanarPart.circle(-0.7, 0.3, 0.2)]


def same_bits(a, b):
    """Check that two fleets are in the same state."""
    for name in ("body_rows", "velocity", "stalled"):
        assert getattr(a, name).tobytes() == getattr(b, name).tobytes(), name


@st.composite
def fleets(draw):
    """Draw what makes a fleet of up to four bodies, some close to others and to walls."""
    place = st.floats(-1.2, 1.2)
    bodies = [
        Body(
            (draw(st.sampled_from(PARTS)),),
            (draw(place), draw(place), draw(st.floats(-3.2, 3.2))),
            drive=draw(st.sampled_from(DRIVES)),
        )
        for _ in range(draw(st.integers(1, 4)))
    ]
    options = {
        "nworld": draw(st.sampled_from([1, 11])),
        "time_step": draw(st.sampled_from([0.001, 0.02])),
        "euler": draw(st.booleans()),
        "sweep": draw(st.booleans()),
        "cell": draw(st.sampled_from([0.3, 9.0])),
        "threads": 1,
    }
    return bodies, options


@settings(max_examples=40, deadline=None)
@given(
    made=fleets(),
    seed=st.integers(0, 99),
    counts=st.lists(st.integers(1, 90), min_size=1, max_size=4),
)
def test_steps_are_merged_with_the_same_bits(made, seed, counts):
    bodies, options = made
    merged, single = (Fleet(bodies, WALLS, **options) for _ in range(2))
    rng = np.random.default_rng(seed)
    for count in counts:
        wanted = rng.choice(
            [0.0, 0.3, -1.0, 2.0, 40.0], merged.command.shape, p=[0.3, 0.3, 0.2, 0.1, 0.1]
        )
        merged.command[:] = single.command[:] = wanted
        merged.step(count)
        for _ in range(count):
            single.step()
        same_bits(merged, single)


def test_what_turns_within_a_narrow_gap_is_tried_at_every_step():
    body = Body((PlanarPart.box(0.6, 0.1),), drive=Drive())
    walls = [PlanarPart.box(2.0, 0.1, y=0.2), PlanarPart.box(2.0, 0.1, y=-0.2)]
    fleet = Fleet([body], walls, time_step=0.001)
    fleet.command[:] = 0.0, 0.0, 1.0
    fleet.step(3000)
    assert fleet.stalled[0, 0]
    yaw = fleet.pose[0, 0, 2]
    corner = 0.3 * math.sin(yaw) + 0.05 * math.cos(yaw)
    assert 0.15 - 0.3 * 0.001 < corner <= 0.15 + 1e-9


@pytest.mark.parametrize("nworld", [1, 9])
def test_a_simulation_may_be_cut_anywhere(nworld):
    """Drives at 30 Hz, obstacles at 10 Hz and a lidar at 5 Hz come between."""
    seen = []
    for pieces in ([0.5], [0.001] * 500, [0.07, 0.13, 0.3]):
        with Simulation("turtlebot3_stage_4", "planar", nworld=nworld, time_step=0.001) as sim:
            robot = sim.spawn("turtlebot3_burger", name="burger", pose=Pose(x=-0.7))
            scans = []
            robot.sensors["lds_lfcd_sensor"].subscribe(
                lambda scan, scans=scans: scans.append(scan.latest().tobytes())
            )
            robot.inputs["cmd_vel"].send(
                np.linspace(0.05, 0.22, nworld), np.linspace(1, -2, nworld)
            )
            for piece in pieces:
                sim.run(piece)
            seen.append((bytes(sim.snapshot()), *scans))
    assert len(seen[0]) > 2
    assert seen[0] == seen[1] == seen[2]
