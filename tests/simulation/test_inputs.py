"""Invalid arguments raise an error at once, in one line, and change nothing."""

import math

import numpy as np
import pytest
import scenes

from gazelle.description import Inertial, Joint, JointAxis, Link, Model, Pose
from gazelle.errors import Error, SimulationError
from gazelle.simulation import Simulation
from gazelle.simulation.inputs import chosen, numbers

NAN = math.nan


def arm():
    axis = JointAxis((1.0, 0.0, 0.0), lower=-1.0, upper=1.0)
    both = JointAxis((0.0, 1.0, 0.0)), JointAxis((1.0, 0.0, 0.0))
    parts = tuple(Link(name, inertial=Inertial()) for name in ("a", "b", "c"))
    joints = (
        Joint("hold", "fixed", "world", "a"),
        Joint("j", "revolute", "a", "b", axes=(axis,)),
        Joint("u", "universal", "a", "c", axes=both),
    )
    return Model("arm", links=parts, joints=joints, pose=Pose(z=3.0))


@pytest.fixture
def sim():
    world = scenes.world(scenes.ground(), scenes.box(pose=Pose(x=2.0, z=0.1)), arm())
    with Simulation(world, nworld=2) as made:
        made.step(3)
        yield made


def box(sim):
    return sim.robots["box"]


def link(sim):
    return sim.robots["box"].links["link"]


def joint(sim, name="j"):
    return sim.robots["arm"].joints[name]


WRONG = {
    "position of 'box' must be finite": lambda s: box(s).set_pose((NAN, 0, 0)),
    "position of 'box' must be 3 numbers": lambda s: box(s).set_pose((0, 0)),
    "orientation of 'box' must be finite": lambda s: box(s).set_pose((0, 0, 1), yaw=NAN),
    "orientation of 'box' must be 4": lambda s: box(s).set_pose((0, 0, 1), (0, 0, 1)),
    "in 0 to 1": lambda s: box(s).set_pose((0, 0, 1), worlds=[2]),
    "a mask of 2": lambda s: box(s).set_twist((0, 0, 1), (0, 0, 0), worlds=[True]),
    "velocity of 'box' must be finite": lambda s: box(s).set_twist((0, math.inf, 0), (0, 0, 0)),
    "position of 'box::link'": lambda s: link(s).set_pose((0, 0, NAN)),
    "velocity of 'box::link'": lambda s: link(s).set_twist((0, 0, 0), (NAN, 0, 0)),
    "for each of 2 worlds": lambda s: link(s).set_twist(np.zeros((3, 3)), (0, 0, 0)),
    "a force must be finite": lambda s: link(s).apply_wrench((NAN, 0, 0)),
    "a force must be 3": lambda s: link(s).apply_wrench((1, 0)),
    "a torque must be 3": lambda s: link(s).apply_wrench(torque=(1, 0)),
    "point of a force": lambda s: link(s).apply_wrench((1, 0, 0), point=(NAN, 0, 0)),
    "start of a force": lambda s: link(s).apply_wrench((1, 0, 0), start=NAN),
    "position of joint 'arm::j' must be finite": lambda s: setattr(joint(s), "position", NAN),
    "position of joint 'arm::u' must be 2": lambda s: setattr(joint(s, "u"), "position", 0.1),
    "velocity of joint": lambda s: setattr(joint(s), "velocity", [0.0, NAN]),
    "effort on joint": lambda s: joint(s).apply_effort([1.0, 2.0, 3.0]),
    "must be numbers": lambda s: setattr(joint(s), "effort", "much"),
    "positions of j must be finite": lambda s: s.robots["arm"].set_configuration(["j"], [NAN]),
    "has 2 axes": lambda s: s.robots["arm"].set_configuration(["u"], [0.1]),
    "mean 'j'|are: j": lambda s: s.robots["arm"].set_configuration(["jj"], [0.1]),
    "lower limit .* would be 2, above": lambda s: joint(s).set_properties(lower=2.0),
    "not an int": lambda s: s.step(1.5),
    "step -1 times": lambda s: s.step(-1),
    "run for nan s": lambda s: s.run(NAN),
    "run for -1.0 s": lambda s: s.run(-1.0, rate=1.0),
    "run for inf s": lambda s: s.run(math.inf),
    "pose of model 'x' must be finite": lambda s: s.spawn(scenes.ball("x"), pose=Pose(math.inf)),
    "cannot be called 'a::b'": lambda s: s.spawn(scenes.ball("x"), name="a::b"),
    "worlds must be": lambda s: s.attach(link(s), s.robots["arm"].links["b"], worlds=[5]),
    "must be 6 numbers": lambda s: link(s).set_properties(inertia=(1, 1, 1)),
    "positive definite": lambda s: link(s).set_properties(mass=7.0, inertia=(1, 1, -1, 0, 0, 0)),
    "link_mass of 'box::link' must be a number": lambda s: s.parameters.link_mass.set(
        "box::link", [1.0, 2.0, 3.0]
    ),
}


