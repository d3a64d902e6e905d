"""Which joint of a loop closes it, and what that costs."""

import math
import warnings

import numpy as np
import pytest
import scenes

from gazelle.description import Inertia, Inertial, Joint, JointAxis, Link, Model, Pose, Source
from gazelle.engines import make_engine
from gazelle.engines.mujoco.tree import tree_of
from gazelle.errors import EngineError, EngineWarning

X, Y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
CRANK, ROD = 0.2, 0.5


def part(name, **pose):
    return Link(name, pose=Pose(**pose), inertial=Inertial(1.0, Pose(), Inertia(0.01, 0.01, 0.01)))


def hinge(name, parent, child, pose=None, **axis):
    axes = (JointAxis(Y, **axis),)
    return Joint(name, "revolute", parent, child, pose=pose or Pose(), axes=axes)


def crank_slider(kind="prismatic", **slide):
    """A crank, a rod and a slider along x; the slider's guide comes last in the file."""
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
    assert set(engine.joint_names) == {"m::turn", "m::pin", "m::guide"}
    engine.set_joint_effort("m::turn", 0.3)
    turned = 0.0
    for _ in range(30):
        engine.step(50)
        angle, at = engine.joint_position("m::turn")[0, 0], engine.joint_position("m::guide")[0, 0]
        reach = CRANK * math.cos(angle) + math.sqrt(ROD**2 - (CRANK * math.sin(angle)) ** 2)
        assert at == pytest.approx(reach - CRANK - ROD, abs=1e-3)
        turned = max(turned, abs(angle))
    assert turned > math.pi / 2.0


@pytest.mark.parametrize("kind", ["screw", "universal", "revolute2"])
def test_joints_that_close_no_loop_are_kept_in_the_tree(kind):
    assert "m::guide" in engine_of(crank_slider(kind)).joint_names


def test_a_joint_with_limits_damping_or_a_spring_is_kept_in_the_tree():
    for own in ({"damping": 0.1}, {"friction": 0.1}, {"spring_stiffness": 1.0}, {"upper": 1.0}):
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


def test_two_guides_of_one_slider_are_an_error_with_a_way_out():
    parts = crank_slider()
    other = Joint("other", "prismatic", "world", "slider", axes=(JointAxis(X),))
    model = Model("m", links=parts.links, joints=(parts.joints[0], other, parts.joints[3]))
    with pytest.raises(EngineError, match="let another joint of the loop close it"):
        engine_of(model)


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
