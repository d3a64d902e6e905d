"""The nodelet ``kobuki_random_walker``: straight on, and a random turn at each obstacle (http://wiki.ros.org/kobuki_random_walker)."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass

from gazelle_ros.base.parameter_values import positive
from gazelle_ros.builtin.kobuki.controller import KobukiController
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.speeds import Speeds, twist_of
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import geometry_msgs, kobuki_msgs
from gazelle_ros.node import Node

_LED = kobuki_msgs.msg.Led


@dataclass(frozen=True, slots=True)
class RandomWalkerSettings:
    """Parameters of ``kobuki_random_walker``.

    Attributes:
        update_rate: Of the commands [Hz].
        linear_velocity: On a straight line [m/s].
        angular_velocity: In a turn [rad/s].
    """

    update_rate: float = 10.0
    linear_velocity: float = 0.5
    angular_velocity: float = 0.1


@dataclass(frozen=True, slots=True)
class RandomTurn:
    """A turn on the spot.

    Attributes:
        speed: About z [rad/s].
        end: Time of its end [ns].
    """

    speed: float
    end: int


class RandomWalker(KobukiController):
    """Commands on ``~commands/velocity``: straight on, with a random turn after a bump or cliff.

    A turn is by up to half a revolution to either side. The robot stands while a wheel has dropped.
    ``~commands/led1`` shows bumps, ``~commands/led2`` cliffs, and both of them dropped wheels.

    Args:
        node: On the graph.
        chance: Source of the turns.

    Raises:
        Error: A parameter is of another kind, or a rate or angular velocity not above zero.
    """

    def __init__(self, node: Node, chance: random.Random | None = None) -> None:
        self.settings = settings_of(node, RandomWalkerSettings)
        for name in ("update_rate", "angular_velocity"):
            positive(name, getattr(self.settings, name))
        self._chance = chance or random.Random()  # noqa: S311  # no secret
        self._turn: RandomTurn | None = None
        self._obstructed = False
        self._output = node.advertise("~commands/velocity", geometry_msgs.msg.Twist, queue_size=10)
        self._leds = [
            node.advertise(f"~commands/led{number}", _LED, queue_size=10) for number in (1, 2)
        ]
        super().__init__(node, self.settings.update_rate)

    def take(self, sensors: set[int], sensor: int, *, active: bool) -> None:
        """Handle an event; bumpers count while the controller is enabled."""
        if self.enabled or sensors is not self.bumpers:
            super().take(sensors, sensor, active=active)

    def on_event(self, sensors: set[int], before: frozenset[int], *, active: bool) -> None:
        """Show an event on the LEDs, and turn at the next step if it is an obstacle."""
        del active
        if sensors is not self.wheels and sensors > before:
            self._obstructed = True
        if bool(sensors) == bool(before):
            return
        colour = _LED.RED if sensors is self.wheels else _LED.ORANGE
        leds = self._leds
        if sensors is not self.wheels:
            leds = leds[:1] if sensors is self.bumpers else leds[1:]
        for each in leds:
            each.publish(_LED(value=colour if sensors else _LED.BLACK))

    def work(self) -> None:
        """Publish a command; there is none in the step that ends a turn."""
        found = self._command()
        if found is not None:
            self._output.publish(twist_of(found))

    def _command(self) -> Speeds | None:
        if self.wheels:
            return (0.0, 0.0)
        now = self.node.clock.now()
        if self._obstructed:
            self._obstructed = False
            self._turn = self._random_turn(now)
        if self._turn is None:
            return (self.settings.linear_velocity, 0.0)
        if now < self._turn.end:
            return (0.0, self._turn.speed)
        self._turn = None
        return None

    def _random_turn(self, now: int) -> RandomTurn:
        speed = self.settings.angular_velocity
        seconds = self._chance.random() * math.pi / speed
        return RandomTurn(self._chance.choice((speed, -speed)), now + round(seconds * SECOND))
