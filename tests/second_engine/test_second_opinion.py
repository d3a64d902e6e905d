"""Ten scenes in MuJoCo and in Bullet: the same motion, but for differences that are explained.

The differences are listed in docs/explanation/accuracy.md; ``tools/second_opinion.py`` prints the list.
"""

from pathlib import Path

import pytest
import scenes
from second_engine.bullet import Bullet
from second_engine.bullet_urdf import UntranslatableError
from second_engine.comparing import compare
from second_engine.ten_scenes import DAMPING, LOOP, SCENES

from gazelle.description import Ellipsoid, Joint, JointAxis, Link, Model

BY_NAME = {scene.name: scene for scene in SCENES}
PAGE = Path(__file__).parents[2] / "docs" / "explanation" / "accuracy.md"


@pytest.mark.long
@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)
def test_two_engines_move_a_scene_alike(scene):
    for measure, outcome in zip(scene.measures, compare(scene, 0.001), strict=True):
        assert outcome.moved > 1e-4, measure.name  # a block sinks by less than a micrometre
        assert outcome.difference < measure.tolerance, measure.name


@pytest.mark.parametrize(
    ("name", "why", "order"),
    [("arm of six axes", DAMPING, 1), ("mimic gripper", DAMPING, 1), ("four-bar", LOOP, 2)],
)
def test_what_the_step_explains_goes_away_with_the_step(name, why, order):
    scene = BY_NAME[name]
    assert scene.measures[0].why == why
    coarse, fine = (compare(scene, step)[0].difference for step in (0.001, 0.0005))
    assert fine == pytest.approx(coarse / 2**order, rel=0.4)


def test_the_documentation_lists_every_comparison_and_its_cause():
    rows = [[cell.strip() for cell in line.split("|")] for line in PAGE.read_text().splitlines()]
    listed = {(row[1], row[2], row[-2]) for row in rows if len(row) == 8}
    for scene in SCENES:
        for measure in scene.measures:
            assert (scene.name, measure.name, measure.why) in listed


@pytest.mark.parametrize(
    "model",
    [
        scenes.solid("egg", Ellipsoid((0.1, 0.1, 0.2))),
        Model("m", links=(Link("a"),), joints=(Joint("j", "fixed", "world", "a"),)),
        Model("m", links=scenes.ball().links, joints=(Joint("j", "ball", "world", "link"),)),
        Model(
            "m",
            links=scenes.ball().links,
            joints=(
                Joint("j", "revolute", "world", "link", axes=(JointAxis(spring_stiffness=1.0),)),
            ),
        ),
    ],
    ids=["shape", "no inertia", "joint", "spring"],
)
def test_what_bullet_is_not_told_is_refused_rather_than_left_out(model):
    with pytest.raises(UntranslatableError):
        Bullet(scenes.world(model))
