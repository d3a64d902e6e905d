"""Links held together at run time: welds that can be switched on in each world."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import mujoco

from gazelle.kinematics.tree import TreeLink

# A weld is as stiff as MuJoCo allows: a time constant of two physics steps would be the
# limit of stability, three leave room for what hangs on it.
WELD_STEPS = 3.0


@dataclass(frozen=True, slots=True)
class Attachment:
    """Two links that can be held together.

    Attributes:
        parent: Scoped name of the link that is held to.
        child: Scoped name of the link that is held.
        settling: Time constant with which they come together [s]; None for as stiff as can be.
    """

    parent: str
    child: str
    settling: float | None = None

    @property
    def name(self) -> str:
        """The name of the weld."""
        return f"{self.parent}>{self.child}"

    @property
    def arguments(self) -> tuple[str | float, ...]:
        """Arguments that make an equal attachment."""
        ends = self.parent, self.child
        return ends if self.settling is None else (*ends, self.settling)

    def is_of(self, model: str) -> bool:
        """Return whether one of the links is a model's."""
        return any(link.startswith(f"{model}::") for link in (self.parent, self.child))


def add_attachments(
    spec: mujoco.MjSpec,
    attachments: tuple[Attachment, ...],
    bodies: Mapping[str, list[TreeLink]],
) -> None:
    """Add a weld, inactive at first, to the model for every pair.

    One that settles is critically damped: after that time constant a gap is down to 74 %, after
    three of them to 20 %. A static link is part of MuJoCo's world body, which is what the other is then held to.
    """
    roots = {body.name: body.root for parts in bodies.values() for body in parts}
    for pair in attachments:
        parent, child = (
            "world" if roots[link] == "static" else link for link in (pair.parent, pair.child)
        )
        spec.add_equality(
            name=pair.name,
            type=mujoco.mjtEq.mjEQ_WELD,
            objtype=mujoco.mjtObj.mjOBJ_BODY,
            name1=parent,
            name2=child,
            active=False,
            solref=[pair.settling or WELD_STEPS * spec.option.timestep, 1.0],
        )
