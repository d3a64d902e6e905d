"""PID control of joint positions and velocities."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.control.commands import rows_of
from gazelle.control.control_law import ControlLaw
from gazelle.control.controller import Controller
from gazelle.control.joint_pid_law import JointPidLaw
from gazelle.control.limits import JointLimits
from gazelle.control.parameters import ControllerParameters
from gazelle.control.pid import PID_TUNABLES, Pid, PidGains, pid_changer, pid_values
from gazelle.control.ports import StatePort
from gazelle.control.values import JointControlState, JointTarget, JointTargets, PidStatus

_EVERY = 10  # updates between two messages of the state


class PidControl(Controller):
    """Common base of controllers with PID on joints: targets, gains and published state."""

    def control(
        self, names: tuple[str, ...], gains: list[tuple[str, ControllerParameters]]
    ) -> None:
        """Claim joints and read their gains.

        Args:
            names: Of the joints.
            gains: Namespace of each one's gains, and the parameters in it.
        """
        self._joints = self.claim(self.interfaces[0], names)
        self._pid = Pid([PidGains.read(part) for _, part in gains], self.nworld)
        self._targets: Floats = np.zeros((self.nworld, len(names)))
        self._error: Floats = np.zeros_like(self._targets)
        self._law = JointPidLaw(self._joints, self._pid.law, self._targets, self._error)
        self._period = 0.0
        self._updates = 0
        self._states: StatePort[JointControlState] | None = None
        self._statuses: list[StatePort[PidStatus]] = []
        for loop, (place, part) in enumerate(gains):
            self._open_gains(loop, place, published=part.flag("publish_state", default=False))

    def _open_gains(self, loop: int, place: str, *, published: bool) -> None:
        self.add_tuning(
            place, PID_TUNABLES, lambda: pid_values(self._pid, loop), pid_changer(self._pid, loop)
        )
        if published:
            port = self.add_output(f"{place}/state", PidStatus, lambda: self._status(loop))
            self._statuses.append(port)

    def open_state(self) -> None:
        """Open the state topic of a single joint."""
        self._states = self.add_output("state", JointControlState, self._state)

    def take(self, values: ArrayLike, worlds: Worlds | None) -> None:
        """Set targets from the next update on."""
        rows = self.rows(worlds)
        what = f"command of '{self.name}'"
        self._targets[rows] = rows_of(what, values, self._targets.shape[1], len(rows))

    def update(self, time: float, period: float) -> None:  # noqa: ARG002  the clock is exact
        """Compute and apply efforts towards the targets."""
        self._period = period
        self._law.act(self.now_ns, period)
        for port in self._statuses:
            port.publish()
        if self._states is not None and self._updates % _EVERY == 0:
            self._states.publish()
        self._updates += 1

    def law(self) -> ControlLaw:
        """Return the law applied to the joints."""
        return self._law

    def wake_ns(self) -> float:
        """Return 0 while there are subscribers: update always."""
        subscribed = any(port.has_subscribers for port in self._statuses)
        subscribed = subscribed or (self._states is not None and self._states.has_subscribers)
        return 0.0 if subscribed else math.inf

    def catch_up(self, updates: int, period: float) -> None:
        """Count."""
        self._updates, self._period = self._updates + updates, period

    def measured(self) -> tuple[Floats, Floats]:
        """Return the controlled values and their rates, shape (nworld, joints)."""
        return self._joints.position, self._joints.velocity

    def begin(self, rows: Worlds) -> None:
        """Restart the PID in some worlds."""
        self._targets[rows] = 0.0
        self._pid.reset(rows)

    def starting(self, time: float) -> None:  # noqa: ARG002  at any time
        """Hold the joints at their positions."""
        self._updates = 0
        self.begin(np.arange(self.nworld))

    def reset(self, worlds: Worlds | None) -> None:
        """Hold the joints at their reset positions."""
        self.begin(self.rows(worlds))

    def _state(self) -> JointControlState:
        value, rate = self.measured()
        gains = self._pid.gains[0]
        return JointControlState(
            self.now_ns,
            self._targets[:, 0].copy(),
            value[:, 0],
            rate[:, 0],
            self._error[:, 0].copy(),
            self._period,
            self._joints.command()[:, 0],
            gains.p,
            gains.i,
            gains.d,
            gains.i_max,
            gains.antiwindup,
        )

    def _status(self, loop: int) -> PidStatus:
        pid, gains = self._pid, self._pid.gains[loop]
        error, rate = pid.p_error[:, loop].copy(), pid.d_error[:, loop].copy()
        return PidStatus(
            self.now_ns,
            self._period,
            error,
            rate,
            error,
            pid.i_error[:, loop].copy(),
            rate,
            gains.p * error,
            pid.i_term[:, loop],
            gains.d * rate,
            gains.i_max,
            gains.i_min,
            pid.output[:, loop].copy(),
        )

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return targets and integrals."""
        kept = {f"pid/{name}": value for name, value in self._pid.state().items()}
        return {"targets": self._targets.copy(), "updates": np.array(self._updates), **kept}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._targets[:] = state["targets"]
        self._updates = int(state["updates"])
        self._pid.restore({name: state[f"pid/{name}"] for name in ("p", "i", "last")})


class PositionTargets(PidControl):
    """Positions by PID, within the limits of the URDF."""

    def limit(self, names: tuple[str, ...]) -> None:
        """Read the limits of the joints."""
        described = [self.description_of(name) for name in names]
        limits = [JointLimits.of_joint(joint) for joint in described]
        self._lower = np.array([each.lower for each in limits])
        self._upper = np.array([each.upper for each in limits])
        turning = np.array([joint.type != "prismatic" for joint in described], bool)
        self._law.hold_positions((self._lower, self._upper), turning)

    def begin(self, rows: Worlds) -> None:
        """Set targets to positions, within limits."""
        super().begin(rows)
        self._targets[rows] = np.clip(self._joints.position[rows], self._lower, self._upper)


class JointPositionController(PositionTargets):
    """One joint to a position, by efforts or by velocities."""

    def init(self, parameters: ControllerParameters) -> None:
        """Read ``joint`` and ``pid``."""
        names = (parameters.text("joint"),)
        self.control(names, [("pid", parameters.part("pid"))])
        self.limit(names)
        self.open_state()
        self.add_input("command", JointTarget, self._receive)

    def _receive(self, target: JointTarget, worlds: Worlds | None) -> None:
        self.take(target.value, worlds)


class JointGroupPositionController(PositionTargets):
    """Several joints to positions, by efforts."""

    def init(self, parameters: ControllerParameters) -> None:
        """Read ``joints`` and ``JOINT/pid``."""
        names = parameters.names("joints")
        self.control(names, [(f"{name}/pid", parameters.part(f"{name}/pid")) for name in names])
        self.limit(names)
        self.add_input("command", JointTargets, self._receive)

    def _receive(self, targets: JointTargets, worlds: Worlds | None) -> None:
        self.take(targets.values, worlds)


class JointVelocityController(PidControl):
    """One joint to a velocity, by efforts."""

    def init(self, parameters: ControllerParameters) -> None:
        """Read ``joint`` and ``pid``."""
        self.control((parameters.text("joint"),), [("pid", parameters.part("pid"))])
        self.open_state()
        self.add_input("command", JointTarget, self._receive)

    def _receive(self, target: JointTarget, worlds: Worlds | None) -> None:
        self.take(target.value, worlds)

    def measured(self) -> tuple[Floats, Floats]:
        """Return velocities; accelerations are unknown, and efforts are as in the original."""
        return self._joints.velocity, self._joints.effort
