"""Whether MuJoCo Warp is installed, and beside the right MuJoCo.

``pip install mujoco-warp`` would bring ``mujoco`` with it, which owns the same folder as the
``mujoco-core`` that Gazelle asks for. So it is installed without what it asks for, and that apart.
"""

from __future__ import annotations

import importlib

from gazelle.engines.mujoco.installation import check_installation
from gazelle.errors import EngineError

HINT = (
    "install it with these two commands: 'pip install \"gazelle[warp]\"' and "
    "'pip install --no-deps \"mujoco-warp>=4\"'; without '--no-deps' pip would put another MuJoCo over "
    "Gazelle's"
)


def check_packages() -> None:
    """Raise what is missing or does not fit, if anything, and bring Warp up without a word.

    Raises:
        EngineError: A package is missing, cannot be imported, or another MuJoCo lies over Gazelle's.
    """
    check_installation()
    for package, module in (("warp-lang", "warp"), ("mujoco-warp", "mujoco_warp")):
        try:
            found = importlib.import_module(module)
        except (ImportError, OSError) as error:
            raise EngineError(
                f"the engine 'mujoco-warp' needs the package '{package}', which cannot be imported: "
                f"{error}",
                hint=HINT,
            ) from error
        if module == "warp":
            found.config.log_level = max(found.config.log_level, found.LOG_ERROR)
    if not hasattr(found, "OverflowType"):
        raise EngineError("this MuJoCo Warp is too old: Gazelle needs 4.0 or newer", hint=HINT)
