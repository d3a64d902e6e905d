"""Geoms of the world's own body, of which a city has a hundred thousand."""

from __future__ import annotations

from typing import Any

import mujoco

_FEW = 1000
"""Geoms that are added one by one."""
_TOGETHER = 4000
"""Geoms that are added in one go."""
_PREFIX = "mesh_"
"""Of names of what is added in one go, as MuJoCo gives them one. Names of meshes have it anyway."""


class WorldGeoms:
    """Adds geoms to the world's body of an ``MjSpec``.

    With each geom that is added MuJoCo lists all elements of the model anew, which is a quarter of
    a millisecond where there are fifty thousand. What is attached from another ``MjSpec`` is
    listed once. So all but the first geoms come in by thousands.
    """

    def __init__(self, spec: mujoco.MjSpec) -> None:
        self._spec = spec
        self._part: mujoco.MjSpec | None = None
        self._count = self._waiting = 0

    def add_geom(self, *, name: str, meshname: str | None = None, **options: Any) -> str:
        """Add a geom; the name that it has in the model.

        Args:
            name: As is wished.
            meshname: Of a mesh of ``ShapeBuilder``.
            options: As ``MjsBody.add_geom`` takes them.
        """
        self._count += 1
        mesh = {} if meshname is None else {"meshname": meshname}
        if self._count <= _FEW or "hfieldname" in options:
            self._spec.worldbody.add_geom(name=name, **mesh, **options)
            return name
        if meshname is not None:
            mesh["meshname"] = meshname.removeprefix(_PREFIX)
        if self._part is None:
            self._part = mujoco.MjSpec()
        self._part.worldbody.add_geom(name=name, **mesh, **options)
        self._waiting += 1
        if self._waiting == _TOGETHER:
            self.finish()
        return f"{_PREFIX}{name}"

    def finish(self) -> None:
        """Add what is still waiting."""
        if self._part is not None:
            self._spec.attach(self._part, frame=self._spec.worldbody.add_frame(), prefix=_PREFIX)
        self._part, self._waiting = None, 0
