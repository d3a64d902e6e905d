"""At which heights Stage's robots meet what is in their way."""

import pytest
from stage_samples import write

from gazelle.stage import StageSimulation


@pytest.mark.parametrize(
    ("robot", "wall", "stalls"),
    [
        ((0.0, 0.3), (0.1, 1.0), True),
        ((0.0, 0.3), (0.3, 1.0), True),  # Stage's bodies meet where they only touch
        ((0.0, 0.3), (0.0, 0.0), True),  # even plates on the ground
        ((0.0, 0.3), (-0.1, 0.1), True),
        ((0.1, 0.3), (0.0, 0.1), True),
        ((0.0, 0.3), (0.310001, 0.2), False),
        ((0.2, 0.1), (0.0, 0.1999), False),
    ],
)
@pytest.mark.parametrize("kind", ["model", "position"])
def test_bodies_meet_at_the_heights_that_both_have(tmp_path, robot, wall, stalls, kind):
    text = (
        f'position ( name "r" size [.4 .4 {robot[1]}] pose [0 0 {robot[0]} 0] )'
        f" {kind} ( size [1 1 {wall[1]}] pose [1 0 {wall[0]} 0] )"
    )
    with StageSimulation(write(tmp_path, text), threads=1) as sim:
        sim.commands[:, 0] = (0.5, 0.0, 0.0)
        sim.step(20)
        assert sim.stalled[0, 0] == stalls
        assert (sim.poses[0, 0, 0] < 0.3 + 1e-9) == stalls
