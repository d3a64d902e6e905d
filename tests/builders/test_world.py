"""Worlds put together step by step."""

import math

import pytest

from gazelle.builders import (
    BuildError,
    Disc,
    Rectangle,
    WorldBuilder,
    box,
    chair,
    desk,
    door,
    footprints,
    hills,
    lamp,
    plugin,
    sphere,
    tree,
)
from gazelle.description import Pose


def names(world):
    return [model.name for model in world.models]


def test_things_get_names_of_their_own():
    world = WorldBuilder("w").place(desk, 0, 0).place(desk, 2, 0).add(desk("chair")).build()
    assert names(world) == ["desk", "desk_1", "chair"]
    lights = WorldBuilder().light(lamp(), lamp()).sun().build().lights
    assert [light.name for light in lights] == ["lamp", "lamp_1", "sun"]


def test_things_stand_where_they_are_put_on_the_ground():
    land = hills(2, length=20, width=20)
    world = WorldBuilder().terrain(land).place(tree, 3.0, 4.0, 0.5, height=2.0).build()
    assert world.models[-1].pose == Pose(3.0, 4.0, land.height(3.0, 4.0), yaw=0.5)


def test_random_things_keep_away_from_what_is_there():
    builder = WorldBuilder(seed=3).ground().room(8.0, 8.0, openings=[door(0, 4.0)])
    builder.place(desk, 1.0, 1.0, 0.7).keep_clear(Disc(-2.0, -2.0, 1.0))
    before = [zone for model in builder.build().models for zone in footprints(model)]
    world = builder.obstacles(6, area=Rectangle(0, 0, 7.5, 7.5), gap=0.1).build()
    for model in world.models[3:]:
        assert model.name.startswith("obstacle")
        for zone in (*before, Disc(-2.0, -2.0, 1.0)):
            assert zone.distance(model.pose.x, model.pose.y) > 0.2


def test_random_calls_differ_and_a_seed_decides():
    def build(seed):
        return WorldBuilder(seed=seed).obstacles(3).obstacles(3).build()

    world = build(1)
    assert world == build(1)
    assert world != build(2)
    assert names(world)[3] == "obstacle_0_1"
    first, second = world.models[:3], world.models[3:]
    assert {m.pose for m in first}.isdisjoint({m.pose for m in second})


def test_options_given_are_not_changed():
    options = {"area": Rectangle(), "seed": 4, "keep_clear": [Disc()]}
    WorldBuilder().obstacles(2, **options)
    assert set(options) == {"area", "seed", "keep_clear"}


def test_a_plan_brings_walls_and_furniture():
    plan = "######\n#d c #\n######"
    world = WorldBuilder().plan(plan, {"d": desk, "c": chair}, cell=1.0).build()
    assert names(world) == ["walls", "desk", "chair"]
    assert world.models[1].pose == Pose(-1.5, 0.0)
    assert world.models[2].pose == Pose(0.5, 0.0)


def test_models_of_files_can_be_included():
    world = WorldBuilder().include("chair", 1.0, 2.0, 0.5).include("turtlebot3_burger").build()
    assert names(world) == ["chair", "turtlebot3_burger"]
    assert world.models[0].pose.is_close(Pose(1.0, 2.0, yaw=0.5))
    named = WorldBuilder().include(box("b"), 1.0, name="mine").build()
    assert names(named) == ["mine"]


def test_the_world_has_what_was_asked_for():
    world = (
        WorldBuilder("moon base")
        .physics("accurate")
        .planet("moon")
        .earth(48.0, 11.0, 500.0)
        .scene(sky=True, grid=True)
        .camera((0.0, 0.0, 2.0), (2.0, 0.0, 0.0))
        .plugin(plugin("p", "libp.so"))
        .road([(0, 0), (5, 0)])
        .build()
    )
    assert world.name == "moon base"
    assert world.profile.name == "accurate"
    assert world.gravity == (0.0, 0.0, -1.62)
    assert world.spherical_coordinates.latitude == 48.0
    assert world.scene.sky
    assert world.camera.pitch == pytest.approx(math.pi / 4)
    assert [p.filename for p in world.plugins] == ["libp.so"]


def test_random_things_keep_off_the_road():
    world = WorldBuilder().road([(-5, 0), (5, 0)], width=4.0).obstacles(5).build()
    assert all(abs(model.pose.y) > 2.0 for model in world.models[1:])


def test_wrong_words_get_a_hint():
    with pytest.raises(BuildError, match="did you mean 'shadows'"):
        WorldBuilder().scene(shadow=True)
    with pytest.raises(BuildError, match="did you mean 'fast'"):
        WorldBuilder().physics("fst")


def test_a_builder_goes_on_after_building():
    builder = WorldBuilder().add(sphere())
    first = builder.build()
    second = builder.add(sphere()).build()
    assert (len(first.models), len(second.models)) == (1, 2)
