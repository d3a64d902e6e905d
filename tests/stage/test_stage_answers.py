"""Results of Stage 4.3 itself for a few worlds, against Gazelle's.

``tools/stage_answers.py`` ran them; ``tools/stage_second_opinion.py`` compares more.
"""

import json
import math
from pathlib import Path

import numpy as np
import pytest

ANSWERS = json.loads(
    (Path(__file__).parents[1] / "data" / "stage_answers.json").read_text(encoding="utf-8")
)
SCENES = {scene["name"].strip(): scene for scene in ANSWERS["scenes"]}
FIRST_LOOK = 5


@pytest.fixture
def run(start):
    """Run a scene; return its values after counted steps, shape (steps, robots, 7)."""

    def make(scene):
        text = scene["world"]
        for i, (words, (x, y, yaw), _) in enumerate(scene["robots"]):
            text += f'\nposition ( name "r{i}" pose [{x:.6f} {y:.6f} 0 {yaw:.6f}] {words} )'
        sim = start(text, euler=True)
        sim.commands[0] = [command for _, _, command in scene["robots"]]
        found, senses = [], None
        for step in range(1, max(ANSWERS["at"]) + 1):
            sim.step()
            if step == FIRST_LOOK:
                senses = sim
            if step in ANSWERS["at"]:
                stalled = sim.stalled[0][:, None]
                found.append(np.hstack((sim.poses[0], stalled, sim.odometry[0])))
        return np.array(found), senses

    return make


def theirs(scene):
    poses = [scene["poses"][f"r{i}"] for i in range(len(scene["robots"]))]
    return np.array(poses).swapaxes(0, 1)


def apart(ours, stage):
    """Return the differences, angles the short way round."""
    difference = ours - stage
    difference[..., (2, 6)] = np.remainder(difference[..., (2, 6)] + math.pi, 2 * math.pi) - math.pi
    return np.abs(difference)


@pytest.mark.parametrize("kind", ["differential bases", "omnidirectional bases", "cars"])
def test_bases_go_where_they_go_in_stage(run, kind):
    ours, _ = run(SCENES[kind])
    gaps = apart(ours, theirs(SCENES[kind]))
    assert gaps[..., :3].max() < 2e-8
    if kind != "omnidirectional bases":  # Stage counts moves to the left as moves to the right
        assert gaps[..., 4:].max() < 2e-8


def test_robots_stall_at_the_heights_that_stall_them_in_stage(run):
    ours, _ = run(SCENES["heights"])
    stage = theirs(SCENES["heights"])
    assert stage[-1, :, 3].any()
    assert not stage[-1, :, 3].all()
    assert (ours[-1, :, 3] == stage[-1, :, 3]).all()
    assert apart(ours, stage)[..., :2].max() < 0.05 + 1e-6  # a step


@pytest.mark.filterwarnings("ignore::gazelle.errors.SimulationWarning")  # one is on another
def test_what_is_on_robots_bumps_as_in_stage(run):
    ours, _ = run(SCENES["bodies on bodies"])
    stage = theirs(SCENES["bodies on bodies"])
    assert stage[-1, :, 3].sum() == len(stage[-1]) - 1  # all but the one without a body
    assert (ours[..., 3] == stage[..., 3]).all()
    assert apart(ours, stage)[..., :3].max() < 2e-8


@pytest.mark.parametrize("name", [name for name in SCENES if name.startswith("fiducials")])
def test_fiducial_finders_see_what_they_see_in_stage(run, name):
    _, sim = run(SCENES[name])
    stage = {
        who: [float(v) for v in rest] for who, *rest in SCENES[name]["fiducials"].get("r0", [])
    }
    ours = {s.name: [s.id, s.distance, s.bearing, s.heading] for s in sim.fiducials("r0")}
    assert ours.keys() == stage.keys()
    for who, values in ours.items():
        assert values == pytest.approx(stage[who], abs=2e-9)


def test_bumpers_touch_what_they_touch_in_stage(run):
    _, sim = run(SCENES["bumpers"])
    bumps = SCENES["bumpers"]["bumps"]
    assert {strip for robot in bumps.values() for strip in robot} == {"-", "w0", "w1"}
    for robot, strips in bumps.items():
        assert [strip or "-" for strip in sim.bumps(robot)] == strips
