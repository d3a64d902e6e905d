"""Modules such as ``std_msgs.msg``, made of definitions, not of files."""

from __future__ import annotations

import importlib
import importlib.abc
import threading
import weakref
from collections.abc import Callable
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

from gazelle_ros.messages.errors import UnknownTypeError
from gazelle_ros.messages.registry import (
    after_register,
    load_message,
    load_service,
    package_names,
)

KINDS = ("msg", "srv")
"""Names of the modules of a package that hold its messages and its services."""
_HALVES = ("Request", "Response")


def has_definitions(package: str, kind: str) -> bool:
    """Return whether a package defines messages (``msg``) or services (``srv``)."""
    return bool(package_names(package, kind))


def has_messages_or_services(package: str) -> bool:
    """Return whether a package defines anything."""
    return any(has_definitions(package, kind) for kind in KINDS)


def _class_names(package: str, kind: str) -> list[str]:
    """Return the names of the classes in a module of messages or services."""
    found = package_names(package, kind)
    if kind == "msg":
        return found
    return [name + half for name in found for half in ("", *_HALVES)]


def _load(package: str, kind: str, name: str) -> Any:
    """Return a class by its name in a module.

    Raises:
        AttributeError: There is none.
    """
    full_name = f"{package}/{name}"
    try:
        if kind == "msg":
            return load_message(full_name)
        if name in package_names(package, "srv"):
            return load_service(full_name)
        for half in _HALVES:
            service = name.removesuffix(half)
            if service != name and service in package_names(package, "srv"):
                return load_message(full_name)
    except UnknownTypeError as error:
        raise AttributeError(str(error)) from None
    raise AttributeError(f"module '{package}.{kind}' has no attribute '{name}'")


_lock = threading.Lock()
_modules: weakref.WeakSet[DefinitionsModule] = weakref.WeakSet()


class DefinitionsModule(ModuleType):
    """Module of classes that are made on first access, and again after `register`."""

    def __init__(self, name: str, doc: str | None = None) -> None:
        super().__init__(name, doc)
        self._made: set[str] = set()
        with _lock:
            _modules.add(self)

    def forget(self) -> None:
        """Remove the classes; the next access queries the registry again."""
        for name in self._made:
            self.__dict__.pop(name, None)
        self._made.clear()

    def __getattr__(self, name: str) -> Any:
        package, kind = self.__name__.split(".")[-2:]
        if name == "__all__":
            return _class_names(package, kind)
        if name.startswith("_"):
            raise AttributeError(f"module '{self.__name__}' has no attribute '{name}'")
        with _lock:
            found = self.__dict__[name] = _load(package, kind, name)
            self._made.add(name)
        return found

    def __dir__(self) -> list[str]:
        package, kind = self.__name__.split(".")[-2:]
        return sorted({*super().__dir__(), *_class_names(package, kind)})


class MessageLoader(importlib.abc.Loader):
    """Loader of ``PACKAGE.msg``, ``PACKAGE.srv``, and the module of one class in them.

    Args:
        prefix: Package that they are below, with a full stop; empty at the top level.
    """

    def __init__(self, prefix: str = "") -> None:
        self._prefix = prefix

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """Create an empty module, or one for a class.

        Raises:
            ModuleNotFoundError: There is no such class.
        """
        package, kind, *member = spec.name.removeprefix(self._prefix).split(".")
        if not member:
            return DefinitionsModule(spec.name, f"The {kind} definitions of {package}.")
        name = member[0].removeprefix("_")
        module = ModuleType(spec.name, f"The class {name}.")
        try:
            self._fill(module, package, kind, name)
        except AttributeError as error:
            raise ModuleNotFoundError(str(error), name=spec.name) from None
        return module

    @staticmethod
    def _fill(module: ModuleType, package: str, kind: str, name: str) -> None:
        for each in (name,) if kind == "msg" else (name, *(name + half for half in _HALVES)):
            setattr(module, each, _load(package, kind, each))

    def exec_module(self, module: ModuleType) -> None:
        """Leave the module as it is: its classes are made on first use."""


def definitions_spec(fullname: str, prefix: str = "") -> ModuleSpec | None:
    """Return the spec of ``PACKAGE.msg``, ``PACKAGE.srv`` or of a module in them; None for others.

    Args:
        fullname: Name of the module.
        prefix: Package that it is below, with a full stop; empty at the top level.
    """
    package, _, rest = fullname.removeprefix(prefix).partition(".")
    kind, _, member = rest.partition(".")
    if kind not in KINDS or not has_definitions(package, kind):
        return None
    return ModuleSpec(fullname, MessageLoader(prefix), is_package=not member)


class PackageLoader(importlib.abc.Loader):
    """Loader of a package that has definitions and no Python code."""

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """Create an empty package."""
        return ModuleType(spec.name, f"The ROS package {spec.name.rpartition('.')[2]}.")

    def exec_module(self, module: ModuleType) -> None:
        """Import ``msg`` and ``srv`` on access."""
        package = module.__name__.rpartition(".")[2]
        module.__dict__["__getattr__"] = importing(module.__name__, package)


def importing(module: str, package: str) -> Callable[[str], ModuleType]:
    """Return the ``__getattr__`` of a package without definition files beside it.

    Args:
        module: Full name of the Python package.
        package: Name of the ROS package that has the definitions.
    """

    def find(name: str) -> ModuleType:
        if name not in KINDS or not has_definitions(package, name):
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        return importlib.import_module(f"{module}.{name}")

    return find


def _forget_all() -> None:
    with _lock:
        for module in _modules:
            module.forget()


after_register.append(_forget_all)
