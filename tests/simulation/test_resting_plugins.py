"""Plugins that only publish rest without subscribers, and wake at once."""

from __future__ import annotations

import pytest

import gazelle
from gazelle import formats
from gazelle.simulation import ModelPlugin, Output, PublisherSystem, register

WORLD = """<sdf version="1.6"><world name="w"><model name="m"><static>1</static><link name="l"/>
<plugin name="teller" filename="libteller.so"/></model></world></sdf>"""
ENGINES = ("mujoco", "planar")


class Teller(ModelPlugin):
    """Publishes a number at each of its updates."""

    system = PublisherSystem
    update_rate = 0.0

    def load(self, robot, parameters):
        self.told = 0
        self._count = robot.outputs["count"] = Output("/count", int, self._tell)
        self.published = (self._count,)

    def _tell(self):
        self.told += 1
        return self.told


@pytest.fixture(params=ENGINES)
def run(request):
    def make(kind):
        register("libteller.so", kind)
        return gazelle.Simulation(formats.load_string(WORLD), engine=request.param)

    return make


def test_it_publishes_only_while_somebody_listens(run):
    with run(Teller) as sim:
        teller = sim.plugins[0].plugin
        sim.step(20)
        assert teller.told == 0
        heard = []
        end = sim.robots["m"].outputs["count"].subscribe(heard.append)
        sim.step(3)
        assert heard == [1, 2, 3]
        end()
        sim.step(3)
        assert teller.told == 3


def test_one_that_cannot_say_whether_it_is_subscribed_is_detached(run):
    class Broken(Teller):
        @property
        def published(self):
            raise RuntimeError("no idea")

        @published.setter
        def published(self, outputs):
            pass

    with run(Broken) as sim:
        with pytest.warns(gazelle.errors.PluginWarning, match="no idea"):
            sim.step()
        sim.step(2)
        assert sim.plugins[0].detached


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.filterwarnings("ignore::gazelle.errors.GazelleWarning")
def test_a_burger_without_listeners_leaves_python_nothing_to_ask(engine):
    with gazelle.Simulation("empty", engine=engine) as sim:
        robot = sim.spawn("turtlebot3_burger")
        sim.run(seconds=0.1)
        due = [each.plugin for each in sim.plugins if each.needs_system]
        assert [type(each).__name__ for each in due] == ["DiffDrive"]
        heard = []
        robot.outputs["imu"].subscribe(heard.append)
        sim.run(seconds=0.5)
        assert heard
