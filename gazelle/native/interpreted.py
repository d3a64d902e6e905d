"""Sources in Python of compiled modules, for debuggers and for comparison."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any, Final

_PREFIX: Final = "cython.cimports."


class _Cimports(MetaPathFinder, Loader):
    """``from cython.cimports.gazelle...`` is an ordinary import there."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return a spec for this package's modules only."""
        del path, target
        if not f"{fullname}.".startswith(f"{_PREFIX}gazelle."):
            return None
        return ModuleSpec(fullname, self, is_package=True)

    def exec_module(self, module: ModuleType) -> None:
        """Replace this module by the real one, where the import system looks for it."""
        name = module.__name__
        sys.modules[name] = importlib.import_module(name.removeprefix(_PREFIX))


def install() -> None:
    """Install the finder, once; it needs Cython, which has the types that sources name."""
    import cython  # noqa: F401

    from gazelle.native import c_math

    sys.modules["cython.cimports.libc.math"] = c_math
    cimports = sys.modules["cython.cimports"]
    cimports.__spec__ = ModuleSpec("cython.cimports", None, is_package=True)
    if not any(isinstance(finder, _Cimports) for finder in sys.meta_path):
        sys.meta_path.insert(0, _Cimports())


def structure() -> Any:
    """Return Python's substitute for a structure of C: it accepts any attribute.

    ``cython.declare(Type[1])`` makes one in sources, which C hands over by its address.
    """
    import cython

    class Structure(cython.struct()):  # type: ignore[misc]
        __setattr__ = object.__setattr__

        def __class_getitem__(cls, _: int) -> Any:
            return cls

    return Structure
