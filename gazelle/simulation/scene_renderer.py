"""Pictures of a running simulation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.description import Model, Pose
from gazelle.engines.tracer import Tracer, make_tracer
from gazelle.sensors import View, range_image, render
from gazelle.simulation.running_state import RunningState


class SceneRenderer:
    """Renderer of a running world; its scene is cached while the models stay the same."""

    def __init__(self) -> None:
        self._models: tuple[Model, ...] = ()
        self._tracer: Tracer | None = None

    def picture(self, simulation: RunningState, view: View, world: int) -> NDArray[np.uint8]:
        """Render one world, shape (height, width, 3)."""
        return render(self._placed(simulation, world), simulation.engine.world, view)

    def ranges(self, simulation: RunningState, view: View, world: int) -> NDArray[np.float64]:
        """Render distances to the surfaces of a picture, shape (height, width)."""
        return range_image(self._placed(simulation, world), view)

    def _placed(self, simulation: RunningState, world: int) -> Tracer:
        """Return a tracer of one world in its present state."""
        engine = simulation.engine
        if self._tracer is None or self._models is not engine.world.models:
            self._models, self._tracer = engine.world.models, make_tracer(engine.world)
        names = engine.links.names
        found = engine.links[names].placement(np.array([world]))
        self._tracer.place(
            {
                name: Pose.from_quaternion(tuple(place), tuple(turned))
                for name, place, turned in zip(
                    names, found.position[0].tolist(), found.quaternion[0].tolist(), strict=True
                )
            }
        )
        return self._tracer