@pytest.mark.parametrize("message", WRONG)
def test_what_cannot_be_is_refused_in_one_line_and_changes_nothing(sim, message):
    before = sim.engine.snapshot(), sim.parameters.link_mass["box::link"]
    with pytest.raises(Error, match=message) as caught:
        WRONG[message](sim)
    assert "\n" not in str(caught.value)
    np.testing.assert_array_equal(sim.engine.snapshot(), before[0])
    np.testing.assert_array_equal(sim.parameters.link_mass["box::link"], before[1])
    np.testing.assert_array_equal(sim.parameters.joint_lower["arm::j"], -1.0)


@pytest.mark.parametrize("options", [{"threads": 0}, {"time_step": math.inf}, {"nworld": 0}])
def test_runs_that_cannot_be_are_refused(options):
    with pytest.raises(Error, match="must be"):
        Simulation(scenes.world(), **options)


def test_limits_move_together_past_where_they_were(sim):
    joint(sim).set_properties(lower=[2.0, -3.0], upper=[4.0, -2.0])
    np.testing.assert_array_equal(sim.parameters.joint_lower["arm::j"], [2.0, -3.0])
    np.testing.assert_array_equal(sim.parameters.joint_upper["arm::j"], [4.0, -2.0])


def test_worlds_keep_their_order_and_can_be_a_mask(sim):
    box(sim).set_pose([(5.0, 0.0, 1.0), (6.0, 0.0, 1.0)], worlds=[1, 0])
    np.testing.assert_array_equal(box(sim).position[:, 0], [6.0, 5.0])
    box(sim).set_pose((7.0, 0.0, 1.0), worlds=np.array([False, True]))
    np.testing.assert_array_equal(box(sim).position[:, 0], [6.0, 7.0])


def test_efforts_and_velocities_of_two_axes_are_one_for_all_or_one_each(sim):
    universal = joint(sim, "u")
    universal.velocity = 0.5
    np.testing.assert_array_equal(universal.velocities(), 0.5)
    universal.velocity = [[0.1, 0.2], [0.3, 0.4]]
    np.testing.assert_array_equal(universal.velocities(), [[0.1, 0.2], [0.3, 0.4]])
    universal.position = [0.3, -0.2]
    np.testing.assert_array_equal(universal.positions(), [[0.3, -0.2]] * 2)


def test_shapes_and_worlds_that_fit():
    assert chosen(None, 3) is None
    np.testing.assert_array_equal(chosen([2, 0], 3), [2, 0])
    np.testing.assert_array_equal(chosen(np.int64(1), 3), [1])
    assert chosen([], 3).size == 0
    assert numbers("x", 1.0, 1, 4).shape == (1, 1)
    assert numbers("x", [1.0, 2.0, 3.0, 4.0], 1, 4).shape == (4, 1)
    assert numbers("x", [1.0, 2.0], 2, 4).shape == (2,)
    assert numbers("x", 1.0, 2, 4, alike=True).shape == (1, 2)
    for wrong in ([-1], [3], [0.5], [[0]], "all"):
        with pytest.raises(SimulationError, match="worlds must be"):
            chosen(wrong, 3)


@pytest.mark.parametrize("kind", "bhilqBHILQ")
def test_worlds_may_be_ints_of_any_width(kind):
    assert chosen(np.array([3, 0], kind), 4).tolist() == [3, 0]
    assert chosen(np.array([], kind), 4).tolist() == []
    wrong = [4, np.iinfo(kind).max] + [-1, np.iinfo(kind).min] * (kind in "bhilq")
    for world in wrong:
        with pytest.raises(SimulationError, match="worlds must be in 0 to 3"):
            chosen(np.array([0, world], kind), 4)


def test_an_array_of_rising_indices_is_copied():
    given = np.array([0, 2])
    found = chosen(given, 3)
    given[0] = 1
    assert found.tolist() == [0, 2]


@pytest.mark.parametrize("wrong", [[0, 3], [-1, 2], [1, 1], [2, 0, 2]])
def test_an_array_of_wrong_indices_is_refused(wrong):
    with pytest.raises(SimulationError, match="worlds must be"):
        chosen(np.array(wrong, np.intp), 3)
