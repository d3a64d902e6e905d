"""Bullet behind the few calls of ``gazelle.engines.Engine`` that the ten scenes need.

Made from the description alone: it shares no line with the engine that it is the second
opinion on. Bullet's own terms are chosen so that the two mean the same:

* Bullet multiplies the friction of two surfaces, Gazelle takes the smaller. ``_frictions``
  finds factors whose products are the smaller ones, or refuses.
* Bullet damps all motion by 4 % a second and brakes all joints by a motor: both are switched off.
* Contacts and constraints correct a fifth of their error a step, as ODE's do by default, and
  the solver iterates four times as often as by default.
"""

from __future__ import annotations

import contextlib
import ctypes
import math
import os
import sys
import tempfile
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
from second_engine.bullet_urdf import WORLD, Tree, UntranslatableError, trees_of

from gazelle.description import Joint, Link, Model, Pose, World
from gazelle.engines.motion import Motion, Placement
from gazelle.engines.table import Table

_ITERATIONS = 200
_ERP = 0.2
_STRONG = 1e9
# Distance of the second point that keeps a hinge's axis in line [m].
_ARM = 0.1


class Bullet:
    """One world in Bullet; arrays have a leading axis of one, as those of ``Engine``."""

    def __init__(self, world: World) -> None:
        with _silence():
            import pybullet
            from pybullet_utils.bullet_client import BulletClient

            self._b = BulletClient(pybullet.DIRECT)
        self._models = {model.name: model for model in world.models}
        self._bodies: dict[str, tuple[int, int]] = {}
        self._shifts: dict[str, Pose] = {}
        self._joints: dict[str, tuple[int, int]] = {}
        self._motors: dict[str, tuple[float, float]] = {}
        self._efforts: dict[str, float] = {}
        self._b.setGravity(*world.gravity)
        self._b.setTimeStep(world.profile.max_step_size)
        self._b.setPhysicsEngineParameter(
            numSolverIterations=_ITERATIONS,
            solverResidualThreshold=1e-12,
            erp=_ERP,
            contactERP=_ERP,
            deterministicOverlappingPairs=1,
        )
        for model in world.models:
            self._add(model)
        self._settle(world)

    @property
    def links(self) -> Table[Any, Any]:
        """Links, as engines have them."""
        return _rows(self, "link", ("placement", "motion"))

    @property
    def joints(self) -> Table[Any, Any]:
        """Joints, as engines have them."""
        names = ("position", "set_position", "set_effort", "set_motor_velocity")
        return _rows(self, "joint", names)

    @property
    def models(self) -> Table[Any, Any]:
        """Models, as engines have them."""
        return _rows(self, "model", ("set_motion",))

    # -- making ------------------------------------------------------------------------

    def _add(self, model: Model) -> None:
        trees, closing = trees_of(model)
        for tree in trees:
            self._load(model, tree)
        for joint in closing:
            self._close_loop(model, joint)
        for joint in model.joints:
            self._add_mimic(model, joint)

    def _load(self, model: Model, tree: Tree) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "tree.urdf"
            path.write_text(tree.text)
            flags = self._b.URDF_USE_INERTIA_FROM_FILE | self._b.URDF_USE_IMPLICIT_CYLINDER
            with _silence():
                body = self._b.loadURDF(str(path), useFixedBase=tree.fixed, flags=flags)
        self._bodies[tree.root if tree.root != WORLD else f"{model.name}::{WORLD}"] = (body, -1)
        for index in range(self._b.getNumJoints(body)):
            name = self._b.getJointInfo(body, index)[12].decode()
            self._bodies[name] = (body, index)
            joint = tree.joints[name]
            if joint.type != "fixed":
                self._joints[f"{model.name}::{joint.name}"] = (body, index)
        self._shifts |= tree.shifts
        self._place_root(body, tree.pose)
        for name in tree.links:
            joint = tree.joints[name]
            if joint.type != "fixed":
                friction = joint.axes[0].friction if joint.axes else 0.0
                self._motor(f"{model.name}::{joint.name}", 0.0, friction)

    def _place_root(self, body: int, pose: Pose) -> None:
        """Place the root: Bullet places a body by its centre of mass."""
        placed = pose * self._inertial_frame(body, -1)
        self._b.resetBasePositionAndOrientation(body, placed.position, placed.quaternion)

    def _inertial_frame(self, body: int, index: int) -> Pose:
        info = self._b.getDynamicsInfo(body, index)
        return Pose.from_quaternion(info[3], info[4])

    def _close_loop(self, model: Model, joint: Joint) -> None:
        """Hold two points on the axis of a hinge together."""
        if joint.type not in {"revolute", "continuous"} or joint.parent == WORLD:
            raise UntranslatableError(f"no {joint.type} joint that closes a loop")
        links = {link.name: link for link in model.links}
        names = [f"{model.name}::{each}" for each in (joint.parent, joint.child)]
        for along in (0.0, _ARM):
            point = joint.pose.apply(tuple(along * a for a in joint.axes[0].xyz))
            seen = links[joint.parent].pose.inverse() * links[joint.child].pose
            ends = [
                self._from_centre(name, at)
                for name, at in zip(names, (seen.apply(point), point), strict=True)
            ]
            (b1, l1), (b2, l2) = (self._bodies[name] for name in names)
            point2point = self._b.JOINT_POINT2POINT
            held = self._b.createConstraint(b1, l1, b2, l2, point2point, (0, 0, 0), *ends)
            self._b.changeConstraint(held, maxForce=_STRONG)

    def _from_centre(self, name: str, point: Any) -> Any:
        """Return a point of a link's frame in its inertial frame, as Bullet needs it."""
        frame = self._shifts[name] * self._inertial_frame(*self._bodies[name])
        return frame.inverse().apply(point)

    def _add_mimic(self, model: Model, joint: Joint) -> None:
        mimic = joint.axes[0].mimic if joint.axes else None
        if mimic is None:
            return
        if mimic.offset or mimic.reference:
            raise UntranslatableError(f"mimic '{joint.name}' has an offset")
        follower = self._joints[f"{model.name}::{joint.name}"]
        leader = self._joints[f"{model.name}::{mimic.joint}"]
        gear = self._b.createConstraint(
            *follower, *leader, self._b.JOINT_GEAR, (0, 0, 0), (0, 0, 0), (0, 0, 0)
        )
        # Bullet's law: the first one's speed + ratio * the second one's = 0.
        self._b.changeConstraint(gear, gearRatio=-mimic.multiplier, maxForce=_STRONG, erp=_ERP)

    def _settle(self, world: World) -> None:
        """Set the friction of all bodies, and no other resistance."""
        factors = _frictions(world)
        for name, (body, index) in self._bodies.items():
            if index < 0:
                free = {"linearDamping": 0.0, "angularDamping": 0.0, "maxJointVelocity": 1e6}
                self._b.changeDynamics(body, index, **free)
            # In a call of its own: with those above, Bullet would give it to the base.
            friction = factors.get(name, 0.0)
            self._b.changeDynamics(body, index, lateralFriction=friction, restitution=0.0)

    # -- moving ------------------------------------------------------------------------

    def step(self, count: int = 1) -> None:
        for _ in range(count):
            for name, effort in self._efforts.items():
                body, index = self._joints[name]
                control = self._b.TORQUE_CONTROL
                self._b.setJointMotorControl2(body, index, control, force=effort)
            self._b.stepSimulation()

    def _joint_set_position(self, joint: str, position: float) -> None:
        self._b.resetJointState(*self._joints[joint], float(position), 0.0)

    def _joint_set_effort(self, joint: str, effort: float) -> None:
        self._efforts[joint] = effort

    def add_motor(self, joint: str, max_effort: float) -> None:
        self._motors[joint] = (0.0, max_effort)

    def _joint_set_motor_velocity(self, joint: str, velocity: float) -> None:
        self._motor(joint, velocity, self._motors[joint][1])

    def _motor(self, joint: str, velocity: float, effort: float) -> None:
        control = self._b.VELOCITY_CONTROL
        body, index = self._joints[joint]
        self._b.setJointMotorControl2(body, index, control, targetVelocity=velocity, force=effort)

    def _model_set_motion(self, model: str, linear: Any, angular: Any) -> None:
        links = self._models[model].links
        if len(links) != 1:
            raise UntranslatableError("only a model of one link can be given a motion")
        name = f"{model}::{links[0].name}"
        body, _ = self._bodies[name]
        centre, _ = self._b.getBasePositionAndOrientation(body)
        arm = np.subtract(centre, self._link_placement(name).position[0])
        self._b.resetBaseVelocity(body, list(linear + np.cross(angular, arm)), list(angular))

    # -- looking -----------------------------------------------------------------------

    def _link_placement(self, link: str) -> Placement:
        body, index = self._bodies[link]
        if index >= 0:
            state = self._b.getLinkState(body, index, computeForwardKinematics=1)
            frame = Pose.from_quaternion(state[4], state[5])
        else:
            centre = Pose.from_quaternion(*self._b.getBasePositionAndOrientation(body))
            frame = centre * self._inertial_frame(body, index).inverse()
        pose = frame * self._shifts[link].inverse()
        return Placement(np.array([pose.position]), np.array([pose.quaternion]))

    def _link_motion(self, link: str) -> Motion:
        """Return the motion of a model of one link."""
        body, index = self._bodies[link]
        if index >= 0:
            raise UntranslatableError("only the motion of roots is read")
        linear, angular = self._b.getBaseVelocity(body)
        centre, _ = self._b.getBasePositionAndOrientation(body)
        arm = np.subtract(self._link_placement(link).position[0], centre)
        return Motion(np.array([linear + np.cross(angular, arm)]), np.array([angular]))

    def _joint_position(self, joint: str) -> np.ndarray:
        return np.array([[self._b.getJointState(*self._joints[joint])[0]]])

    def close(self) -> None:
        self._b.disconnect()


