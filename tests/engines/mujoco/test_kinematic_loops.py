"""Choice of the joint that closes a loop, and its cost."""

import math
import warnings

import numpy as np
import pytest
import scenes

from gazelle.description import Inertia, Inertial, Joint, JointAxis, Link, Model, Pose, Source
from gazelle.engines import make_engine
from gazelle.errors import EngineError, EngineWarning
from gazelle.kinematics.tree import tree_of

X, Y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
CRANK, ROD = 0.2, 0.5


def part(name, **pose):
    return Link(name, pose=Pose(**pose), inertial=Inertial(1.0, Pose(), Inertia(0.01, 0.01, 0.01)))


def hinge(name, parent, child, pose=None, **axis):
    axes = (JointAxis(Y, **axis),)
    return Joint(name, "revolute", parent, child, pose=pose or Pose(), axes=axes)


def crank_slider(kind="prismatic", **slide):
    """Return a crank, a rod and a slider along x; the slider's guide comes last in the file."""
    guide = JointAxis(X, **slide)
    second = (JointAxis(Y),) if kind in ("universal", "revolute2") else ()
    joints = (
        hinge("turn", "world", "crank"),
        hinge("pin", "crank", "rod"),
        hinge("wrist", "rod", "slider"),
        Joint("guide", kind, "world", "slider", axes=(guide, *second)),
    )
    parts = part("crank"), part("rod", x=CRANK), part("slider", x=CRANK + ROD)
    return Model("m", links=parts, joints=joints)


def engine_of(model, nworld=1):
    return make_engine("mujoco", scenes.world(model, gravity=(0.0, 0.0, 0.0)), nworld)


@pytest.fixture(autouse=True)
def _no_warnings():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


def test_a_guide_that_comes_last_is_kept_and_the_pin_closes_the_loop():
    engine = engine_of(crank_slider())
    assert set(engine.joints.names) == {"m::turn", "m::pin", "m::guide"}
    engine.joints["m::turn"].set_effort(0.3)
    turned = 0.0
    for _ in range(30):
        engine.step(50)
        angle, at = (
            engine.joints["m::turn"].position()[0, 0],
            engine.joints["m::guide"].position()[0, 0],
        )
        reach = CRANK * math.cos(angle) + math.sqrt(ROD**2 - (CRANK * math.sin(angle)) ** 2)
        assert at == pytest.approx(reach - CRANK - ROD, abs=1e-3)
        turned = max(turned, abs(angle))
    assert turned > math.pi / 2.0


@pytest.mark.parametrize("kind", ["universal", "revolute2"])
def test_joints_that_close_no_loop_are_kept_in_the_tree(kind):
    assert "m::guide" in engine_of(crank_slider(kind)).joints.names


def test_a_joint_with_limits_damping_or_a_spring_is_kept_in_the_tree():
    for own in (
        {"damping": 0.1},
        {"friction": 0.1},
        {"spring_stiffness": 1.0},
        {"armature": 1.0},
        {"upper": 1.0},
    ):
        last = hinge("last", "world", "slider", **own)
        model = crank_slider()
        model = Model("m", links=model.links, joints=(*model.joints[:3], last))
        (closure,) = tree_of(model).closures
        assert closure.name == "m::wrist"


def test_what_a_loop_takes_from_a_joint_is_said_with_its_place():
    source = Source("loop.sdf", 12, "joint[last]")
    axes = (JointAxis(Y, damping=0.1, upper=1.0),)
    last = Joint("last", "revolute", "world", "slider", axes=axes, source=source)
    parts = crank_slider()
    first = (*parts.joints[:2], hinge("wrist", "rod", "slider", friction=0.1))
    model = Model("m", links=parts.links, joints=(*first, last))
    with pytest.warns(EngineWarning, match=r"loop\.sdf:12.*without effect there: damping, limits"):
        engine_of(model)


def test_two_guides_of_one_slider_agree():
    parts = crank_slider()
    other = Joint("other", "prismatic", "world", "slider", axes=(JointAxis(X),))
    engine = engine_of(
        Model("m", links=parts.links, joints=(parts.joints[0], other, parts.joints[3]))
    )
    engine.links["m::slider"].set_wrench((1.0, 5.0, -3.0), (0.1, 0.2, 0.3))
    engine.step(1000)
    place = engine.links["m::slider"].placement()
    start = CRANK + ROD
    assert place.position[0, 0] - start == pytest.approx(0.5 / 1.01, rel=2e-3)
    np.testing.assert_allclose(place.position[0, 1:], 0.0, atol=1e-4)
    np.testing.assert_allclose(place.quaternion[0], [0, 0, 0, 1], atol=1e-4)


def jack(pitch, *, base="world", turn=None):
    """Return a carriage that slides along z, a screw about z, and the thread between them."""
    up = (0.0, 0.0, 1.0)
    joints = (
        Joint("lift", "prismatic", base, "carriage", axes=(JointAxis(up),)),
        Joint("turn", "revolute", base, "screw", axes=(turn or JointAxis(up),)),
        Joint("thread", "screw", "carriage", "screw", axes=(JointAxis(up),), thread_pitch=pitch),
    )
    links = part("carriage", x=0.1), part("screw", z=0.2)
    return Model("m", links=links, joints=joints)


