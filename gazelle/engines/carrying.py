"""What engines have that take controllers of joints into their steps."""

from __future__ import annotations

from collections.abc import Sequence
from inspect import getattr_static
from typing import Protocol, cast, runtime_checkable

from gazelle.engines.engine import Engine
from gazelle.native.joint_system import JointSystem


@runtime_checkable
class CarryingEngine(Protocol):
    """What an engine has whose steps bring systems that command joints, in native code."""

    @property
    def revision(self) -> int:
        """Counts changes of models: systems then have to be bound to joints anew."""

    @property
    def carries(self) -> bool:
        """Whether it can, the way it integrates."""

    def expect_systems(self) -> None:
        """Be ready to carry systems: what has to be compiled for that is."""

    def bind_joints(self, system: JointSystem, joints: Sequence[str]) -> None:
        """Say where joints are, good for one ``revision``.

        Args:
            system: To be told.
            joints: Scoped names, each with one axis.
        """

    def read_joints(self, system: JointSystem) -> None:
        """Tell a bound system where its joints are now."""

    def push_joints(self, system: JointSystem) -> None:
        """Let act what a bound system says."""


def as_carrying_engine(engine: Engine) -> CarryingEngine | None:
    """An engine that is one of these; None for another.

    ``isinstance`` asks for all properties, and so would have a world compiled before its plugins
    have been loaded.
    """
    names = [name for name in vars(CarryingEngine) if not name.startswith("_")]
    has_all = all(getattr_static(engine, name, None) is not None for name in names)
    return cast("CarryingEngine", engine) if has_all else None
