"""The part of PyKDL that scripts use for frames; chains, solvers and trees are not here."""

from gazelle.ros.compat.PyKDL.difference import addDelta, diff
from gazelle.ros.compat.PyKDL.frame import Frame
from gazelle.ros.compat.PyKDL.motion import Twist, Wrench
from gazelle.ros.compat.PyKDL.rotation import Rotation
from gazelle.ros.compat.PyKDL.vector import Vector, dot

__all__ = ["Frame", "Rotation", "Twist", "Vector", "Wrench", "addDelta", "diff", "dot"]
