"""ROS messages and services as modules that editors and type checkers know.

::

    from gazelle_ros.msgs import geometry_msgs

    command = geometry_msgs.msg.Twist()
    command.linear.x = 0.2

A script for ROS needs only the prefix: ``from gazelle_ros.msgs.geometry_msgs.msg import Twist``.
The classes are those of `gazelle_ros.load_message`. The stubs in this folder describe the bundled
packages; they are written by ``tools/message_stubs.py``. Packages on ROS_PACKAGE_PATH can be
imported as well, without types.
"""

from __future__ import annotations

import importlib.abc
import sys
from collections.abc import Sequence
from importlib.machinery import ModuleSpec
from types import ModuleType

from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.messages.library import bundled_packages
from gazelle_ros.messages.modules import (
    PackageLoader,
    definitions_spec,
    has_messages_or_services,
)

_PREFIX = f"{__name__}."


def _is_package(name: str) -> bool:
    if name in bundled_packages():  # definitions are read when a class is made
        return True
    return has_messages_or_services(name)


class _Finder(importlib.abc.MetaPathFinder):
    """Finder of the modules below this package."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return the spec of a package, of its messages or services, or of one of their modules.

        Raises:
            ModuleNotFoundError: Nothing is known of such a package.
        """
        del path, target
        if not fullname.startswith(_PREFIX):
            return None
        package, _, rest = fullname.removeprefix(_PREFIX).partition(".")
        found = definitions_spec(fullname, _PREFIX)
        if found is not None:
            return found
        if not rest and _is_package(package):
            return ModuleSpec(fullname, PackageLoader(), is_package=True)
        hint = "" if rest else did_you_mean(package, bundled_packages())
        raise ModuleNotFoundError(
            f"No module named {fullname!r}" + (hint and f"; {hint}"), name=fullname
        )


def __dir__() -> list[str]:
    return sorted({*globals(), *bundled_packages()})


sys.meta_path.insert(0, _Finder())
