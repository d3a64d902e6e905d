"""Planned motions are shown on the page of a simulation, by ghosts of the robots."""

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

import gazelle
from gazelle.description import World
from gazelle.formats import load_model_string
from gazelle.planning import Group
from gazelle.simulation import JointMotion
from gazelle.viewer import LiveView
from tests.ros.graph import until
from tests.viewer.browser import opened, pixels

LINK = (
    '<link name="{0}"><visual><origin xyz="{1}"/><geometry><box size="{2}"/></geometry></visual>'
    '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
)
ARM = (
    '<robot name="arm"><link name="world"/>'
    '<joint name="stand" type="fixed"><parent link="world"/><child link="base"/></joint>'
    + LINK.format("base", "0 0 0.25", "0.2 0.2 0.5")
    + LINK.format("upper", "0.5 0 0", "1 0.1 0.1")
    + LINK.format("fore", "0.5 0 0", "1 0.1 0.1")
    + '<link name="tool"/>'
    '<joint name="pan" type="revolute"><parent link="base"/><child link="upper"/>'
    '<origin xyz="0 0 0.5"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="90" velocity="2"/></joint>'
    '<joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/>'
    '<origin xyz="1 0 0"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="90" velocity="2"/></joint>'
    '<joint name="mount" type="fixed"><parent link="fore"/><child link="tool"/><origin xyz="1 0 0"/></joint>'
    "</robot>"
)
JOINTS = ("pan", "elbow")


@pytest.fixture
def arm():
    with gazelle.Simulation(World("lab"), nworld=2) as simulation:
        robot = simulation.spawn(load_model_string(ARM, name="arm.urdf"), name="arm")
        robot.controllers.load(
            "arm", {"type": "position_controllers/JointTrajectoryController", "joints": [*JOINTS]}
        )
        robot.controllers.start("arm")
        yield robot


def planar(pan, elbow):
    """Return the place of the tool [m]."""
    return np.cos(pan) + np.cos(pan + elbow), np.sin(pan) + np.sin(pan + elbow), 0.5


def motion_layer(view):
    return view._optional["Motions"]


def pictured(view):
    view._picture()
    return next(iter(motion_layer(view)._ghosts.values()), None)


@pytest.mark.long
def test_a_plan_of_a_group_is_shown_until_it_is_made(arm):
    with LiveView(arm.simulation) as view:
        assert pictured(view) is None
        group = Group(arm, "arm", world=1, tip="tool")
        plan = group.plan({"pan": 1.0, "elbow": -0.8})
        pictured(view)
        ghost = pictured(view)
        assert set(ghost.links) == {"upper", "fore"}
        assert ghost.line[0] == pytest.approx(planar(0.0, 0.0), abs=1e-9)
        assert ghost.line[-1] == pytest.approx(planar(1.0, -0.8), abs=1e-9)
        base = arm.links["base"].placement(np.array([1])).position[0]
        assert ghost._frame.position == pytest.approx(base + view._context.spots[1], abs=1e-6)
        assert ghost._frame.visible
        assert plan.run()
        ghost = pictured(view)
        pictured(view)
        until(lambda: pictured(view).made)
        assert not ghost._frame.visible or ghost.made


def test_any_planner_may_tell_of_a_motion(arm):
    motion = JointMotion(("elbow",), np.array([0.0, 2.0]), np.array([[0.0], [1.0]]), {"pan": 0.5})
    with LiveView(arm.simulation) as view:
        planned = arm.simulation.events.planned
        planned.emit(arm, 0, motion)
        ghost = pictured(view)
        assert ghost.motion is motion
        assert ghost.links == ("fore",)
        assert ghost.line[-1] == pytest.approx(planar(0.5, 1.0), abs=1e-9)
        other = JointMotion(("pan",), np.array([0.0]), np.array([[0.3]]), {})
        planned.emit(arm, 0, other)
        assert pictured(view).motion is other
        motion_layer(view).shown = False
        assert pictured(view) is None
        motion_layer(view).shown = True
        assert pictured(view).motion is other
        arm.simulation.delete("arm")
        assert pictured(view) is None
        assert motion_layer(view)._motions == {}


def test_a_motion_that_cannot_be_shown_is_said_and_forgotten(arm, monkeypatch):
    with LiveView(arm.simulation) as view:
        said = []
        monkeypatch.setattr(type(view._context), "notify", lambda _, *words: said.append(words))
        motion = JointMotion(("tail",), np.array([0.0]), np.array([[0.3]]), {})
        arm.simulation.events.planned.emit(arm, 0, motion)
        assert pictured(view) is None
        view._picture()
        assert [title for title, _ in said] == ["A motion cannot be shown"]


def test_nobody_is_told_after_the_view_is_closed(arm):
    with LiveView(arm.simulation):
        pass
    assert arm.simulation.events.planned._listeners == []


def violet(shown):
    """Return how many pixels have the colour of ghost or path, and the middle of their columns."""
    red, green, blue = (shown[..., k] for k in range(3))
    found = (blue > green + 10) & (red > green + 5)
    return int(found.sum()), float(np.nonzero(found)[1].mean()) if found.any() else 0.0


@pytest.mark.slow
def test_a_browser_sees_the_ghost_move_and_go(arm):
    simulation = arm.simulation
    motion = JointMotion(JOINTS, np.array([0.0, 3.0]), np.array([[-1.2, 0.0], [1.2, 0.0]]), {})
    with LiveView(simulation, worlds=1) as view, opened(view.url) as page:
        until(lambda: pixels(page).max() > 0)
        assert violet(pixels(page))[0] < 50
        simulation.events.planned.emit(arm, 0, motion)
        places = []

        def moves():
            count, column = violet(pixels(page))
            if count > 300:
                places.append(column)
            return len(places) > 1 and max(places) - min(places) > 20

        until(moves)
        arm.set_configuration(JOINTS, (1.2, 0.0))
        until(lambda: violet(pixels(page))[0] < 50)
