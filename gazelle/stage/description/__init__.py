"""Description of Stage's worlds, models and devices: SI units and radians.

Recordings may contain the classes named here, through an entry point of the group
``gazelle.descriptions``.
"""

from gazelle.stage.description.contents import stage_model, stage_world
from gazelle.stage.description.devices import (
    StageActuator,
    StageBlinkenlight,
    StageBlobfinder,
    StageBumper,
    StageCamera,
    StageDevice,
    StageFiducial,
    StageGripper,
    StageLightIndicator,
    StagePosition,
    StageRanger,
    StageSensor,
)
from gazelle.stage.description.models import (
    PlacedStageModel,
    StageBitmap,
    StageBlock,
    StageController,
    StageGui,
    StageModel,
    StagePose,
    StagePower,
    StageReturns,
    StageSize,
    StageWindow,
    StageWorld,
)
from gazelle.stage.description.plugin import StagePlugin

__all__ = [
    "PlacedStageModel",
    "StageActuator",
    "StageBitmap",
    "StageBlinkenlight",
    "StageBlobfinder",
    "StageBlock",
    "StageBumper",
    "StageCamera",
    "StageController",
    "StageDevice",
    "StageFiducial",
    "StageGripper",
    "StageGui",
    "StageLightIndicator",
    "StageModel",
    "StagePlugin",
    "StagePose",
    "StagePosition",
    "StagePower",
    "StageRanger",
    "StageReturns",
    "StageSensor",
    "StageSize",
    "StageWindow",
    "StageWorld",
    "stage_model",
    "stage_world",
]
