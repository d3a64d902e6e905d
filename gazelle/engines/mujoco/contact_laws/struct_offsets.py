"""Offsets of the fields of MuJoCo's structs, for the laws that are compiled (``struct_layout``)."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import cython

from gazelle.engines.mujoco.contact_laws.struct_layout import Offsets

if not cython.compiled:
    AT: Any = SimpleNamespace()


def fill(found: Offsets) -> None:
    """Store the offsets, before MuJoCo calls any law."""
    if cython.compiled:
        global AT  # noqa: PLW0603  # a structure of C, which has no other owner
        AT = found._asdict()
    else:
        AT.__dict__.update(found._asdict())  # type: ignore[used-before-def]
