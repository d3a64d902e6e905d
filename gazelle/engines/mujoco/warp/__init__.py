"""MuJoCo on a graphics card: the MuJoCo engine, with steps and rays of MuJoCo Warp.

Everything here is imported only when the engine ``mujoco-warp`` is requested.
"""

from gazelle.engines.mujoco.installation import check_packages

check_packages()  # before anything here imports what may be missing

from gazelle.engines.mujoco.warp.engine import WarpEngine  # noqa: E402

__all__ = ["WarpEngine"]
