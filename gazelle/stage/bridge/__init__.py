"""ROS interface of stage_ros: topics, frames, services, the clock."""

from gazelle.stage.bridge.interface import StageInterface
from gazelle.stage.bridge.serving import StageServer, serve_stage

__all__ = ["StageInterface", "StageServer", "serve_stage"]
