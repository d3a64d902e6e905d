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
_ASSETS = ("meshname", "hfieldname")
"""Options that name what is in the model, not in the part."""


class WorldGeoms:
    """Adds geoms to the world's body of an ``MjSpec``.

    With each geom that is added MuJoCo lists all elements of the model again, which is a quarter of
    a millisecond where there are fifty thousand. What is attached from another ``MjSpec`` is
    listed once. So all but the first geoms come in by thousands, after all else is added. Of what
    is listed it is the names that take the time, so those are given at the end, to what was
    attached and to meshes.
    """

    def __init__(self, spec: mujoco.MjSpec) -> None:
        self._spec = spec
        self._parts: list[mujoco.MjSpec] = []
        self._count = 0
        self._later: list[tuple[Any, str, str]] = []

    def add_geom(self, *, name: str, **options: Any) -> str:
        """Add a geom; its name, which it has at the latest after ``finish``.

        Args:
            name: In the model.
            options: As ``MjsBody.add_geom`` takes them.
        """
        self._count += 1
        if self._count <= _FEW:
            self._spec.worldbody.add_geom(name=name, **options)
            return name
        if (self._count - _FEW) % _TOGETHER == 1 or not self._parts:
            self._parts.append(mujoco.MjSpec())
        assets = [(each, options.pop(each)) for each in _ASSETS if each in options]
        geom = self._parts[-1].worldbody.add_geom(**options)
        self.name_later(geom, name)
        self._later += [(geom, what, asset) for what, asset in assets]
        return name

    def name_later(self, element: Any, name: str) -> None:
        """Queue a name for an element of the model; ``finish`` sets it."""
        self._later.append((element, "name", name))

    def finish(self) -> None:
        """Add the queued geoms, and set names."""
        for part in self._parts:
            self._spec.attach(part, frame=self._spec.worldbody.add_frame(), prefix=_PREFIX)
        self._parts.clear()
        for element, what, name in self._later:
            setattr(element, what, name)
        self._later.clear()
