"""Range finders that compiled code casts, against MuJoCo's rays of a batch of worlds."""

from dataclasses import replace

import numpy as np
import pytest

from gazelle import formats
from gazelle.engines import RangeRays
from gazelle.engines.laws import with_profile
from gazelle.engines.mujoco import MujocoEngine

PART = """<link name='{0}'><pose>{1} 0 0 0 0 {1}</pose><inertial><mass>1</mass></inertial>
<collision name='c'><geometry><box><size>.2 .3 .4</size></box></geometry></collision></link>"""
MODEL = """<model name='{name}'><static>{static}</static><pose>{x} .5 .3 0 .1 .7</pose>{parts}</model>"""
GROUND = """<model name='ground'><static>1</static><link name='l'><collision name='c'><geometry><plane/>
</geometry></collision></link></model>"""
ARM = PART.format("base", 0) + PART.format("arm", 0.6) + (
    "<joint name='j' type='revolute'><parent>base</parent><child>arm</child>"
    "<axis><xyz>0 0 1</xyz></axis></joint>"
)  # fmt: skip


def engine(*, sleeps=False, **options):
    models = [
        MODEL.format(name="robot", static=0, x=0.0, parts=ARM),
        MODEL.format(name="placed", static=1, x=2.0, parts=PART.format("base", 0)),
        MODEL.format(name="wall", static=1, x=-2.0, parts=PART.format("base", 0)),
        MODEL.format(name="loose", static=0, x=3.5, parts=PART.format("base", 0)),
        GROUND,
    ]
    text = f"<sdf version='1.7'><world name='w'>{''.join(models)}</world></sdf>"
    world = formats.load_string(text)
    profile = replace(world.profile, auto_disable=sleeps)
    made = MujocoEngine(with_profile(world, profile), **options)
    made.make_kinematic("placed")
    return made


def scan(link, rays=9):
    angles = np.linspace(-3.0, 3.0, rays)
    along = np.stack((np.cos(angles), np.sin(angles), 0.1 * np.sin(5.0 * angles)), axis=1)
    return RangeRays(link, np.array([0.0, 0.02, 0.1]) + 0.4 * along, along)


LINKS = ("robot::base", "robot::arm", "placed::base", "wall::base", "loose::base")


@pytest.mark.parametrize("sleeps", [False, True])
@pytest.mark.parametrize(("nworld", "threads"), [(1, 1), (5, 1), (5, 3)])
def test_each_ray_is_as_long_as_that_of_its_link(nworld, threads, sleeps):
    made = engine(nworld=nworld, threads=threads, sleeps=sleeps)
    table = made.range_table([scan(link) for link in LINKS])
    for turn in range(3):
        spread = 0.3 * np.arange(nworld)[:, None] * (1.0, 0.5, 0.2) + turn
        made.links["robot::base"].set_motion(spread, 2.0 * spread)
        made.models["placed"].set_placement((1.5, 0.1 * turn, 0.4), (0.0, 0.0, 0.0, 1.0))
        made.step(400)
        found = table.cast().copy()
        for place, link in enumerate(LINKS):
            rays = scan(link)
            hits = made.links[link].cast_rays(rays.origins, rays.directions)
            wanted = np.where(hits.from_inside, -np.inf, hits.distance)
            # Kinematics made again normalises a quaternion again: by rounding.
            np.testing.assert_allclose(found[:, place], wanted, rtol=1e-12)
        some = np.arange(nworld)[::2]
        np.testing.assert_array_equal(table.cast(some), found[some])
    assert np.isfinite(found).any()
    made.close()


def test_a_table_made_before_models_came_is_replaced_by_its_revision():
    made = engine()
    before, revision = made.range_table([scan("wall::base")]).cast().copy(), made.revision
    text = f"<sdf version='1.7'>{MODEL.format(name='new', static=1, x=-1.4, parts=PART.format('l', 0))}</sdf>"
    made.spawn(formats.load_model_string(text))
    assert made.revision != revision
    assert (made.range_table([scan("wall::base")]).cast() < before).any()
    made.close()
