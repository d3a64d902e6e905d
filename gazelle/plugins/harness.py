"""A harness that holds a model up: ``libgazebo_ros_harness.so`` and ``libHarnessPlugin.so``.

The joints that the plugin names hang the model on the world; one of them is a winch, which PID
controllers pull at, and one is let go when the model is to stand by itself. Here each joint
moves a small carriage, a model of its own in the engine alone, and the model's link is held
to that; so a model can be let go in some worlds and hang in others.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.description import Inertia, Inertial, Model, Parameters
from gazelle.errors import SimulationError, did_you_mean
from gazelle.formats.reading import Reading
from gazelle.formats.resolve import Resolver
from gazelle.formats.sdf import read_sdf
from gazelle.plugins.pid import Gains, GazeboPid
from gazelle.simulation import Input, ModelPlugin, Robot, Stopwatch, absolute, namespace_of
from gazelle.simulation.values import Number
from gazelle.states import restore_all, states_of

# Mass of a carriage as a share of the model's, and its size [m]. Lighter ones hold the weight
# less stiffly, heavier ones slow the winch down.
_SHARE, _SIZE = 0.05, 0.3
# Slower than this is a winch that shall hold [m/s or rad/s], as in Gazebo.
_STILL = 1e-6


@dataclass(frozen=True, slots=True)
class _Rope:
    """One joint of a harness.

    Attributes:
        name: As the file has it.
        joint: Scoped name in the engine.
        carriage: Scoped name of the link on the joint.
        link: Attached link.
    """

    name: str
    joint: str
    carriage: str
    link: str


class Harness(ModelPlugin):
    """Hangs a model on joints to the world; a winch lifts and lowers it until it is let go.

    A reset hangs it up again, where Gazebo leaves it free.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, make the joints, hang the model up, open the topics."""
        self._robot, self._simulation = robot, robot.simulation
        self._ropes: list[_Rope] = []
        nworld = robot.simulation.nworld
        self._held = np.zeros(nworld, np.bool_)
        winch = parameters.find("winch")
        self._pids = {
            name: GazeboPid(Gains.read(None if winch is None else winch.find(name)), nworld)
            for name in ("pos_pid", "vel_pid")
        }
        try:
            self._rig(parameters, winch)
        except Exception:
            self._drop()
            raise
        self._speed, self._place = np.zeros((2, nworld))
        self._watch = Stopwatch(robot.simulation.clock)
        self._open(robot, namespace_of(robot, parameters))
        self._unsubscribe = robot.simulation.events.deleted.subscribe(self._end)

    def _rig(self, parameters: Parameters, winch: Parameters | None) -> None:
        """Make the joints, and attach the model to them."""
        for rope in _ropes(self._robot, parameters):
            self._ropes.append(rope)
        if not self._ropes:
            raise SimulationError("a <joint> is required here", source=parameters.source)
        self._winch = self._named(None if winch is None else winch.find("joint"))
        self._released = self._named(parameters.find("detach"))
        self._hang(None)

    def _named(self, tag: Parameters | None) -> _Rope:
        """Return the rope that a tag names; the first by default."""
        if tag is None or not tag.text:
            return self._ropes[0]
        for rope in self._ropes:
            if rope.name == tag.text:
                return rope
        known = [rope.name for rope in self._ropes]
        raise SimulationError(
            f"the harness has no joint '{tag.text}'",
            source=tag.source,
            hint=did_you_mean(tag.text, known),
        )

    def _open(self, robot: Robot, namespace: str) -> None:
        prefix = f"{robot.name}/harness"
        robot.inputs["harness_velocity"] = Input(
            absolute(namespace, f"{prefix}/velocity"), Number, self._wind
        )
        robot.inputs["harness_detach"] = Input(
            absolute(namespace, f"{prefix}/detach"), bool, self._let_go
        )

    def _wind(self, speed: Number, worlds: Worlds | None) -> None:
        """Set the winch's speed; at rest it holds its position."""
        if not np.isfinite(speed.value):
            raise SimulationError(f"the speed of a winch must be finite, not {speed.value}")
        rows = slice(None) if worlds is None else worlds
        self._speed[rows] = speed.value
        if abs(speed.value) <= _STILL:
            self._place[rows] = self._simulation.engine.joints[self._winch.joint].position()[
                rows, 0
            ]
            self._pids["pos_pid"].reset(worlds)

    def _let_go(self, detach: bool, worlds: Worlds | None) -> None:  # noqa: FBT001  what the topic says
        """Detach the model for good, and stop the winch."""
        if not detach:
            return
        chosen = np.zeros(len(self._held), np.bool_)
        chosen[slice(None) if worlds is None else worlds] = True
        rows = np.flatnonzero(chosen & self._held)
        if rows.size:
            engine, rope = self._simulation.engine, self._released
            engine.detach(rope.carriage, rope.link, rows)
            engine.joints[self._winch.joint].set_effort(np.zeros(1), rows)
            self._held[rows] = False

    @property
    def active(self) -> bool:
        """True if the model hangs in any world."""
        return bool(self._held.any())

    def on_update(self, time: float) -> None:  # noqa: ARG002  the clock of the simulation counts
        """Control the winch: by its speed, and at rest by its position too."""
        interval = self._watch.lap()
        engine, joint = self._simulation.engine, self._winch.joint
        holds = np.abs(self._speed) <= _STILL
        off = np.where(holds, engine.joints[joint].position()[:, 0] - self._place, 0.0)
        slip = engine.joints[joint].velocity()[:, 0] - self._speed
        pull = np.maximum(self._pids["vel_pid"].update(slip, interval), 0.0)
        pull = pull + self._pids["pos_pid"].update(off, interval)
        engine.joints[joint].set_effort(np.where(self._held, pull, 0.0)[:, None])

    def _hang(self, worlds: Worlds | None) -> None:
        for rope in self._ropes:
            self._simulation.engine.attach(rope.carriage, rope.link, worlds)
        self._held[slice(None) if worlds is None else worlds] = True

    def _end(self, gone: Robot) -> None:
        """Delete the carriages with the model."""
        if gone is self._robot:
            self._drop()
            self._unsubscribe()

    def _drop(self) -> None:
        while self._ropes:
            self._simulation.engine.delete(self._ropes.pop().carriage.partition("::")[0])

    def reset(self, worlds: Worlds | None) -> None:
        """Attach the model again, the winch at rest."""
        rows = slice(None) if worlds is None else worlds
        self._speed[rows], self._place[rows] = 0.0, 0.0
        for pid in self._pids.values():
            pid.reset(worlds)
        self._watch.restart()
        self._hang(worlds)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return its position, and the state of the winch."""
        return {
            **states_of(self._pids),
            "held": self._held.copy(),
            "speed": self._speed.copy(),
            "place": self._place.copy(),
            "time": np.array(self._watch.start_ns),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned; that it hangs is in the engine's state."""
        restore_all(self._pids, state)
        self._held[:] = state["held"]
        self._speed[:], self._place[:] = state["speed"], state["place"]
        self._watch.start_ns = int(np.asarray(state["time"]))


