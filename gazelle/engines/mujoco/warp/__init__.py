"""MuJoCo on a graphics card: the MuJoCo engine, whose steps and rays are MuJoCo Warp's.

Everything here is imported only when the engine ``mujoco-warp`` is asked for.
"""

from gazelle.engines.mujoco.installation import check_packages

check_packages()  # before anything here imports what may be missing

from gazelle.engines.mujoco.warp.engine import WarpEngine  # noqa: E402

__all__ = ["WarpEngine"]
