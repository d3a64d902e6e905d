"""What a plane without forces cannot do."""

# ruff: noqa: ARG002  # whatever is asked for is refused

from __future__ import annotations

from collections.abc import Sequence

from numpy.typing import ArrayLike

from gazelle.array_types import Worlds
from gazelle.engines.reactions import Contacts, Wrench
from gazelle.errors import EngineError


class Refusals:
    """The part of ``gazelle.engines.engine.Engine`` that needs forces."""

    @staticmethod
    def refuse(what: str) -> EngineError:
        """The error for something that the plane has not."""
        return EngineError(
            f"the planar engine knows no forces, so it has not {what}", hint="use the engine mujoco"
        )

    def set_link_wrench(
        self, link: str, force: ArrayLike, torque: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Refused."""
        raise self.refuse(f"a push on '{link}'")

    def set_joint_effort(self, joint: str, effort: ArrayLike, worlds: Worlds | None = None) -> None:
        """Refused."""
        raise self.refuse(f"an effort on '{joint}'")

    def joint_wrench(self, joint: str, worlds: Worlds | None = None) -> Wrench:
        """Refused."""
        raise self.refuse(f"what '{joint}' carries")

    def contacts(self, collisions: Sequence[str], world: int = 0) -> Contacts:
        """Refused."""
        raise self.refuse("contact points")

    def touching(
        self, collisions: Sequence[str], worlds: Worlds | None = None
    ) -> tuple[Worlds, Contacts]:
        """Refused."""
        raise self.refuse("contact points")

    def attach(
        self,
        parent: str,
        child: str,
        worlds: Worlds | None = None,
        settling: float | None = None,
    ) -> None:
        """Refused."""
        raise self.refuse(f"a joint between '{parent}' and '{child}'")

    def detach(self, parent: str, child: str, worlds: Worlds | None = None) -> None:
        """Refused."""
        raise self.refuse(f"a joint between '{parent}' and '{child}'")

    def set_parameter(
        self, kind: str, name: str, values: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Refused."""
        raise self.refuse(f"the parameter {kind}")