def _ropes(robot: Robot, parameters: Parameters) -> Iterator[_Rope]:
    """Yield the carriages of a harness's joints."""
    mass = _SHARE * sum(
        (link.description.inertial or Inertial()).mass for link in robot.links.values()
    )
    for tag in parameters.find_all("joint"):
        if tag.require("parent", str) != "world":
            raise SimulationError("a harness must be attached to the world", source=tag.source)
        link, offset = robot.frame(tag.require("child", str))
        name = tag.attributes.get("name", "")
        owner = f"{robot.name}/harness/{name}"
        model = _carriage(owner, tag, mass)
        robot.simulation.engine.spawn(replace(model, pose=link.pose * offset))
        yield _Rope(name, f"{owner}::{name}", f"{owner}::carriage", link.name)


def _carriage(owner: str, joint: Parameters, mass: float) -> Model:
    """Return a model of one link on a joint of a harness, read as SDF reads a joint."""
    ends = (Parameters("parent", "world"), Parameters("child", "carriage"))
    kept = tuple(child for child in joint.children if child.tag not in {"parent", "child"})
    link = Parameters("link", attributes={"name": "carriage"}, source=joint.source)
    content = (link, replace(joint, children=(*ends, *kept)))
    model = Parameters("model", "", {"name": owner}, content, joint.source)
    root = Parameters("sdf", "", {"version": "1.6"}, (model,), joint.source)
    (made,) = read_sdf(root, Reading(Resolver(()))).models
    moment = mass * _SIZE**2
    inertial = Inertial(mass, inertia=Inertia(moment, moment, moment))
    weightless = replace(made.links[0], inertial=inertial, gravity=False)
    return replace(made, links=(weightless,))
