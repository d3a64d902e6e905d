"""Makes the modules of ROS 1 importable, without touching the ones that may be installed.

Five kinds of names are answered: modules this package has (``rospy``), packages with definitions
(``std_msgs``, ``std_msgs.msg``), modules made by ``.cfg`` files (``demo.cfg.DemoConfig``), the Python
code of packages on ROS_PACKAGE_PATH, and, where the user has none, those that installed packages
register as entry points of the group ``gazelle_ros.modules`` (``openai_ros``, ``gym``).
"""

from __future__ import annotations

import importlib
import importlib.abc
import importlib.util
import sys
from collections.abc import Sequence
from functools import cache
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from types import ModuleType

from gazelle_ros.base.entry_points import entry_points_of
from gazelle_ros.compat import namesakes, workspace_code
from gazelle_ros.compat.cfg_modules import CfgLoader, has_cfg
from gazelle_ros.messages.library import bundled_packages
from gazelle_ros.messages.modules import (
    MessageLoader,
    PackageLoader,
    definitions_spec,
    has_messages_or_services,
    importing,
)

HOME = "gazelle_ros.compat"
GROUP = "gazelle_ros.modules"
"""Entry points: names of modules that stand in for missing ones, and where they are."""
_COMPILED = frozenset({"moveit_ros_planning_interface"})
"""Of C++ where they are installed, for a Python that is not this one: ours come first."""


@cache
def own_modules() -> frozenset[str]:
    """Return names of the top-level modules of ROS that this package has itself."""
    folder = Path(__file__).parent
    private = {
        "__init__",
        "commands",
        "finder",
        "import_errors",
        "module_hints",
        "cfg_modules",
        "python2",
        "script",
        "setup_files",
        "workspace_code",
        "namesakes",
    }
    found = {path.stem for path in folder.glob("*.py")} - private
    return frozenset(found | {path.parent.name for path in folder.glob("*/__init__.py")})


@cache
def substitutes() -> dict[str, str]:
    """Return where the top-level modules are that replace a user's own, if those are missing.

    It is called for missing modules only: reading entry points takes time and imports modules.
    """
    return {name: point.value for name, point in entry_points_of(GROUP).items()}


def place_of(name: str) -> str:
    """Return the module of Gazelle, or of another package, that a module of ROS is."""
    top, dot, rest = name.partition(".")
    own = top in own_modules() or top not in substitutes()
    return f"{HOME}.{name}" if own else f"{substitutes()[top]}{dot}{rest}"


class AliasLoader(importlib.abc.Loader):
    """Loads a module of Gazelle under the name it has in ROS."""

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """Return the module itself, so that there is only one under any name."""
        module = importlib.import_module(place_of(spec.name))
        self._spec = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        """Undo the import system's changes of the module.

        ``from actionlib import msg`` finds messages.
        """
        name = module.__spec__.name if module.__spec__ is not None else ""
        module.__spec__ = self._spec
        if not hasattr(module, "__getattr__") and has_messages_or_services(name):
            module.__dict__["__getattr__"] = importing(name, name)


class CopyLoader(importlib.abc.Loader):
    """Loads a module that has what another one has.

    Args:
        place: The other one; a substitute names it in its table ``PLACES``.
    """

    def __init__(self, place: str) -> None:
        self._place = place

    def exec_module(self, module: ModuleType) -> None:
        """Fill the module."""
        names = vars(importlib.import_module(self._place)).items()
        module.__dict__.update({name: value for name, value in names if name[:2] != "__"})


