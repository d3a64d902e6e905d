"""Camera views of an engine's worlds in their present state."""

from __future__ import annotations

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Worlds
from gazelle.description import Model
from gazelle.engines import Engine
from gazelle.errors import EngineError
from gazelle.rendering.lens import PinholeLens
from gazelle.rendering.renderer import Frames, Renderer


@checked(EngineError)
class LiveScene:
    """Renderer of an engine's worlds; its scene is cached while the models stay the same.

    Args:
        engine: Knows where the links are.
        gamma: See ``Renderer``.

    Attributes:
        shadows: Whether things throw shadows, in the pictures of cameras too; off at first.
    """

    def __init__(self, engine: Engine, *, gamma: float = 1.0) -> None:
        self._engine, self._gamma = engine, gamma
        self._models: tuple[Model, ...] = ()
        self._links: tuple[str, ...] = ()
        self._renderer: Renderer | None = None
        self.shadows = False

    @property
    def renderer(self) -> Renderer:
        """Renderer of the present models."""
        world = self._engine.world
        if self._renderer is None or self._models is not world.models:
            self._models = world.models
            self._renderer = Renderer(world, nworld=self._engine.nworld, gamma=self._gamma)
            known = set(self._engine.links.names)
            self._links = tuple(link for link in self._renderer.links if link in known)
        self._renderer.shadows = self.shadows
        return self._renderer

    def render(
        self,
        lens: PinholeLens,
        positions: Floats,
        quaternions: Floats,
        worlds: Worlds | None = None,
        *,
        want: tuple[str, ...],
    ) -> Frames:
        """Render one camera in each of some worlds now; see ``Renderer.render``."""
        renderer = self.renderer
        place = self._engine.links[self._links].placement(worlds)
        renderer.place_all(self._links, place.position, place.quaternion, worlds)
        chosen = np.arange(self._engine.nworld) if worlds is None else worlds
        return renderer.render(lens, positions, quaternions, chosen, want=want)
