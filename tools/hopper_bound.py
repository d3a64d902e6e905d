"""Largest sideways lean from which HopperStayUp's leg could be brought back by any motion: an upper bound.

Hip, thigh, shank and foot lie in one plane; the base is a ball centred on the axis of haa. Joints turn by
one rate at most, so there are three ways to act on a lean out of that plane:

- the base spins against the plane, while the foot stands;
- the base, which was pitched before, spins and turns the plane about the vertical, so that the knee,
  which acts in the plane, acts sideways;
- the base spins against the plane in the air, which moves the foot, after the knee has thrown the leg up.

A leg on its foot is a pendulum: lean + rate / omega grows like exp(omega t), omega the rate at which it falls. A
lean comes back only if the integral of exp(-omega t) times what joints add to its rate is as large.

    .venv/bin/python tools/hopper_bound.py
"""

from __future__ import annotations

import sys
from dataclasses import dataclass

import numpy as np

from gazelle import assets, formats
from gazelle.array_types import Floats
from gazelle.description import Model, Sphere
from gazelle.envs.hopper.task import CONTROL_PERIOD, LOWER, START, STEP, UPPER

RATE = STEP / CONTROL_PERIOD  # of a joint [rad/s]
_GRAVITY = 9.8
_KNEES = np.linspace(LOWER[2], UPPER[2], 321)  # angles [rad]
_TURN = 1e-4  # [rad], by which effects of the knee are found


@dataclass(frozen=True)
class Leg:
    """The leg in its plane, with the shank upright: x ahead and z up, from the centre of the foot.

    Attributes:
        masses: Of base, hip, thigh and shank [kg], shape (4,).
        places: Of their centres of mass [m], shape (4, 2).
        inertias: Of each about its centre, across the plane [kg m2], shape (4,).
        foot: Radius of the foot [m].
    """

    masses: Floats
    places: Floats
    inertias: Floats
    foot: float

    @property
    def centre(self) -> Floats:
        """Centre of mass [m], shape (2,)."""
        return np.asarray(self.masses @ self.places / self.masses.sum(), np.float64)

    @property
    def height(self) -> float:
        """Of the centre of mass above the foot's, where it is right above it [m]."""
        return float(np.hypot(*self.centre))

    @property
    def own_inertia(self) -> float:
        """About the centre of mass [kg m2]."""
        away = ((self.places - self.centre) ** 2).sum(axis=1)
        return float(self.masses @ away + self.inertias.sum())

    @property
    def inertia(self) -> float:
        """About the contact with the ground [kg m2]."""
        return self.own_inertia + float(self.masses.sum()) * (self.height + self.foot) ** 2

    @property
    def omega(self) -> float:
        """Rate at which the leg falls [1/s]."""
        return float(np.sqrt(self.masses.sum() * _GRAVITY * self.height / self.inertia))


def leg(model: Model, knee: float) -> Leg:
    """Return the leg with its knee at an angle [rad]."""
    links = {link.name: link for link in model.links}
    parts = [links[name] for name in ("base_link", "haa_link", "upperleg", "lowerleg")]
    foot = next(each for each in parts[3].collisions if isinstance(each.geometry, Sphere))
    assert isinstance(foot.geometry, Sphere)
    bone = -parts[3].pose.position[2]
    thigh = np.array((np.sin(-knee), np.cos(-knee)))  # from the knee on
    knee_place = np.array((0.0, -foot.pose.position[2]))
    centres = [part.inertial.pose.position[2] for part in parts]
    places = [knee_place + (bone + up) * thigh for up in centres[:3]]
    places.append(knee_place + np.array((0.0, centres[3])))
    return Leg(
        np.array([part.inertial.mass for part in parts]),
        np.array(places),
        np.array([part.inertial.inertia.iyy for part in parts]),
        foot.geometry.radius,
    )


def knee_effect(model: Model, knee: float) -> float:
    """Return what a turn of the knee adds to the rate of the lean in the plane, as a share of its rate."""
    before, here, after = (leg(model, knee + turn) for turn in (-_TURN, 0.0, _TURN))
    speeds = (after.places - before.places) / (2.0 * _TURN)
    from_contact = here.places + np.array((0.0, here.foot))
    spin = here.masses @ (from_contact[:, 1] * speeds[:, 0] - from_contact[:, 0] * speeds[:, 1])
    # Base, hip and thigh turn from z to x as the angle falls.
    spin -= here.inertias[:3].sum()
    lean = (np.arctan2(*after.centre) - np.arctan2(*before.centre)) / (2.0 * _TURN)
    return abs(float(spin / here.inertia - lean))


def bounds(model: Model) -> dict[str, float]:
    """Return the largest lean that each of the three ways makes up for [rad]."""
    base = next(link for link in model.links if link.name == "base_link")
    momentum = base.inertial.inertia.ixx * RATE
    shapes = [leg(model, float(knee)) for knee in _KNEES]
    omega = min(each.omega for each in shapes)
    spin = max(momentum / each.inertia for each in shapes)
    aloft = max(momentum / each.own_inertia for each in shapes)
    knee = max(knee_effect(model, float(angle)) for angle in _KNEES) * RATE
    # What leans more in the plane than the knee makes up for does not come back.
    pitched = (knee + spin) / omega
    # An action of the knee throws the leg up, in the next one the base may spin until the leg lands.
    heights = np.array([each.height for each in shapes])
    thrown = RATE * float(np.abs(np.gradient(heights, _KNEES)).max())  # [m/s]
    in_the_air = min(2.0 * thrown / _GRAVITY / CONTROL_PERIOD, 1.0) / 2.0
    # One joint at a time: pitched in half of the time, turned in the other, by (RATE t / 2)^2 at most.
    turned = RATE**2 / (2.0 * omega**3) + RATE * pitched / omega**2
    return {
        "the base spins": spin / omega,
        "the plane turns, and the knee moves": knee * turned,
        "the base spins in the air": in_the_air * aloft / omega,
    }


def main() -> int:
    """Print the bound."""
    found = bounds(formats.load_model(assets.robot("monoped")))
    for name, lean in found.items():
        sys.stdout.write(f"{name}: {lean:.4f} rad\n")
    total = sum(found.values())
    share = max(0.0, 1.0 - total / START)
    sys.stdout.write(f"together: {total:.4f} rad; {share:.0%} of the starts lean more\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
