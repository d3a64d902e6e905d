"""Table of all panels."""

from __future__ import annotations

from gazelle.viewer.graph.panels.bag_player import BagPlayerPanel
from gazelle.viewer.graph.panels.console import ConsolePanel
from gazelle.viewer.graph.panels.controllers import ControllersPanel
from gazelle.viewer.graph.panels.image_view import ImageViewPanel
from gazelle.viewer.graph.panels.joint_sliders import JointSlidersPanel
from gazelle.viewer.graph.panels.joint_trajectory import JointTrajectoryPanel
from gazelle.viewer.graph.panels.joystick import JoystickPanel
from gazelle.viewer.graph.panels.logger_levels import LoggerLevelPanel
from gazelle.viewer.graph.panels.node_graph import NodeGraphPanel
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle.viewer.graph.panels.plot import PlotPanel
from gazelle.viewer.graph.panels.publisher import PublisherPanel
from gazelle.viewer.graph.panels.reconfigure import ReconfigurePanel
from gazelle.viewer.graph.panels.service_caller import ServiceCallerPanel
from gazelle.viewer.graph.panels.steering import SteeringPanel
from gazelle.viewer.graph.panels.tf_tree import TfTreePanel
from gazelle.viewer.graph.panels.topic_monitor import TopicMonitorPanel

PANELS: dict[str, type[GraphPanel]] = {
    panel.title: panel
    for panel in (
        BagPlayerPanel,
        ConsolePanel,
        ControllersPanel,
        ImageViewPanel,
        JointSlidersPanel,
        JointTrajectoryPanel,
        JoystickPanel,
        LoggerLevelPanel,
        NodeGraphPanel,
        PlotPanel,
        PublisherPanel,
        ReconfigurePanel,
        ServiceCallerPanel,
        SteeringPanel,
        TfTreePanel,
        TopicMonitorPanel,
    )
}
"""Panels by title, in the order of the page."""
