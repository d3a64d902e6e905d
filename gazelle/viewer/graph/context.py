"""Common context of all parts of the page of a graph."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from gazelle.viewer.graph.robots import DescribedRobot
from gazelle.viewer.page.server import PageServer
from gazelle.viewer.page.user_actions import UserActions
from gazelle_ros import Node, Time
from gazelle_ros.tf import FrameTree

if TYPE_CHECKING:
    from viser import GuiApi, SceneApi, ViserServer

_FIXED = ("map", "odom", "world", "base_link", "base_footprint")


@dataclass
class GraphContext(UserActions):
    """Access of the parts of a page to the graph.

    Attributes:
        node: Of the page, on the graph.
        server: Of the page.
        tree: Frames of the graph.
        robots: Robots of the graph by the parameters of their descriptions.
        requested_frame: Fixed frame; "" for the first there is of map, odom, world, base_link.
    """

    node: Node
    server: PageServer
    tree: FrameTree = field(default_factory=FrameTree)
    robots: dict[str, DescribedRobot] = field(default_factory=dict)
    requested_frame: str = ""

    @property
    def page(self) -> ViserServer:  # type: ignore[override]
        """Server of viser."""
        return self.server.viser

    @property
    def scene(self) -> SceneApi:
        """Scene of the page."""
        return self.page.scene

    @property
    def gui(self) -> GuiApi:
        """Panel of the page."""
        return self.page.gui

    @property
    def fixed(self) -> str:
        """Frame that stands still."""
        if self.requested_frame:
            return self.requested_frame
        names = self.tree.names()
        return next((name for name in _FIXED if name in names), names[0] if names else "map")

    def stamp(self) -> Time:
        """Return the graph's time: with simulated time that of the latest transform.

        ``/clock`` would do too, but a thousand messages a second cost more than the page.
        """
        if self.node.get_param("/use_sim_time", default=False) is not True:
            return Time(0, self.node.clock.now())
        latest = (cache.latest() for _, _, cache in self.tree.known())
        return Time(0, max((found[0] for found in latest if found), default=0))