def _rows(engine: Bullet, kind: str, names: Sequence[str]) -> Table[Any, Any]:
    """Return rows whose methods are those of the engine for one name."""

    def row(key: str) -> Any:
        return SimpleNamespace(
            **{name: partial(getattr(engine, f"_{kind}_{name}"), key) for name in names}
        )

    return Table(lambda: (), row, row)


@contextlib.contextmanager
def _silence() -> Iterator[None]:
    """Silence Bullet, which writes to the process's own standard output, past Python's."""
    sys.stdout.flush()
    kept = os.dup(1)
    with Path(os.devnull).open("w") as nowhere:
        os.dup2(nowhere.fileno(), 1)
    try:
        yield
    finally:
        ctypes.CDLL(None).fflush(None)  # what C has buffered must not come out later
        os.dup2(kept, 1)
        os.close(kept)


def _frictions(world: World) -> dict[str, float]:
    """Return a factor for each link, so that products are the smaller of two frictions.

    A link has one coefficient in Bullet: the smallest of its collisions'.
    """
    moving = {n: mu for model in world.models if not model.static for n, mu in _each(model)}
    resting = {n: mu for model in world.models if model.static for n, mu in _each(model)}
    if len({*moving.values(), *resting.values()}) <= 1:
        return {name: math.sqrt(mu) for name, mu in (moving | resting).items()}
    alone = sum(not model.static for model in world.models) <= 1
    if not alone or max(moving.values()) > min(resting.values()):
        raise UntranslatableError("no factors of friction multiply to the smaller coefficients")
    return moving | dict.fromkeys(resting, 1.0)


def _each(model: Model) -> list[tuple[str, float]]:
    return [
        (f"{model.name}::{link.name}", _smallest(link)) for link in model.links if link.collisions
    ]


def _smallest(link: Link) -> float:
    return min(each.surface.friction.mu for each in link.collisions)
