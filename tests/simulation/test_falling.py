"""A model that falls out of the world is named once, whatever the cause."""

import warnings

import pytest

import gazelle
from gazelle import formats
from gazelle.errors import SimulationWarning

SHAPE = "<geometry><box><size>1 1 1</size></box></geometry>"
SOLID = f"<collision name='c'>{SHAPE}</collision>"


def model(name, pose="0 0 2 0 0 0", inside=SOLID, static=0):
    return (
        f"<model name='{name}'><static>{static}</static><pose>{pose}</pose>"
        f"<link name='l'>{inside}</link></model>"
    )


def world(*models):
    return formats.load_string(
        f"<sdf version='1.7'><world name='w'>{''.join(models)}</world></sdf>"
    )


FLOOR = model(
    "floor",
    "0 0 0 0 0 0",
    "<collision name='c'><geometry><plane/></geometry></collision>",
    static=1,
)
TABLE = model("table", "0 0 -0.5 0 0 0", static=1)


@pytest.mark.parametrize(
    ("models", "name", "cause"),
    [
        ([model("box")], "box", "no ground"),
        ([FLOOR, model("ghost", inside="")], "ghost", "no link of it has a <collision>"),
        ([TABLE, model("box", "9 0 2 0 0 0")], "box", "beside the ground"),
    ],
)
def test_a_model_that_falls_is_named_once_with_the_cause(models, name, cause):
    with gazelle.Simulation(world(*models), threads=1) as sim:
        with pytest.warns(SimulationWarning, match=f"'{name}' has fallen.*{cause}") as caught:
            sim.run(3.0)
        assert len(caught) == 1
        sim.reset()
        sim.run(3.0)


def test_each_model_is_named_and_the_world_it_fell_out_of():
    with gazelle.Simulation(world(TABLE, model("box")), nworld=3, threads=1) as sim:
        sim.robots["box"].set_pose((9.0, 0.0, -30.0), worlds=[1])
        with pytest.warns(SimulationWarning, match="'box' of world 1 has fallen"):
            sim.run(1.0)
        late = f"<sdf version='1.7'>{model('late', inside='')}</sdf>"
        sim.spawn(formats.load_model_string(late))
        with pytest.warns(SimulationWarning, match="'late'"):
            sim.run(3.0)


def test_nothing_falls_in_the_plane():
    with gazelle.Simulation(world(model("box")), "planar", threads=1) as sim:
        sim.robots["box"].set_pose((0.0, 0.0, -50.0))
        sim.run(1.0)


def test_what_has_ground_below_does_not_count_as_fallen():
    high = model("high", "0 0 60 0 0 0")
    with warnings.catch_warnings(), gazelle.Simulation(world(FLOOR, high), threads=1) as sim:
        warnings.simplefilter("error")
        sim.run(5.0)
        assert sim.robots["high"].pose.z < 1.0


def test_looking_for_models_that_fall_changes_nothing_in_the_plane():
    with gazelle.Simulation(world(TABLE, model("box")), "planar", threads=1) as sim:
        before = sim.engine.revision
        sim.run(3.0)
        assert sim.engine.revision == before
