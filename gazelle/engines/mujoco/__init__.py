"""The 3-D engine: MuJoCo. Only this package knows MuJoCo's names and quaternion order."""

from pathlib import Path

from gazelle.engines.mujoco.installation import check_installation
from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

check_installation()  # before anything here imports a MuJoCo that may be half overwritten

from gazelle.engines.mujoco.compiler.mjcf import to_mjcf  # noqa: E402
from gazelle.engines.mujoco.engine import MujocoEngine  # noqa: E402

__all__ = ["MujocoEngine", "check_installation", "to_mjcf"]