@pytest.mark.parametrize("pitch", [-3141.6, -10.0, 2.0, 10.0, 300.0])
def test_a_thread_that_closes_a_loop_lifts_as_it_is_turned(pitch):
    """Work of the torque goes into the turn and the lift: torque = (I + m / pitch²) angle''."""
    engine = engine_of(jack(pitch))
    assert set(engine.joints.names) == {"m::lift", "m::turn"}
    torque = 0.05
    engine.joints["m::turn"].set_effort(torque)
    engine.step(1000)
    angle, lift = (engine.joints[f"m::{name}"].position()[0, 0] for name in ("turn", "lift"))
    # The screw is the child: against the carriage it goes down as that goes up.
    assert lift == pytest.approx(angle / pitch, rel=2e-3, abs=1e-6)
    assert angle == pytest.approx(0.5 * torque / (0.01 + 1.0 / pitch**2), rel=0.02)


@pytest.mark.parametrize("pitch", [-40.0, 40.0])
def test_a_carriage_on_a_thread_falls_as_energy_says(pitch):
    engine = make_engine("mujoco", scenes.world(jack(pitch)), 1)
    engine.step(1000)
    fallen = 0.5 * 9.8 / (1.0 + 0.01 * pitch**2)  # m g = (m + I pitch²) z''
    lift = engine.joints["m::lift"].position()[0, 0]
    assert lift == pytest.approx(-fallen, rel=0.02)
    assert engine.joints["m::turn"].position()[0, 0] == pytest.approx(lift * pitch, rel=2e-3)


def test_a_thread_on_a_base_that_moves_keeps_it_where_it_is():
    """What the parts do to each other moves no centre of mass."""
    model = jack(10.0, base="base")
    model = Model("m", links=(part("base"), *model.links), joints=model.joints)
    engine = engine_of(model)
    engine.joints["m::turn"].set_effort(0.05)
    engine.step(500)
    centres = [
        engine.links[f"m::{n}"].placement().position[0] for n in ("base", "carriage", "screw")
    ]
    assert engine.joints["m::lift"].position()[0, 0] > 0.02
    np.testing.assert_allclose(np.sum(centres, axis=0), [0.1, 0.0, 0.2], atol=2e-3)


def test_limits_of_a_thread_in_a_loop_hold():
    up = (0.0, 0.0, 1.0)
    parts = jack(10.0)
    stop = JointAxis(up, lower=-0.5, upper=0.5)
    thread = Joint("thread", "screw", "carriage", "screw", axes=(stop,), thread_pitch=10.0)
    engine = engine_of(Model("m", links=parts.links, joints=(*parts.joints[:2], thread)))
    engine.joints["m::turn"].set_effort(0.02)
    engine.step(3000)
    assert engine.joints["m::turn"].position()[0, 0] == pytest.approx(0.5, abs=0.02)


def test_a_thread_without_pitch_that_closes_a_loop_is_an_error():
    with pytest.raises(EngineError, match="thread pitch of 0"):
        engine_of(jack(0.0))


def test_two_hinges_in_one_joint_close_a_loop():
    """A table on a column and on a joint of two axes beside it turns about neither of its own."""
    axes = (JointAxis(X), JointAxis(Y))
    joints = (
        Joint("first", "revolute2", "world", "table", axes=axes),
        Joint("second", "revolute2", "world", "table", pose=Pose(x=0.5), axes=axes),
    )
    engine = engine_of(Model("m", links=(part("table"),), joints=joints))
    engine.links["m::table"].set_wrench((0.0, 0.0, 1.0), (0.3, 0.2, 0.1))
    engine.step(500)
    place = engine.links["m::table"].placement()
    np.testing.assert_allclose(place.position[0], 0.0, atol=1e-3)
    x, y, z, _ = place.quaternion[0]
    assert abs(x) > 0.1  # about the line through both
    np.testing.assert_allclose([y, z], 0.0, atol=2e-3)


def test_a_ring_is_cut_where_it_costs_nothing_and_not_at_what_hangs_on_it():
    """Three links in a ring, and one that hangs on them and comes first in the file."""
    links = tuple(part(name) for name in ("tail", "a", "b", "c"))
    joints = (
        hinge("t", "a", "tail"),
        hinge("ca", "c", "a", damping=0.2),
        hinge("ab", "a", "b"),
        hinge("bc", "b", "c", damping=0.2),
    )
    (closure,) = tree_of(Model("m", links=links, joints=joints)).closures
    assert closure.name == "m::ab"


def test_a_plain_loop_is_closed_by_the_last_joint_as_before():
    parts = crank_slider()
    plain = (*parts.joints[:3], hinge("last", "world", "slider"))
    (closure,) = tree_of(Model("m", links=parts.links, joints=plain)).closures
    assert closure.name == "m::last"
    assert np.isfinite(engine_of(Model("m", links=parts.links, joints=plain)).snapshot()).all()