class RosFinder(importlib.abc.MetaPathFinder):
    """Finds the modules of ROS."""

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,
        target: ModuleType | None = None,
    ) -> ModuleSpec | None:
        """Return the spec of a module; None if it is not one of ROS."""
        del target
        found = definitions_spec(fullname)
        if found is not None:
            return found
        package, _, rest = fullname.partition(".")
        kind, _, member = rest.partition(".")
        if kind == "cfg" and has_cfg(package):
            return ModuleSpec(fullname, CfgLoader(), is_package=not member)
        if package in own_modules():
            if importlib.util.find_spec(f"{HOME}.{fullname}") is None:
                return None
            return ModuleSpec(fullname, AliasLoader())
        if fullname in namesakes.NAMES:
            return namesakes.spec(fullname, path)
        if rest:
            return _below_a_substitute(package, fullname) or self._run_on_worker(fullname, path)
        if package in _COMPILED:
            return ModuleSpec(package, AliasLoader())
        return self._package(package, path)

    @staticmethod
    def _run_on_worker(name: str, path: Sequence[str] | None) -> ModuleSpec | None:
        """Return the spec of a module of a package, if the module lies in another folder."""
        named = workspace_code.named_spec(name)
        return named if named is not None and PathFinder.find_spec(name, path) is None else None

    @staticmethod
    def _package(name: str, path: Sequence[str] | None) -> ModuleSpec | None:
        """Return a package's own Python code, the user's first; an empty module without any.

        Gazelle has the definitions of many packages, but the code of few: that of ``openai_ros``,
        say, is the user's.
        """
        other = PathFinder.find_spec(name, path)
        plain = other is not None and other.loader is not None
        named = None
        if other is None or not plain or workspace_code.comes_after(other):
            named = workspace_code.named_spec(name)
        if plain or named is not None:
            return named  # without it, it is found without us
        usual = workspace_code.usual_spec(name)
        if usual is not None:
            return usual
        if name not in sys.stdlib_module_names and name in substitutes():
            return ModuleSpec(name, AliasLoader())
        if _known(name):
            return ModuleSpec(name, PackageLoader(), is_package=True)
        return None


def _below_a_substitute(package: str, fullname: str) -> ModuleSpec | None:
    """Return the spec of a module in a substitute package, unless the user has the package."""
    parent = sys.modules.get(package)
    real = getattr(parent, "__name__", package)
    if real == package or real != substitutes().get(package):
        return None
    places, name = getattr(parent, "PLACES", {}), fullname.partition(".")[2]
    if name in places:
        return ModuleSpec(fullname, CopyLoader(places[name]), is_package=True)
    if name.rpartition(".")[0] in places:  # what is in a copy is in the table, too
        return None
    if importlib.util.find_spec(place_of(fullname)) is None:
        return None
    return ModuleSpec(fullname, AliasLoader())


def _known(package: str) -> bool:
    return has_messages_or_services(package) or has_cfg(package)


LOADERS = (AliasLoader, CopyLoader, MessageLoader, CfgLoader, PackageLoader)
_finder = RosFinder()
_uses = 0
_hidden: dict[str, ModuleType] = {}


def _is_builtin_program(name: str) -> bool:
    """Return True for a name below one that this finder answers at the top level."""
    top = name.partition(".")[0]
    return top in own_modules() or top in bundled_packages()


def _is_alias(name: str, real: str) -> bool:
    """Return whether a module of Gazelle is registered under a name of ROS."""
    return real != name and real == place_of(name)


class Installed:
    """Result of `install`: at the end of a ``with`` block, the installation is undone."""

    def __enter__(self) -> None:
        """Do nothing: it is installed already."""

    def __exit__(self, *error: object) -> None:
        uninstall()


def install() -> Installed:
    """Install the import hook: ``import rospy`` and its like import Gazelle's.

    It may be called more than once; as many calls of `uninstall` undo it. As a context manager it
    undoes itself.
    """
    global _uses  # noqa: PLW0603  # there is one import system
    _uses += 1
    if _uses == 1:
        for name in [name for name in sys.modules if _is_builtin_program(name)]:
            _hidden[name] = sys.modules.pop(name)
        namesakes.adapt()
        sys.meta_path.insert(0, _finder)
    return Installed()


def uninstall() -> None:
    """Undo `install`; modules that were imported stay."""
    global _uses  # noqa: PLW0603  # there is one import system
    if not _uses:
        return
    _uses -= 1
    if _uses:
        return
    sys.meta_path.remove(_finder)
    namesakes.restore()
    for name, module in list(sys.modules.items()):
        loader = getattr(getattr(module, "__spec__", None), "loader", None)
        alias = _is_alias(name, getattr(module, "__name__", ""))
        if alias or isinstance(loader, LOADERS):
            del sys.modules[name]
    sys.modules.update(_hidden)
    _hidden.clear()
