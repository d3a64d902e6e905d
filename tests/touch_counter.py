"""Counts how often a model runs into others, from the contacts of the simulation.

A file names it as ``filename="touch_counter:TouchCounter"`` where this folder is on ``PYTHONPATH``.
"""

from gazelle.simulation import ModelPlugin, Output

RATE = 50.0
APART_S = 0.5
"""What is touched again within this time was touched all the while: contacts rattle."""

WITNESS = """<sdf version="1.6"><model name="witness"><static>1</static><link name="l"/>
<plugin name="touches" filename="touch_counter:TouchCounter"><model>{model}</model></plugin></model></sdf>"""


class Touches:
    """What of a world a model runs into.

    Args:
        simulation: That it is in.
        model: Its name.
        ground: Names of models that it may touch.
    """

    def __init__(self, simulation, model, ground=("ground_plane",)):
        self._simulation, self._model, self._ground = simulation, model, ground
        self._last = {}
        self.met = []

    @property
    def count(self):
        """How often it ran into something."""
        return len(self.met)

    def look(self):
        """Check present contacts; one that is gone for a while counts."""
        robot = self._simulation.robots[self._model]
        own = [
            f"{robot.name}::{link.name}::{collision.name}"
            for link in robot.description.links
            for collision in link.collisions
        ]
        touched = {
            other
            for other in self._simulation.engine.contacts([own]).named().others
            if other.partition("::")[0] not in (self._model, *self._ground)
        }
        now = self._simulation.time
        self.met += [each for each in touched if now - self._last.get(each, -APART_S) >= APART_S]
        self._last |= dict.fromkeys(touched, now)


class TouchCounter(ModelPlugin):
    """Tells on ``/touches`` how often the model that ``<model>`` names ran into something."""

    update_rate = RATE

    def load(self, robot, parameters):
        self._touches = Touches(robot.simulation, parameters.require("model", str))
        self._told = Output("/touches", int, lambda: self._touches.count)
        robot.outputs["touches"] = self._told

    def on_update(self, time):
        self._touches.look()
        self._told.publish()
