"""State of a step and of a contact for contact laws; compiled modules have ``contact_data.pxd``.

A ``Touch`` has, of a step: addresses of the ``mjModel``, the ``mjData`` and the geoms' custom
numbers, the physics step [s], the strength of gravity [m/s²], whether friction is a ``cone`` or a
pyramid, whether Jacobians are ``sparse``, addresses of the numbers of all constraint rows, and the
accelerations of the step ``before``.

Of a contact: the address of the ``mjContact``, how many directions it acts in (``dim``), its first
``row``, its two ``geoms``, its ``frame`` (normal, first and second direction, in rows) and
``friction``, and from its first row on ``velocity``, ``reference`` (the acceleration that it is to
have), ``terms`` (four a row, of which the second is the damping) and ``jacobian``: as many numbers
a row as ``width`` says, for the velocities that ``columns`` lists where it is sparse.
"""

from __future__ import annotations

from typing import Any

from gazelle.native.interpreted import structure


def __getattr__(name: str) -> Any:
    """Build ``Touch`` when sources run in Python need it: it takes Cython, which users lack."""
    if name != "Touch":
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    globals()[name] = structure()
    return globals()[name]
