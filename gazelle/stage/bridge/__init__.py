"""ROS interface of stage_ros: topics, frames, services, the clock."""

from gazelle.stage.bridge.door import StageDoor
from gazelle.stage.bridge.serving import StageServer, serve_stage

__all__ = ["StageDoor", "StageServer", "serve_stage"]
