"""ROS interface of stage_ros: topics, frames, services, the clock."""

from gazelle.bridges.stage.door import StageDoor
from gazelle.bridges.stage.serving import StageServer, serve_stage

__all__ = ["StageDoor", "StageServer", "serve_stage"]
