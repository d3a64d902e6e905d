"""Modules of another version than ROS 1 Noetic has: they are adapted while `install` lasts.

``xacro`` of PyPI is that of ROS 2. Noetic has Python 3.8, PyYAML 5.3 and NumPy 1.17, and its scripts use
names that have been taken out since. Names are only added, but for functions that refuse old arguments.
"""

from __future__ import annotations

import contextlib
import functools
import importlib.abc
import sys
from collections import abc
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, ExitStack
from importlib.machinery import ModuleSpec, PathFinder
from types import ModuleType
from typing import Any

from gazelle_ros.base.xacro_engine import replaced

_BUILTINS = {
    "complex": complex,
    "float": float,
    "int": int,
    "long": int,
    "object": object,
    "str": str,
}
_RENAMED = {
    "Inf": "inf", "Infinity": "inf", "NAN": "nan", "NaN": "nan", "PINF": "inf", "alltrue": "all",
    "complex_": "complex128", "cumproduct": "cumprod", "float_": "float64", "infty": "inf",
    "int0": "intp", "product": "prod", "row_stack": "vstack", "sometrue": "any", "string_": "bytes_",
    "trapz": "trapezoid", "unicode_": "str_",
}  # fmt: skip
"""From a name of NumPy 1 to what it is called in NumPy 2."""


def _xacro(_: Any) -> AbstractContextManager[Any]:
    from gazelle_ros.builtin.xacro import as_in_ros1

    return as_in_ros1()


@contextlib.contextmanager
def _yaml(yaml: Any) -> Iterator[None]:
    """Allow ``load`` and ``load_all`` without a loader, as in PyYAML 5.

    They use the one for plain data then.
    """
    values = {}
    for name in ("load", "load_all"):
        plain = getattr(yaml, name)

        @functools.wraps(plain)
        def load(stream: Any, Loader: Any = None, plain: Any = plain) -> Any:  # noqa: N803
            return plain(stream, Loader or yaml.FullLoader)

        values[name] = load
    with replaced(vars(yaml), values):
        yield


@contextlib.contextmanager
def _numpy(numpy: Any) -> Iterator[None]:
    """Add the names of NumPy 1.17, and the binary mode of ``fromstring`` that images are read with."""
    plain = numpy.fromstring

    @functools.wraps(plain)
    def fromstring(string: Any, dtype: Any = float, count: int = -1, *, sep: str = "") -> Any:
        if sep == "":
            return numpy.frombuffer(string, dtype, count).copy()
        return plain(string, dtype, count, sep=sep)

    names = {old: getattr(numpy, new) for old, new in _RENAMED.items()} | _BUILTINS
    names["asscalar"] = lambda array: array.item()
    missing = {name: value for name, value in names.items() if name not in vars(numpy)}
    with replaced(vars(numpy), {**missing, "fromstring": fromstring}):
        yield


def _collections(collections: Any) -> AbstractContextManager[None]:
    """Add the abstract classes, which Python 3.10 took out of this module."""
    names = {name: getattr(abc, name) for name in abc.__all__ if not hasattr(collections, name)}
    return replaced(vars(collections), names)


_CHANGES: dict[str, Callable[[Any], AbstractContextManager[Any]]] = {
    "collections": _collections,
    "numpy": _numpy,
    "xacro": _xacro,
    "yaml": _yaml,
}
NAMES = frozenset(_CHANGES)

_changed = ExitStack()


def adapt() -> None:
    """Adapt the modules that have been imported already, until `restore`."""
    for name, change in _CHANGES.items():
        module = sys.modules.get(name)
        if hasattr(module, "__path__"):
            _changed.enter_context(change(module))


def restore() -> None:
    """Undo all changes."""
    _changed.close()


class AdaptingLoader(importlib.abc.Loader):
    """Loads a package as its own loader does, then adapts it."""

    def __init__(self, loader: importlib.abc.Loader) -> None:
        self._loader = loader

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        """Return the module, not yet executed."""
        return self._loader.create_module(spec)

    def exec_module(self, module: ModuleType) -> None:
        """Execute the package, and adapt it; its own loader gives its resources."""
        spec = module.__spec__
        if spec is not None:
            spec.loader = module.__loader__ = self._loader
        self._loader.exec_module(module)
        _changed.enter_context(_CHANGES[module.__name__](module))


def spec(name: str, path: Sequence[str] | None) -> ModuleSpec | None:
    """Return the spec of one of these packages; None if it is not there."""
    found = PathFinder.find_spec(name, path)
    if found is not None and found.loader is not None and found.submodule_search_locations:
        found.loader = AdaptingLoader(found.loader)
    return found
