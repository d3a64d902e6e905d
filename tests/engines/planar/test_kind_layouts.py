"""Models of kinds that lay themselves out in the plane, which entry points find."""

from dataclasses import dataclass
from importlib.metadata import EntryPoint

import numpy as np
import pytest

from gazelle.description import Link, Model, Pose, World
from gazelle.engines.planar import Body, Drive, KindLayout, PlanarEngine, PlanarPart, kind_layouts
from gazelle.errors import EngineError


@dataclass(frozen=True)
class Disc:
    """A round base, and a satellite on it."""

    kind: str
    radius: float = 0.3


def lay_out(models, *, kinematic, others):
    part = [(PlanarPart.circle(0.0, 0.0, each.content.radius),) for each in models]
    layout = KindLayout()
    for model, own in zip(models, part, strict=True):
        driven = None if model.name in kinematic else Drive("omni")
        layout.bodies.append(Body(own, (model.pose.x, model.pose.y, 0.0), 0.0, driven))
        layout.names.append(model.name)
        layout.extra_bodies.append(Body((), (float(others), 0.0, 0.0), 0.0))
    return layout


@pytest.fixture
def installed(monkeypatch):
    def install(**values):
        points = {name: EntryPoint(name, value, "g") for name, value in values.items()}
        monkeypatch.setattr(kind_layouts, "entry_points_of", lambda _: points)
        kind_layouts.find_layout.cache_clear()

    yield install
    monkeypatch.undo()
    kind_layouts.find_layout.cache_clear()


def model(name, content, **more):
    return Model(name, links=(Link("base"),), content=content, **more)


def test_a_kind_has_its_bodies_first_and_its_riders_last(installed):
    installed(disc=f"{__name__}:lay_out")
    plain = Model("plain", links=(Link("base"),))
    world = World(
        models=(plain, model("a", Disc("disc")), model("b", Disc("disc"), pose=Pose(5.0)))
    )
    engine = PlanarEngine(world)
    assert engine.bodies == {"a": 0, "b": 1, "plain": 2}
    assert engine.fleet.nbody == 5
    assert engine.fleet.pose[0, 3:, 0].tolist() == [1.0, 1.0]  # one body is between
    commands = np.zeros((1, 5, 3))
    commands[0, 0, 0] = 1.0
    engine.command(commands)
    engine.step(10)
    assert engine.fleet.pose[0, 0, 0] == pytest.approx(10 * engine.time_step)
    engine.delete("a")
    engine.delete("b")
    assert engine.bodies == {"plain": 0}
    assert engine.layout.of_kind == KindLayout(statics=engine.layout.of_kind.statics)
    engine.close()


def test_models_of_a_kind_that_nothing_lays_out_are_made_of_their_links(installed):
    installed()
    engine = PlanarEngine(World(models=(model("a", Disc("disc")),)))
    assert engine.bodies == {"a": 0}
    assert engine.layout.of_kind.bodies == []
    engine.close()


def test_two_kinds_in_one_plane_are_refused(installed):
    installed(disc=f"{__name__}:lay_out", ring=f"{__name__}:lay_out")
    engine = PlanarEngine(World(models=(model("a", Disc("disc")),)))
    with pytest.raises(EngineError, match="models of 'disc' and 'ring' files at once"):
        engine.spawn(model("b", Disc("ring")))
    assert list(engine.bodies) == ["a"]
    engine.close()


@pytest.mark.parametrize("value", ["no_such_module:X", f"{__name__}:NOTHING"])
def test_a_layout_that_cannot_be_imported_is_named(installed, value):
    installed(disc=value)
    with pytest.raises(EngineError, match=r"the layout of 'disc' models \(.*\) cannot be loaded"):
        PlanarEngine(World(models=(model("a", Disc("disc")),)))
