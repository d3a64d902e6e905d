"""Geoms of the world's own body, of which a city has hundreds of thousands."""

from __future__ import annotations

from typing import Any

import mujoco

_FEW = 1000
"""Geoms that are added one by one."""
_TOGETHER = 4000
"""Geoms that are added in one go."""
_PREFIX = "still_"
"""Prefix of attached names, required by MuJoCo. Nothing has a name by then."""


class WorldGeoms:
    """Adds geoms to the world's body of an ``MjSpec``.

    With each geom that is added MuJoCo lists all elements of the model again, which is a quarter of
    a millisecond where there are fifty thousand. What is attached from another ``MjSpec`` is
    listed once. So all but the first geoms come in by thousands. Of what is listed it is the names
    that take the time, so those are given at the end, to what was attached and to meshes.
    """

    def __init__(self, spec: mujoco.MjSpec) -> None:
        self._spec = spec
        self._part: mujoco.MjSpec | None = None
        self._count = self._waiting = 0
        self._later: list[tuple[Any, str, str]] = []

    def add_geom(self, *, name: str, meshname: str | None = None, **options: Any) -> str:
        """Add a geom; its name, which it has at the latest after ``finish``.

        Args:
            name: In the model.
            meshname: Of a mesh of the model.
            options: As ``MjsBody.add_geom`` takes them.
        """
        self._count += 1
        if self._count <= _FEW or "hfieldname" in options:
            mesh = {} if meshname is None else {"meshname": meshname}
            self._spec.worldbody.add_geom(name=name, **mesh, **options)
            return name
        if self._part is None:
            self._part = mujoco.MjSpec()
        geom = self._part.worldbody.add_geom(**options)
        self.name_later(geom, name)
        if meshname is not None:
            self._later.append((geom, "meshname", meshname))
        self._waiting += 1
        if self._waiting == _TOGETHER:
            self._attach()
        return name

    def name_later(self, element: Any, name: str) -> None:
        """Queue a name for an element of the model; ``finish`` sets it."""
        self._later.append((element, "name", name))

    def finish(self) -> None:
        """Add the queued geoms, and set names."""
        self._attach()
        for element, what, name in self._later:
            setattr(element, what, name)
        self._later.clear()

    def _attach(self) -> None:
        if self._part is not None:
            self._spec.attach(self._part, frame=self._spec.worldbody.add_frame(), prefix=_PREFIX)
        self._part, self._waiting = None, 0
