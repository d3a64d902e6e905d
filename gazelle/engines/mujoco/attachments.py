"""Hold links of MuJoCo's worlds together."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Worlds
from gazelle.engines.limits import LONGEST_STEP
from gazelle.engines.motion import Placement
from gazelle.engines.mujoco.compiler.welds import Attachment
from gazelle.engines.mujoco.state import rows_of
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.engines.state import LinkRow, LinkRows
from gazelle.engines.table import Table
from gazelle.errors import EngineError
from gazelle.rotations import conjugate, multiply, rotate


class LinkHolding:
    """Attachments of links; see ``gazelle.engines.engine.Engine``.

    Args:
        run: Worlds that run.
        links: Links of all models.
    """

    def __init__(self, run: RunningWorlds, links: Table[LinkRow, LinkRows]) -> None:
        self._run, self._links = run, links

    def attach(
        self,
        parent: str,
        child: str,
        worlds: Worlds | None = None,
        settling: float | None = None,
    ) -> None:
        """Attach two links at their present relative pose; see the protocol."""
        if settling is not None and not 0.0 < settling <= LONGEST_STEP:
            raise EngineError(
                f"the settling time must be positive, not {settling} s", hint="above 0"
            )
        pair = Attachment(parent, child, settling)
        ends = [self._run.up_to_date().link(link).body for link in (parent, child)]
        if ends[0] == ends[1]:
            raise EngineError(f"'{parent}' and '{child}' cannot move against each other anyway")
        layout = self._run.prepare(pair)
        base, held = self._body_placement(parent, worlds), self._body_placement(child, worlds)
        back = conjugate(base.quaternion)
        position = rotate(back, held.position - base.position)
        pose = np.concatenate((position, multiply(back, held.quaternion)), axis=1)
        self._run.set_parameter("attachment", pair.name, pose, worlds)
        self._run.batch.eq_active[rows_of(worlds), layout.attachments[pair.name]] = 1.0

    def _body_placement(self, link: str, worlds: Worlds | None) -> Placement:
        """Return the pose of MuJoCo's body of a link: the world's at the origin."""
        place = self._links[link].placement(worlds)
        if self._run.layout.link(link).body != 0:
            return place
        upright = np.zeros_like(place.quaternion)
        upright[:, 3] = 1.0
        return Placement(np.zeros_like(place.position), upright)

    def detach(self, parent: str, child: str, worlds: Worlds | None = None) -> None:
        """Detach two links that ``attach`` holds together."""
        name = Attachment(parent, child).name
        layout = self._run.up_to_date()
        if name not in layout.attachments:
            raise EngineError(f"'{child}' was never attached to '{parent}'")
        self._run.batch.eq_active[rows_of(worlds), layout.attachments[name]] = 0.0
