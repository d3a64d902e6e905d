"""The 3-D engine: MuJoCo. Only this package knows MuJoCo's names and quaternion order."""

from gazelle.engines.mujoco.installation import check_installation

check_installation()  # before anything here imports a MuJoCo that may be half overwritten

from gazelle.engines.mujoco.compiler.mjcf import to_mjcf  # noqa: E402
from gazelle.engines.mujoco.engine import MujocoEngine  # noqa: E402

__all__ = ["MujocoEngine", "check_installation", "to_mjcf"]
