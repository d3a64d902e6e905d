"""Base of controllers: control laws between joint states and joint commands.

A controller of one's own is a subclass, found by its type (see ``registry``)::

    class Spring(Controller):
        interfaces = (EFFORT,)

        def init(self, parameters: ControllerParameters) -> None:
            self._joint = self.claim(EFFORT, parameters.names("joint"))
            self._stiffness = parameters.number("stiffness", 10.0)

        def update(self, time: float, period: float) -> None:
            self._joint.set_command(-self._stiffness * self._joint.position)

**How a bridge binds one.** After ``ControllerManager.load`` a controller's ports are in five tables,
by a name that does not change: ``inputs`` (``CommandPort``: subscribe, hand each message's value to
``send``), ``outputs`` (``StatePort``: listen with ``subscribe`` while the topic has subscribers),
``actions`` (``ActionPort``: give each goal to ``send`` and keep the ``Goal`` it returns; its states are
actionlib's; ``Goal.subscribe`` reports changes and feedback, ``Goal.cancel`` takes a cancel request),
``queries`` (``QueryPort``: a service, ``call``; a ``ControlError`` is its failure) and ``tunings``
(``TuningPort``: a dynamic_reconfigure server). A port's ``topic`` is relative to the manager's
namespace (``arm_controller/command``), or begins with a slash. Its ``kind`` is the class of the values:
see ``values`` and ``measurements``, which say which message they stand for. All ports may be used from
any thread. Values that are published hold all worlds; a bridge shows its own. What is sent holds in the
``worlds`` that are given. ``ControllerManager.watch`` reports controllers that are loaded and unloaded.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.control.control_law import ControlLaw
from gazelle.control.goals import ActionPort
from gazelle.control.interfaces import JointHandles
from gazelle.control.parameters import ControllerParameters
from gazelle.control.ports import (
    CommandPort,
    QueryPort,
    Serializer,
    StatePort,
    TunableValue,
    TuningPort,
    rows_of,
)
from gazelle.errors import ControlError, did_you_mean

if TYPE_CHECKING:
    from gazelle.control.hardware import RobotHardware
    from gazelle.description import Joint, Model

T = TypeVar("T")
Q = TypeVar("Q")
R = TypeVar("R")


@dataclass(frozen=True, slots=True)
class ControllerSetup:
    """Environment that a controller is created with.

    Attributes:
        name: Its name.
        type: Such as ``effort_controllers/JointPositionController``.
        hardware: Of its robot.
        model: The robot as its URDF describes it; None if unknown.
        call: Does work between two updates.
        sync: Called before the time is looked at, as native code may update the controller.
    """

    name: str
    type: str
    hardware: RobotHardware
    model: Model | None
    call: Serializer
    sync: Callable[[], None]


class Controller:
    """Base class of all controllers. One object controls in all worlds: arrays have them first.

    Args:
        setup: Given by the manager.

    Attributes:
        interfaces: Interfaces of the robot that it cannot do without; set it in the class.
        name: Its name.
        type: Such as ``effort_controllers/JointPositionController``.
        nworld: Number of worlds.
        running: Whether it is updated, kept by the manager.
        claimed: Resources that it has for itself, by interface.
        inputs: Commands that it takes.
        outputs: Published outputs.
        actions: Goals that it takes.
        queries: Questions that it answers.
        tunings: Parameters that can be changed at run time.
    """

    interfaces: ClassVar[tuple[str, ...]] = ()

    def __init__(self, setup: ControllerSetup) -> None:
        self.name, self.type = setup.name, setup.type
        self.hardware, self.nworld = setup.hardware, setup.hardware.nworld
        self._now_ns = 0
        self._sync = setup.sync
        self.running = False
        self.claimed: dict[str, tuple[str, ...]] = {}
        self.inputs: dict[str, CommandPort[Any]] = {}
        self.outputs: dict[str, StatePort[Any]] = {}
        self.actions: dict[str, ActionPort[Any]] = {}
        self.queries: dict[str, QueryPort[Any, Any]] = {}
        self.tunings: dict[str, TuningPort] = {}
        self._setup = setup

    @property
    def now_ns(self) -> int:
        """Time of the last update [ns], kept by the manager."""
        self._sync()
        return self._now_ns

    @now_ns.setter
    def now_ns(self, time: int) -> None:
        self._now_ns = time

    # -- to be overridden --------------------------------------------------------------

    def init(self, parameters: ControllerParameters) -> None:
        """Read the parameters, claim joints, open ports.

        Raises:
            ControlError: It is invalid; nothing of it stays then.
        """

    def starting(self, time: float) -> None:
        """Start at a time [s]: command what holds the robot."""

    def update(self, time: float, period: float) -> None:
        """Control.

        Args:
            time: Now [s].
            period: Since the last update [s].
        """

    def law(self) -> ControlLaw | None:
        """Return the native code of ``update``, for controllers of Gazelle's own; None if there is none.

        Such a controller is updated between physics steps without Python, until ``wake_ns``. A
        subclass that overrides ``update`` is updated by that again.
        """
        return None

    def wake_ns(self) -> float:
        """Return the time [ns] at which ``update`` must be called for subscribers.

        What it says holds until then, or until something comes through a port or the manager.
        """
        return math.inf

    @property
    def deferrable(self) -> bool:
        """True if ``catch_up`` may be delayed until this controller is accessed."""
        return True

    def catch_up(self, updates: int, period: float) -> None:
        """Update the state after native updates, the last one at ``now_ns``.

        Args:
            updates: Number of updates.
            period: Of the last one [s].
        """

    def stopping(self, time: float) -> None:
        """Stop at a time [s]; the last commands stay in the joints."""

    def reset(self, worlds: Worlds | None) -> None:
        """Reset the controller in these worlds, all if None, and hold the robot there.

        A controller that does not say otherwise starts again, in all worlds.
        """
        del worlds
        if self.running:
            self.starting(self.now_ns * 1e-9)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        return {}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""

    # -- for subclasses ----------------------------------------------------------------

    def claim(self, interface: str, names: Sequence[str]) -> JointHandles:
        """Return joints of the robot.

        They are claimed for this controller alone if they are to be commanded.

        Args:
            interface: Such as ``hardware_interface/EffortJointInterface``.
            names: Of the joints.

        Raises:
            ControlError: The robot has no such interface, or no such joint in it.
        """
        return cast("JointHandles", self.resources(interface, names))

    def resources(self, interface: str, names: Sequence[str]) -> Any:
        """Return the resources of an interface of any kind: what its ``handles`` returns."""
        found = self.hardware.interface(interface)
        handles = found.handles(names)
        if found.claims:
            known = self.claimed.get(found.name, ())
            self.claimed[found.name] = tuple(sorted({*known, *names}))
        return handles

    def description_of(self, joint: str) -> Joint:
        """Return the joint's description in the robot's URDF.

        Raises:
            ControlError: There is no URDF, or no such joint in it.
        """
        if self._setup.model is None:
            raise ControlError(
                f"controller '{self.name}' needs the robot's URDF, which is not available",
                hint="set the parameter robot_description",
            )
        known = {j.name: j for placed in self._setup.model.walk() for j in placed.model.joints}
        if joint not in known:
            raise ControlError(
                f"could not find joint '{joint}' in the URDF, for controller '{self.name}'",
                hint=did_you_mean(joint, known),
            )
        return known[joint]

    @property
    def model(self) -> Model | None:
        """The robot as its URDF describes it; None if unknown."""
        return self._setup.model

    def topic(self, name: str) -> str:
        """Return a name in this controller's namespace."""
        return f"{self.name}/{name}"

    def rows(self, worlds: Worlds | None) -> Worlds:
        """Return indices of worlds, shape (n,).

        Raises:
            ControlError: There is no such world.
        """
        return rows_of(worlds, self.nworld)

    def add_input(
        self, name: str, kind: type[T], receive: Callable[[T, Worlds | None], None]
    ) -> CommandPort[T]:
        """Add an input for commands in this controller's namespace."""
        port = CommandPort(self.topic(name), kind, receive, self._setup.call)
        self.inputs[name] = port
        return port

    def add_output(
        self,
        name: str,
        kind: type[T],
        produce: Callable[[], T],
        *,
        topic: str | None = None,
        queue_size: int = 1,
    ) -> StatePort[T]:
        """Publish values; ``topic`` is where, if not in this controller's namespace."""
        where = self.topic(name) if topic is None else topic
        port = StatePort(where, kind, produce, self._setup.call, queue_size=queue_size)
        self.outputs[name] = port
        return port

    def add_query(
        self, name: str, request: type[Q], response: type[R], answer: Callable[[Q], R]
    ) -> QueryPort[Q, R]:
        """Add a query with an answer."""
        port = QueryPort(self.topic(name), request, response, answer, self._setup.call)
        self.queries[name] = port
        return port

    def add_tuning(
        self,
        name: str,
        tunables: Sequence[TunableValue],
        values: Callable[[], Mapping[str, bool | float]],
        change: Callable[[Mapping[str, Any]], None],
    ) -> TuningPort:
        """Add values that can be changed; an empty name is the controller's own namespace."""
        where = self.topic(name).rstrip("/")
        port = TuningPort(where, tunables, values, change, self._setup.call)
        self.tunings[name] = port
        return port

    def add_action(self, name: str, port: Callable[[str, Serializer], ActionPort[T]]) -> None:
        """Add an action; ``port`` makes the port for a topic."""
        self.actions[name] = port(self.topic(name), self._setup.call)


def law_of(controller: Controller) -> ControlLaw | None:
    """Return the native law of a controller; None where Python has to update it."""
    owner = next(kind for kind in type(controller).__mro__ if {"law", "update"} & set(vars(kind)))
    return controller.law() if "law" in vars(owner) else None


def state_below(
    begin: str, state: Mapping[str, NDArray[np.generic]]
) -> dict[str, NDArray[np.generic]]:
    """Return the part of a state whose names begin so, without that beginning."""
    return {k.removeprefix(begin): v for k, v in state.items() if k.startswith(begin)}
