"""Everything public that a simulation offers, found by looking at it."""

from __future__ import annotations

import inspect
from contextlib import nullcontext
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from gazelle.engines import CHANGES
from gazelle.sensors import View, look_at
from gazelle.simulation import (
    Input,
    JointHandle,
    LinkHandle,
    Output,
    PhysicsProperties,
    Robot,
    SensorUnit,
    Service,
    Simulation,
    Tuning,
    TwistInput,
    WorldParameters,
)
from gazelle.simulation.parameters import InitialPoses, Parameter, SensorNoise
from gazelle.stage import StageFleet

# What is no reading: it changes something, or the thing's owner calls it.
CHANGING = {
    Simulation: {
        *("attach", "close", "delete", "detach", "load_plugin", "pause", "record", "reset"),
        *("restore", "run", "set_light", "spawn", "step", "subscribe", "unpause"),
    },
    PhysicsProperties: {"set", "use"},
    WorldParameters: {"randomize", "reseed", "restore", "scale_mass"},
    Parameter: {"set"},
    SensorNoise: set(),
    InitialPoses: {"apply", "forget", "restore"},
    # A robot gets a manager of controllers, or a pilot, when it is asked for it.
    Robot: {
        *(
            "add_manager",
            "back_to",
            "bind",
            "controllers",
            "mark",
            "navigation",
            "set_configuration",
        ),
        *("set_pose", "set_twist"),
    },
    LinkHandle: {
        *("apply_wrench", "approach", "clear_wrenches", "set_pose", "set_properties", "set_twist"),
    },
    JointHandle: {
        *("add_motor", "apply_effort", "clear_efforts", "drive", "set_position"),
        *("set_properties", "set_velocity"),
    },
    SensorUnit: {
        *("join", "leave", "reseed", "reset", "restore", "limit_rate", "subscribe", "system"),
        "update",
    },
    TwistInput: {"bind", "clear", "keep_in", "store_in", "send"},
    Input: {"bind", "clear", "send"},
    Output: {"bind", "forget", "publish", "publish_computed", "subscribe"},
    Service: {"bind", "call"},
    Tuning: {"bind", "send"},
}

# Readings that a handle refuses, whoever asks.
REFUSED = {(JointHandle, "effort")}

KINDS = tuple(CHANGING)


@dataclass(frozen=True)
class Reading:
    """A property or method of a handle, and how it is called; with a lock held, if it needs one."""

    path: str
    handle: object
    name: str
    arguments: tuple = ()
    lock: object = field(default_factory=nullcontext)

    def __call__(self):
        with self.lock:
            value = getattr(self.handle, self.name)
            return value(*self.arguments) if callable(value) else value


def kind_of(handle):
    return next(kind for kind in KINDS if isinstance(handle, kind))


def handles(sim):
    """Yield all handles of a simulation, by path."""
    yield "sim", sim
    yield "sim.physics", sim.physics
    yield "sim.parameters", sim.parameters
    for name, each in vars(sim.parameters).items():
        if not name.startswith("_"):
            yield f"sim.parameters.{name}", each
    yield from ports("sim.ports", sim.ports)
    for robot in sim.robots.values():
        yield robot.name, robot
        for table in ("links", "joints", "sensors"):
            for name, each in getattr(robot, table).items():
                yield f"{robot.name}.{table}[{name}]", each
        yield from ports(robot.name, robot)


def ports(path, owner):
    for table in ("inputs", "outputs", "services", "settings", "tunings"):
        for name, each in getattr(owner, table).items():
            if isinstance(each, KINDS):
                yield f"{path}.{table}[{name}]", each


class Everything:
    """All that can be read of a simulation."""

    def __init__(self, sim):
        self.sim = sim

    @cached_property
    def readings(self):
        found = [each for path, handle in handles(self.sim) for each in self._of(path, handle)]
        return found + list(self._of_engine())

    def _of(self, path, handle):
        kind = kind_of(handle)
        for name in sorted(n for n in dir(kind) if not n.startswith("_")):
            if name in CHANGING[kind] or (kind, name) in REFUSED:
                continue
            member = inspect.getattr_static(kind, name)
            if not callable(member) and not isinstance(member, property):
                continue
            for arguments in self._arguments(kind, name, member):
                yield Reading(f"{path}.{name}", handle, name, arguments)
        if hasattr(kind, "__getitem__"):
            for key in self._keys(handle):
                yield Reading(f"{path}[{key}]", handle, "__getitem__", (key,))

    def _arguments(self, kind, name, member):
        """Return ways to call a member; a method that needs arguments must be known here."""
        known = {
            (Simulation, "render"): [(View(look_at((2.0, 2.0, 2.0), (0.0, 0.0, 0.0)), 4, 4),)],
            (Simulation, "extension"): [(StageFleet,)],
            (WorldParameters, "stream"): [("test",)],
            (Robot, "frame"): [(self.link,)],
            (Robot, "joint_description"): [(self.joint,)],
            (Robot, "wrench"): [(self.joint,)],
        }
        if kind is SensorUnit and name == "reading":
            return []  # takes what ``latest`` gives, which is read
        if (kind, name) in known:
            return known[kind, name]
        if isinstance(member, property):
            return [()]
        needed = [
            p
            for p in list(inspect.signature(member).parameters.values())[1:]
            if p.default is p.empty and p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)
        ]
        assert not needed, f"say in {__name__} how to call {kind.__name__}.{name}"
        return [()]

    @property
    def robot(self):
        return next(r for r in self.sim.robots.values() if r.joints)

    @property
    def link(self):
        return next(iter(self.robot.links))

    @property
    def joint(self):
        return next(iter(self.robot.joints))

    def _keys(self, handle):
        if isinstance(handle, InitialPoses):
            return [self.robot.name]
        if isinstance(handle, SensorNoise):
            return [u.name for u in self.robot.sensors.values() if hasattr(u.model, "noise")]
        kind = handle._kind.partition("_")[0]
        link = self.robot.links[self.link]
        wheel = self.robot.joints[self.joint]
        collision = f"{link.name}::{link.description.collisions[0].name}"
        return {"link": [link.name], "joint": [wheel.name], "collision": [collision]}.get(kind, [])

    def _of_engine(self):
        engine, lock = self.sim.engine, self.sim.lock
        for name in ("peek", "snapshot", "history", "world"):
            assert name not in CHANGES
            yield Reading(f"sim.engine.{name}", engine, name, lock=lock)
        link, joint = self.robot.links[self.link].name, self.robot.joints[self.joint].name
        for table, key, names in (
            ("links", link, ("placement", "motion", "acceleration")),
            ("joints", joint, ("position", "velocity", "wrench")),
            ("models", self.robot.name, ("placement",)),
        ):
            with lock:
                rows = getattr(engine, table)
                row = rows[key]
            yield Reading(f"sim.engine.{table}.names", rows, "names", lock=lock)
            for name in names:
                yield Reading(f"sim.engine.{table}[...].{name}", row, name, (), lock)


def arrays_in(value, depth=4):
    """Yield all arrays in a value."""
    if isinstance(value, np.ndarray):
        yield value
    elif depth and isinstance(value, dict):
        for each in value.values():
            yield from arrays_in(each, depth - 1)
    elif depth and isinstance(value, list | tuple):
        for each in value:
            yield from arrays_in(each, depth - 1)
    elif depth and hasattr(type(value), "__dataclass_fields__"):
        for name in type(value).__dataclass_fields__:
            yield from arrays_in(getattr(value, name, None), depth - 1)
