"""The 3-D engine: MuJoCo. Only this package knows MuJoCo's names and quaternion order."""

from gazelle.engines.mujoco.engine import MujocoEngine
from gazelle.engines.mujoco.mjcf import to_mjcf

__all__ = ["MujocoEngine", "to_mjcf"]
