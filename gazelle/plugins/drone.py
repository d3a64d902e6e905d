"""SJTU's quadrotor, of which there are many copies: what ``libplugin_drone.so`` does."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Worlds
from gazelle.description import Parameters
from gazelle.engines import Motion, Placement
from gazelle.plugins.drone_commands import DroneCommands
from gazelle.plugins.drone_law import DroneLaw, DroneMoment, DroneOrders
from gazelle.rotations import rotate
from gazelle.simulation import Input, ModelPlugin, Output, Robot, absolute, namespace_of
from gazelle.simulation.values import Trigger
from gazelle.states import restore_all, states_of


class FlightPhase(IntEnum):
    """Flight phase of a drone."""

    LANDED = 0
    TAKING_OFF = 1
    FLYING = 2
    LANDING = 3


# Share of force and torque that acts in each phase, and how long those take that end by themselves [s].
_SHARE = np.array([0.0, 1.5, 1.0, 0.8])
_TAKE_OFF_S, _LANDING_S = 0.5, 1.0
_GROUND_TRUTH_QUEUE = 1024


class Drone(ModelPlugin):
    """Flies by commands: takes off, holds a velocity or a place, lands.

    The link named ``bodyName`` is pushed; mass and inertia are taken as they are when it is loaded.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, open the ports."""
        self._simulation = simulation = robot.simulation
        engine, nworld = simulation.engine, simulation.nworld
        body = parameters.get("bodyName", next(iter(robot.links)))
        self._link, _ = robot.frame(body)
        mass = engine.parameter("link_mass", self._link.name)[:, 0].copy()
        inertia = engine.parameter("link_inertia", self._link.name)[:, :3].copy()
        self._law = DroneLaw(parameters, mass, inertia)
        self._phase = np.zeros(nworld, np.int64)
        self._since: Floats = np.zeros(nworld)
        self._places: Bools = np.zeros(nworld, np.bool_)
        self._speeds: Bools = np.zeros(nworld, np.bool_)
        self._velocity, self._position, self._acceleration = np.zeros((3, nworld, 3))
        self._open(robot, parameters)

    def _open(self, robot: Robot, parameters: Parameters) -> None:
        simulation, namespace = robot.simulation, namespace_of(robot, parameters)
        self._command = robot.inputs["cmd_vel"] = DroneCommands(
            simulation.nworld,
            absolute(namespace, "cmd_vel"),
            parameters,
            simulation.clock,
            simulation.seed,
            f"{robot.name}::drone",
        )
        for name, begun in (("takeoff", self._take_off), ("land", self._land)):
            robot.inputs[name] = Input(
                absolute(namespace, f"drone/{name}"), Trigger, begun, queue_size=1
            )
        for name, chosen in (("posctrl", self._places), ("vel_mode", self._speeds)):
            robot.inputs[name] = Input(
                absolute(namespace, f"drone/{name}"), bool, _setter(chosen), queue_size=1
            )
        self._outputs = [
            Output(
                absolute(namespace, f"drone/gt_{name}"),
                kind,
                produce,
                queue_size=_GROUND_TRUTH_QUEUE,
            )
            for name, kind, produce in (
                ("pose", Placement, self._link.placement),
                ("vel", Motion, self._seen_velocity),
                ("acc", Motion, self._seen_acceleration),
            )
        ]
        for name, output in zip(("gt_pose", "gt_vel", "gt_acc"), self._outputs, strict=True):
            robot.outputs[name] = output

    # -- commands -----------------------------------------------------------------

    def _take_off(self, _trigger: Trigger, worlds: Worlds | None) -> None:
        self._begin(FlightPhase.TAKING_OFF, (FlightPhase.LANDED,), worlds)

    def _land(self, _trigger: Trigger, worlds: Worlds | None) -> None:
        self._begin(FlightPhase.LANDING, (FlightPhase.FLYING, FlightPhase.TAKING_OFF), worlds)

    def _begin(
        self, phase: FlightPhase, after: tuple[FlightPhase, ...], worlds: Worlds | None
    ) -> None:
        """Start a phase in worlds that are in an earlier one."""
        may = np.zeros(len(self._phase), np.bool_)
        may[slice(None) if worlds is None else worlds] = True
        begins = may & np.isin(self._phase, after)
        self._phase[begins], self._since[begins] = phase, 0.0

    def fly(self, worlds: Worlds | None = None) -> None:
        """Set drones to flying, as after a take-off."""
        rows = slice(None) if worlds is None else worlds
        self._phase[rows], self._since[rows] = FlightPhase.FLYING, 0.0

    @property
    def phase(self) -> NDArray[np.int64]:
        """Flight phase of each drone, a `FlightPhase`, shape (nworld,)."""
        return self._phase

    # -- what it does ----------------------------------------------------------------------

    def on_update(self, time: float) -> None:  # noqa: ARG002  it acts at every step
        """Apply the wrench, and publish ground truth."""
        engine = self._simulation.engine
        step = engine.time_step
        self._go_on(step)
        place, motion = self._link.placement(), self._link.motion()
        self._acceleration = (motion.linear - self._velocity) / step
        now = DroneMoment(place, motion, self._acceleration, place.position - self._position, step)
        self._velocity, self._position = motion.linear.copy(), place.position.copy()
        flying = self._phase == FlightPhase.FLYING
        command = self._command
        orders = DroneOrders(command.linear, command.angular, flying, self._places, self._speeds)
        thrust, torque = self._law.wrench(now, orders, engine.parameter("gravity", ""))
        share = _SHARE[self._phase]
        force = np.zeros((len(share), 3))
        force[:, 2] = share * thrust
        turn = place.quaternion
        self._simulation.applied_wrenches.hold(
            "drone",
            self._link.name,
            rotate(turn, force),
            rotate(turn, share[:, None] * torque),
        )
        for output in self._outputs:
            output.publish()

    def _go_on(self, step: float) -> None:
        """End take-offs and landings that took their time."""
        rising = self._phase == FlightPhase.TAKING_OFF
        landing = self._phase == FlightPhase.LANDING
        self._since[:] = np.where(rising | landing, self._since + step, 0.0)
        self._phase[rising & (self._since > _TAKE_OFF_S)] = FlightPhase.FLYING
        self._phase[landing & (self._since > _LANDING_S)] = FlightPhase.LANDED

    def _seen_velocity(self) -> Motion:
        return self._turned(self._link.motion().linear)

    def _seen_acceleration(self) -> Motion:
        return self._turned(self._acceleration)

    def _turned(self, vector: Floats) -> Motion:
        """Return a vector turned by the drone's attitude; the original means the inverse."""
        return Motion(rotate(self._link.placement().quaternion, vector), np.zeros_like(vector))

    # -- forgetting and saving -----------------------------------------------------------------

    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Set the seed of the random numbers."""
        self._command.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None) -> None:
        """Reset to the ground, without commands."""
        rows = slice(None) if worlds is None else worlds
        self._phase[rows], self._since[rows] = FlightPhase.LANDED, 0.0
        self._places[rows] = self._speeds[rows] = False
        self._velocity[rows] = self._acceleration[rows] = 0.0
        self._position[rows] = 0.0
        self._law.reset(worlds)
        self._command.reset(worlds)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return phases, modes, the last step's measurements, integrals and noise."""
        return {
            **{name: array.copy() for name, array in self._arrays().items()},
            **states_of({**self._law.pids, "noise": self._command}),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        for name, array in self._arrays().items():
            array[:] = state[name]
        restore_all({**self._law.pids, "noise": self._command}, state)

    def _arrays(self) -> dict[str, NDArray[np.generic]]:
        return {
            "phase": self._phase,
            "since": self._since,
            "places": self._places,
            "speeds": self._speeds,
            "velocity": self._velocity,
            "position": self._position,
            "acceleration": self._acceleration,
        }


def _setter(chosen: Bools) -> Callable[[bool, Worlds | None], None]:
    def take(value: bool, worlds: Worlds | None) -> None:  # noqa: FBT001  a port's value
        chosen[slice(None) if worlds is None else worlds] = value

    return take
