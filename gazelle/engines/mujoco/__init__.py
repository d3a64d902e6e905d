"""The 3-D engine: MuJoCo. Only this package knows MuJoCo's names and quaternion order."""

from gazelle.engines.mujoco.engine import MujocoEngine

__all__ = ["MujocoEngine"]
