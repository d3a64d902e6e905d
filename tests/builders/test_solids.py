"""Colours, parts and models of one link."""

import pytest

import gazelle
from gazelle.builders import (
    PALETTE,
    BuildError,
    Part,
    assemble,
    box,
    cylinder,
    ground,
    material,
    post,
    slab,
    sphere,
)
from gazelle.description import Material, Pose, Sphere, World


def test_a_colour_has_a_name_numbers_or_a_script():
    assert material("oak").diffuse == (*PALETTE["oak"], 1.0)
    assert material((0.1, 0.2, 0.3)).diffuse == (0.1, 0.2, 0.3, 1.0)
    assert material([0.1, 0.2, 0.3, 0.4]).ambient == (0.1, 0.2, 0.3, 0.4)
    assert material("Gazebo/Red").diffuse == (1.0, 0.0, 0.0, 1.0)
    assert material("Gazebo/Red").script == "Gazebo/Red"
    own = Material(script="mine")
    assert material(own) is own


def test_an_unknown_colour_names_the_nearest():
    with pytest.raises(BuildError, match="did you mean 'oak'"):
        material("oack")
    with pytest.raises(BuildError, match="Gazebo/Nothing"):
        material("Gazebo/Nothing")
    with pytest.raises(BuildError, match="from 0 to 1"):
        material((255, 0, 0))
    with pytest.raises(BuildError, match="three or four"):
        material((0.5, 0.5))


def test_parts_collide_and_show_as_they_say():
    parts = [
        slab("a", (1, 1, 1), (0, 0, 0)),
        slab("b", (1, 1, 1), (0, 0, 0), collides=False),
        Part("c", Sphere(1.0), shows=False),
    ]
    (link,) = assemble("m", parts).links
    assert [c.name for c in link.collisions] == ["a", "c"]
    assert [v.name for v in link.visuals] == ["a_visual", "b_visual"]


def test_a_mass_makes_a_model_movable():
    parts = [post("p", 0.1, 1.0, (0, 0, 0.5))]
    assert assemble("m", parts).static
    movable = assemble("m", parts, mass=2.0)
    assert not movable.static
    assert movable.links[0].inertial.mass == 2.0


def test_impossible_models_are_refused():
    part = slab("a", (1, 1, 1), (0, 0, 0))
    with pytest.raises(BuildError, match="two parts of 'm' are called 'a'"):
        assemble("m", [part, part])
    with pytest.raises(BuildError, match="fall for ever"):
        assemble("m", [slab("a", (1, 1, 1), (0, 0, 0), collides=False)], mass=1.0)
    with pytest.raises(BuildError, match="'pose' must be finite numbers"):
        assemble("m", [part], pose=Pose(float("nan")))
    with pytest.raises(BuildError, match="size of 'a'"):
        slab("a", (1, 0, 1), (0, 0, 0))
    with pytest.raises(BuildError, match="radius"):
        sphere(radius=-1.0)


def test_solids_rest_where_they_are_put():
    things = (
        box("b", (0.4, 0.6, 0.8), pose=Pose(1.0, yaw=0.4), mass=3.0),
        cylinder("c", 0.2, 0.5, pose=Pose(-1.0), mass=2.0),
        sphere("s", 0.2, pose=Pose(0.0, 1.0), mass=1.0),
    )
    with gazelle.Simulation(World(models=(ground(), *things))) as sim:
        sim.run(1.0)
        for thing in things:
            moved = sim.robots[thing.name].pose
            assert moved.is_close(thing.pose, position=2e-3, angle=2e-3)
